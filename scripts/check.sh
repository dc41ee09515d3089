#!/usr/bin/env bash
# Every check of the project, one after the other, on a Debian 12 machine; installs what is missing. Ends with a table of
# steps, results and minutes; status 1 if one failed.
#   scripts/check.sh [--jobs N] [STEP...]     default: all steps, as many compilers at once as there are cores
# Steps (docs/checks.md says what each is for):
#   release    what a change must pass: scripts/test.sh
#   tidy       clang-tidy over every source, shellcheck over the scripts
#   asan       a build of everything with the second compiler, warnings as errors, under AddressSanitizer and UBSan with
#              assertions: its unit, contract and guarantee tests, and the bytes of the small meshes
#   tsan       ThreadSanitizer and assertions over the tests that start threads
#   arm        the engine built for 64-bit ARM, its tests in QEMU: the same bytes (scripts/arm_test.sh)
#   coverage   lines that the tests run, per module
#   hashes     the bytes of fifty meshes (scripts/mesh_hashes.sh)
#   fuzz       damaged files through the program, and libFuzzer on each reader
#   mutations  a certified mesh changed in 22 ways, 100 times each: none is certified
#   kills      runs that are killed leave whole files
#   formats    every mesh format with 1, 3 and 116 regions, of both orders, read back by other programs
#   tutorials  the worked examples of docs/tutorials, meshed, solved and drawn; their figures beside the pages' (scripts/tutorials.py)
#   physics    models that CalculiX solves, beside their formulas (scripts/physics.py)
#   second_order  elements of second order on real scans: each proved positive (scripts/second_order.py)
#   packages   the Debian packages, tried out in a bare Debian 12
#   container  those packages in a container, built by the Containerfile's second half (scripts/container_test.sh)
#   paraview   the plugin of ParaView, in a bare Debian 12 with its ParaView (scripts/paraview_test.sh)
#   notebook   the Python package in a notebook without a display, interrupted (bindings/python/tests/notebook_check.py)
#   cohort     fifty scans through a real Slurm, killed three times (scripts/cohort_test.sh)
#   doxygen    the public headers' documentation, without a warning
# shellcheck source-path=SCRIPTDIR disable=SC2317
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

all_steps=(release tidy asan tsan arm coverage hashes fuzz mutations kills formats tutorials physics second_order packages container paraview notebook cohort doxygen)
jobs=$(nproc)
steps=()
while (($# > 0)); do
  case "$1" in
    --jobs)
      if [[ ! ${2:-} =~ ^[1-9][0-9]*$ ]]; then say "--jobs needs a number from 1 on"; exit 2; fi
      jobs=$2
      shift
      ;;
    -*) say "check.sh: there is no option $1; the head of the script lists them"; exit 2 ;;
    *)
      if [[ " ${all_steps[*]} " != *" $1 "* ]]; then say "check.sh: no step is called $1; use ${all_steps[*]}"; exit 2; fi
      steps+=("$1")
      ;;
  esac
  shift
