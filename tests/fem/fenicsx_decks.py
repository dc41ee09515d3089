"""Decks as FEniCSx solves them: patch tests, and a bar's frequency, in elements of both orders.

fenicsx_decks.py SCANTET; exit status 77 (skipped) without dolfinx. Each deck is run as it is, and its functions looked at.
"""
import contextlib
import importlib.util
import io
import logging
import pathlib
import re
import runpy
import sys
import tempfile

if not all(importlib.util.find_spec(name) for name in ("dolfinx", "h5py", "slepc4py")):
    sys.exit(77)

from bar_model import E, K, NU, RHO, make, write_inputs  # noqa: E402


def solve(scantet, folder, deck, order, *arguments):
    """What the deck leaves in its variables, and what it prints."""
    make(scantet, folder, deck, "bar.xdmf", "--order", order, *arguments)
    text = io.StringIO()
    with contextlib.redirect_stdout(text):
        left = runpy.run_path(str(folder / f"bar_{deck}.py"))
    return left, text.getvalue()


def values_at_nodes(left, name):
    """The nodes' places, and the function's values there."""
    import numpy as np
    function, space = left[name], left["space"]
    block = space.dofmap.bs
    values = np.empty((len(left["mesh"].geometry.x), block))
    values[left["mesh"].geometry.dofmap.array] = function.x.array.reshape(-1, block)[space.dofmap.list.array]
    return left["mesh"].geometry.x, values


def check_static(scantet, folder, order):
    import numpy as np
    pull = 2.0
    for load in (f"tip={-pull}", f"tip=0,0,{64 * pull}"):  # as a pressure, and as a force
        left, _ = solve(scantet, folder, "static", order, "--hold", "foot=z", "--hold", "at_x=x", "--hold", "at_y=y", "--load", load)
        x, u = values_at_nodes(left, "displacement")
        exact = np.stack([-NU * (x[:, 0] + 4), -NU * (x[:, 1] + 4), x[:, 2] + 8], axis=1) * pull / E
        worst = abs(u - exact).max() / (16 * pull / E)
        print(f"static, order {order}: {len(x)} nodes, largest error {worst:.1e} of the largest displacement")
        assert len(x) > 50 and worst < 1e-8, worst
        stress = left["von_mises"].x.array
        assert abs(stress - pull).max() < 1e-8 * pull, (stress.min(), stress.max())


def check_conduction(scantet, folder, deck, order):
    flow = 3.0
    left, _ = solve(scantet, folder, deck, order, "--hold", "foot=5", "--load", f"tip={flow}")
    x, u = values_at_nodes(left, "temperature" if deck == "heat" else "potential")
    rise = flow / 64 / K
    worst = abs(u[:, 0] - 5 - rise * (x[:, 2] + 8)).max() / (16 * rise)
    print(f"{deck}, order {order}: largest error {worst:.1e} of the largest difference")
    assert worst < 1e-8, worst


def check_modal(scantet, folder, order):
    _, text = solve(scantet, folder, "modal", order, "--hold", "foot")
    found = [float(f) for f in re.findall(r"frequency \d+: (\S+) Hz", text)]
    beam = 3.5160 / (2 * 3.14159265 * 16 ** 2) * (E * 8 ** 4 / 12 / (RHO * 1e-9 * 64)) ** 0.5
    print(f"modal, order {order}: {found[0]:.0f} Hz, a slender beam {beam:.0f} Hz")
    assert len(found) == 10 and found == sorted(found), found
    assert 0.7 * beam < found[0] < 1.1 * beam, (found[0], beam)


def main():
    logging.disable(logging.INFO)  # the compiler's calls
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        write_inputs(folder)
        for order in ("1", "2"):
            check_static(sys.argv[1], folder, order)
            check_conduction(sys.argv[1], folder, "heat", order)
            check_conduction(sys.argv[1], folder, "electro", order)
            check_modal(sys.argv[1], folder, order)


main()
