#!/usr/bin/env bash
# What a run of the tests leaves unsaid: which seeds its random tests printed, and what was left out and why.
#   summary.sh build/host/Testing/Temporary/LastTest.log
set -euo pipefail
awk '
  function counted(number, word) { return number " " word (number == 1 ? "" : "s") }
  /^[0-9]+\/[0-9]+ Testing: / { name = $0; sub(/^[^:]*: /, "", name); program = name; sub(/: .*/, "", program); reason = 0; next }
  # GoogleTest says why on the line below.
  / Skipped$/ && /:[0-9]+: / { getline; gsub(/[^ ]*\/shared\//, "../shared/"); ++left[$0]; ++reason; next }
  /^skipped: / { ++left[substr($0, 10)]; next }
  /^\[  SKIPPED \] [0-9]+ tests?(\.|, listed below:)$/ && !reason { left["its program does not say why"] += $3; next }
  tolower($0) ~ /seed/ {
    text = tolower($0)
    while (match(text, /seeds?[ =:]+[0-9]+( to [0-9]+)?/)) {
      seed = substr(text, RSTART, RLENGTH)
      text = substr(text, RSTART + RLENGTH)
      sub(/^seeds?[ =:]+/, "", seed)
      if (!((program, seed) in known)) { known[program, seed]; seeds[program] = seeds[program] " " seed }
    }
  }
  END {
    for (program in seeds) printf "seeds of %s:%s\n", program, seeds[program] | "sort"
    close("sort")
    for (why in left) { total += left[why]; printf "left out %s: %s\n", counted(left[why], "test"), why | "sort" }
    close("sort")
    print counted(total + 0, "test") " left out"
  }' "$1"
