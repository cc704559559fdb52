#!/usr/bin/env bash
# All tests that can run under ASan and UBSan, with the real programs as processes, of which `./dev check` takes those of boards,
# firmware and libraries. Takes half an hour, whatever SECONDS says.
set -euo pipefail
cmake --preset host-asan -DASTROLABE_TESTS=ON -DASTROLABE_SANITIZE_ALL=ON >/dev/null
cmake --build build/host-asan --target astro_tests
ended=0
ctest --test-dir build/host-asan -j "$(nproc)" --output-on-failure || ended=$?
tests/ci/summary.sh build/host-asan/Testing/Temporary/LastTest.log
exit "$ended"
