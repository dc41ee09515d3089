#!/usr/bin/env bash
# Runs damaged inputs of every kind through the program, with limits on time and memory, and prints a table; status 1 on a
# fault. Inputs that made one are kept in build/fuzz/faults with their command.
#   scripts/fuzz.sh [N] [SEED]     N damaged files in all (default 2000), the same ones for the same SEED (default 1)
# shellcheck source-path=SCRIPTDIR
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

count=${1:-2000}
seed=${2:-1}
scantet=${SCANTET:-build/release/bin/scantet}
if [[ ! -x $scantet ]]; then
  scripts/install_deps.sh build
  configure
  build --target all
fi
exec python3 scripts/fuzz.py "$scantet" "$count" "$seed" build/fuzz
