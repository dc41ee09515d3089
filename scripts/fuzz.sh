#!/usr/bin/env bash
# Runs damaged inputs of every kind through the program, with limits on time and memory, and prints a table; status 1 on a
# fault. Inputs that made one are kept in build/fuzz/faults with their command.
#   scripts/fuzz.sh [--count N] [--seed S] [--jobs N] [--minutes M] [--kinds A,B] [--sanitized]
# N damaged files in all (default 2000), the same ones for the same seed (default 1). --sanitized: through a program built
# with AddressSanitizer and UBSan (preset fuzzers), whose findings are faults. SCANTET: the program, if not the one built.
# shellcheck source-path=SCRIPTDIR
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

preset=release
[[ " $* " == *" --sanitized "* ]] && preset=fuzzers
scantet=${SCANTET:-build/$preset/bin/scantet}
if [[ ! -x $scantet ]]; then
  if [[ $preset == release ]]; then
    scripts/install_deps.sh build
    configure
    build --target all
  else
    scripts/install_deps.sh build fuzz
    cmake --preset "$preset"
    cmake --build --preset "$preset" --parallel "$(nproc)" -- --quiet
  fi
fi
exec python3 scripts/fuzz.py "$@" "$scantet" build/fuzz
