#!/usr/bin/env bash
# SIGKILL at system calls spread over every command that writes, and over the simulator that keeps its flash in a file.
#   kill.sh [KILLS] [SEED]      at least KILLS of them (600); the seed is printed, and repeats them
set -euo pipefail
cd "$(dirname "$0")/../.."
kills=${1:-600}
seed=${2:-$((RANDOM * 32768 + RANDOM))}
cmake --preset host -DASTROLABE_TESTS=ON >/dev/null
cmake --build build/host --target host.campaign.test
log=$(mktemp)
trap 'rm -f "$log"' EXIT
if ! ASTRO_KILLS=$kills ASTRO_SEED=$seed build/host/tests/host.campaign.test --gtest_filter='*Killed*:FlashFile*' \
  >"$log" 2>&1; then
  cat "$log"
  echo "kill.sh $kills $seed fails"
  exit 1
fi
grep ' kills over ' "$log"
sed -n 's/.*: \([0-9]*\) kills over .*/\1/p' "$log" |
  awk -v seed="$seed" '{ sum += $1 } END { print sum " kills, seed " seed ", nothing lost and nothing mixed" }'
