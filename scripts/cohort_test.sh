#!/usr/bin/env bash
# cohort_test.sh [SEED]: fifty synthetic subjects through a real Slurm on this machine, disturbed as a cluster would be.
# Starts munged, slurmctld and three slurmd of its own, with their configuration in a temporary folder; the system's services
# are not touched. First the cohort is meshed undisturbed, without Slurm, on two cores; then through Slurm, where it is killed three times at
# random (the command, Snakemake and a running job, with SIGKILL) while one node is drained, and slurmctld is ended and started
# again. Both must end with the same meshes; the empty scan and the one that is cut off must be in quarantine, with their
# reasons; nothing may be meshed twice but what was killed while it ran. Prints a table; exits with 1 on a fault.
# SCANTET: the program, if not the one built.
# shellcheck disable=SC2009
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
scantet=${SCANTET:-$root/build/release/bin/scantet}
RANDOM=${1:-$(date +%s)}
subjects=50
folder=$(mktemp -d "${TMPDIR:-/tmp}/cohort.XXXXXX")
export SLURM_CONF=$folder/slurm.conf
faults=0
killed=0 # meshing programs

say() { printf '%s\n' "cohort_test: $*"; }
fault() { say "FAULT: $*"; faults=$((faults + 1)); }

for program in munged slurmctld slurmd sbatch snakemake; do
  if ! PATH=$PATH:/usr/sbin command -v "$program" >/dev/null; then
    say "$program is missing: apt-get install --no-install-recommends slurmctld slurmd slurm-client munge snakemake"
    exit 1
  fi
done
PATH=$PATH:/usr/sbin

# processes PART: those whose command line names this test's folder, which no other process has, and matches PART.
processes() {
  local pid
  for pid in $(pgrep -f -- "$folder" || true); do
    if [[ $pid != "$$" ]] && tr '\0' ' ' 2>/dev/null <"/proc/$pid/cmdline" | grep -qE -- "$1"; then echo "$pid"; fi
  done
}

stop_slurm() {
  local file
  scancel --user "$(id -un)" 2>/dev/null || true
  for file in "$folder"/slurmd.*.pid "$folder"/slurmctld.pid "$folder"/munged.pid; do
    if [[ -s $file ]]; then kill "$(<"$file")" 2>/dev/null || true; fi
  done
}
finish() {
  local pid
  if [[ -n ${command:-} ]]; then kill -9 "$command" 2>/dev/null || true; fi
  for pid in $(processes snakemake); do kill -9 "$pid" 2>/dev/null || true; done
  stop_slurm
  sleep 1
  for pid in $(pgrep slurmstepd || true); do # of this Slurm alone
    if grep -qsF "SLURM_CONF=$SLURM_CONF" "/proc/$pid/environ"; then kill -9 "$pid" 2>/dev/null || true; fi
  done
  if [[ -z ${KEEP:-} ]]; then rm -rf "$folder"; fi
}
trap finish EXIT

# A free port of this machine, and those after it.
first_port=$(/usr/bin/python3 -c 'import socket; s = socket.socket(); s.bind(("", 0)); print(s.getsockname()[1])')

