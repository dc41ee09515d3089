#!/usr/bin/env python3
"""Measures what meshes take, fits the coefficients of `scantet mesh --plan`, and says how far off it is.

    scripts/calibrate_plan.py [--program FILE] [--volumes DIR] [--keep FILE] [--quick]

Each case is planned (--plan) and then meshed; vertices are fitted to the four features of the plan, and the rest to the
vertices by where they come from, by least squares of the relative errors, with no cost below nothing. Then each scan (all of its cases together) is left out once, and predicted
by what the others give: those are the errors to quote. Prints the table of
src/scantet/size_options/prediction_coefficients.h.

    --program FILE  default build/release/bin/scantet
    --volumes DIR   the folder with skull.nrrd (not part of this tree); default SCANTET_VOLUMES, else ../shared/volumes
    --keep FILE     keep what meshes took in FILE (JSON), and mesh what is not in it only; all are planned anew
    --quick         no case that takes more than half a minute

For the seconds the machine must have nothing else to do. Cases whose input is not on this machine are left out.
"""

import argparse
import array
import gzip
import json
import math
import os
import random
import subprocess
import sys
import tempfile
import time

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
TEMPLATES = "/usr/share/mricron/templates/"
FEATURES = ["inside", "cubes", "narrow", "bent"]
TETS_ROOM = 1.5  # in 6 - 5 / (1.5 + room), tets for each vertex: not fitted, for errors hardly depend on it


def noisy(source, target, percent):
    """A copy of an NRRD file of gzipped floats with Gaussian noise of so many percent of its range."""
    with open(source, "rb") as file:
        header, data = file.read().split(b"\n\n", 1)
    values = array.array("f", gzip.decompress(data))
    noise = random.Random(percent)
    sigma = percent / 100 * (max(values) - min(values))
    with open(target, "wb") as file:
        file.write(header.replace(b"encoding: gzip", b"encoding: raw") + b"\n\n")
        array.array("f", [value + noise.gauss(0, sigma) for value in values]).tofile(file)


def cases(volumes, folder, quick):
    """(scan, input, options, size) of each case whose input is there."""
    listed = [
        ("ch2bet at 20", TEMPLATES + "ch2bet.nii.gz", ["--level", "20"], [2, 3, 4]),
        ("ch2bet at 60", TEMPLATES + "ch2bet.nii.gz", ["--level", "60"], [2, 3, 4]),
        ("inia19-t1-brain at 100", TEMPLATES + "inia19-t1-brain.nii.gz", ["--level", "100"], [1, 2]),
        ("ch2better at 60", TEMPLATES + "ch2better.nii.gz", ["--level", "60"], [2] if quick else [1, 2]),
        ("torus.nrrd", os.path.join(ROOT, "sample_volumes/torus.nrrd"), ["--level", "0.5"], [0.5, 1]),
        ("sphere", "implicit:sphere", [], [0.05, 0.1]),
        ("torus", "implicit:torus", [], [0.03, 0.06]),
    ]
    skull = os.path.join(volumes, "skull.nrrd")
    if os.path.exists(skull):
        listed.append(("skull", skull, ["--level", "2.9"], [2, 4]))
        for percent in (5, 10):
            file = os.path.join(folder, f"skull{percent}.nrrd")
            noisy(skull, file, percent)
            listed.append((f"skull, {percent} % noise", file, ["--level", "2.9"], [2, 4]))
    for scan, file, options, sizes in listed:
        if ":" not in file and not os.path.exists(file):
            print(f"left out, no such file: {file}")
            continue
        for size in sizes:
            yield scan, file, options, size


