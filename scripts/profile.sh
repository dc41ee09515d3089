#!/usr/bin/env bash
# Builds scantet, runs it under callgrind on one thread and writes docs/profile.md: the share of each function in all
# instructions, which is the same on every run and machine of a kind.
#   scripts/profile.sh [SCAN LEVEL SIZE_MM]     default: the tanglecube of sample_volumes at 0.6 mm
# shellcheck source-path=SCRIPTDIR
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

scan=${1:-sample_volumes/tanglecube.nrrd}
level=${2:-0.1}
size=${3:-0.6}
scripts/install_deps.sh build profile
configure
build --target scantet

results=build/profile
mkdir -p "$results"
program=build/release/bin/scantet
arguments=(mesh "$scan" --level "$level" --size "$size" --threads 1)
say "running under callgrind (a minute or two)"
valgrind --tool=callgrind --callgrind-out-file="$results/callgrind.out" "$program" "${arguments[@]}" \
  >"$results/log" 2>&1 </dev/null || { tail -n 5 "$results/log" >&2; exit 1; }
callgrind_annotate --threshold=100 "$results/callgrind.out" >"$results/functions"
python3 scripts/profile_page.py "$results/functions" "scantet ${arguments[*]/$scan/$(basename "$scan")}" >docs/profile.md
say "page: $PWD/docs/profile.md"
