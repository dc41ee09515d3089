#!/usr/bin/env python3
"""How many iterations CalculiX's iterative solver takes on a scan's mesh, beside the skull's with as many nodes.

    scripts/solver_iterations.py [CASE...] [--held height|nodes] [--program FILE] [--volumes DIR] [--ccx FILE]
                                 [--meshes DIR] [--page docs/fem.md] [-- OPTION...]

Each case is a scan at a level and a size; its largest component is meshed. The skull is meshed at sizes that are searched
until its nodes are as many, within 10 %. Both are solved by SOLVER=ITERATIVE SCALING: linear elastic (1 GPa, 0.3),
weight along -z, all nodes in the lowest 5 % of the height held, or with --held nodes the lowest 0.5 % of the nodes, so
that as many are held in both. Prints nodes, iterations and their ratio. CASE: ch2bet-20-4 is
ch2bet at level 20 with 4 mm, noise5-2.9-2 the skull with Gaussian noise of 5 % of its range; default: all of CASES, which
takes hours. What follows -- goes to every scantet mesh. --meshes keeps the meshes and decks there. --page puts the rows
into the page's last section, in place of those of the same cases; others stay. Needs Debian's calculix-ccx and
mricron-data.
"""
import argparse
import array
import gzip
import os
import pathlib
import random
import re
import subprocess
import sys
import tempfile

TEMPLATES = "/usr/share/mricron/templates/"
SCANS = {"ch2bet": "ch2bet.nii.gz", "inia19": "inia19-t1-brain.nii.gz", "ch2better": "ch2better.nii.gz"}
CASES = ["ch2bet-20-4", "ch2bet-20-3", "ch2bet-20-2", "ch2bet-60-4", "ch2bet-60-3", "ch2bet-60-2", "inia19-100-2", "inia19-100-1",
         "ch2better-60-2", "ch2better-60-1", "noise5-2.9-2", "noise10-2.9-2"]
SKULL_LEVEL = 2.9
SKULL_SIZE_MM, SKULL_NODES = 2.0, 91000  # where the search for sizes starts
CLOSE_ENOUGH = 0.1
HELD_HEIGHT, HELD_NODES = 0.05, 0.005  # shares
HEADING = "## Iterations on rough scans"


def noisy(skull, percent, path):
    """Writes the skull with Gaussian noise, whose standard deviation is this share of the values' range."""
    header, packed = pathlib.Path(skull).read_bytes().split(b"\n\n", 1)
    values = array.array("f", gzip.decompress(packed))
    rng, sigma = random.Random(1), percent / 100 * (max(values) - min(values))
    noise = array.array("f", [value + rng.gauss(0, sigma) for value in values])
    pathlib.Path(path).write_bytes(header + b"\n\n" + gzip.compress(noise.tobytes(), mtime=0))
    return path


def mesh_nodes(program, scan, level, size, options, path):
    """Meshes the largest component into an .inp file; returns its nodes, id to coordinates."""
    command = [program, "mesh", scan, "--level", str(level), "--size", f"{size:g}", "--components", "largest",
               "--no-theory", "--quiet", "-o", path, *options]
    status = subprocess.run(command, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True, check=False)
    if status.returncode not in (0, 4):  # 4: there is a mesh, and something is said about it
        sys.exit(f"{' '.join(command)}: status {status.returncode}: {status.stderr.strip()}")
    nodes, reading = {}, False
    with open(path, encoding="utf-8") as file:
        for line in file:
            if line.startswith("*"):
                reading = line.startswith("*NODE,")
            elif reading:
                number, *place = line.split(",")
                nodes[int(number)] = tuple(map(float, place))
    return nodes


def write_deck(mesh, nodes, path, of_nodes=False):
    """A deck for CalculiX that includes the mesh; returns how many nodes are held."""
    heights = sorted(z for _, _, z in nodes.values())
    low = heights[0] + HELD_HEIGHT * (heights[-1] - heights[0])
    if of_nodes:
        low = heights[int(HELD_NODES * len(heights))]
    held = [number for number, (_, _, z) in nodes.items() if z <= low]
    with open(path, "w", encoding="utf-8") as deck:
        deck.write(f"*INCLUDE, INPUT={os.path.basename(mesh)}\n*NSET, NSET=HELD\n")
        deck.writelines(f"{number}\n" for number in held)
        deck.write("*MATERIAL, NAME=SOFT\n*ELASTIC\n1000, 0.3\n*DENSITY\n1e-9\n"
                   "*SOLID SECTION, ELSET=EALL, MATERIAL=SOFT\n*BOUNDARY\nHELD, 1, 3\n"
                   "*STEP\n*STATIC, SOLVER=ITERATIVE SCALING\n*DLOAD\nEALL, GRAV, 9810, 0, 0, -1\n"
                   "*NODE PRINT, NSET=HELD\nU\n*END STEP\n")
    return len(held)


