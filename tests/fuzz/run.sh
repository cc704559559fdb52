#!/usr/bin/env bash
# Runs campaigns one after the other; each is a script of its own in campaigns/, which gets the seconds that it may take
# for each of its parts.
#   run.sh SECONDS [NAME...]     all of them where no name is given
set -euo pipefail
cd "$(dirname "$0")/../.."
seconds=$1
shift
names=("$@")
if [[ ${#names[@]} == 0 ]]; then
  for script in tests/fuzz/campaigns/*.sh; do names+=("$(basename "$script" .sh)"); done
fi
for name in "${names[@]}"; do
  if [[ ! -f tests/fuzz/campaigns/$name.sh ]]; then
    echo "there is no campaign '$name'; there are: $(cd tests/fuzz/campaigns && ls | sed 's/\.sh$//' | tr '\n' ' ')" >&2
    exit 2
  fi
done
for name in "${names[@]}"; do
  echo "==> $name"
  "tests/fuzz/campaigns/$name.sh" "$seconds"
done
