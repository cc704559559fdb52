#!/usr/bin/env bash
# Every system call by which record, upload and umbmark change something fails in turn, and every place where they
# allocate memory gets none.
#   fail.sh      at most ASTROLABE_FAILURES of each kind and command, spread over all of them (300); all of them are
#                some 28,000 runs
set -euo pipefail
cmake --preset host -DASTROLABE_TESTS=ON >/dev/null
cmake --build build/host --target host.campaign.test
log=$(mktemp)
trap 'rm -f "$log"' EXIT
if ! ASTRO_FAILURES=${ASTROLABE_FAILURES:-300} build/host/tests/host.campaign.test --gtest_filter='*Fails*' >"$log" 2>&1; then
  cat "$log"
  exit 1
fi
grep ' told$' "$log"
