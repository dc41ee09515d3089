#!/usr/bin/env python3
"""Meshes segmentations into few ragged tissues: brains of Debian's mricron-data, cut at grey values.

    scripts/tissues.py [--only SCAN:VALUE,VALUE,… ...] [--every N] [--size MM] [--threads N] [--program FILE]

Labels are how many of the values a voxel reaches, so that they are as ragged as the scan is rough: thousands of parts, some
of one voxel, and connections of a voxel's width. --every: only each Nth slice, for voxels N times as high as wide. A row a
mesh: tets, places where the size was made finer, seconds, the exit status, and what it says is left. Needs nothing but Python.
"""
import argparse
import gzip
import json
import pathlib
import struct
import subprocess
import sys
import tempfile
import time

ROOT = pathlib.Path(__file__).resolve().parent.parent
FOLDER = pathlib.Path("/usr/share/mricron/templates")
SCANS = ["ch2bet:20,60,100", "ch2:40,70,100", "inia19-t1-brain:60,110"]
UINT8 = 2


def cut(scan, every, path):
    """Writes the scan's labels as a NIfTI file."""
    name, values = scan.split(":")
    values = [int(value) for value in values.split(",")]
    data = gzip.decompress((FOLDER / f"{name}.nii.gz").read_bytes())
    header = bytearray(data[:352])
    sizes = struct.unpack_from("<4h", header, 40)
    if struct.unpack_from("<h", header, 70)[0] != UINT8:
        sys.exit(f"{name}: only scans of bytes can be cut")
    begin = int(struct.unpack_from("<f", header, 108)[0])
    slice_voxels = sizes[1] * sizes[2]
    kept = range(0, sizes[3], every)
    table = bytes(sum(value >= other for other in values) for value in range(256))
    voxels = b"".join(data[begin + k * slice_voxels:begin + (k + 1) * slice_voxels] for k in kept).translate(table)
    struct.pack_into("<h", header, 46, len(kept))
    struct.pack_into("<f", header, 88, every * struct.unpack_from("<f", header, 88)[0])  # pixdim[3]
    for row in (280, 296, 312):  # of the affine map, their third column
        struct.pack_into("<f", header, row + 8, every * struct.unpack_from("<f", header, row + 8)[0])
    struct.pack_into("<f", header, 108, 352)
    path.write_bytes(gzip.compress(bytes(header) + voxels, compresslevel=1))


def mesh(options, scan):
    """Seconds, exit status, messages and report of one mesh."""
    size = ["--size", options.size] if options.size else []
    with tempfile.TemporaryDirectory() as folder:
        labels, report = pathlib.Path(folder) / "labels.nii.gz", pathlib.Path(folder) / "report.json"
        cut(scan, options.every, labels)
        begin = time.monotonic()
        done = subprocess.run(
            [options.program, "mesh", labels, "--labels", "all", *size, "--threads", str(options.threads), "--quiet",
             "--output", pathlib.Path(folder) / "mesh.vtu", "--report", report],
            capture_output=True, text=True, check=False)
        seconds = time.monotonic() - begin
        if not report.exists():
            sys.exit(f"{scan}: status {done.returncode}: {done.stderr.strip()}")
        return seconds, done.returncode, done.stderr.splitlines(), json.loads(report.read_text(encoding="utf-8"))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--only", nargs="+", default=SCANS, metavar="SCAN:VALUE,VALUE,…")
    parser.add_argument("--every", type=int, default=1, metavar="N")
    parser.add_argument("--size", metavar="MM", help="default: the program's")
    parser.add_argument("--threads", type=int, default=2)
    parser.add_argument("--program", default=ROOT / "build/release/bin/scantet")
    options = parser.parse_args()
    print("| scan, cut at | tets | finer places | s | status |\n| --- | ---: | ---: | ---: | ---: |")
    for scan in options.only:
        seconds, status, messages, report = mesh(options, scan)
        finer = report["optimization"].get("finer", {}).get("places", 0)
        print(f"| {scan} | {report['mesh']['tets']:,} | {finer} | {seconds:.0f} | {status} |", flush=True)
        for message in messages:
            print(f"<!-- {message} -->")


if __name__ == "__main__":
    main()
