#!/usr/bin/env python3
"""Meshes random smooth-noise volumes and says how many keep the components, cavities and handles of their field.

    scripts/noise_volumes.py [--count N] [--first SEED] [--size VOXELS ...] [--voxels N] [--sheets N] [--white N ...]
                             [--checkerboard N ...] [--thin VOXELS ...] [--masks] [--require told|equal] [--seconds S] [--verify]
                             [--program FILE]

Volume number SEED is noise of that seed, N x N x N voxels of 1 mm (default 32), smoothed by a Gaussian of 1.2 to 3
voxels, at a level between the 5th and the 95th percentile of its values. It is meshed at each size (default: 1 and 2
voxels). --sheets N adds two volumes of N parallel sheets, one voxel thick and one apart, alone and with two posts between
each two, at a size of one voxel. --white N adds noise of 16 bits that is not smoothed, N x N x N voxels, at its median;
--checkerboard N voxels of 0 and 1 in turn at 0.5; --thin VOXELS one sheet so thick; each of these at the default size.
--masks makes masks of the volumes of noise, 1 above their level and 0 elsewhere, and meshes these at 0.5.
What the field has comes from `scantet info`, what the mesh has from its JSON report.

--verify holds each mesh against its scan with `scantet verify`: the line says the grade and the share of facets and of area with a
collar; the summary says how many meshes have each grade, and how many that are equal are not bounded.

A line for each mesh: components, cavities and handles of the mesh, and of the field where they differ; exit status;
seconds. Then a summary. Status 1 if a loss is silent: exit status 0 though something differs (--require told, the
default); if anything differs (--require equal); if boundary facets of a mesh cross (at the default size only if that is
not told); or if one takes longer than --seconds (default 600). Needs nothing but Python.
"""
import argparse
import array
import collections
import json
import math
import os
import pathlib
import random
import subprocess
import sys
import tempfile
import time

ROOT = pathlib.Path(__file__).resolve().parent.parent


def smoothed_rows(rows, weights):
    """Each row with its neighbours in it weighed; rows are as if mirrored at their ends."""
    reach = len(weights) // 2
    out = []
    for row in rows:
        n = len(row)
        wide = [row[min(abs(i), 2 * n - 2 - i) if i >= n else abs(i)] for i in range(-reach, n + reach)]
        out.append([sum(map(float.__mul__, weights, wide[i:i + len(weights)])) for i in range(n)])
    return out


def turned(rows, n):
    """Rows along the next axis: x becomes the slowest."""
    return [[rows[r * n + j][i] for j in range(n)] for i in range(n) for r in range(n)]


def smooth_noise(seed, n):
    """The values, x fastest, and the level."""
    rng = random.Random(seed)
    sigma = rng.uniform(1.2, 3)
    reach = math.ceil(4 * sigma)
    weights = [math.exp(-0.5 * (i / sigma) ** 2) for i in range(-reach, reach + 1)]
    rows = [[rng.random() for _ in range(n)] for _ in range(n * n)]
    for _ in range(3):
        rows = turned(smoothed_rows(rows, weights), n)
    values = array.array("f", [value for row in rows for value in row])
    level = sorted(values)[int(rng.uniform(0.05, 0.95) * len(values))]
    return values, level, f"noise {seed}, sigma {sigma:.2f}"


def mask(values, level, what):
    return array.array("B", [value > level for value in values]), 0.5, what + ", mask"


