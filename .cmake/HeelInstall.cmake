# What is installed where, and the Debian packages made of it (see docs/command.md, "Install").

include(CMakePackageConfigHelpers)

# A static library would need everything it is built on wherever it is used: not installed.
set(HEEL_INSTALL OFF)
if(PROJECT_IS_TOP_LEVEL AND BUILD_SHARED_LIBS AND NOT HEEL_SANITIZE)
  set(HEEL_INSTALL ON)
endif()

set(HEEL_CONFIG_DIR "${CMAKE_INSTALL_LIBDIR}/cmake/heel")
set(HEEL_DATA_DIR "${CMAKE_INSTALL_DATADIR}/heel")

# Under /usr the loader looks in the right place by itself; anywhere else, an installed tree can be
# moved as a whole.
if(NOT CMAKE_INSTALL_PREFIX STREQUAL "/usr")
  file(RELATIVE_PATH bin_to_lib "${CMAKE_INSTALL_FULL_BINDIR}" "${CMAKE_INSTALL_FULL_LIBDIR}")
  set(CMAKE_INSTALL_RPATH "$ORIGIN;$ORIGIN/${bin_to_lib}")
endif()

# Installs the library heel::NAME as the component NAME of find_package(heel), and the headers of
# its folder.
function(heel_install_module name)
  install(TARGETS heel_${name} EXPORT heel-${name}
    LIBRARY DESTINATION "${CMAKE_INSTALL_LIBDIR}"
      COMPONENT runtime NAMELINK_COMPONENT development)
  file(RELATIVE_PATH folder "${PROJECT_SOURCE_DIR}" "${CMAKE_CURRENT_SOURCE_DIR}")
  install(DIRECTORY "${CMAKE_CURRENT_SOURCE_DIR}/"
    DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}/heel/${folder}" COMPONENT development
    FILES_MATCHING PATTERN "*.hpp")
  install(EXPORT heel-${name} FILE heel-${name}-targets.cmake NAMESPACE heel::
    DESTINATION "${HEEL_CONFIG_DIR}" COMPONENT development)
endfunction()

# Installs the heel command, what it reads (scenes, plans and robots), its workflow, and what
# completes its calls in bash and zsh, where Debian's look for it; the command itself writes that.
function(heel_install_command)
  install(TARGETS heel_command RUNTIME COMPONENT runtime)
  set(completions "${PROJECT_BINARY_DIR}/completions")
  file(MAKE_DIRECTORY "${completions}")
  add_custom_command(TARGET heel_command POST_BUILD
    COMMAND heel_command completion bash > "${completions}/heel"
    COMMAND heel_command completion zsh > "${completions}/_heel" VERBATIM)
  install(FILES "${completions}/heel" COMPONENT runtime
    DESTINATION "${CMAKE_INSTALL_DATADIR}/bash-completion/completions")
  install(FILES "${completions}/_heel" COMPONENT runtime
    DESTINATION "${CMAKE_INSTALL_DATADIR}/zsh/vendor-completions")
  install(DIRECTORY "${PROJECT_SOURCE_DIR}/apps/scenes" "${PROJECT_SOURCE_DIR}/apps/plans"
    "${PROJECT_SOURCE_DIR}/apps/robots" "${PROJECT_SOURCE_DIR}/apps/batch"
    DESTINATION "${HEEL_DATA_DIR}" COMPONENT runtime)
endfunction()

# Makes and installs heel(1) and a page for each verb.
function(heel_man_pages)
  find_program(HEEL_HELP2MAN help2man REQUIRED)
  find_program(HEEL_GZIP gzip REQUIRED)
  set(pages "${PROJECT_BINARY_DIR}/man1")
  set(script "${PROJECT_SOURCE_DIR}/.cmake/man_pages.cmake")
  add_custom_command(OUTPUT "${pages}/heel.1.gz"
    COMMAND "${CMAKE_COMMAND}" "-DHEEL=$<TARGET_FILE:heel_command>" "-DPAGES=${pages}"
      "-DVERSION=${PROJECT_VERSION}" "-DHELP2MAN=${HEEL_HELP2MAN}" "-DGZIP=${HEEL_GZIP}"
      -P "${script}"
    DEPENDS heel_command "${script}" COMMENT "Making man pages of the heel command's help" VERBATIM)
  add_custom_target(heel_man_pages ALL DEPENDS "${pages}/heel.1.gz")
  if(HEEL_INSTALL)
    install(DIRECTORY "${pages}/" DESTINATION "${CMAKE_INSTALL_MANDIR}/man1" COMPONENT runtime
      FILES_MATCHING PATTERN "*.1.gz")
  endif()
endfunction()

if(NOT HEEL_INSTALL)
  return()
endif()

configure_package_config_file(
  "${CMAKE_CURRENT_LIST_DIR}/heel-config.cmake.in" "${PROJECT_BINARY_DIR}/heel-config.cmake"
  INSTALL_DESTINATION "${HEEL_CONFIG_DIR}" PATH_VARS HEEL_DATA_DIR NO_SET_AND_CHECK_MACRO)
write_basic_package_version_file("${PROJECT_BINARY_DIR}/heel-config-version.cmake"
  COMPATIBILITY SameMinorVersion)
install(
  FILES "${PROJECT_BINARY_DIR}/heel-config.cmake" "${PROJECT_BINARY_DIR}/heel-config-version.cmake"
  DESTINATION "${HEEL_CONFIG_DIR}" COMPONENT development)