def run(program, arguments, report):
    """Runs the program; its report, peak memory in bytes, seconds on the clock and of the processor."""
    if os.path.exists(report):
        os.remove(report)
    start = time.monotonic()
    process = subprocess.Popen([program, "mesh", *arguments, "--report", report, "--quiet"],
                               stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    _, status, usage = os.wait4(process.pid, 0)
    seconds = time.monotonic() - start
    if not os.path.exists(report):
        sys.exit(f"{program} mesh {' '.join(arguments)} ended with {os.waitstatus_to_exitcode(status)} and no report")
    with open(report, encoding="utf-8") as file:
        return json.load(file), usage.ru_maxrss * 1024, seconds, usage.ru_utime + usage.ru_stime


def plan(program, case, folder):
    """What --plan goes by."""
    scan, file, options, size = case
    arguments = [file, *options, "--size", str(size), "--plan"]
    report, _, _, _ = run(program, arguments, os.path.join(folder, "plan.json"))
    features = report["features"]
    return {"scan": scan, "size": size, "features": {name: features[name] for name in FEATURES},
            "held": features["held_bytes"], "trial_s": features["trial_s"], "threads": report["plan"]["threads"]}


def measure(program, case, folder):
    """What the mesh takes."""
    _, file, options, size = case
    arguments = [file, *options, "--size", str(size), "-o", os.path.join(folder, "mesh.vtu")]
    report, peak, _, processor_s = run(program, arguments, os.path.join(folder, "report.json"))
    timing = report["timing_s"]
    meshing = sum(timing.get(step) or 0 for step in ("sample", "refine", "optimize"))
    return {"vertices": report["mesh"]["vertices"], "tets": report["mesh"]["tets"], "peak": peak,
            "meshing_s": meshing, "processor_s": processor_s * meshing / timing["total"]}


def solve(matrix, right):
    """Gaussian elimination."""
    n = len(right)
    rows = [row[:] + [value] for row, value in zip(matrix, right)]
    for i in range(n):
        pivot = max(range(i, n), key=lambda r: abs(rows[r][i]))
        rows[i], rows[pivot] = rows[pivot], rows[i]
        if rows[i][i] == 0:
            continue
        for r in range(n):
            if r != i:
                factor = rows[r][i] / rows[i][i]
                rows[r] = [a - factor * b for a, b in zip(rows[r], rows[i])]
    return [rows[i][n] / rows[i][i] if rows[i][i] else 0.0 for i in range(n)]


def least_squares(rows, wanted, weights):
    """Coefficients, none negative, that make the weighted squares of the errors least; tries all sets of columns."""
    columns = len(rows[0])
    best, best_error = None, None
    for bits in range(1, 1 << columns):
        chosen = [c for c in range(columns) if bits >> c & 1]
        scaled = [[row[c] * weight for c in chosen] for row, weight in zip(rows, weights)]
        aims = [value * weight for value, weight in zip(wanted, weights)]
        matrix = [[sum(row[a] * row[b] for row in scaled) for b in range(len(chosen))] for a in range(len(chosen))]
        found = solve(matrix, [sum(row[a] * aim for row, aim in zip(scaled, aims)) for a in range(len(chosen))])
        if min(found) < 0:
            continue
        error = sum((predicted(found, row) - aim) ** 2 for row, aim in zip(scaled, aims))
        if best is None or error < best_error:
            best = [0.0] * columns
            for c, value in zip(chosen, found):
                best[c] = value
            best_error = error
    return best


def predicted(costs, row):
    return sum(cost * value for cost, value in zip(costs, row))


def fit(rows, wanted):
    """The same for relative errors, in which half as much counts like twice as much."""
    weights = [1 / value for value in wanted]
    for _ in range(10):
        costs = least_squares(rows, wanted, weights)
        weights = [1 / math.sqrt(value * max(predicted(costs, row), 0.01 * value)) for row, value in zip(rows, wanted)]
    return costs


class Model:
    """What has been fitted to some of the cases."""

    def __init__(self, found):
        rows = [self.features(case) for case in found]
        self.vertices = fit(rows, [case["vertices"] for case in found])
        self.tets = fit([self.tet_row(case) for case in found], [case["tets"] for case in found])
        shares = [self.shares(case) + [1.0] for case in found]
        self.memory = fit(shares, [max(case["peak"] - case["held"], 1.0) for case in found])
        self.seconds = fit(shares, [case["processor_s"] for case in found])

    @staticmethod
    def features(case):
        return [case["features"][name] for name in FEATURES]

    def shares(self, case):
        parts = [cost * value for cost, value in zip(self.vertices, self.features(case))]
        return [parts[0], parts[1], parts[2] + parts[3]]

    def tet_row(self, case):
        inside, cubes = self.features(case)[:2]
        vertices = sum(self.shares(case))
        return [vertices, -vertices / (TETS_ROOM + inside / cubes)]

    def predict(self, case):
        shares = self.shares(case) + [1.0]
        return {"vertices": sum(shares[:3]), "tets": predicted(self.tets, self.tet_row(case)),
                "memory": case["held"] + predicted(self.memory, shares),
                "processor time": predicted(self.seconds, shares)}


def print_errors(found, whole):
    """The errors of each case in percent: of what all cases give, and with its scan left out."""
    truth = {"vertices": "vertices", "tets": "tets", "memory": "peak", "processor time": "processor_s"}
    scans = {case["scan"] for case in found}
    without = {scan: Model([case for case in found if case["scan"] != scan]) for scan in scans}
    print("\nerrors of the fit / with the scan left out, %")
    print(f"  {'':30}" + "".join(f"{name:>20}" for name in truth))
    worst = dict.fromkeys(truth, 0.0)
    for case in found:
        line = f"  {case['scan']:24} {case['size']:5}"
        for name, key in truth.items():
            own = 100 * (whole.predict(case)[name] / case[key] - 1)
            other = 100 * (without[case["scan"]].predict(case)[name] / case[key] - 1)
            worst[name] = max(worst[name], abs(other))
            line += f"{own:12.0f} /{other:6.0f}"
        print(line)
    print(f"  {'worst with the scan left out':30}" + "".join(f"{worst[name]:20.0f}" for name in truth))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--program", default=os.path.join(ROOT, "build/release/bin/scantet"))
    parser.add_argument("--volumes", default=os.environ.get("SCANTET_VOLUMES", os.path.join(ROOT, "../shared/volumes")))
    parser.add_argument("--keep")
    parser.add_argument("--quick", action="store_true")
    options = parser.parse_args()
    kept = {}
    if options.keep and os.path.exists(options.keep):
        with open(options.keep, encoding="utf-8") as file:
            kept = json.load(file)
    found = []
    with tempfile.TemporaryDirectory() as folder:
        for case in cases(options.volumes, folder, options.quick):
            name = f"{case[0]}, {case[3]} mm"
            if name not in kept:
                kept[name] = measure(options.program, case, folder)
                print(f"{name}: {kept[name]['vertices']} vertices, {kept[name]['processor_s']:.1f} s", flush=True)
            found.append({**kept[name], **plan(options.program, case, folder)})
            if options.keep:
                with open(options.keep, "w", encoding="utf-8") as file:
                    json.dump(kept, file, indent=1)
    model = Model(found)
    print_errors(found, model)
    threads = found[0]["threads"]
    ratios = sorted(case["meshing_s"] / case["processor_s"] for case in found)
    serial = (ratios[len(ratios) // 2] - 1 / threads) / (1 - 1 / threads) if threads > 1 else 0.0
    trial = sorted(case["trial_s"] for case in found)[len(found) // 2]

    def row(costs):
        return ", ".join(f"{cost:.4g}" for cost in costs)

    print("\nprediction_coefficients.h:")
    print(f"inline constexpr VertexCosts kVertexCosts{{{row(model.vertices)}}};")
    print(f"inline constexpr double kTetsInside = {model.tets[0]:.4g};")
    print(f"inline constexpr double kTetsLost = {model.tets[1]:.4g};")
    print(f"inline constexpr double kTetsRoom = {TETS_ROOM};")
    print(f"inline constexpr ShareCosts kByteCosts{{{row(model.memory)}}};")
    print(f"inline constexpr ShareCosts kSecondCosts{{{row(model.seconds)}}};")
    print(f"inline constexpr double kTrialSeconds = {trial:.3g};")
    print(f"inline constexpr double kSerialShare = {min(max(serial, 0.0), 1.0):.2f};")


if __name__ == "__main__":
    main()
