#!/usr/bin/env bash
# All tests, each with all that it can do: every place where power can be cut, a thousand mutations of each sample, films of whole
# experiments, claims about the median of many robots. `./dev test` takes a share of it, and says what it left out. Takes most of an
# hour, whatever SECONDS says.
set -euo pipefail
cmake --preset host -DASTROLABE_TESTS=ON >/dev/null
cmake --build build/host
ended=0
ASTROLABE_THOROUGH=1 ctest --test-dir build/host -j "$(nproc)" --output-on-failure || ended=$?
tests/ci/summary.sh build/host/Testing/Temporary/LastTest.log
exit "$ended"
