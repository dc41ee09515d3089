#!/usr/bin/python3
"""What a cohort costs beside the meshing itself.

  cohort_speed.py throughput [--count N] [--side N] [--size MM] [--turns N] [--program FILE]
      synthetic scans through `scantet cohort` on two cores, and through two command lines side by side that write the same
      files, each taking the next scan when it is done; in turn, twice each. Prints seconds and
      the share.
  cohort_speed.py scheduler [--count N] [--program FILE]
      how long Snakemake takes to lay out N jobs, and what memory; how long it takes to find N scans and to checksum a GB."""
import argparse
import concurrent.futures
import hashlib
import os
import pathlib
import resource
import shutil
import subprocess
import sys
import tempfile
import time
from typing import List

ROOT = pathlib.Path(__file__).resolve().parent.parent
sys.path.insert(0, str(ROOT / "cohort"))
from make_subjects import make_dataset  # noqa: E402

from scantet_cohort import hashing, workflow  # noqa: E402
from scantet_cohort.layout import Layout  # noqa: E402
from scantet_cohort.scans import Choice, find_scans  # noqa: E402


def cohort_seconds(program: str, study: pathlib.Path, output: pathlib.Path, options: List[str]) -> float:
    begin = time.monotonic()
    subprocess.run([program, "cohort", str(study), str(output), "participant", "--n-cpus", "2", "--", *options],
                   check=True, stdout=subprocess.DEVNULL)
    return time.monotonic() - begin


def side_by_side_seconds(program: str, study: pathlib.Path, output: pathlib.Path, options: List[str]) -> float:
    output.mkdir()

    def mesh(scan: pathlib.Path) -> None:
        place = str(output / scan.parent.parent.name)
        subprocess.run([program, "mesh", str(scan), *options, "--quiet", "--threads", "1", "-o", place + ".vtu", "--report",
                        place + ".html", "--report", place + ".json"], check=True, stderr=subprocess.DEVNULL)

    begin = time.monotonic()
    with concurrent.futures.ThreadPoolExecutor(2) as pool:
        list(pool.map(mesh, sorted(study.glob("sub-*/anat/*.nii.gz"))))
    return time.monotonic() - begin


def processor_seconds() -> float:
    """What processes that have ended took, which other work on the machine disturbs less than the clock."""
    usage = resource.getrusage(resource.RUSAGE_CHILDREN)
    return usage.ru_utime + usage.ru_stime


def throughput(arguments: argparse.Namespace) -> None:
    options = ["--level", "60", "--size", str(arguments.size)]
    with tempfile.TemporaryDirectory(prefix="scantet_cohort_") as name:
        folder = pathlib.Path(name)
        make_dataset(folder / "study", arguments.count, arguments.side)
        print(f"{arguments.count} scans of {arguments.side}^3 voxels, --size {arguments.size}, load {os.getloadavg()[0]:.1f}")
        sums, processors = [0.0, 0.0], [0.0, 0.0]
        for turn in range(arguments.turns):
            for index, measure in enumerate((side_by_side_seconds, cohort_seconds)):
                output = folder / f"out{turn}{index}"
                before = processor_seconds()
                seconds = measure(arguments.program, folder / "study", output, options)
                processor = processor_seconds() - before
                sums[index] += seconds
                processors[index] += processor
                print(f"{measure.__name__[:-8]:14} {seconds:8.1f} s, of processors {processor:8.1f} s   load {os.getloadavg()[0]:.1f}", flush=True)
                shutil.rmtree(output)
        print(f"throughput of the cohort: {100 * sums[0] / sums[1]:.1f} % of two command lines side by side; "
              f"by processor time {100 * processors[0] / processors[1]:.1f} %")


def scheduler(arguments: argparse.Namespace) -> None:
    with tempfile.TemporaryDirectory(prefix="scantet_cohort_") as name:
        folder = pathlib.Path(name)
        for number in range(arguments.count):
            place = folder / "study" / f"sub-{number:06d}" / "anat"
            place.mkdir(parents=True)
            (place / f"sub-{number:06d}_T1w.nii.gz").write_bytes(str(number).encode())
        begin = time.monotonic()
        scans = find_scans(folder / "study", folder / "out", Choice())
        print(f"finding {len(scans)} scans: {time.monotonic() - begin:.1f} s")
        begin = time.monotonic()
        hashing.Checksums(folder / "hashes.json").of([scan.path for scan in scans], 2)
        print(f"opening and checksumming them, a few bytes each: {time.monotonic() - begin:.1f} s")
        block = folder / "block"
        block.write_bytes(os.urandom(1 << 20) * 1000)
        begin = time.monotonic()
        hashing.file_sha256(block)
        print(f"checksum of 1.05 GB on one core: {time.monotonic() - begin:.1f} s")
        layout = Layout(folder / "out")
        targets = []
        for number in range(arguments.count):
            key = hashlib.sha256(str(number).encode()).hexdigest()[:32]
            targets.append(f".scantet/results/{key[:2]}/{key}.json")
        begin = time.monotonic()
        machine = workflow.Machine(2, 20000, None, 1)
        workflow.run_snakemake(layout, machine, "mesh", targets, ["--dry-run"])
        memory = resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss * 1024
        print(f"Snakemake lays out {arguments.count} jobs: {time.monotonic() - begin:.1f} s, {memory / 1e6:.0f} MB")


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("what", choices=["throughput", "scheduler"])
    parser.add_argument("--count", type=int, default=16)
    parser.add_argument("--side", type=int, default=128)
    parser.add_argument("--size", type=float, default=1.2)
    parser.add_argument("--turns", type=int, default=2)
    parser.add_argument("--program", default=str(ROOT / "build/release/bin/scantet"))
    arguments = parser.parse_args()
    throughput(arguments) if arguments.what == "throughput" else scheduler(arguments)


if __name__ == "__main__":
    main()
