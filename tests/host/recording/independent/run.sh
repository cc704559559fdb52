#!/bin/sh
# run.sh <program that writes the sample> <folder to write to>: 77 means skipped.
here=$(dirname "$0")
if ! command -v node >/dev/null || [ ! -d "$here/node_modules/@mcap/core" ]; then
  echo "skipped: install Node.js and run 'npm ci' in $here for the check by foreign readers"
  exit 77
fi
mkdir -p "$2" && "$1" "$2" && exec node "$here/check.mjs" "$2"
