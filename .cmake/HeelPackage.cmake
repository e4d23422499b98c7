# The Debian packages, made by CPack: heel (the command, its data, the shared libraries) and
# heel-dev (what one needs to build with the libraries).

set(HEEL_CONTACT "The Heel authors <heel@example.org>" CACHE STRING "Who maintains the packages")
set(release 1)
set(control_folder "${PROJECT_BINARY_DIR}/debian")

file(WRITE "${control_folder}/triggers" "activate-noawait ldconfig\n")

# What Debian wants to read of every package.
string(TIMESTAMP today "%a, %d %b %Y %H:%M:%S +0000" UTC)
file(WRITE "${control_folder}/changelog.Debian"
  "heel (${PROJECT_VERSION}-${release}) unstable; urgency=medium\n\n"
  "  * See changelog.gz.\n\n -- ${HEEL_CONTACT}  ${today}\n")
configure_file("${PROJECT_SOURCE_DIR}/CHANGELOG.md" "${control_folder}/changelog" COPYONLY)
foreach(text changelog.Debian changelog)
  file(ARCHIVE_CREATE OUTPUT "${control_folder}/${text}.gz" PATHS "${control_folder}/${text}"
    FORMAT raw COMPRESSION GZip COMPRESSION_LEVEL 9)
endforeach()
file(READ "${PROJECT_SOURCE_DIR}/LICENSE" licence)
file(READ "${PROJECT_SOURCE_DIR}/apps/pages/assets/uplot/LICENSE" uplot_licence)
file(WRITE "${control_folder}/copyright" "${licence}\n\n"
  "The command's reports contain uPlot (https://github.com/leeoniya/uPlot):\n\n${uplot_licence}\n")
foreach(package "heel;runtime" "heel-dev;development")
  list(GET package 0 name)
  list(GET package 1 component)
  set(folder "${CMAKE_INSTALL_DATADIR}/doc/${name}")
  install(FILES "${control_folder}/changelog.Debian.gz" "${control_folder}/changelog.gz"
    DESTINATION "${folder}" COMPONENT ${component})
  install(FILES "${control_folder}/copyright" DESTINATION "${folder}" COMPONENT ${component})
endforeach()

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME heel)
set(CPACK_PACKAGE_CONTACT "${HEEL_CONTACT}")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "person following for mobile robots")
set(CPACK_PACKAGING_INSTALL_PREFIX "${CMAKE_INSTALL_PREFIX}")
set(CPACK_STRIP_FILES ON)
set(CPACK_VERBATIM_VARIABLES ON)
set(CPACK_COMPONENTS_ALL runtime development)

set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_RELEASE "${release}")
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS ON)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)

set(CPACK_DEBIAN_RUNTIME_PACKAGE_NAME heel)
set(CPACK_DEBIAN_RUNTIME_PACKAGE_SECTION science)
set(CPACK_DEBIAN_RUNTIME_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_RUNTIME_PACKAGE_CONTROL_EXTRA "${control_folder}/triggers")
set(CPACK_COMPONENT_RUNTIME_DESCRIPTION
"A camera and a laser see a person; the robot learns what they look like and
follows them. This package holds the heel command, which runs the whole on
recordings and in simulated homes, its scenes and plans, and the libraries.")

# What the libraries' headers and the CMake config ask for.
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME heel-dev)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS
  "heel (= ${PROJECT_VERSION}-${release}), libeigen3-dev, libopencv-dev, libpcl-dev, liboctomap-dev")
set(CPACK_COMPONENT_DEVELOPMENT_DESCRIPTION
"Headers and CMake files for programs that use Heel's libraries, such as its
colour filter for PCL's point clouds.")

include(CPack)
