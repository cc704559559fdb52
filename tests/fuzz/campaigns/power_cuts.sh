#!/usr/bin/env bash
# Power cuts at every word of a commit, of which `./dev check` takes those where the kind of damage changes and one in
# fifteen of the rest. Takes minutes, whatever SECONDS says.
set -euo pipefail
cmake --preset host -DASTROLABE_TESTS=ON >/dev/null
cmake --build build/host --target target.power_cut.test
ASTRO_CUT_EVERY_WORD=1 build/host/tests/target.power_cut.test --gtest_filter='*PowerCut*'
