# The Debian packages, made by CPack: heel (the command, its data, the shared libraries) and
# heel-dev (what one needs to build with the libraries).

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME heel)
set(HEEL_CONTACT "The Heel authors <heel@example.org>" CACHE STRING "Who maintains the packages")
set(CPACK_PACKAGE_CONTACT "${HEEL_CONTACT}")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "person following for mobile robots")
set(CPACK_PACKAGING_INSTALL_PREFIX "${CMAKE_INSTALL_PREFIX}")
set(CPACK_STRIP_FILES ON)
set(CPACK_VERBATIM_VARIABLES ON)
set(CPACK_COMPONENTS_ALL runtime development)

set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_RELEASE 1)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)

set(CPACK_DEBIAN_RUNTIME_PACKAGE_NAME heel)
set(CPACK_DEBIAN_RUNTIME_PACKAGE_SECTION science)
set(CPACK_DEBIAN_RUNTIME_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_RUNTIME_PACKAGE_GENERATE_SHLIBS ON)
set(CPACK_DEBIAN_RUNTIME_PACKAGE_GENERATE_SHLIBS_POLICY "=")
set(CPACK_COMPONENT_RUNTIME_DESCRIPTION
"A camera and a laser see a person; the robot learns what they look like and
follows them. This package holds the heel command, which runs the whole on
recordings and in simulated homes, its scenes and plans, and the libraries.")

# What the libraries' headers and the CMake config ask for.
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME heel-dev)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS
  "heel (= ${PROJECT_VERSION}-1), libeigen3-dev, libopencv-dev, libpcl-dev, liboctomap-dev")
set(CPACK_COMPONENT_DEVELOPMENT_DESCRIPTION
"Headers and CMake files for programs that use Heel's libraries, such as its
colour filter for PCL's point clouds: find_package(heel COMPONENTS segmentation).")

include(CPack)
