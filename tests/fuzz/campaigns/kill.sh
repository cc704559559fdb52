#!/usr/bin/env bash
# SIGKILL at system calls spread over every command that writes, and over the simulator that keeps its flash in a file.
#   kill.sh      ASTROLABE_KILLS of them at least (600), whatever seconds they take; the seed is printed, and
#                ASTROLABE_SEED repeats it
set -euo pipefail
kills=${ASTROLABE_KILLS:-600}
seed=${ASTROLABE_SEED:-$((RANDOM * 32768 + RANDOM))}
cmake --preset host -DASTROLABE_TESTS=ON >/dev/null
cmake --build build/host --target host.campaign.test
log=$(mktemp)
trap 'rm -f "$log"' EXIT
if ! ASTRO_KILLS=$kills ASTRO_SEED=$seed build/host/tests/host.campaign.test --gtest_filter='*Killed*:FlashFile*' \
  >"$log" 2>&1; then
  cat "$log"
  echo "fails with ASTROLABE_KILLS=$kills ASTROLABE_SEED=$seed"
  exit 1
fi
grep ' kills over ' "$log"
sed -n 's/.*: \([0-9]*\) kills over .*/\1/p' "$log" |
  awk -v seed="$seed" '{ sum += $1 } END { print sum " kills, seed " seed ", nothing lost and nothing mixed" }'
