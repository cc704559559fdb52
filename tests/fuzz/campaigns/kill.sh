#!/usr/bin/env bash
# SIGKILL at system calls spread over every command that writes, and over the simulator and the emulator that keep
# their flash in a file.
#   kill.sh      ASTROLABE_KILLS of each (50; or at each of its calls where they are fewer), 500 in all at least, whatever
#                seconds they take; the seed is printed, and ASTROLABE_SEED repeats it
set -euo pipefail
kills=${ASTROLABE_KILLS:-50}
seed=${ASTROLABE_SEED:-$((RANDOM * 32768 + RANDOM))}
cmake --preset host -DASTROLABE_TESTS=ON >/dev/null
cmake --build build/host --target host.campaign.test
log=$(mktemp)
trap 'rm -f "$log"' EXIT
if ! ASTROLABE_THOROUGH=1 ASTRO_KILLS=$kills ASTRO_SEED=$seed build/host/tests/host.campaign.test --gtest_filter='*Killed*:*FlashFile*' \
  >"$log" 2>&1; then
  cat "$log"
  echo "fails with ASTROLABE_KILLS=$kills ASTROLABE_SEED=$seed"
  exit 1
fi
grep ' kills over ' "$log"
sed -n 's/.*: \([0-9]*\) kills over .*/\1/p' "$log" | awk -v seed="$seed" '
  { sum += $1 }
  END {
    print sum " kills, seed " seed ", nothing lost and nothing mixed"
    if (sum < 500) { print "these are fewer than 500: give ASTROLABE_KILLS more"; exit 1 }
  }'
