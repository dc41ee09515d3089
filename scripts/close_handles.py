#!/usr/bin/env python3
"""Meshes the brains of Debian's mricron-data with --close-handles, and prints the table of docs/algorithm.md.

    scripts/close_handles.py [--only SCAN:LEVEL ...] [--size MM] [--mm MM ...] [--threads N] [--program FILE]

Each is meshed without the option first. A row a mesh: handles of the field (of the image as it is, or as changed), cuts and
fillings, voxels changed, processor seconds of closing (the report's phase "handles"), vertices, handles of the mesh (surfaces
less half the Euler number of the boundary), and the exit status. Needs nothing but Python.
"""
import argparse
import json
import pathlib
import re
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent
FOLDER = pathlib.Path("/usr/share/mricron/templates")
SCANS = ["ch2bet:60", "ch2bet:20", "inia19-t1-brain:100"]
CLOSED = re.compile(r"leaves (\d+) of (\d+) handles?: (\d+) cuts? and (\d+) fillings? change (\d+) voxel")


def mesh(program, scan, words, threads):
    """The report of one mesh and its exit status."""
    name, level = scan.split(":")
    with tempfile.TemporaryDirectory() as folder:
        report = pathlib.Path(folder) / "report.json"
        done = subprocess.run(
            [program, "mesh", FOLDER / f"{name}.nii.gz", "--level", level, *words, "--threads", str(threads), "--quiet",
             "--output", pathlib.Path(folder) / "mesh.vtu", "--report", report],
            capture_output=True, text=True, check=False)
        if not report.exists():
            sys.exit(f"{scan} {' '.join(words)}: status {done.returncode}: {done.stderr.strip()}")
        return json.loads(report.read_text(encoding="utf-8")), done.returncode


def closed(report):
    """Handles left, handles of the image, cuts, fillings, voxels changed; None if the report tells nothing of closing."""
    found = next(filter(None, map(CLOSED.search, report["notes"])), None)
    return [int(number) for number in found.groups()] if found else None


def row(scan, mm, report, status, handles, changes):
    name, level = scan.split(":")
    seconds = sum(phase["cpu_seconds"] for phase in report["phases"] if phase["part"] == "handles")
    topology = report["topology"]
    of_mesh = topology["boundary_components"] - topology["euler"] // 2
    cuts, fillings, voxels = changes or ("–", "–", "–")
    return [f"{name}.nii.gz", level, mm or "–", handles, f"{cuts} + {fillings}" if changes else "–", voxels,
            f"{seconds:.1f}" if changes else "–", f"{report['mesh']['vertices']:,}", of_mesh, status]


def rows_of(options, scan):
    """The first row is without the option; the others tell how many handles the image has."""
    size = ["--size", options.size]
    plain, status = mesh(options.program, scan, size, options.threads)
    rows, of_image = [], "–"
    for mm in options.mm:
        report, status_closed = mesh(options.program, scan, [*size, "--close-handles", mm], options.threads)
        told = closed(report)
        if told is None:
            sys.exit(f"{scan} --close-handles {mm}: no note says what was closed")
        left, of_image, *changes = told
        rows.append(row(scan, mm, report, status_closed, left, changes))
    return [row(scan, None, plain, status, of_image, None), *rows]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--only", nargs="+", default=SCANS, metavar="SCAN:LEVEL")
    parser.add_argument("--size", default="3", metavar="MM")
    parser.add_argument("--mm", nargs="+", default=["1", "2", "4"], metavar="MM")
    parser.add_argument("--threads", type=int, default=2)
    parser.add_argument("--program", type=pathlib.Path, default=ROOT / "build" / "release" / "bin" / "scantet")
    options = parser.parse_args()
    print("| scan | level | MM | handles of the field | cuts + fillings | voxels changed | processor time, s | vertices of the mesh | its handles "
          "| exit status |")
    print("| --- " * 10 + "|")
    for scan in options.only:
        for cells in rows_of(options, scan):
            print("| " + " | ".join(map(str, cells)) + " |", flush=True)


if __name__ == "__main__":
    main()
