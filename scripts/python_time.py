#!/usr/bin/env python3
"""Measures what meshing from Python takes beside the command: the same jobs, in pairs, in turn.

    PYTHONPATH=build/release/python scripts/python_time.py [--program FILE] [--pairs N] [JOB...]

Each run is a process of its own that writes a .vtu, the order within a pair changing from pair to pair. Of both, the wall
time of the process is taken, and for Python that of the call of scantet.mesh(), too, without the start of Python
and NumPy. Prints the median of each, the ratio of the medians (call to command), and whether the bytes are the same.
"""
import argparse
import hashlib
import os
import pathlib
import statistics
import subprocess
import sys
import tempfile
import time

ROOT = pathlib.Path(__file__).resolve().parent.parent
VOLUMES = pathlib.Path(os.environ.get("SCANTET_VOLUMES", ROOT.parent / "shared" / "volumes"))
JOBS = {
    "sphere": (ROOT / "sample_volumes" / "sphere.nrrd", 127.5, 0.8),
    "torus": (ROOT / "sample_volumes" / "torus.nrrd", 300.5, 0.5),
    "skull_2mm": (VOLUMES / "skull.nrrd", 2.9, 2.0),
    "brain_3mm": (pathlib.Path("/usr/share/mricron/templates/ch2bet.nii.gz"), 20.0, 3.0),
}
CALL = """
import sys, time, warnings
import scantet
warnings.simplefilter("ignore", scantet.UnmetWarning)
scan, level, size, out = sys.argv[1:]
start = time.perf_counter()
scantet.mesh(scan, level=float(level), size=float(size), output=out)
print(time.perf_counter() - start)
"""


def run(words):
    start = time.perf_counter()
    done = subprocess.run(words, capture_output=True, text=True, check=False)
    if done.returncode not in (0, 4):
        sys.exit(done.stderr)
    return time.perf_counter() - start, done.stdout


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--program", default=ROOT / "build" / "release" / "bin" / "scantet")
    parser.add_argument("--pairs", type=int, default=5)
    parser.add_argument("jobs", nargs="*", default=list(JOBS))
    arguments = parser.parse_args()
    for name in arguments.jobs:
        scan, level, size = JOBS[name]
        if not scan.exists():
            print(f"left out: {name}, as there is no {scan}")
            continue
        command, call, process = [], [], []
        with tempfile.TemporaryDirectory() as folder:
            ours, theirs = pathlib.Path(folder) / "python.vtu", pathlib.Path(folder) / "command.vtu"
            for pair in range(arguments.pairs):
                for which in (pair % 2, 1 - pair % 2):
                    if which == 0:
                        command.append(run([arguments.program, "mesh", scan, "--level", repr(level), "--size", repr(size),
                                            "--quiet", "-o", theirs])[0])
                    else:
                        wall, printed = run([sys.executable, "-c", CALL, scan, repr(level), repr(size), ours])
                        process.append(wall)
                        call.append(float(printed))
            same = hashlib.sha256(ours.read_bytes()).digest() == hashlib.sha256(theirs.read_bytes()).digest()
        a, b, c = (statistics.median(times) for times in (command, call, process))
        print(f"{name}: command {a:.3f} s, call {b:.3f} s (ratio {b / a:.3f}), process of Python {c:.3f} s, "
              f"{'the same bytes' if same else 'OTHER BYTES'}", flush=True)


if __name__ == "__main__":
    main()
