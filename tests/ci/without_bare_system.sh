#!/usr/bin/env bash
# usage: without_bare_system.sh .ci/run
set -euo pipefail
tree=$(mktemp -d)
trap 'rm -rf "$tree"' EXIT
mkdir -p "$tree/checkout/.ci"
cp "$1" "$tree/checkout/.ci/run"
cat >"$tree/checkout/dev" <<'STUB'
#!/usr/bin/env bash
echo "checked: $*" >&2
exit "${DEV_ENDS_WITH:-0}"
STUB
chmod +x "$tree/checkout/dev"

# expect CODE LAST_LINE [NAME=VALUE...]: how the run ends, and what its last line begins with.
expect() {
  local code=$1 last=$2 ended=0
  shift 2
  env ASTROLABE_CI_CACHE="$tree/cache" "$@" bash "$tree/checkout/.ci/run" 2>"$tree/log" || ended=$?
  if [[ $ended != "$code" || $(tail -1 "$tree/log") != "$last"* ]]; then
    echo "expected $code and '$last', got $ended and:"
    cat "$tree/log"
    exit 1
  fi
}
expect 0 "ci: the checks passed, but on no bare system: ../shared/tools/clean-machine is not here"
expect 3 "ci: the checks passed, but on no bare system" ASTROLABE_CI_BARE=required
expect 1 "checked: test" DEV_ENDS_WITH=1