done
if ((${#steps[@]} == 0)); then steps=("${all_steps[@]}"); fi

# build_preset PRESET [TARGET...]: configures and builds a preset.
build_preset() {
  local preset=$1 target targets=()
  shift
  for target in "${@:-all}"; do targets+=(--target "$target"); done
  cmake --preset "$preset"
  cmake --build --preset "$preset" --parallel "$jobs" "${targets[@]}" -- --quiet
}

# has_assertions PRESET: fails if a source of ours is compiled without.
has_assertions() {
  if grep -q -e '-DNDEBUG' "build/$1/build.ninja"; then say "the preset $1 is built without assertions"; return 1; fi
}

# tests PRESET LABELS: runs the tests with one of these labels.
tests() { ctest --preset "$1" -j "$jobs" -L "$2" --no-tests=error; }

step_release() { scripts/test.sh; }

step_tidy() {
  cmake --preset asan-ubsan
  shellcheck -x -S warning scripts/*.sh
  python3 scripts/tidy.py --database build/asan-ubsan --jobs "$jobs"
}

step_asan() {
  build_preset asan-ubsan
  has_assertions asan-ubsan
  ASAN_OPTIONS=detect_stack_use_after_return=1 UBSAN_OPTIONS=print_stacktrace=1 \
    LSAN_OPTIONS=suppressions=$PWD/tests/lsan.supp tests asan-ubsan 'unit|contract|guarantee'
  LSAN_OPTIONS=suppressions=$PWD/tests/lsan.supp scripts/mesh_hashes.sh --quick --program build/asan-ubsan/bin/scantet
}

step_tsan() {
  build_preset tsan threaded_tests
  has_assertions tsan
  TSAN_OPTIONS=halt_on_error=1:second_deadlock_stack=1:suppressions=$PWD/tests/tsan.supp tests tsan threads
}

step_arm() { scripts/arm_test.sh --jobs "$jobs"; }

step_coverage() {
  build_preset coverage
  find build/coverage -name '*.gcda' -delete
  tests coverage 'unit|contract|guarantee|cli'
  python3 scripts/coverage.py build/coverage
}

step_hashes() {
  build_preset release
  scripts/mesh_hashes.sh --check
}

step_fuzz() {
  local target kind
  build_preset release
  scripts/fuzz.sh --count 600 --jobs "$jobs"
  build_preset fuzzers
  for target in build/fuzzers/bin/fuzz_*; do
    kind=${target##*/fuzz_}
    printf '\nlibFuzzer: %s\n' "$kind"
    "$target" -max_total_time=20 -timeout=20 -rss_limit_mb=4096 -artifact_prefix=build/fuzzers/fault_ -print_final_stats=1 \
      -verbosity=0 "build/fuzzers/corpus/$kind"
  done
}

step_mutations() {
  build_preset release test_guarantee test_verify
  SCANTET_MUTATION_SEEDS=100 build/release/bin/test_guarantee --gtest_filter='Certificate.MutatedMeshesAreNotCertified'
  SCANTET_MUTATION_SEEDS=100 build/release/bin/test_verify --gtest_filter='VerifyLabels.DamagedMeshesAreNotBounded'
}

step_packages() { scripts/package_test.sh; }

step_container() {
  step_packages
  scripts/container_test.sh --debs build/packages/deb
}

step_paraview() {
  build_preset release
  scripts/paraview_test.sh
}

step_notebook() {
  build_preset release scantet_python
  PYTHONPATH=$PWD/build/release/python /usr/bin/python3 bindings/python/tests/notebook_check.py "$PWD/sample_volumes/sphere.nrrd"
}

step_kills() {
  build_preset release
  scripts/kill_test.sh 40
}

step_formats() {
  build_preset release scantet
  /usr/bin/python3 tests/fem/formats_read_back.py build/release/bin/scantet sample_volumes labels
}

step_tutorials() {
  build_preset release scantet
  /usr/bin/python3 scripts/tutorials.py --check
}

step_physics() {
  build_preset release scantet
  /usr/bin/python3 scripts/physics.py --program build/release/bin/scantet
}

step_second_order() {
  build_preset release scantet
  /usr/bin/python3 scripts/second_order.py
}

step_cohort() {
  build_preset release
  scripts/cohort_test.sh
}

step_doxygen() { build_preset release doxygen; }

scripts/install_deps.sh build test demo check
logs=build/check
mkdir -p "$logs"
table=() failed=0
for step in "${steps[@]}"; do
  log=$logs/$step.log
  say "$step (log: $PWD/$log)"
  begin=$SECONDS
  status=0
  (set -e; "step_$step") >"$log" 2>&1 </dev/null & # a shell of its own, where set -e holds
  wait $! || status=$?
  taken=$((SECONDS - begin))
  if ((status == 0)); then result=passed; else result=FAILED failed=$((failed + 1)); fi
  if ((status != 0)); then tail -n 25 "$log" >&2; fi
  table+=("$(printf '%-12s %-7s %4d:%02d' "$step" "$result" $((taken / 60)) $((taken % 60)))")
  if [[ $step == coverage ]]; then sed -n '/^module/,$p' "$log"; fi
done
printf '%-12s %-7s %7s\n' step result minutes
printf '%s\n' "${table[@]}"
exit $((failed > 0))
