#!/usr/bin/env python3
"""Meshes segmentations that Debian has and says, for each, what of it the mesh does not have.

    scripts/atlases.py [--only NAME ...] [--optimize none|full ...] [--voxels N] [--threads N] [--seconds S]
                       [--program FILE]

They are the atlases of mricron-data, of which four are meshed without --only (all: each there is), and the liver of
libcgal-demo. Each is meshed with --labels all at N times its voxels' least edge (default 2), without improvement and with
it. A line of a table each: exit status, findings of the audit by kind, elements out of bounds, components where the field
has another number, labels of over 1,000 voxels whose volume is more than 0.5 % off their voxels' (and the most that one is off), voxel
centres that are not in their label's region, seconds of processor time. A run that takes more than S seconds of it
(default 300) is ended and said not to have ended. Needs nothing but Python.
"""
import argparse
import collections
import gzip
import json
import os
import pathlib
import resource
import signal
import struct
import subprocess
import sys
import tarfile
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent
FOLDER = pathlib.Path("/usr/share/mricron/templates")
ATLASES = {"aal": "aal.nii.gz", "AICHA": "AICHAmc.nii.gz", "Harvard-Oxford": "HarvardOxford-cort-maxprob-thr0-1mm.nii.gz",
           "natbrainlab": "natbrainlab.nii.gz", "JHU": "JHU-WhiteMatter-labels-1mm.nii.gz",
           "JHU-2mm": "JHU-WhiteMatter-labels-2mm.nii.gz", "jhu189": "jhu189.nii.gz", "brodmann": "brodmann.nii.gz",
           "NeuroMaps": "inia19-NeuroMaps.nii.gz"}
ASKED_FOR = 4       # the first of them, without --only
LIVER = pathlib.Path("/usr/share/doc/libcgal-dev/data.tar.gz"), "data/images/liver.inr.gz"
LARGE = 1000        # voxels
MOST_OFF = 0.5      # percent


def voxel_mm(path):
    """The least spacing in the header of a NIfTI-1 or INRIMAGE file."""
    with gzip.open(path) as file:
        header = file.read(256)
    if header.startswith(b"#INRIMAGE"):
        return min(float(line[3:]) for line in header.decode("latin-1").splitlines() if line[:3] in ("VX=", "VY=", "VZ="))
    return min(abs(mm) for mm in struct.unpack("<8f", header[76:108])[1:4])


def path_of(name, folder):
    """The file of a segmentation."""
    if name != "liver":
        return FOLDER / ATLASES[name]
    archive, member = LIVER
    with tarfile.open(archive) as data:
        data.extract(member, folder)
    return folder / member


def mesh(program, path, size, optimize, threads, seconds, folder):
    """The report (None without one), the exit status, and processor seconds."""
    report = folder / "report.json"
    report.unlink(missing_ok=True)
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    line = [program, "mesh", str(path), "--labels", "all", "--size", f"{size:g}", "--optimize", optimize, "--threads",
            str(threads), "--quiet", "--no-theory", "-o", str(folder / "mesh.vtu"), "--report", str(report)]
    run = subprocess.run(line, capture_output=True, text=True,
                         preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_CPU, (seconds, seconds + 30)))
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    spent = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    told = json.loads(report.read_text()) if report.exists() else None
    if told is None and run.returncode != -signal.SIGXCPU:
        print(run.stderr.strip(), file=sys.stderr)
    return told, run.returncode, spent


def described(told, status, spent, seconds):
    """The cells of a row."""
    if told is None:
        return [f"not ended after {seconds} s" if status == -signal.SIGXCPU else f"status {status}"] + [""] * 6
    findings = collections.Counter()
    for finding in told["audit"]["findings"]:
        findings[finding["code"].removeprefix("audit.")] += finding["count"]
    labels = [region for region in told["regions"] if region["region"] != 0]
    other = sum(region["components"] != region["field_components"] for region in labels)
    large = [abs(region["off_voxels_percent"]) for region in labels if region["voxels"] > LARGE]
    off = [percent for percent in large if percent > MOST_OFF]
    lost = sum(region["voxels"] - region["voxels_kept"] for region in told["regions"])
    all_centres = sum(region["voxels"] for region in told["regions"])
    broken = [f"{bound['name']} {bound['broken']:,}" for bound in told["bounds"] if bound["broken"]]
    return [str(status), ", ".join(f"{code} {count:,}" for code, count in sorted(findings.items())) or "none",
            ", ".join(broken) or "none", f"{other} of {len(labels)}",
            f"{len(off)} of {len(large)}, {max(large, default=0):.1f} %", f"{lost:,} of {all_centres:,}", f"{spent:.0f}"]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--only", nargs="+", choices=[*ATLASES, "liver", "all"], default=list(ATLASES)[:ASKED_FOR])
    parser.add_argument("--optimize", nargs="+", choices=["none", "full"], default=["none", "full"])
    parser.add_argument("--voxels", type=float, default=2)
    parser.add_argument("--threads", type=int, default=1)
    parser.add_argument("--seconds", type=int, default=300)
    parser.add_argument("--program", default=os.environ.get("SCANTET", str(ROOT / "build/release/bin/scantet")))
    options = parser.parse_args()
    print("| atlas | improved | exit status | findings | out of bounds | labels with other components | large labels off by "
          f"over {MOST_OFF:g} %, the most | centres not kept | processor s |")
    print("|" + " --- |" * 9)
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        for atlas in [*ATLASES, "liver"] if "all" in options.only else options.only:
            try:
                path = path_of(atlas, folder)
                size = options.voxels * voxel_mm(path)
            except OSError as error:
                print(f"{atlas}: {error}; it is in Debian's mricron-data or libcgal-demo", file=sys.stderr)
                return 1
            for optimize in options.optimize:
                told, status, spent = mesh(options.program, path, size, optimize, options.threads, options.seconds, folder)
                cells = described(told, status, spent, options.seconds)
                print(f"| {atlas} | {'no' if optimize == 'none' else 'yes'} | " + " | ".join(cells) + " |", flush=True)
    return 0


if __name__ == "__main__":
    sys.exit(main())
