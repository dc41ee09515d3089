#!/usr/bin/env bash
# Installs what is missing, builds scantet and meshes a real scan: Debian's human brain MRI (package mricron-data).
# The mesh and its report go to out/. Works from any folder and without a terminal.
# shellcheck source-path=SCRIPTDIR
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

scripts/install_deps.sh build
configure -DSCANTET_BUILD_TESTS=OFF
build --target scantet

scan=/usr/share/mricron/templates/ch2bet.nii.gz
what="a human brain MRI, smoothed by 1 mm" # as it was read, 3 mm lose thin sheets of it: status 4
level=20
size=3
smoothing=(--smooth 1)
name=brain
if [[ ! -r $scan ]]; then scripts/install_deps.sh demo || true; fi
if [[ ! -r $scan ]]; then
  say "the brain MRI (Debian package mricron-data) cannot be had: meshing a synthetic scan of sample_volumes/ instead"
  scan=sample_volumes/tanglecube.nrrd
  what="a synthetic scan"
  level=0.1
  size=2
  smoothing=()
  name=tanglecube
fi

mkdir -p out
command=(build/release/bin/scantet mesh "$scan" --level "$level" --size "$size" "${smoothing[@]}"
  -o "out/$name.vtu" -o "out/$name.stl" --report "out/$name.html" --report "out/$name.json")
say "meshing $what: ${command[*]}"
status=0
"${command[@]}" || status=$?
if ((status != 0 && status != 4)); then exit "$status"; fi # 4: written, but a bound is unmet

say "tetrahedra: $PWD/out/$name.vtu (for ParaView)"
say "boundary:   $PWD/out/$name.stl"
say "report:     $PWD/out/$name.html (for a browser), $PWD/out/$name.json"
exit "$status"
