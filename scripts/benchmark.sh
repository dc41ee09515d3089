#!/usr/bin/env bash
# Installs what is missing, builds scantet and its benchmarks, compares scantet with CGAL Mesh_3 and writes
# docs/benchmarks.md. Works from any folder and without a terminal. Keep the machine idle meanwhile.
#   scripts/benchmark.sh [--calls N] [compare option...]
#     --calls N      calls of the whole comparison, of which the worst is quoted; default 3
#     --volumes DIR  the folder with skull.nrrd (the image of the paper's Figure 6, not part of this tree), from here or
#                    from the root of the tree; default ../shared/volumes. Without it its cases are left out.
#   e.g. scripts/benchmark.sh --calls 1 --runs 1 --cases tanglecube       benchmarks/compare --help has all options
# shellcheck source-path=SCRIPTDIR
here=$PWD
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

calls=3
volumes=../shared/volumes
options=()
while (($# > 0)); do
  case "$1" in
    --calls | --volumes)
      if (($# < 2)); then say "$1 needs a value"; exit 2; fi
      if [[ $1 == --calls ]]; then calls=$2; else volumes=$2; fi
      shift 2
      ;;
    *) options+=("$1"); shift ;;
  esac
done
if [[ ! $calls =~ ^[1-9][0-9]*$ ]]; then say "--calls: $calls is not a number from 1 on"; exit 2; fi
if [[ $volumes != /* && -d $here/$volumes ]]; then volumes=$here/$volumes; fi

scripts/install_deps.sh build benchmark
configure -DSCANTET_BUILD_TESTS=OFF -DSCANTET_BUILD_BENCHMARKS=ON
build --target compare scantet

results=build/benchmarks
mkdir -p "$results"
rm -f "$results"/call_*.json
status=0
for ((call = 1; call <= calls; ++call)); do
  say "call $call of $calls"
  json=$results/call_$call.json
  build/release/bin/compare --volumes "$volumes" --json "$json" "${options[@]}" || status=$?
  [[ -f $json ]] || exit "$status" # wrong use, or --help
done
SCANTET_VOLUMES=$volumes python3 scripts/whole_command.py --runs 5 --json "$results/whole.json"
python3 benchmarks/page.py --page docs/benchmarks.md --plot docs/benchmarks.svg --whole "$results/whole.json" "$results"/call_*.json
say "runs: $PWD/$results/call_*.json"
say "page: $PWD/docs/benchmarks.md"
exit "$status"
