#!/usr/bin/python3
"""Submits a job script of Snakemake to Slurm and prints the job's number.

If a job of the same name waits or runs, as after Snakemake was killed, its number is printed and nothing is submitted: each job's name
holds the key of its scan and the output folder."""
import hashlib
import json
import os
import pathlib
import subprocess
import sys
from typing import Any, Dict, Optional


def properties_of(script: pathlib.Path) -> Dict[str, Any]:
    """What Snakemake writes into the second line of its job scripts."""
    for line in script.read_text().splitlines():
        if line.startswith("# properties = "):
            return dict(json.loads(line[len("# properties = "):]))
    sys.exit(f"{script} has no properties of a Snakemake job")


def name_of(properties: Dict[str, Any]) -> str:
    place = hashlib.sha256(os.getcwd().encode()).hexdigest()[:8]
    wildcards = properties.get("wildcards", {})
    return f"scantet-{place}-{wildcards.get('key') or wildcards.get('chunk') or properties.get('rule', 'job')}"


def running(name: str) -> Optional[str]:
    done = subprocess.run(["squeue", "--me", "--noheader", "--name", name, "--format", "%i"], capture_output=True,
                          text=True, check=False)
    return done.stdout.split()[0] if done.returncode == 0 and done.stdout.strip() else None


def main() -> int:
    script = pathlib.Path(sys.argv[-1])
    properties = properties_of(script)
    name = name_of(properties)
    job = running(name)
    if job is None:
        resources = properties.get("resources", {})
        logs = pathlib.Path("logs", "slurm")
        logs.mkdir(parents=True, exist_ok=True)
        words = ["sbatch", "--parsable", "--requeue", "--nodes", "1", "--ntasks", "1", "--job-name", name,
                 "--cpus-per-task", str(properties.get("threads", 1)), "--mem", f"{resources.get('mem_mb', 2000)}M",
                 "--time", str(resources.get("runtime", 60)), "--output", f"{logs}/%x-%j.out", str(script)]
        done = subprocess.run(words, stdout=subprocess.PIPE, text=True, check=False)
        if done.returncode != 0:
            return done.returncode
        job = done.stdout.strip().split(";")[0]
    print(job)
    return 0


if __name__ == "__main__":
    sys.exit(main())
