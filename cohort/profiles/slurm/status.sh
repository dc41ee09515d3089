#!/bin/sh
# Says what has become of a Slurm job: running, success or failed. A job that Slurm has forgotten counts as success, for then
# Snakemake looks for its output, which tells. While Slurm does not answer, the job counts as running.
job=$1
if shown=$(scontrol show job --oneliner "$job" 2>&1); then
  state=$(printf '%s\n' "$shown" | sed -n 's/.* JobState=\([A-Z_]*\).*/\1/p' | head -n 1)
else
  case $shown in
    *"Invalid job id"*) state=$(sacct --jobs "$job" --noheader --parsable2 --allocations --format State 2>/dev/null | head -n 1) ;;
    *) echo running; exit 0 ;;
  esac
fi
case $state in
  COMPLETED | "") echo success ;;
  PENDING | CONFIGURING | RUNNING | COMPLETING | REQUEUED | REQUEUE_HOLD | REQUEUE_FED | RESIZING | SIGNALING | STAGE_OUT | STOPPED | SUSPENDED | SPECIAL_EXIT) echo running ;;
  *) echo failed ;;
esac