def sheets(count, posts):
    """Sheets across z, every second layer; with two posts between each two there is a handle for each gap."""
    n = 2 * count + 3
    values = array.array("f", [0.0] * n ** 3)
    for sheet in range(count):
        k = 2 * sheet + 2
        for j in range(2, n - 2):
            for i in range(2, n - 2):
                values[(k * n + j) * n + i] = 1.0
        if posts and sheet + 1 < count:
            for i in (3 + sheet % 5, n - 4 - sheet % 5):
                values[((k + 1) * n + n // 2) * n + i] = 1.0
    return values, 0.5, f"{count} sheets" + (" with posts" if posts else "")


def white_noise(n):
    rng = random.Random(n)
    values = array.array("H", [rng.randrange(1 << 16) for _ in range(n ** 3)])
    return values, sorted(values)[len(values) // 2] + 0.5, f"white noise {n}"


def checkerboard(n):
    values = array.array("B", [(i + j + k) % 2 for k in range(n) for j in range(n) for i in range(n)])
    return values, 0.5, f"checkerboard {n}"


def thin_sheet(thick):
    """One layer of ones; the level cuts it off so near the top that it is that thick."""
    n = 16
    inside = range(3, n - 3)
    values = array.array("f", [float(k == n // 2 and i in inside and j in inside)
                               for k in range(n) for j in range(n) for i in range(n)])
    return values, 1 - thick / 2, f"sheet of {thick:g} voxels"


def write_nrrd(path, values):
    n = round(len(values) ** (1 / 3))
    pixel = {"f": "float", "H": "ushort", "B": "uchar"}[values.typecode]
    header = f"NRRD0004\ntype: {pixel}\ndimension: 3\nsizes: {n} {n} {n}\nspacings: 1 1 1\nendian: {sys.byteorder}\nencoding: raw\n\n"
    path.write_bytes(header.encode() + values.tobytes())


def field_counts(program, scan, level):
    text = subprocess.run([program, "info", str(scan), f"--level={level!r}", "--json"], check=True, capture_output=True,
                          text=True).stdout
    section = json.loads(text)["components"]
    return tuple(section.get(key) for key in ("components", "cavities", "handles"))


def mesh_counts(program, folder, scan, level, size):
    """Counts of the mesh (None without one), whether its boundary crosses itself, exit status, seconds. size: None for the default."""
    report = folder / "mesh.json"
    report.unlink(missing_ok=True)
    begin = time.monotonic()
    sizes = [] if size is None else ["--size", str(size)]
    run = subprocess.run([program, "mesh", str(scan), f"--level={level!r}", *sizes, "--quiet", "--no-theory",
                          "-o", str(folder / "mesh.vtu"), "--report", str(report)], capture_output=True, text=True)
    seconds = time.monotonic() - begin
    if not report.exists():
        print(run.stderr.strip())
        return None, False, run.returncode, seconds
    told = json.loads(report.read_text())
    topology = told.get("topology", {})
    crosses = any(finding["code"] == "audit.crossing" for finding in told["audit"]["findings"])
    return tuple(topology.get(key) for key in ("components", "cavities", "handles")), crosses, run.returncode, seconds


def certificate_text(program, folder, scan, level):
    """The grade of the mesh, and a text of it."""
    file = folder / "mesh.cert.json"
    file.unlink(missing_ok=True)
    subprocess.run([program, "verify", str(folder / "mesh.vtu"), "--against", str(scan), f"--level={level!r}", "--json", str(file)],
                   capture_output=True, check=False)
    if not file.exists():
        return "not verified", "not verified"
    told = json.loads(file.read_text())
    facets = told["facets"]
    text = (f"{told['grade']}, collars: {100 * facets['certified'] / facets['count']:.2f} % of facets, "
            f"{100 * facets['area_certified_mm2'] / facets['area_mm2']:.2f} % of area")
    return told["grade"], text


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--count", type=int, default=100)
    parser.add_argument("--first", type=int, default=1)
    parser.add_argument("--size", type=float, nargs="+", default=[1.0, 2.0])
    parser.add_argument("--voxels", type=int, default=32)
    parser.add_argument("--sheets", type=int, default=0)
    parser.add_argument("--white", type=int, nargs="+", default=[])
    parser.add_argument("--checkerboard", type=int, nargs="+", default=[])
    parser.add_argument("--thin", type=float, nargs="+", default=[])
    parser.add_argument("--masks", action="store_true")
    parser.add_argument("--require", choices=["told", "equal"], default="told")
    parser.add_argument("--seconds", type=float, default=600)
    parser.add_argument("--verify", action="store_true")
    parser.add_argument("--program", default=os.environ.get("SCANTET", str(ROOT / "build/release/bin/scantet")))
    options = parser.parse_args()

    volumes = [smooth_noise(seed, options.voxels) for seed in range(options.first, options.first + options.count)]
    jobs = [(mask(*volume) if options.masks else volume, options.size) for volume in volumes]
    if options.sheets > 0:
        jobs += [(sheets(options.sheets, posts), [1.0]) for posts in (False, True)]
    jobs += [(white_noise(n), [None]) for n in options.white]
    jobs += [(checkerboard(n), [None]) for n in options.checkerboard]
    jobs += [(thin_sheet(thick), [None]) for thick in options.thin]
    meshes = equal = silent = slow = crossing = 0
    longest = 0.0
    grades = collections.Counter()
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        scan = folder / "scan.nrrd"
        for (values, level, what), sizes in jobs:
            write_nrrd(scan, values)
            wanted = field_counts(options.program, scan, level)
            for size in sizes:
                found, crosses, status, seconds = mesh_counts(options.program, folder, scan, level, size)
                same = found == wanted
                meshes += 1
                equal += same
                silent += status == 0 and not same
                slow += seconds > options.seconds
                crossing += crosses and (size is not None or status == 0)
                longest = max(longest, seconds)
                verdict = "equal" if same else f"differs from {wanted}" + ("" if status else ", SILENT")
                verdict += ", crosses itself" if crosses else ""
                if options.verify and found is not None:
                    grade, text = certificate_text(options.program, folder, scan, level)
                    grades["equal" if same else "other", grade] += 1
                    verdict += f", {text}"
                print(f"{what}, level {level:.6g}, size {size or 'chosen'}: {found}, {verdict}, status {status}, {seconds:.2f} s",
                      flush=True)
    print(f"{equal} of {meshes} meshes have the components, cavities and handles of their field; "
          f"{silent} differ without a word; {crossing} cross themselves; the longest took {longest:.2f} s")
    for (counts, grade), number in sorted(grades.items()):
        print(f"{number} meshes with {'the same' if counts == 'equal' else 'other'} counts: {grade}")
    failed = silent > 0 or slow > 0 or crossing > 0 or (options.require == "equal" and equal < meshes)
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
