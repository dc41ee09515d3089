#!/usr/bin/python3
"""Whether elements of second order hold on real scans: none whose Jacobian is not proved positive.

    scripts/second_order.py [CASE...] [--program FILE] [--volumes DIR] [--page docs/second_order.md]

Meshes each case with --order 2, takes from the report how many elements were eased and how many are not proved, and looks
at the written elements by itself: the Jacobian determinant of each at 35 points. Prints a table, and puts it into the page
under "Proved on scans". Status 1 if an element is not proved, a determinant is not positive, or the program ends with
anything but 0 or 4 (4: something else is said of a rough scan's mesh, and noted in the table). Scans that are not there
are left out (with --page they must all be there). Needs Debian's mricron-data and python3-numpy.
"""
import argparse
import json
import os
import pathlib
import re
import subprocess
import sys
import tempfile

import numpy as np

ROOT = pathlib.Path(__file__).resolve().parent.parent
TEMPLATES = pathlib.Path("/usr/share/mricron/templates")
SKULL, BRAIN, ATLAS = "skull.nrrd", TEMPLATES / "ch2bet.nii.gz", TEMPLATES / "aal.nii.gz"
SAMPLES = ROOT / "sample_volumes"
CASES = {
    "skull": (SKULL, "--level", "2.9", "--outside", "0", "--size", "2"),
    "ch2bet": (BRAIN, "--level", "20", "--size", "2"),
    "ch2bet-smooth": (BRAIN, "--level", "20", "--size", "2", "--smooth", "1"),
    "aal-1-12": (ATLAS, "--labels", "1-12", "--size", "3"),
    "aal": (ATLAS, "--labels", "all", "--size", "4"),
    **{path.stem: (path, "--labels", "all") for path in sorted(SAMPLES.glob("labels_*.nrrd"))},
}
EDGES = ((0, 1), (1, 2), (0, 2), (0, 3), (1, 3), (2, 3))  # of the nodes 4 to 9, in the file's order
HEADING = "## Proved on scans"


def numbers_under(text, keyword):
    """The rows of numbers under each line that begins with a keyword, as one array a block."""
    for block in re.split(r"(?m)^(?=\*)", text):
        if block.startswith(keyword):
            rows = block.split("\n", 1)[1]
            width = rows.split("\n", 1)[0].count(",") + 1
            yield np.fromstring(rows.replace(",", " "), sep=" ").reshape(-1, width)


def least_determinant(path):
    """The least Jacobian determinant, as a share of that of the element's straight tet, at the points of a grid in each."""
    text = path.read_text()
    nodes = np.concatenate(list(numbers_under(text, "*NODE,")))
    at = np.empty((int(nodes[:, 0].max()) + 1, 3))
    at[nodes[:, 0].astype(int)] = nodes[:, 1:]
    tets = np.concatenate(list(numbers_under(text, "*ELEMENT, TYPE=C3D10"))).astype(int)[:, 1:]
    straight = np.linalg.det(at[tets[:, 1:4]] - at[tets[:, :1]])
    corners = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]])
    slopes = np.array([[-1, -1, -1], [1, 0, 0], [0, 1, 0], [0, 0, 1]])  # of the four coordinates
    least = np.inf
    for shares in ((a, b, c, 4 - a - b - c) for a in range(5) for b in range(5 - a) for c in range(5 - a - b)):
        x = np.array(shares) / 4
        of_nodes = np.array([(4 * x[i] - 1) * slopes[i] for i in range(len(corners))]
                            + [4 * (x[i] * slopes[j] + x[j] * slopes[i]) for i, j in EDGES])
        jacobian = sum(at[tets[:, n], :, None] * of_nodes[n] for n in range(10))
        least = min(least, (np.linalg.det(jacobian) / straight).min())
    return len(tets), least


def measure(program, folder, scan, options):
    """A row of the table, and whether all is well."""
    mesh, report = folder / "mesh.inp", folder / "mesh.json"
    command = [program, "mesh", str(scan), *options, "--order", "2", "--quiet", "-o", str(mesh), "--report", str(report)]
    status = subprocess.run(command, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True, check=False)
    if status.returncode not in (0, 4):
        sys.exit(f"{' '.join(command)}: status {status.returncode}: {status.stderr.strip()}")
    found = json.loads(report.read_text())["second_order"]
    tets, least = least_determinant(mesh)
    row = (f"| `{' '.join([pathlib.Path(scan).name, *options])}` | {tets:,} | {found['edges']:,} | {found['eased_edges']:,} | {found['eased_tets']:,} | "
           f"{found['unproved']:,} | {found['least_share']:.3f} | {least:.3f} | {status.returncode} |")
    return row, found["unproved"] == 0 and found["least_share"] > 0 and found["least_share"] <= least


def write_page(path, rows):
    part = [HEADING, "",
            "Made by `scripts/second_order.py --page docs/second_order.md`, the step `second_order` of `scripts/check.sh`. The least share is of the determinant of the straight tet: "
            "the program's bound for all points of all elements, and what the script finds by itself at 35 points of each. Status 4 is about the straight tets, as about the angles of a rough scan.", "",
            "| scan and options | tets | edges | eased | tets of these | not proved | least share, proved | at points | status |",
            "| --- | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: |", *rows]
    before = path.read_text().partition(HEADING)[0].rstrip()  # it is the page's last section
    path.write_text(before + "\n\n" + "\n".join(part) + "\n")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("cases", nargs="*", metavar="CASE", help=f"default: all of {', '.join(CASES)}")
    parser.add_argument("--program", default=str(ROOT / "build/release/bin/scantet"))
    parser.add_argument("--volumes", default=os.environ.get("SCANTET_VOLUMES", str(ROOT.parent / "shared/volumes")))
    parser.add_argument("--page")
    options = parser.parse_args()
    rows, failed, missing = [], [], []
    with tempfile.TemporaryDirectory() as folder:
        for case in options.cases or CASES:
            scan, *arguments = CASES[case]
            scan = pathlib.Path(options.volumes) / scan  # an absolute path stays as it is
            if not scan.exists():
                print(f"{case}: {scan} is not there")
                missing.append(case)
                continue
            row, well = measure(options.program, pathlib.Path(folder), scan, arguments)
            print(row, flush=True)
            rows.append(row)
            if not well:
                failed.append(case)
    if options.page and not missing:
        write_page(pathlib.Path(options.page), rows)
    if failed or not rows or (options.page and missing):
        sys.exit(f"not as it should be: {', '.join(failed + missing) or 'no scan is there'}")


if __name__ == "__main__":
    main()
