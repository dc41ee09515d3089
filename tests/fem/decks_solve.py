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


def solve(folder, deck):
    log = run("ccx", f"bar_{deck}", cwd=folder)
    assert "WARNING" not in log and "ERROR" not in log, log


def nodes(folder):
    text = (folder / "bar.inp").read_text().split("*ELEMENT")[0].splitlines()[2:]
    return {int(l.split(",")[0]): tuple(map(float, l.split(",")[1:])) for l in text}


def table(folder, deck):
    """The rows of numbers in the first table of results, by their number."""
    rows = {}
    for line in (folder / f"bar_{deck}.dat").read_text().splitlines():
        words = line.split()
        if len(words) > 1 and words[0].isdigit():
            rows.setdefault(int(words[0]), [float(w) for w in words[1:]])
    return rows


def largest_error(scantet, folder, templates, deck, freedoms, exact, *arguments):
    """Of all nodes' values, the largest difference from the exact ones, and the number of nodes.

    CalculiX prints seven digits of a value, so it takes the difference itself: each node has two more, one that is held at the exact
    value and one whose value is by an equation that of the node less the exact one. These are printed.
    """
    template = re.sub(r"\*NODE PRINT.*\n.*\n", "", (templates / f"ccx_{deck}.inp").read_text())
    template = template.replace("*INCLUDE, INPUT={{mesh}}\n", "*INCLUDE, INPUT={{mesh}}\n*INCLUDE, INPUT=equations.inp\n")
    template = template.replace("TEMPERATURE\nNALL, 0.\n", "TEMPERATURE\nNALL, 0.\nEXACT, 0.\nERRORS, 0.\n")
    what = "U" if deck == "static" else "NT"
    (folder / "template.inp").write_text(template.replace("*END STEP", f"*INCLUDE, INPUT=exact.inp\n*NODE PRINT, NSET=ERRORS\n{what}\n*END STEP"))
    make(scantet, folder, deck, "bar.inp", *arguments, "--deck-template", "template.inp")
    at = nodes(folder)
    more = max(at)
    with (folder / "equations.inp").open("w") as file:
        for first, name in ((more, "EXACT"), (2 * more, "ERRORS")):
            file.write(f"*NODE, NSET={name}\n" + "".join(f"{first + n}, 0, 0, {n}\n" for n in at))
        for n in at:
            for freedom in freedoms:
                file.write(f"*EQUATION\n3\n{2 * more + n}, {freedom}, 1, {n}, {freedom}, -1, {more + n}, {freedom}, 1\n")
    with (folder / "exact.inp").open("w") as file:
        file.write("*BOUNDARY\n")  # of a number CalculiX reads the first 20 characters
        for n, place in at.items():
            file.writelines(f"{more + n}, {freedom}, {freedom}, {value:.13e}\n" for freedom, value in zip(freedoms, exact(*place)))
    solve(folder, deck)
    errors = table(folder, deck)
    assert len(errors) == len(at) > 50, (len(errors), len(at))
    return max(abs(e) for row in errors.values() for e in row), len(at)


def check_static(scantet, folder, templates, order):
    """A bar under a pull is stretched evenly, exactly so with tets of either order."""
    pull = 2.0
    stretch = 16 * pull / E

    def exact(x, y, z):
        return -NU * pull / E * (x + 4), -NU * pull / E * (y + 4), pull / E * (z + 8)
    for load in (f"tip={-pull}", f"tip=0,0,{64 * pull}"):  # as a pressure, and as a force
        worst, count = largest_error(scantet, folder, templates, "static", (1, 2, 3), exact, "--order", order, "--hold", "foot=z",
                                     "--hold", "at_x=x", "--hold", "at_y=y", "--load", load)
        print(f"static, {load}, order {order}: {count} nodes, largest error {worst / stretch:.1e} of the largest displacement")
        assert worst < 1e-8 * stretch, worst


def check_conduction(scantet, folder, templates, deck, order):
    """Heat or a current along a bar: a potential that is linear, exactly so with tets of either order."""
    flow = 3.0
    rise = flow / 64 / K
    worst, _ = largest_error(scantet, folder, templates, deck, (11,), lambda x, y, z: (5 + rise * (z + 8),), "--order", order,
                             "--hold", "foot=5", "--load", f"tip={flow}")
    print(f"{deck}, order {order}: largest error {worst / (16 * rise):.1e} of the largest difference")
    assert worst < 1e-8 * 16 * rise, worst


