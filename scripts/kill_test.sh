#!/usr/bin/env bash
# kill_test.sh [N]: kills N runs (default 200) and N/4 conversions with SIGKILL at random times, and looks at what they leave.
# Two jobs write the same files in turn. After each kill every file must be whole, of one job or the other; the
# checksums in the report must match all meshes exactly when these are of the report's job; and the next run must take
# away what the killed one left. Prints a table; exits with 1 on a fault. SCANTET: the program, if not the one built.
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
scantet=${SCANTET:-$root/build/release/bin/scantet}
kills=${1:-200}
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
meshes=(a.vtu a.msh a.stl a.stls/boundary_1_0.stl)
certificate=a.cert.json # it has times, and so is another each time
sizes=([1]=1 [2]=1.25)

# run JOB FOLDER: job 1 or 2; in the background it becomes the program itself, so that the kill meets it.
run() {
  cd "$2"
  exec "$scantet" mesh "$root/sample_volumes/sphere.nrrd" --level 127.5 --size "${sizes[$1]}" --quiet --no-theory \
    -o a.vtu -o a.msh -o a.stl -o a.stls --certify bounded --certificate "$certificate" --report a.json
}

# job_of FILE: 1 or 2, whose file it is; 0 if of neither.
job_of() {
  local job
  for job in 1 2; do
    if cmp -s "$folder/out/$1" "$folder/whole$job/$1"; then echo "$job"; return; fi
  done
  echo 0
}

# Whether the report is whole and its checksums are those of the meshes; prints the job of a whole set.
set_of() {
  python3 - "$folder/out" "${meshes[@]}" "$certificate" <<'PY'
import hashlib, json, pathlib, sys
folder = pathlib.Path(sys.argv[1])
report = json.loads((folder / "a.json").read_text())  # half a report, or half a certificate, fails here
json.loads((folder / sys.argv[-1]).read_text())
listed = {file["path"]: file["sha256"] for file in report["files"]}
there = {name: hashlib.sha256((folder / name).read_bytes()).hexdigest() for name in sys.argv[2:]}
print({1: 1, 1.25: 2}[report["options"]["size"]] if listed == there else "none")
PY
}

is_writing() {
  local file
  for file in "$folder"/out/.scantet-*; do
    if [[ -s $file ]]; then return 0; fi
  done
  return 1
}

left_over() { find "$folder/out" -name '.scantet-*' | wc -l; }

fault() {
  echo "fault after kill $kill: $*" >&2
  faults=$((faults + 1))
}

for job in 1 2; do
  mkdir -p "$folder/whole$job"
  begin=$(date +%s%N)
  (run "$job" "$folder/whole$job")
  longest_ms=$((($(date +%s%N) - begin) / 1000000))
done
cp -r "$folder/whole1" "$folder/out"
cp "$folder/whole2/a.stl" "$folder/out"
kill=0 faults=0
[[ $(set_of) == none ]] || fault "a mesh of another run is not told apart"
cp "$folder/whole1/a.stl" "$folder/out"

early=0 old=0 mixed=0 new=0 leaving=0
for ((kill = 1; kill - early <= kills; ++kill)); do
  job=$((kill % 2 + 1))
  (run "$job" "$folder/out") 2>/dev/null &
  pid=$!
  if ((kill % 4 < 2)); then # at any time
    sleep "$(printf '%d.%03d' 0 $((RANDOM % (longest_ms < 999 ? longest_ms + 1 : 999))))"
  else # soon after it has begun to write
    until is_writing || ! kill -0 "$pid" 2>/dev/null; do :; done
    sleep "$(printf '0.%03d' $((RANDOM % 40)))"
  fi
  kill -KILL "$pid" 2>/dev/null && killed=1 || killed=0
  wait "$pid" 2>/dev/null || true
  ((killed)) || early=$((early + 1))

  jobs=""
  for mesh in "${meshes[@]}"; do
    of=$(job_of "$mesh")
    ((of)) || fault "$mesh is of neither job"
    jobs+=$of
  done
  if whole=$(set_of); then
    case $jobs$whole in
      11111 | 22222) if [[ $whole == "$job" ]]; then new=$((new + 1)); else old=$((old + 1)); fi ;;
      *none) mixed=$((mixed + 1)) ;;
      *) fault "meshes of jobs $jobs, and the report says $whole" ;;
    esac
  else
    fault "the report or the certificate is not whole"
  fi
  (($(left_over) == 0)) || leaving=$((leaving + 1))

  (run "$job" "$folder/out") || fault "the next run failed"
  (($(left_over) == 0)) || fault "$(left_over) files are left over after the next run"
  [[ $(set_of) == "$job" ]] || fault "the next run's set is not whole"
done

# convert SOURCE FILE: in the background it becomes the program itself.
convert() { exec "$scantet" convert "$1" "$2" >"$folder/said" 2>&1; }

# One file, no report: it is the one that was there, or the new one.
converted=$folder/out/c.msh2
for job in 1 2; do
  begin=$(date +%s%N)
  (convert "$folder/whole$job/a.vtu" "$folder/whole$job/c.msh2")
  longest_ms=$((($(date +%s%N) - begin) / 1000000))
done
cp "$folder/whole1/c.msh2" "$converted"
conversions=$((kills / 4))
for ((kill = 1; kill <= conversions; ++kill)); do
  job=$((kill % 2 + 1))
  (convert "$folder/whole$job/a.vtu" "$converted") &
  pid=$!
  sleep "$(printf '0.%03d' $((RANDOM % (longest_ms < 999 ? longest_ms + 1 : 999))))"
  kill -KILL "$pid" 2>/dev/null || true
  wait "$pid" 2>/dev/null || true
  (($(job_of c.msh2))) || fault "a converted mesh is of neither job"
  (convert "$folder/whole$job/a.vtu" "$converted") || fault "the next conversion failed"
  [[ $(job_of c.msh2) == "$job" ]] || fault "the next conversion's mesh is not whole"
  (($(left_over) == 0)) || fault "$(left_over) files are left over after the next conversion"
done

printf '%-52s %6d\n' "conversions killed" "$conversions" "runs killed" "$kills" "runs that had ended before" "$early" \
  "all files old, the report matches" "$old" "all files new, the report matches" "$new" \
  "some new, some old, and the report does not match" "$mixed" "temporary files left, cleared by the next run" "$leaving" \
  "faults" "$faults"
exit $((faults > 0))
