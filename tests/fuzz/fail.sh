#!/usr/bin/env bash
# Every system call by which record, upload and umbmark change something fails in turn, and every place where they
# allocate memory gets none.
#   fail.sh [FAILURES]      at most so many of each kind and command, spread over all of them (all)
set -euo pipefail
cd "$(dirname "$0")/../.."
cmake --preset host -DASTROLABE_TESTS=ON >/dev/null
cmake --build build/host --target host.campaign.test
log=$(mktemp)
trap 'rm -f "$log"' EXIT
if ! ASTRO_FAILURES=${1:-1000000} build/host/tests/host.campaign.test --gtest_filter='*Fails*' >"$log" 2>&1; then
  cat "$log"
  exit 1
fi
grep ' told$' "$log"
