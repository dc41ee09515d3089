"""Decks as CalculiX solves them: patch tests, and a bar against its formulas.

decks_solve.py SCANTET; exit status 77 (skipped) without ccx. The mesh is a ball of a synthetic scan, cut to a slab with flat faces.
"""
import pathlib
import re
import shutil
import sys
import tempfile

if not shutil.which("ccx"):
    sys.exit(77)

from bar_model import E, K, NU, RHO, make, run, write_inputs  # noqa: E402


def solve(scantet, folder, deck, *arguments):
    make(scantet, folder, deck, "bar.inp", *arguments)
    log = run("ccx", f"bar_{deck}", cwd=folder)
    assert "WARNING" not in log and "ERROR" not in log, log


def nodes(folder):
    text = (folder / "bar.inp").read_text().split("*ELEMENT")[0].splitlines()[2:]
    return {int(l.split(",")[0]): tuple(map(float, l.split(",")[1:])) for l in text}


def of_frd(folder, deck, name, first=0):
    """The values of a block of the results, by node; CalculiX prints six digits there."""
    found = {}
    blocks = re.split(r"(?m)^ -4  ", (folder / f"bar_{deck}.frd").read_text())
    block = next(b for b in blocks if b.startswith(name))
    for line in block.splitlines():
        if line.startswith(" -1"):
            found[int(line[3:13])] = [float(line[13 + 12 * i:25 + 12 * i]) for i in range((len(line) - 13) // 12)]
    return found


def of_dat(folder, deck):
    """The rows of numbers in the table of results, which has all digits."""
    rows = {}
    for line in (folder / f"bar_{deck}.dat").read_text().splitlines():
        words = line.split()
        if len(words) > 1 and words[0].isdigit():
            rows[int(words[0])] = [float(w) for w in words[1:]]
    return rows


def with_table(folder, templates, deck, what):
    """A template of the same deck that prints the nodes' values with more digits."""
    text = (templates / f"ccx_{deck}.inp").read_text()
    text = re.sub(r"\*NODE PRINT.*\n.*\n", "", text).replace("*END STEP", f"*NODE PRINT, NSET=NALL\n{what}\n*END STEP")
    (folder / "template.inp").write_text(text)
    return "--deck-template", "template.inp"


def check_static(scantet, folder, templates, order):
    """A bar under a pull is stretched evenly, exactly so with tets of either order."""
    pull = 2.0
    table = *with_table(folder, templates, "static", "U"), "--order", order
    solve(scantet, folder, "static", *table, "--hold", "foot=z", "--hold", "at_x=x", "--hold", "at_y=y", "--load", f"tip={-pull}")
    worst = 0
    at = nodes(folder)
    for node, u in of_dat(folder, "static").items():
        x, y, z = at[node]
        exact = (-NU * pull / E * (x + 4), -NU * pull / E * (y + 4), pull / E * (z + 8))
        worst = max(worst, max(abs(a - b) for a, b in zip(u, exact)))
    print(f"static, order {order}: {len(at)} nodes, largest error {worst / (16 * pull / E):.1e} of the largest displacement")
    assert len(at) > 50 and worst < 1e-6 * 16 * pull / E, worst
    solve(scantet, folder, "static", *table, "--hold", "foot=z", "--hold", "at_x=x", "--hold", "at_y=y", "--load",
          f"tip=0,0,{64 * pull}")  # the same as a force
    assert max(abs(u[2] - pull / E * (at[n][2] + 8)) for n, u in of_dat(folder, "static").items()) < 1e-6 * 16 * pull / E


def check_conduction(scantet, folder, templates, deck, order):
    """Heat or a current along a bar: a potential that is linear, exactly so with tets of either order."""
    flow = 3.0
    table = *with_table(folder, templates, deck, "NT"), "--order", order
    solve(scantet, folder, deck, *table, "--hold", "foot=0", "--load", f"tip={flow}")
    at = nodes(folder)
    rise = flow / 64 / K
    worst = max(abs(t[0] - rise * (at[n][2] + 8)) for n, t in of_dat(folder, deck).items())
    print(f"{deck}, order {order}: largest error {worst / (16 * rise):.1e} of the largest difference")
    assert worst < 1e-6 * 16 * rise, worst


def check_modal(scantet, folder, order):
    """The lowest frequency of a short clamped bar is below that of Euler and Bernoulli's beam, and of its order."""
    solve(scantet, folder, "modal", "--order", order, "--hold", "foot")
    first = next(float(l.split()[3]) for l in (folder / "bar_modal.dat").read_text().splitlines()
                 if l.split()[:1] == ["1"])
    beam = 3.5160 / (2 * 3.14159265 * 16 ** 2) * (E * 8 ** 4 / 12 / (RHO * 1e-9 * 64)) ** 0.5
    print(f"modal, order {order}: {first:.0f} Hz, a slender beam {beam:.0f} Hz")
    assert 0.7 * beam < first < 1.1 * beam, (first, beam)


def main():
    scantet, templates = sys.argv[1], pathlib.Path(sys.argv[2])
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        write_inputs(folder)
        for order in ("1", "2"):
            check_static(scantet, folder, templates, order)
            check_conduction(scantet, folder, templates, "heat", order)
            check_conduction(scantet, folder, templates, "electro", order)
            check_modal(scantet, folder, order)


main()
