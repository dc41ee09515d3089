#!/usr/bin/env bash
# Meshes sample volumes, verifies the meshes, and prints the table of docs/certificate.md. Those that are not certified are meshed
# again with --certify refine; the row then says how many more vertices that took.
#   scripts/certificates.sh [SKULL]     SKULL: the paper's head CT (skull.nrrd, level 2.9), at 2 and 1 mm
set -euo pipefail

root="$(cd "$(dirname "$0")/.." && pwd)"
program="${SCANTET_PROGRAM:-$root/build/release/bin/scantet}"
folder="$(mktemp -d)"
trap 'rm -rf "$folder"' EXIT

value() { sed -n "s/^$1 *//p" "$folder/out" | sed -E 's/, proved \(largest near \([^)]*\)\)//; s/ at \([^)]*\)//; s/ with a collar.*//'; }

print_row() { # FILE SIZE MORE
  printf '| %s | %s%s | %s | %s | %s | %s | %s |\n' "$(basename "$1")" "$2" "$3" "$(value grade)" "$(value facets)" \
    "$(value 'mesh to level')" "$(value 'level to mesh')" "$(value time)"
}

row() { # FILE LEVEL SIZE [option...]
  local file="$1" level="$2" size="$3" more
  shift 3
  "$program" mesh "$file" --level "$level" "$@" --size "$size" -o "$folder/a.vtu" --quiet 2>/dev/null || true
  "$program" verify "$folder/a.vtu" --against "$file" --level "$level" "$@" >"$folder/out" || true
  print_row "$file" "$size" ""
  if [[ $(value grade) == certified ]]; then return; fi
  "$program" mesh "$file" --level "$level" "$@" --size "$size" -o "$folder/a.vtu" --certify refine --report "$folder/a.json" --quiet 2>/dev/null || true
  "$program" verify "$folder/a.vtu" --against "$file" --level "$level" "$@" >"$folder/out" || true
  more=$(sed -n 's/.*"points_added": *\([0-9]*\).*/\1/p' "$folder/a.json")
  print_row "$file" "$size" ", refine: $more more vertices"
}

echo '| scan | size, mm | grade | facets with a collar | mesh to level | level to mesh | time |'
echo '| --- | --- | --- | --- | --- | --- | --- |'
samples="$root/sample_volumes"
row "$samples/sphere.nrrd" 127.5 2
row "$samples/sphere.nrrd" 127.5 1
row "$samples/torus.nrrd" 300.5 2
row "$samples/torus.nrrd" 300.5 1
row "$samples/tanglecube.nrrd" 0.1 2
row "$samples/shell.mha" 1000.5 1 --inside below
row "$samples/ellipsoid_anisotropic.nii.gz" 0.5 1
row "$samples/ellipsoid_oblique.nrrd" 0.5 1
row "$samples/ellipsoid_flipped.nrrd" 0.5 1
row "$samples/ellipsoid_sheared.nrrd" 0.5 1
row "$samples/islands.nii.gz" 60 1
row "$samples/bar.mha" 0.5 1.5
if (($# > 0)); then
  row "$1" 2.9 2
  row "$1" 2.9 1
fi
