#!/usr/bin/env python3
"""Measures what a whole run of scantet takes, and which share of it is not spent on making the mesh.

    scripts/whole_command.py [--program FILE] [--runs N] [--threads N] [--parts] [--json FILE] [JOB...]

Each job writes a .vtu and a JSON report; with +html behind its name, a page, too. The rest is the wall time of the
process, from its start to its end, less sampling, refining and improving, as the report has them. Medians of --runs
runs (3), the jobs in turn. The share by processor time does not suffer from what else the machine does: that of the
phases in the report (reading, checking, writing) over that of the process. --parts lists these phases. --json
writes the figures to a file, of which benchmarks/page.py makes a table. A job whose
scan is not on this machine is left out with a line that says so.
"""

import argparse
import json
import os
import pathlib
import statistics
import subprocess
import tempfile
import time

ROOT = pathlib.Path(__file__).resolve().parent.parent
VOLUMES = pathlib.Path(os.environ.get("SCANTET_VOLUMES", ROOT.parent / "shared" / "volumes"))
TEMPLATES = pathlib.Path("/usr/share/mricron/templates")
BRAIN = TEMPLATES / "ch2bet.nii.gz"
JOBS = {
    "skull_2mm": (VOLUMES / "skull.nrrd", ["--level", "2.9", "--size", "2"]),
    "skull_1mm": (VOLUMES / "skull.nrrd", ["--level", "2.9", "--size", "1"]),
    "brain60_3mm": (BRAIN, ["--level", "60", "--size", "3"]),
    "brain20_3mm": (BRAIN, ["--level", "20", "--size", "3"]),
    "aal_2mm": (TEMPLATES / "aal.nii.gz", ["--labels", "all", "--size", "2"]),
}


def run(program, job, threads, folder):
    """One run. Return: wall and processor seconds of the process, and its report."""
    name, _, form = job.partition("+")
    scan, how = JOBS[name]
    report = folder / "a.json"
    command = [program, "mesh", str(scan), *how, "-o", str(folder / "a.vtu"), "--report", str(report)]
    if form:
        command += ["--report", str(folder / ("a." + form))]
    if threads:
        command += ["--threads", str(threads)]
    start = time.monotonic()
    process = subprocess.Popen(command, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    _, status, usage = os.wait4(process.pid, 0)
    wall = time.monotonic() - start
    process.returncode = os.waitstatus_to_exitcode(status)
    if process.returncode not in (0, 4):
        raise SystemExit(f"{' '.join(command)}: status {process.returncode}")
    return wall, usage.ru_utime + usage.ru_stime, json.loads(report.read_text())


def rest_of(wall, report):
    """The seconds that were not spent on making the mesh."""
    timing = report["timing_s"]
    return wall - sum(timing.get(part, 0) for part in ("sample", "refine", "optimize"))


def phases_of(report, key):
    """The seconds of each phase; several of a name are added up."""
    parts = {}
    for phase in report.get("phases", []):
        name = f"{phase['stage']}: {phase['part']}"
        parts[name] = parts.get(name, 0) + phase[key]
    return parts


def main():
    arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    arguments.add_argument("--program", default=str(ROOT / "build/release/bin/scantet"))
    arguments.add_argument("--runs", type=int, default=3)
    arguments.add_argument("--threads", type=int, default=0)
    arguments.add_argument("--parts", action="store_true")
    arguments.add_argument("--json", type=pathlib.Path)
    arguments.add_argument("jobs", nargs="*", metavar="JOB", help=", ".join(JOBS) + "; each also with +html")
    chosen = arguments.parse_args()
    jobs = chosen.jobs or [name + form for name in JOBS for form in ("", "+html")]
    present = [job for job in jobs if JOBS[job.partition("+")[0]][0].exists()]
    for job in jobs:
        if job not in present:
            print(f"{job}: left out, as there is no {JOBS[job.partition('+')[0]][0]}")

    runs = {job: [] for job in present}
    with tempfile.TemporaryDirectory() as folder:
        for _ in range(chosen.runs):
            for job in present:
                runs[job].append(run(chosen.program, job, chosen.threads, pathlib.Path(folder)))
    rows = []
    print(f"{'job':18} {'tets':>9} {'whole s':>8} {'rest s':>7} {'share':>6} {'cpu s':>7} {'rest s':>7} {'share':>6}")
    for job, measured in runs.items():
        whole = statistics.median([wall for wall, _, _ in measured])
        rest = statistics.median([rest_of(wall, report) for wall, _, report in measured])
        share = statistics.median([rest_of(wall, report) / wall for wall, _, report in measured])
        cpu = statistics.median([cpu for _, cpu, _ in measured])
        rest_cpu = statistics.median([sum(phases_of(report, "cpu_seconds").values()) for _, _, report in measured])
        tets = measured[0][2]["mesh"]["tets"]
        print(f"{job:18} {tets:9,} {whole:8.2f} {rest:7.2f} {share:6.0%} {cpu:7.2f} {rest_cpu:7.2f} {rest_cpu / cpu:6.0%}")
        rows.append({"job": job, "tets": tets, "whole_s": whole, "rest_s": rest, "share": share, "cpu_s": cpu, "rest_cpu_s": rest_cpu,
                     "cpu_share": rest_cpu / cpu})
        if not chosen.parts:
            continue
        for name in phases_of(measured[0][2], "seconds"):
            seconds = statistics.median([phases_of(report, "seconds")[name] for _, _, report in measured])
            cpu_seconds = statistics.median([phases_of(report, "cpu_seconds")[name] for _, _, report in measured])
            print(f"    {name:38} {seconds:7.3f} s, {cpu_seconds:7.3f} s of processor time")
    if chosen.json:
        command = "scripts/whole_command.py " + " ".join(["--runs", str(chosen.runs)] + chosen.jobs)
        chosen.json.write_text(json.dumps({"command": command.strip(), "rows": rows}, indent=2) + "\n")


if __name__ == "__main__":
    main()
