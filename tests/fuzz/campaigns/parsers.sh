#!/usr/bin/env bash
# libFuzzer on every parser of foreign bytes, under ASan and UBSan, one target after the other.
#   parsers.sh SECONDS [TARGET...]     for each target; prints executions, coverage (edges) and the corpus
# The corpus stays in build/fuzz-corpus and grows from run to run. What breaks a parser is left in build/fuzz-corpus/
# TARGET.found/; build/fuzz/fuzz/fuzz.TARGET FILE repeats it.
set -euo pipefail
cd "$(dirname "$0")/../../.."
seconds=$1
shift
cmake --preset fuzz >/dev/null
if [[ $# == 0 ]]; then
  cmake --build build/fuzz --target fuzz_targets
  programs=(build/fuzz/fuzz/fuzz.*)
else
  cmake --build build/fuzz --target "${@/#/fuzz.}"
  programs=("${@/#/build/fuzz/fuzz/fuzz.}")
fi
export UBSAN_OPTIONS=print_stacktrace=1
if [[ -d /dev/shm && -z ${TMPDIR:-} ]]; then export TMPDIR=/dev/shm; fi  # for parsers that take a path
failed=0
for program in "${programs[@]}"; do
  name=${program##*/fuzz.}
  corpus=build/fuzz-corpus/$name
  mkdir -p "$corpus" "$corpus.found"
  "$program" --seeds "$corpus"
  if ! "$program" "$corpus" -max_total_time="$seconds" -max_len=65536 -len_control=20 -timeout=5 -rss_limit_mb=1024 \
    -malloc_limit_mb=512 -print_final_stats=1 -artifact_prefix="$corpus.found/" >"$corpus.log" 2>&1; then
    tail -n 60 "$corpus.log"
    failed=1
  fi
  executions=$(sed -n 's/^stat::number_of_executed_units: *//p' "$corpus.log")
  edges=$(grep -o 'cov: [0-9]*' "$corpus.log" | tail -n 1)
  features=$(grep -o 'ft: [0-9]*' "$corpus.log" | tail -n 1)
  echo "$name: ${executions:-?} executions, ${edges:-cov: ?} edges, ${features:-ft: ?} features," \
    "$(find "$corpus" -type f | wc -l) inputs kept, $(find "$corpus.found" -type f | wc -l) findings ever"
done
exit "$failed"
