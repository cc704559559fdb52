#!/usr/bin/env bash
# How large the rooms, files and functions are: figures for a reader, no test. Of the tests it counts the rooms. usage: house.sh [--long]
#   --long  also lists the longest functions
set -euo pipefail
cd "$(dirname "$0")/../.."
sources() { git ls-files 'common/*.[ch]pp' 'firmware/*.[ch]pp' 'hal/*.[ch]pp' 'host/*.[ch]pp'; }

# An idea is a header with its source, or either alone.
ideas_by_room() { sed 's/\.[ch]pp$//' | sort -u | sed 's|/[^/]*$||' | sort | uniq -c | sort -rn; }
rooms=$(sources | ideas_by_room)
test_rooms=$(git ls-files 'tests/*.[ch]pp' | ideas_by_room)
largest() { head -1 <<<"$1" | awk '{ print $1 " ideas (" $2 ")" }'; }
# The sources are formatted by clang-format, so a function ends with a brace at the indent at which its first line began,
# and what opens a brace at that indent is a function unless it says otherwise.
lengths=$(sources | xargs awk '
  FNR == 1 { start = 0 }
  {
    match($0, /^ */); indent = RLENGTH
    if (start && indent == depth && $0 ~ /^ *\}[;,)]*$/) { print FNR - start + 1, FILENAME ":" start; start = 0; first = 0; next }
    if (start) next
    if ($0 ~ /^ *(\/\/|#|$)/ || $0 ~ /^ *(public|private|protected):/) { first = 0; next }
    if (!first) { first = FNR; depth = indent; text = "" }
    text = text $0
    if ($0 ~ /\{$/) {
      if (text ~ /\(/ && text !~ /^ *(namespace|class|struct|enum|union|extern)[ {]/ && text !~ /[=(,] *\{$/) start = first
      else first = 0
    } else if ($0 ~ /\}[;]?$/ && text ~ /\(.*\).*\{/) { print FNR - first + 1, FILENAME ":" first; first = 0 }
    else if ($0 ~ /[;,:]$/ && $0 ~ /;$/) first = 0
    else if ($0 ~ /^ *\};?$/) first = 0
  }' | sort -n)
count=$(wc -l <<<"$lengths")
at() { sed -n "$((($count * $1 + 99) / 100))p" <<<"$lengths" | cut -d' ' -f1; }
large=$(sources | xargs wc -l | awk '$2 != "total" && $1 > 250' | sort -rn)

echo "rooms:     $(wc -l <<<"$rooms"), largest $(largest "$rooms"); of tests $(wc -l <<<"$test_rooms"), largest $(largest "$test_rooms")"
echo "functions: $count, median $(at 50) lines, 90th percentile $(at 90), longest $(tail -1 <<<"$lengths" | awk '{ print $1 " (" $2 ")" }')"
echo "files:     $(sources | wc -l), over 250 lines: $([[ $large ]] && wc -l <<<"$large" || echo 0)"
[[ $large ]] && sed 's/^ */           /' <<<"$large"
if [[ ${1:-} == --long ]]; then tail -20 <<<"$lengths" | sort -rn | sed 's/^/           /'; fi
