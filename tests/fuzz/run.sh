#!/usr/bin/env bash
# Power cuts at every word of a commit; then the property tests of everything that reads foreign bytes, with new random
# seeds, under ASan and UBSan.
#   run.sh SECONDS      a failing seed is printed; RC_PARAMS="seed=N" repeats it
set -euo pipefail
cd "$(dirname "$0")/../.."
seconds=$1
cmake --preset host-asan -DASTROLABE_TESTS=ON >/dev/null
cmake --build build/host-asan --target common.protocol.test common.params.test common.fixed.test
cmake --preset host -DASTROLABE_TESTS=ON >/dev/null
cmake --build build/host --target target.power_cut.test
ASTRO_CUT_EVERY_WORD=1 build/host/tests/target.power_cut.test --gtest_filter='*PowerCut*'  # minutes
tests/fuzz/kill.sh
tests/fuzz/fail.sh
end=$((SECONDS + seconds))
rounds=0
while ((SECONDS < end)); do
  seed=$((RANDOM * 32768 + RANDOM))
  for program in common.protocol common.params common.fixed; do
    RC_PARAMS="seed=$seed max_success=2000" "build/host-asan/tests/$program.test" >build/fuzz.log 2>&1 || {
      cat build/fuzz.log
      echo "$program fails with RC_PARAMS=\"seed=$seed max_success=2000\""
      exit 1
    }
  done
  rounds=$((rounds + 1))
done
echo "$rounds rounds of new seeds, no failure"
