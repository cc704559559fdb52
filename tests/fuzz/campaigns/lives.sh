#!/usr/bin/env bash
# Random lives of random robots, under ASan and UBSan: after three seconds of silence the bridges are open,
# and a stop holds.
#   lives.sh      ASTROLABE_LIVES of them (10,000), whatever seconds they take, from ASTROLABE_LIVES_SEED on; and as many
#                 drives that another host halts, while the first one goes on to ask for motion
set -euo pipefail
cmake --preset host-asan -DASTROLABE_TESTS=ON >/dev/null
cmake --build build/host-asan --target scenario.test
export ASTROLABE_LIVES=${ASTROLABE_LIVES:-10000}
export ASTROLABE_LIVES_SEED=${ASTROLABE_LIVES_SEED:-$((RANDOM * 32768 + RANDOM))}
export ASTROLABE_STOPS=$ASTROLABE_LIVES ASTROLABE_STOPS_SEED=$ASTROLABE_LIVES_SEED
build/host-asan/tests/scenario.test --gtest_filter='Lives.*:StopHolds.*'
