#!/usr/bin/env bash
# Installs what is missing, builds, and runs the tests.
#   ./test.sh            the whole suite, optimised
#   ./test.sh asan       the same under a preset: release, debug, asan, tsan
# Further words go to ctest: ./test.sh release -L tracking
set -euo pipefail
cd "$(dirname "$0")"

preset=${1:-release}
[ $# -gt 0 ] && shift

.ci/setup test
cmake --preset "$preset" --log-level=WARNING
cmake --build --preset "$preset"
ctest --preset "$preset" --parallel "$(nproc)" "$@"
