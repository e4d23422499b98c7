# Installs what was built into a folder of its own, and uses it as others do: ctest -L consumer.

set(root "${PROJECT_BINARY_DIR}/consumer")
set(prefix "${root}/prefix")

# consumer_test(NAME [NEEDS fixture] [MAKES fixture] COMMAND ...)
function(consumer_test name)
  cmake_parse_arguments(PARSE_ARGV 1 T "" "NEEDS;MAKES" "COMMAND")
  add_test(NAME "Consumer.${name}" COMMAND ${T_COMMAND})
  set_tests_properties("Consumer.${name}" PROPERTIES LABELS consumer TIMEOUT 600
    FIXTURES_REQUIRED "${T_NEEDS}" FIXTURES_SETUP "${T_MAKES}")
endfunction()

consumer_test(StartsFromNothing MAKES nothing COMMAND "${CMAKE_COMMAND}" -E rm -rf "${root}")
consumer_test(Installs NEEDS nothing MAKES installed
  COMMAND "${CMAKE_COMMAND}" --install "${PROJECT_BINARY_DIR}" --prefix "${prefix}")
consumer_test(BuildsAndRuns NEEDS installed
  COMMAND "${CMAKE_CTEST_COMMAND}"
    --build-and-test "${CMAKE_CURRENT_SOURCE_DIR}/consumer" "${root}/build"
    --build-generator "${CMAKE_GENERATOR}"
    --build-options "-DCMAKE_PREFIX_PATH=${prefix}" "-DCMAKE_BUILD_TYPE=${CMAKE_BUILD_TYPE}"
      "-DCMAKE_CXX_COMPILER=${CMAKE_CXX_COMPILER}"
      "-DCMAKE_CXX_COMPILER_LAUNCHER=${CMAKE_CXX_COMPILER_LAUNCHER}"
    --test-command "${CMAKE_CTEST_COMMAND}" --output-on-failure --no-tests=error)
set_tests_properties(Consumer.BuildsAndRuns PROPERTIES PROCESSORS 2)
if(HEEL_BUILD_APPS)
  consumer_test(InstalledCommandFindsItsScenes NEEDS installed
    COMMAND "${prefix}/${CMAKE_INSTALL_BINDIR}/heel" map home --out "${root}/map")
endif()
