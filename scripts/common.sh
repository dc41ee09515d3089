# shellcheck shell=bash
# What demo.sh and test.sh share; sourced by them. Leaves the shell in the root of the source tree.
set -euo pipefail
scripts=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
cd "$(dirname "$scripts")"

say() { printf '%s\n' "scantet: $*" >&2; }

# configure [cmake option...]: the release preset; shows CMake's messages only if it fails.
configure() {
  local log=build/release/configure.log
  mkdir -p "$(dirname "$log")"
  say "configuring build/release"
  if ! cmake --preset release "$@" >"$log" 2>&1 </dev/null; then
    tail -n 40 "$log" >&2
    say "CMake failed; all of its messages are in $PWD/$log"
    exit 1
  fi
}

# build [cmake --build option...]: as many compilers at once as there are cores; no chatter unless on a terminal.
build() {
  local chatter=()
  [[ -t 1 ]] || chatter=(-- --quiet)
  say "building (some minutes the first time)"
  cmake --build --preset release --parallel "$(nproc)" "$@" "${chatter[@]}" </dev/null
}
