#!/usr/bin/env bash
# Fails if an object file computes in floating point, or if it calls the heap or libm. Moves through vector
# registers are fine: compilers copy structures with them.
set -euo pipefail
arithmetic='(add|sub|mul|div|sqrt|min|max|ucomi|comi|round|fn?madd[0-9]*|cmp[a-z]*)(ss|sd|ps|pd)$|^v?cvt|^f(ild|ist|add|sub|mul|div|sqrt|ld|st|com|ucom)'
objdump -d --no-show-raw-insn "$@" | awk -v pattern="$arithmetic" '
  /^[0-9a-f]+ <.*>:$/ { name = $0; sub(/^[0-9a-f]+ </, "", name); sub(/>:$/, "", name); functions++ }
  /^ +[0-9a-f]+:/ { if ($2 ~ pattern) { print "float arithmetic in " name ": " $0; bad = 1 } }
  END {
    if (functions == 0) { print "no code found: nothing was checked"; exit 1 }
    if (!bad) print functions " functions, integers only"
    exit bad
  }' || exit 1
if nm -u "$@" | grep -E ' U (malloc|calloc|realloc|free|_Znw|_Zna|_Zdl|_Zda|sin|cos|tan|atan|sqrt|pow|exp|log|floor|ceil|round|__cxa_throw)' ; then
  echo "the symbols above reach for the heap, libm or exceptions"
  exit 1
fi
