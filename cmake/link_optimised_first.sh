#!/usr/bin/env bash
# Links a test program: link_optimised_first.sh COMPILER ARGUMENTS...
# An inline function or a template that is not inlined is compiled into each object that uses it, and the linker keeps the copy
# that it reads first. Those of the tests are not optimised, and if they came first, all that is tested would call them: with
# Eigen that is twenty times as slow, and not what ships. So the libraries are read before the tests' objects, and what these
# call is said beforehand, because the linker takes from a library only what has been called already.
set -euo pipefail

objects=() modules=() support=()
for word in "${@:2}"; do
  case $word in
    /*) ;;  # Debian's
    *.o) objects+=("$word") ;;
    tests/*.a) support+=("$word") ;;
    *.a) modules+=("$word") ;;
  esac
done

calls=$(mktemp)
trap 'rm -f "$calls"' EXIT
{
  nm --format=posix --extern-only "${objects[@]}"
  if [[ ${#support[@]} != 0 ]]; then nm --format=posix --undefined-only "${support[@]}"; fi
} | awk '$2 == "U" { called[$1] } $2 ~ /^[^Uvw]$/ { defined[$1] }
         END { for (name in called) if (!(name in defined)) print "-Wl,-u," name }' >"$calls"
"$1" "@$calls" -Wl,--start-group "${modules[@]}" "${support[@]}" -Wl,--end-group "${@:2}"
