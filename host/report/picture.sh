#!/usr/bin/env bash
# Makes picture.png anew, which the README of the whole shows: the two sections of a demonstration's report that say most.
#   host/report/picture.sh [ASTROLABE]
set -euo pipefail
cd "$(dirname "$0")"
program=$(realpath "${1:-../../build/host/bin/astrolabe}")
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
"$program" demo --out "$folder/demo" >/dev/null
page=$folder/demo/experiment/report.html
echo '<style>h1, h2, nav, #end-errors > p, .selector, section:not(#result, #end-errors) { display: none }</style>' >>"$page"
chromium --headless --no-sandbox --hide-scrollbars --virtual-time-budget=20000 --window-size=960,815 \
  --force-device-scale-factor=0.8 --screenshot="$PWD/picture.png" "file://$page"
