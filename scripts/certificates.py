#!/usr/bin/env python3
"""Meshes volumes, verifies the meshes, and prints the tables of docs/certificate.md.

    scripts/certificates.py [--skull FILE] [--brains FOLDER] [--no-samples] [--program FILE]

Without options the sample volumes: the grey ones in all their frames, once more with --certify refine if they are not
certified, and the label maps with --certify bounded. --skull adds the paper's head CT (skull.nrrd, level 2.9) at 2 and 1 mm;
--brains those of MRIcron (ch2bet, inia19-t1-brain) in that folder, /usr/share/mricron/templates. A row says how the mesher ended
if not with status 0, how many facets have a collar, how large a share of the area that is, and what keeps the mesh from being
certified, each finding with how many places it has.
"""
import argparse
import json
import os
import pathlib
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent
SAMPLES = ROOT / "sample_volumes"
SIZES = {"sphere.nrrd": [2, 1], "torus.nrrd": [2, 1], "tanglecube.nrrd": [2], "bar.mha": [1.5]}  # others: 1


def sample_rows():
    """The grey samples: file, level, side."""
    for line in (SAMPLES / "README.md").read_text(encoding="utf-8").splitlines():
        cells = [cell.strip() for cell in line.strip("|").split("|")]
        if len(cells) > 3 and cells[2] in ("above", "below"):
            yield cells[0], cells[1], cells[2]


def run(program, words):
    """Exit status and what it said."""
    done = subprocess.run([str(program), *map(str, words)], capture_output=True, text=True, check=False)
    return done.returncode, done.stderr.strip()


def why_of(certificate):
    return ", ".join(f"`{finding['code']}`" + (f" × {finding['count']}" if finding["count"] > 1 else "")
                     for finding in certificate["findings"]) or "–"


def distance_text(distance):
    if distance["upper_mm"] is None:
        return "not bounded"
    return f"{distance['upper_mm']:.3g} ({distance['lower_mm']:.3g})"


def verified(program, mesh, scan, words):
    """The certificate; nothing if there is no mesh."""
    if not mesh.exists():
        return None
    told = mesh.with_suffix(".cert.json")
    run(program, ["verify", mesh, "--against", scan, *words, "--json", told])
    return json.loads(told.read_text(encoding="utf-8"))


def meshed(program, folder, scan, words, size, more=()):
    """The mesh, which may not be there, the report and the exit status."""
    mesh, report = folder / "mesh.vtu", folder / "mesh.json"
    for old in (mesh, report):
        old.unlink(missing_ok=True)
    status, said = run(program, ["mesh", scan, *words, "--size", size, "-o", mesh, "--report", report, "--quiet", *more])
    if not mesh.exists():
        print(said, file=sys.stderr)
    return mesh, json.loads(report.read_text(encoding="utf-8")) if report.exists() else {}, status


def print_row(name, size, how, status, certificate):
    if certificate is None:
        print(f"| {name} | {size} | {how} | no mesh, status {status} | – | – | – | – | – |", flush=True)
        return
    facets = certificate["facets"]
    share = 100 * facets["area_certified_mm2"] / facets["area_mm2"]
    ended = "" if status == 0 else f", status {status}"
    print(f"| {name} | {size} | {how} | {certificate['grade']}{ended} | {facets['certified']} of {facets['count']} | {share:.6g} % | "
          f"{distance_text(certificate['mesh_to_level'])} | {distance_text(certificate['level_to_mesh'])} | {why_of(certificate)} |", flush=True)


def grey_rows(program, folder, scan, words, size, how="", refines=True):
    mesh, _, status = meshed(program, folder, scan, words, size)
    certificate = verified(program, mesh, scan, words)
    print_row(scan.name, size, how or "–", status, certificate)
    if not refines or certificate is None or certificate["grade"] == "certified":
        return
    mesh, report, status = meshed(program, folder, scan, words, size, ["--certify", "refine"])
    added = report.get("certificate", {}).get("points_added", 0)
    print_row(scan.name, size, f"refine: {added} more vertices", status, verified(program, mesh, scan, words))


def label_row(program, folder, scan, size):
    _, report, status = meshed(program, folder, scan, ["--labels", "all"], size, ["--certify", "bounded"])
    certificate = report["certificate"]
    parts = sum(region["mesh_components"] for region in certificate["regions"])
    print(f"| {scan.name} | {size} | {certificate['grade']}{'' if status == 0 else f', status {status}'} | {parts} | "
          f"{distance_text(certificate['mesh_to_field'])} | {distance_text(certificate['field_to_mesh'])} | {why_of(certificate)} |", flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--skull", type=pathlib.Path)
    parser.add_argument("--brains", type=pathlib.Path)
    parser.add_argument("--no-samples", action="store_true")
    parser.add_argument("--program", default=os.environ.get("SCANTET_PROGRAM", str(ROOT / "build/release/bin/scantet")))
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        print("| scan | size, mm | how | grade | facets with a collar | of the area | mesh to level at most (at least), mm | "
              "level to mesh at most (at least), mm | what keeps it from more |\n" + "| --- " * 9 + "|")
        for file, level, side in [] if options.no_samples else sample_rows():
            for size in SIZES.get(file, [1]):
                grey_rows(options.program, folder, SAMPLES / file, ["--level", level, "--inside", side], size)
        for size in [2, 1] if options.skull else []:
            grey_rows(options.program, folder, options.skull, ["--level", 2.9], size)
        if options.brains:
            ch2, inia = options.brains / "ch2bet.nii.gz", options.brains / "inia19-t1-brain.nii.gz"
            for level, sizes in ((20, [2, 3]), (20.5, [3]), (60, [4])):
                for size in sizes:
                    grey_rows(options.program, folder, ch2, ["--level", level], size, f"level {level}", False)
            for level, size in ((20, 3), (60, 4)):
                grey_rows(options.program, folder, ch2, ["--level", level, "--smooth", 1], size, f"level {level}, smoothed by 1 mm", False)
            grey_rows(options.program, folder, inia, ["--level", 100], 1, "level 100", False)
        if not options.no_samples:
            print("\n| label map | size, mm | grade | parts | mesh to field at most (at least), mm | field to mesh at most (at least), mm | "
                  "what is not proved |\n" + "| --- " * 7 + "|")
            for scan in sorted(SAMPLES.glob("labels_*.nrrd")):
                label_row(options.program, folder, scan, 2)


if __name__ == "__main__":
    main()
