# How a module of Heel is built, and with which flags.

# With the base, a file that another build or clone has compiled is not compiled again.
find_program(HEEL_CCACHE ccache)
if(HEEL_CCACHE AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
  set(CMAKE_CXX_COMPILER_LAUNCHER
    "${CMAKE_COMMAND}" -E env "CCACHE_BASEDIR=${PROJECT_SOURCE_DIR}" "${HEEL_CCACHE}")
endif()

# Our own code's flags; private to the build tree, never exported.
add_library(heel_flags INTERFACE)
target_compile_options(heel_flags INTERFACE
  -Wall -Wextra -Wpedantic -Wconversion -Wshadow -Woverloaded-virtual
  $<$<CXX_COMPILER_ID:Clang>:-Wno-sign-conversion>)
if(HEEL_SANITIZE)
  # Eigen allocates in its own way under a sanitizer, unlike in Debian's PCL, with which we exchange
  # dynamic vectors; malloc's memory is aligned well enough.
  target_compile_definitions(heel_flags INTERFACE EIGEN_MALLOC_ALREADY_ALIGNED=1)
  target_compile_options(heel_flags INTERFACE
    -fsanitize=${HEEL_SANITIZE} -fno-sanitize-recover=all -fno-omit-frame-pointer
    # Instrumented code makes gcc see uninitialized values in the standard library itself.
    $<$<CXX_COMPILER_ID:GNU>:-Wno-maybe-uninitialized>)
  target_link_options(heel_flags INTERFACE -fsanitize=${HEEL_SANITIZE})
endif()

# Headers are included as <heel/tracking/tracker.hpp>, in the tree and where Heel is installed: the
# build has a folder "heel" with a link to each folder of sources.
set(HEEL_INCLUDE "${PROJECT_BINARY_DIR}/include")
file(MAKE_DIRECTORY "${HEEL_INCLUDE}/heel")
foreach(folder cloud segmentation tracking mapping planning apps)
  file(CREATE_LINK "${PROJECT_SOURCE_DIR}/${folder}" "${HEEL_INCLUDE}/heel/${folder}" SYMBOLIC)
endforeach()

# heel_alone(FILES...) keeps files out of unity builds, which the presets ask for: eight files of a
# target are then compiled as one, so that the headers of PCL, Eigen and OpenCV are read once. From
# nothing, the command takes 7.5 minutes of one core; after a change of one file, 5 seconds and not
# 2 or 3. What two files have in their unnamed namespaces needs two names, or one of them is alone.
function(heel_alone)
  set_source_files_properties(${ARGN} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
endfunction()

# heel_module(NAME SOURCES ... PUBLIC targets... PRIVATE targets... [COMMAND_ONLY])
# makes the library heel::NAME from the current folder. It is installed with its headers as the
# component NAME of the package heel, unless it is COMMAND_ONLY: then it is a part of the heel
# command and nothing else.
function(heel_module name)
  cmake_parse_arguments(PARSE_ARGV 1 M "COMMAND_ONLY" "" "SOURCES;PUBLIC;PRIVATE")
  set(kind "")
  if(M_COMMAND_ONLY)
    set(kind STATIC)
  endif()
  add_library(heel_${name} ${kind} ${M_SOURCES})
  add_library(heel::${name} ALIAS heel_${name})
  set_target_properties(heel_${name} PROPERTIES
    EXPORT_NAME ${name} POSITION_INDEPENDENT_CODE ON CXX_EXTENSIONS OFF
    # Until 1.0 a minor version may change the binary interface.
    VERSION ${PROJECT_VERSION} SOVERSION ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR}
    DEFINE_SYMBOL "")  # the same command line, and ccache entry, for a shared and a static library
  target_include_directories(heel_${name} PUBLIC
    "$<BUILD_INTERFACE:${HEEL_INCLUDE}>" "$<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>")
  target_compile_features(heel_${name} PUBLIC cxx_std_17)
  target_link_libraries(heel_${name}
    PUBLIC ${M_PUBLIC} PRIVATE ${M_PRIVATE} $<BUILD_INTERFACE:heel_flags>)
  if(HEEL_INSTALL AND NOT M_COMMAND_ONLY)
    heel_install_module(${name})
  endif()
endfunction()
