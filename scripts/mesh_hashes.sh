#!/usr/bin/env bash
# Meshes a fixed list of jobs and compares each mesh with tests/hashes/mesh_hashes.txt: the SHA-256 of its vertices,
# boundary triangles and tets, and how many vertices and tets there are. A change that is to leave every mesh as it was keeps all of these lines.
#   scripts/mesh_hashes.sh [--check | --write] [--quick] [--program FILE] [--volumes DIR] [JOB...]
#     --check         compare, print each difference; status 1 if there is one (the default)
#     --write         record what the program makes; lines of jobs that did not run stay
#     --quick         the small jobs alone, those that ctest runs (label hashes)
#     --program FILE  default build/release/bin/scantet
#     --volumes DIR   the folder with skull.nrrd (not part of this tree); default SCANTET_VOLUMES, else ../shared/volumes
#     JOB...          these jobs alone
# A job whose input is not on this machine is left out with a line that says so.
# shellcheck source-path=SCRIPTDIR
here=$PWD
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

mode=check quick=0 program=build/release/bin/scantet volumes=${SCANTET_VOLUMES:-../shared/volumes}
declare -A wanted=()
while (($# > 0)); do
  case "$1" in
    --check | --write) mode=${1#--} ;;
    --quick) quick=1 ;;
    --program | --volumes)
      if (($# < 2)); then say "$1 needs a value"; exit 2; fi
      path=$2
      if [[ $path != /* && -e $here/$path ]]; then path=$here/$path; fi
      if [[ $1 == --program ]]; then program=$path; else volumes=$path; fi
      shift
      ;;
    -*) say "mesh_hashes.sh: there is no option $1; the head of the script lists them"; exit 2 ;;
    *) wanted[$1]=1 ;;
  esac
  shift
done
if [[ ! -x $program ]]; then say "there is no program $program; build it, or name one with --program"; exit 2; fi

record=tests/hashes/mesh_hashes.txt
samples=sample_volumes
brain=/usr/share/mricron/templates/ch2bet.nii.gz
cgal_archive=/usr/share/doc/libcgal-dev/data.tar.gz
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
declare -A hash_of=() counts_of=()
names=()        # of the jobs that ran, in their order
left_out=0 failed=0

# is_wanted NAME SPEED: whether the job is one of those asked for.
is_wanted() {
  if ((${#wanted[@]} > 0)) && [[ -z ${wanted[$1]:-} ]]; then return 1; fi
  [[ $2 == quick ]] || ((!quick))
}

# job NAME SPEED INPUT [OPTION...]: meshes INPUT; SPEED is quick or full.
job() {
  local name=$1 speed=$2 input=$3 mesh=$folder/mesh.mesh status=0
  is_wanted "$name" "$speed" || return 0
  if [[ $input != implicit:* && ! -e $input ]]; then
    say "left out: $name, as there is no $input"
    left_out=$((left_out + 1))
    return 0
  fi
  "$program" mesh "${@:3}" -o "$mesh" --quiet --no-theory >"$folder/log" 2>&1 </dev/null || status=$?
  if ((status != 0 && status != 4)); then  # 4: there is a mesh, and a bound is unmet
    say "failed: $name, with status $status: $(tail -n 1 "$folder/log")"
    failed=$((failed + 1))
    return 0
  fi
  names+=("$name")
  # Comments name the program's version and its options; curves are edges of the tets, in sections of their own.
  hash_of[$name]=$(awk '/^(Edges|Ridges|Corners)$/ {getline n; for (; n > 0; --n) getline; next} !/^#/' "$mesh" |
    sha256sum | cut -d ' ' -f 1)
  counts_of[$name]=$(awk '/^Vertices/ {getline; v = $1} /^Tetrahedra/ {getline; t = $1} END {print v + 0, t + 0}' "$mesh")
  rm -f "$mesh"
}

# Every scan of the sample volumes, at the level of their table and twice the voxel spacing.
sample_jobs() {
  local file level inside speed
  while read -r file level inside; do
    speed=quick
    if [[ $file == ellipsoid_*.nii.gz || $file == ellipsoid_axis.mha ]]; then speed=full; fi  # the shape of the .nrrd
    job "$file" "$speed" "$samples/$file" --level "$level" --inside "$inside"
  done < <(awk -F '|' '/^\| [a-z_]+\.(nrrd|mha|nii)/ && !/^\| labels_/ {print $2, $3, $4}' "$samples/README.md")
}

option_jobs() {
  local torus=("$samples/torus.nrrd" --level 300.5)
  job torus_none quick "${torus[@]}" --optimize none
  job torus_exude quick "${torus[@]}" --optimize exude
  job torus_20deg quick "${torus[@]}" --min-dihedral 20
  job torus_paper quick "${torus[@]}" --seeding paper --optimize none
  job torus_distance quick "${torus[@]}" --facet-distance 0.05 --alpha 0.7
  job torus_seed quick "${torus[@]}" --seed 7
  job torus_formula quick "${torus[@]}" --size '1 + 0.3*d' --boundary-size 0.8
  job torus_fine full "${torus[@]}" --size 0.4
  job torus_auto full "${torus[@]}" --size auto
  job islands_components quick $samples/islands.nii.gz --level 60 --components 20
  job sphere_below quick $samples/sphere.nrrd --level 40 --inside below
  job torus_nested quick $samples/torus.nrrd --level 300.5 --level 450 --size 0.8 --alpha 0.5
  job tanglecube_nested full $samples/tanglecube.nrrd --level 0.1 --level 150 --size 1.3 --alpha 0.5
  job sphere_three_levels quick $samples/sphere.nrrd --level 60 --level 127.5 --level 200 --region-size 3=0.8
}

# Each plugin's inputs: a formula; a surface, points and a grid that are made here.
plugin_jobs() {
  job implicit_torus_coarse quick implicit:torus --size 0.1
  job implicit_formula quick 'implicit:x^2 + 2*y^2 + z^2 + 0.3*sin(3*x) - 1' --bounds=-2,-2,-2,2,2,2 --size 0.15
  python3 - "$folder" <<'PY'
import math, pathlib, sys
folder = pathlib.Path(sys.argv[1])
turns, sides = 48, 24  # a torus of quads cut in two, of radii 10 and 4
at = lambda i, n: 2 * math.pi * i / n
corners = [((10 + 4 * math.cos(at(j, sides))) * math.cos(at(i, turns)),
            (10 + 4 * math.cos(at(j, sides))) * math.sin(at(i, turns)), 4 * math.sin(at(j, sides)))
           for i in range(turns) for j in range(sides)]
number = lambda i, j: (i % turns) * sides + j % sides
faces = [f for i in range(turns) for j in range(sides)
         for f in ((number(i, j), number(i + 1, j), number(i + 1, j + 1)),
                   (number(i, j), number(i + 1, j + 1), number(i, j + 1)))]
(folder / "torus.off").write_text(
    f"OFF\n{len(corners)} {len(faces)} 0\n" + "".join("%.6f %.6f %.6f\n" % c for c in corners)
    + "".join("3 %d %d %d\n" % f for f in faces))
spiral = [(1 - (2 * i + 1) / 2000, math.pi * (3 - math.sqrt(5)) * i) for i in range(2000)]
unit = [(math.sqrt(1 - z * z) * math.cos(a), math.sqrt(1 - z * z) * math.sin(a), z) for z, a in spiral]
(folder / "egg.xyz").write_text("".join("%.6f %.6f %.6f %.6f %.6f %.6f\n" % (12 * x, 8 * y, 8 * z, x / 12, y / 8, z / 8)
                                        for x, y, z in unit))
PY
  job polyhedron_torus quick "$folder/torus.off" --size 1.2
  job points_egg quick "$folder/egg.xyz" --size 1.5
  "$program" convert $samples/tanglecube.nrrd "$folder/tanglecube.vdb" >/dev/null 2>&1 ||
    { say "failed: tanglecube.vdb is not written"; failed=$((failed + 1)); }
  job vdb_tanglecube quick "$folder/tanglecube.vdb" --level 0.1 --inside above --size 2
}

# Segmentations: surfaces that meet in curves and corners.
label_jobs() {
  job labels_octants quick $samples/labels_octants.nrrd --size 2
  job labels_tubes quick $samples/labels_tubes.nrrd --size 2
  job labels_voronoi quick $samples/labels_voronoi.nrrd --size 2 --optimize none
}

# What benchmarks/cases.cpp times, as far as the program can be asked for it.
benchmark_jobs() {
  local name unpacked=$folder/cgal skull=$volumes/skull.nrrd
  job skull full "$skull" --level 2.9 --size 2 --optimize none
  job skull_1mm full "$skull" --level 2.9 --size 1 --optimize none
  job skull_full full "$skull" --level 2.9 --size 2
  job skull_20deg full "$skull" --level 2.9 --size 2 --min-dihedral 20
  job skull_exude full "$skull" --level 2.9 --size 2 --optimize exude
  job brain full $brain --level 20 --size 4 --alpha 0.5 --optimize none
  job brain_3mm full $brain --level 20 --size 3
  job brain_largest full $brain --level 20 --size 4 --components largest
  job brain_cavities full $brain --level 60 --size 4
  job brain_nested full $brain --level 20 --level 100 --size 5
  job implicit_torus full implicit:torus --size 0.03 --optimize none
  job implicit_tanglecube full implicit:tanglecube --size 0.08 --optimize none
  job implicit_gyroid full implicit:gyroid --size 0.13 --optimize none
  job implicit_graded full implicit:tanglecube --size auto --feature-share 0.2 --least-size 0.01 --seeding paper
  mkdir -p "$unpacked"
  for name in elephant:0.01 anchor_dense:0.01 armadillo:1.2; do
    if [[ -e $cgal_archive ]] && is_wanted "polyhedron_${name%:*}" full; then
      tar -xzf $cgal_archive -C "$unpacked" "data/meshes/${name%:*}.off"
    fi
    job "polyhedron_${name%:*}" full "$unpacked/data/meshes/${name%:*}.off" --size "${name#*:}" --optimize none
  done
}

head_of_record() {
  cat <<'TEXT'
# Meshes by their bytes: job, SHA-256 of the MEDIT file without its comments, vertices, tets.
# Written and checked by scripts/mesh_hashes.sh, which says what each job is. The numbers depend on the code and on the
# rounding of its arithmetic: x86-64, GCC 12, Release (-O3, no contraction), the C library's elementary functions
# (glibc 2.36) and the libraries of Debian 12 (CGAL's data, muParser, OpenVDB, ITK). They do not depend on the threads.
TEXT
}

write_record() {
  local new=$folder/record name old_hash vertices tets
  local -A known=()
  head_of_record >"$new"
  for name in "${names[@]}"; do
    read -r vertices tets <<<"${counts_of[$name]}"
    printf '%-28s %s %7s %8s\n' "$name" "${hash_of[$name]}" "$vertices" "$tets" >>"$new"
    known[$name]=1
  done
  if [[ -e $record ]]; then
    while read -r name old_hash vertices tets; do
      if [[ $name != '#'* && -z ${known[$name]:-} ]]; then
        printf '%-28s %s %7s %8s\n' "$name" "$old_hash" "$vertices" "$tets" >>"$new"
      fi
    done <"$record"
  fi
  mv "$new" "$record"
  say "recorded ${#names[@]} meshes in $record"
}

check_record() {
  local name old_hash vertices tets different=0
  local -A old=()
  while read -r name old_hash vertices tets; do
    if [[ $name != '#'* ]]; then old[$name]="$old_hash $vertices $tets"; fi
  done <"$record"
  for name in "${names[@]}"; do
    if [[ -z ${old[$name]:-} ]]; then
      say "different: $name is not recorded"
      different=$((different + 1))
    elif [[ ${old[$name]} != "${hash_of[$name]} ${counts_of[$name]}" ]]; then
      read -r old_hash vertices tets <<<"${old[$name]}"
      say "different: $name has ${counts_of[$name]% *} vertices and ${counts_of[$name]#* } tets, ${hash_of[$name]:0:12};" \
        "recorded $vertices and $tets, ${old_hash:0:12}"
      different=$((different + 1))
    fi
  done
  say "${#names[@]} meshes: $((${#names[@]} - different)) as recorded, $different different; $left_out jobs left out, $failed failed"
  ((different == 0))
}

sample_jobs
label_jobs
option_jobs
plugin_jobs
benchmark_jobs
if ((${#names[@]} == 0)); then say "no job ran"; exit 1; fi
status=0
if [[ $mode == write ]]; then write_record; else check_record || status=1; fi
exit $((status || failed > 0))
