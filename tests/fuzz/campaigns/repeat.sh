#!/usr/bin/env bash
# Shows that no test depends on load or luck: all tests again and again beside busy loops, and each test of programs,
# ptys, sockets and peers more often, several at a time.
#   repeat.sh SECONDS      for each of both parts, but each test once at least. ASTROLABE_REPEATS and ASTROLABE_PROGRAM_REPEATS say how
#                          often instead; ASTROLABE_BUSY how many loops are beside (4); ASTROLABE_TESTS which programs of the
#                          second part (a pattern of ctest)
set -euo pipefail
seconds=$1
repeats=${ASTROLABE_REPEATS:-0}
program_repeats=${ASTROLABE_PROGRAM_REPEATS:-0}
programs=${ASTROLABE_TESTS:-'^(host\.(campaign|live|programs|robot|simulation|truth)|target\.program)'}
cmake --preset host -DASTROLABE_TESTS=ON >/dev/null
cmake --build build/host
folder=build/repeat
rm -rf "$folder"
mkdir -p "$folder"

loops=()
trap 'if ((${#loops[@]})); then kill "${loops[@]}" 2>/dev/null; fi' EXIT
for ((i = 0; i < ${ASTROLABE_BUSY:-4}; ++i)); do
  (while :; do :; done) &
  loops+=($!)
done

failures=0
once() { # what, number, further ctest arguments
  local log=$folder/$1.$2.log begin=$SECONDS what=$1 number=$2
  shift 2
  ctest --test-dir build/host --output-on-failure "$@" >"$log" 2>&1 || true
  local failed
  failed=$(sed -n 's/^[ \t]*[0-9]* - \(.*\) (\(Failed\|Timeout\|SEGFAULT\|Subprocess aborted\|Not Run\).*)/\1/p' "$log")
  echo "$what $number: $(grep -E 'tests? (passed|failed)' "$log" || tail -n 1 "$log"), $((SECONDS - begin)) s"
  if [[ -n $failed ]]; then
    printf '  failed: %s\n' "$failed"
    failures=$((failures + $(wc -l <<<"$failed")))
  fi
  if ! grep -q '^100% tests passed' "$log"; then failed_runs=$((failed_runs + 1)); fi
}

failed_runs=0
repeat() { # what, how often (0: until the seconds have passed), further ctest arguments
  local what=$1 most=$2 number=0 end=$((SECONDS + seconds))
  shift 2
  while ((number < most || (most == 0 && (number == 0 || SECONDS < end)))); do
    number=$((number + 1))
    once "$what" "$number" "$@"
  done
}
repeat all "$repeats" -j "$((2 * $(nproc)))"
repeat programs "$program_repeats" -j "$((2 * $(nproc)))" -R "$programs"
echo "$failed_runs runs in which a test failed, $failures failures beside ${#loops[@]} busy loops; logs are in $folder"
exit $((failed_runs > 0))