def last_iteration(text):
    """Of the iterative solver, as CalculiX counts them in what it prints; None if it has none."""
    found = re.findall(r"iteration\s*=?\s*(\d+)", text)
    return int(found[-1]) if found else None


def solve(ccx, deck):
    """The iterations that CalculiX says it took."""
    folder, name = os.path.split(os.path.splitext(deck)[0])
    run = subprocess.run([ccx, "-i", name], cwd=folder, capture_output=True, text=True, check=False)
    iterations = last_iteration(run.stdout)
    if run.returncode != 0 or iterations is None:
        sys.exit(f"{ccx} {deck}: status {run.returncode}: {run.stdout[-500:]}{run.stderr[-500:]}")
    return iterations


def skull_like(program, skull, count, options, path):
    """Meshes the skull with about so many nodes; returns the size and the nodes."""
    size = SKULL_SIZE_MM * (SKULL_NODES / count) ** 0.4
    for _ in range(8):
        nodes = mesh_nodes(program, skull, SKULL_LEVEL, size, options, path)
        if abs(len(nodes) / count - 1) <= CLOSE_ENOUGH:
            return size, nodes
        size *= (len(nodes) / count) ** 0.4
    sys.exit(f"no size of the skull gives {count} nodes")


def write_page(page, rows):
    """Rows are by case; they replace those of the same cases in the page's last section."""
    before, _, after = page.read_text().partition(HEADING)
    found = {match[1]: match[0] for match in re.finditer(r"(?m)^\| ([^ |]+-[^ |]+-[^ |]+) \|.*$", after)} | rows
    order = sorted(found, key=lambda case: (CASES.index(case) if case in CASES else len(CASES), case))
    page.write_text("\n".join([
        before.rstrip(), "", HEADING, "",
        "Made by `scripts/solver_iterations.py CASE... --page docs/fem.md`: iterations of CalculiX's `SOLVER=ITERATIVE SCALING` for a linear elastic body under its weight, the largest component, all nodes in "
        "the lowest 5 % of its height held, beside the paper's skull with as many nodes (within 10 %). A case is a scan, its level and the size in mm; `noise5` is the skull with Gaussian noise of 5 % of its range. "
        "What hangs on necks far thinner than an element is on soft hinges, and takes many: `--smooth` takes such necks away ([algorithm.md](algorithm.md), *Short edges*).", "",
        "| case | nodes | held | iterations | skull, mm | nodes | held | iterations | ratio |",
        "| --- | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: |", *(found[case] for case in order)]) + "\n")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("cases", nargs="*", metavar="CASE")
    parser.add_argument("--held", choices=["height", "nodes"], default="height")
    parser.add_argument("--program", default="build/release/bin/scantet")
    parser.add_argument("--volumes", default=os.environ.get("SCANTET_VOLUMES", "../shared/volumes"))
    parser.add_argument("--ccx", default="ccx")
    parser.add_argument("--page")
    parser.add_argument("--meshes", help="where the meshes and decks stay")
    own = sys.argv[1:sys.argv.index("--")] if "--" in sys.argv else sys.argv[1:]
    options = sys.argv[len(own) + 2:]
    arguments = parser.parse_args(own)
    with tempfile.TemporaryDirectory() as temporary:
        folder = arguments.meshes or temporary
        os.makedirs(folder, exist_ok=True)
        print("case         nodes   held  iterations | skull mm  nodes   held  iterations | ratio", flush=True)
        for case in arguments.cases or CASES:
            scan, level, size = case.split("-")
            counts, skull_mm, skull = [], None, os.path.join(arguments.volumes, "skull.nrrd")
            for name in (case, f"{case}-skull"):
                mesh, deck = (os.path.join(folder, name + end) for end in (".inp", "-deck.inp"))
                if name != case:
                    skull_mm, nodes = skull_like(arguments.program, skull, counts[0][0], options, mesh)
                elif scan.startswith("noise"):
                    source = noisy(skull, float(scan[5:]), os.path.join(folder, f"{scan}.nrrd"))
                    nodes = mesh_nodes(arguments.program, source, level, float(size), options, mesh)
                else:
                    nodes = mesh_nodes(arguments.program, TEMPLATES + SCANS[scan], level, float(size), options, mesh)
                held = write_deck(mesh, nodes, deck, arguments.held == "nodes")
                counts.append((len(nodes), held, solve(arguments.ccx, deck)))
            (n, held, its), (skull_n, skull_held, skull_its) = counts
            print(f"{case:12s} {n:6d} {held:6d} {its:11d} | {skull_mm:8.3g} {skull_n:6d} {skull_held:6d} {skull_its:11d} |"
                  f" {its / skull_its:5.2f}", flush=True)
            if arguments.page:  # case by case, as one takes long
                write_page(pathlib.Path(arguments.page), {case: f"| {case} | {n:,} | {held:,} | {its:,} | {skull_mm:.3g} | {skull_n:,} | {skull_held:,} | "
                                                                f"{skull_its:,} | {its / skull_its:.2f} |"})


if __name__ == "__main__":
    main()