def height_squared(folder, order):
    """The integral over the bar of the square of the height above its foot, as a share of the whole height, mm³.

    As CalculiX integrates masses: exactly with tets of ten nodes, by the value in the middle with those of four.
    """
    if order == "2":
        return 64 * 16 / 3
    at, total = nodes(folder), 0.0
    rows = re.search(r"(?m)^\*ELEMENT, TYPE=C3D4.*\n((?:[\d ,]+\n)+)", (folder / "bar.inp").read_text()).group(1)
    for row in rows.splitlines():
        a, b, c, d = (at[int(n)] for n in row.split(",")[1:])
        u, v, w = ([q - p for p, q in zip(a, corner)] for corner in (b, c, d))
        volume = abs(u[0] * (v[1] * w[2] - v[2] * w[1]) + u[1] * (v[2] * w[0] - v[0] * w[2]) + u[2] * (v[0] * w[1] - v[1] * w[0])) / 6
        total += volume * ((a[2] + b[2] + c[2] + d[2]) / 64 + 0.5) ** 2
    return total


def check_modes_of_even_strain(scantet, folder, templates, order):
    """A bar that can only shear and stretch evenly has frequencies that tets of either order give exactly.

    Equations tie all nodes to one. Ten tiny stiff tets beside it are there because the solver needs more unknowns than modes.
    """
    text = (templates / "ccx_modal.inp").read_text().replace("{{mesh}}\n", "{{mesh}}\n*INCLUDE, INPUT=equations.inp\n")
    (folder / "template.inp").write_text(text.replace("*FREQUENCY\n10\n", "*FREQUENCY\n3\n"))
    make(scantet, folder, "modal", "bar.inp", "--order", order, "--hold", "foot", "--deck-template", "template.inp")
    at = nodes(folder)
    tip, feet, tips, tets = max(at) + 1, max(at) + 2, max(at) + 5, 10 ** 6
    with (folder / "equations.inp").open("w") as file:
        file.write(f"*NODE\n{tip}, 0, 0, 8\n")
        file.writelines(f"*EQUATION\n2\n{n}, {way}, 1, {tip}, {way}, {-(z + 8) / 16:.12e}\n"
                        for n, (_, _, z) in at.items() if z > -8 for way in (1, 2, 3))
        file.write(f"*NODE, NSET=FEET\n{feet}, 0, 0, 9\n{feet + 1}, 1, 0, 9\n{feet + 2}, 0, 1, 9\n*NODE\n")
        file.writelines(f"{tips + i}, 0, 0, {10 + i / 10}\n" for i in range(10))
        file.write("*ELEMENT, TYPE=C3D4, ELSET=STIFF\n")
        file.writelines(f"{tets + i}, {feet}, {feet + 1}, {feet + 2}, {tips + i}\n" for i in range(10))
        file.write("*MATERIAL, NAME=STIFF\n*ELASTIC\n1e5, 0.3\n*DENSITY\n1e-9\n*SOLID SECTION, ELSET=STIFF, MATERIAL=STIFF\n"
                   "*BOUNDARY\nFEET, 1, 3\n")
    solve(folder, "modal")
    found = [row[0] for row in list(table(folder, "modal").values())[:3]]
    shear, stretch = E / 2 / (1 + NU), E * (1 - NU) / (1 + NU) / (1 - 2 * NU)
    mass = RHO * 1e-9 * height_squared(folder, order)
    worst = max(abs(a / (modulus * 64 / 16 / mass) - 1) for a, modulus in zip(found, (shear, shear, stretch)))
    print(f"modal, order {order}: largest error {worst:.1e} of an eigenvalue, which is printed with seven digits")
    assert len(found) == 3 and worst < 5e-7, found


def check_modal(scantet, folder, order):
    """The lowest frequency of a short clamped bar is below that of Euler and Bernoulli's beam, and of its order."""
    make(scantet, folder, "modal", "bar.inp", "--order", order, "--hold", "foot")
    solve(folder, "modal")
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
            check_modes_of_even_strain(scantet, folder, templates, order)
            check_modal(scantet, folder, order)


main()