start_slurm() {
  local node
  mkdir -p "$folder"/{state,log}
  chmod 755 "$folder"
  dd if=/dev/urandom of="$folder/munge.key" bs=1024 count=1 status=none
  chmod 400 "$folder/munge.key"
  munged --force --socket="$folder/munge.socket" --key-file="$folder/munge.key" --log-file="$folder/log/munged.log" \
    --pid-file="$folder/munged.pid" --seed-file="$folder/munge.seed"
  {
    cat <<CONF
ClusterName=cohort
SlurmctldHost=$(hostname)(127.0.0.1)
SlurmUser=$(id -un)
SlurmdUser=$(id -un)
AuthType=auth/munge
AuthInfo=socket=$folder/munge.socket
SlurmctldPort=$first_port
StateSaveLocation=$folder/state
SlurmdSpoolDir=$folder/spool.%n
SlurmctldPidFile=$folder/slurmctld.pid
SlurmdPidFile=$folder/slurmd.%n.pid
SlurmctldLogFile=$folder/log/slurmctld.log
SlurmdLogFile=$folder/log/slurmd.%n.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
MpiDefault=none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU_Memory
ReturnToService=2
AccountingStorageType=accounting_storage/none
JobAcctGatherType=jobacct_gather/none
CONF
    for node in 1 2 3; do
      echo "NodeName=n$node NodeHostname=$(hostname) NodeAddr=127.0.0.1 Port=$((first_port + node)) CPUs=1 RealMemory=4000"
    done
    echo "PartitionName=main Nodes=n1,n2,n3 Default=YES MaxTime=INFINITE State=UP"
  } >"$SLURM_CONF"
  slurmctld -f "$SLURM_CONF"
  for node in n1 n2 n3; do slurmd -N "$node" -f "$SLURM_CONF"; done
  for _ in {1..50}; do
    if [[ $(sinfo --noheader --states idle --format %D 2>/dev/null) == 3 ]]; then return; fi
    sleep 0.2
  done
  say "Slurm did not start:"
  tail -n 5 "$folder"/log/*.log
  exit 1
}

# hashes OUTPUT: the checksums of the meshes by their names.
hashes() { (cd "$1" && sha256sum -- sub-*/anat/*_mesh.vtu); }

# words OUTPUT OPTION...: the command line of the participant level, in the array `line`.
words() {
  local output=$1
  shift
  line=("$scantet" cohort "$folder/study" "$output" participant "$@" -- --level 60 --size 1.5)
}

verdicts() { find "$folder/out/.scantet/results" -name '*.json' 2>/dev/null | wc -l; }

# wait_for N: until there are so many verdicts, or five minutes have gone by.
wait_for() {
  local end=$((SECONDS + 300))
  while (($(verdicts) < $1 && SECONDS < end)) && kill -0 "$command" 2>/dev/null; do sleep 0.2; done
}

kill_at_random() {
  local pid victims=() end=$((SECONDS + 15))
  while ((${#victims[@]} == 0 && SECONDS < end)); do # a mesh that is being made
    mapfile -t victims < <(processes 'scantet mesh .*thumbnail.stl')
  done
  if ((${#victims[@]} > 0)) && kill -9 "${victims[RANDOM % ${#victims[@]}]}" 2>/dev/null; then killed=$((killed + 1)); fi
  kill -9 "$command" 2>/dev/null || true
  if ((RANDOM % 2)); then
    for pid in $(processes "snakemake.*--profile"); do kill -9 "$pid" 2>/dev/null || true; done
  fi
  wait "$command" 2>/dev/null || true
}

/usr/bin/python3 "$root/cohort/make_subjects.py" "$folder/study" "$subjects" --side 40 --corrupt 1 --hopeless 1
begin=$SECONDS
status=0
words "$folder/quiet" --n-cpus 2
"${line[@]}" >"$folder/quiet.log" || status=$?
quiet_seconds=$((SECONDS - begin))
if ((status != 4)); then fault "the undisturbed run ended with $status: $(tail -n 3 "$folder/quiet.log")"; fi

start_slurm
begin=$SECONDS
words "$folder/out" --profile slurm
for kills in 1 2 3; do
  "${line[@]}" >>"$folder/out.log" 2>&1 &
  command=$!
  wait_for $((14 * (kills - 1) + 3 + RANDOM % 10)) # verdicts; then, somewhere in the next two seconds
  sleep $((RANDOM % 2)).$((RANDOM % 10))
  if ! kill -0 "$command" 2>/dev/null; then fault "kill $kills came too late: the cohort was done"; fi
  kill_at_random
  say "kill $kills after $((SECONDS - begin)) s, with $(verdicts) of $subjects verdicts"
  if ((kills == 1)); then
    scontrol update nodename=n2 state=drain reason=test
    drained_at=$(date --utc +%Y-%m-%dT%H:%M:%S)
  fi
  if ((kills == 2)); then
    pid=$(<"$folder/slurmctld.pid") # ended as by systemd: killed by SIGKILL it may forget jobs, and drains the nodes that run them
    kill "$pid"
    while kill -0 "$pid" 2>/dev/null; do sleep 0.2; done
    slurmctld -f "$SLURM_CONF"
  fi
done
status=1
for _ in 1 2 3; do
  status=0
  "${line[@]}" >>"$folder/out.log" 2>&1 &
  command=$!
  wait "$command" || status=$?
  if ((status != 1)); then break; fi
done
command=
slurm_seconds=$((SECONDS - begin))
if ((status != 4)); then fault "the disturbed run ended with $status: $(tail -n 3 "$folder/out.log")"; fi

hashes "$folder/quiet" >"$folder/quiet.sums"
hashes "$folder/out" >"$folder/out.sums" || true
if ! cmp -s "$folder/quiet.sums" "$folder/out.sums"; then
  fault "other meshes: $(diff "$folder/quiet.sums" "$folder/out.sums" | head -n 4)"
fi
if (($(wc -l <"$folder/out.sums") != subjects - 2)); then fault "$(wc -l <"$folder/out.sums") meshes"; fi
for run in quiet out; do
  reasons=$(cut -f 4 "$folder/$run/quarantine.tsv")
  if [[ $(wc -l <<<"$reasons") != 3 || $reasons != *"has the value 0"* || $reasons != *"truncated or damaged"* ]]; then
    fault "$run: quarantine.tsv has $reasons"
  fi
done
twice=$(cat "$folder"/out/logs/jobs/*/*.jsonl | grep '"event": "meshed"' | grep -o '"key": "[0-9a-f]*"' | sort | uniq -d | wc -l)
if ((twice > 0)); then fault "$twice scans were meshed twice"; fi
begun=$(cat "$folder"/out/logs/jobs/*/*.jsonl | grep -c '"event": "begun"')
if [[ $(sinfo --noheader --nodes n2 --format %t) != drain* ]]; then fault "n2 is not drained"; fi
nodes=$(scontrol show jobs --oneliner | sed -n 's/.*StartTime=\([^ ]*\).* NodeList=\(n[0-9]\).*/\1 \2/p')
late=$(TZ=UTC awk -v at="$drained_at" '$2 == "n2" && $1 > at' <<<"$nodes" | wc -l)
if ((late > 1)); then fault "$late jobs began on the drained node"; fi
if "$scantet" cohort "$folder/study" "$folder/out" group >/dev/null; then :; else fault "the group level failed"; fi

printf '%-28s %s\n' subjects "$subjects" meshes "$(wc -l <"$folder/out.sums"), the same as undisturbed" quarantined 2 \
  "kills" "3, and $killed meshing programs" "slurmctld restarted" once "drained nodes" "1 of 3" "meshes begun, finished" "$begun, $((subjects - 2))" \
  "seconds undisturbed, 2 cores" "$quiet_seconds" "seconds through Slurm" "$slurm_seconds" faults "$faults"
exit $((faults > 0))
