"""What each choice of "integrate" in a materials file makes of one bone, and the sampling rule of py_bonemat_abaqus beside our integral.

    scripts/materials_compared.py [--program FILE] [--page docs/materials.md]

Meshes the phantom of docs/tutorials/femur.md, a stiffness for each tetrahedron, and solves it (ccx). Prints a table, and
writes it into the page.
"""
import argparse
import gzip
import json
import pathlib
import re
import tempfile

import numpy as np
from scipy.interpolate import RegularGridInterpolator

from tutorials import Model, PAGES, ROOT, grid, write_scans

STEPS = 4  # of the rule, as py_bonemat_abaqus's example has it


def sampled(model, folder, law):
    """E at voxels, trilinear, at lattice points of each tet with equal weights: a mean of ten."""
    raw = gzip.decompress((folder / "femur.nrrd").read_bytes().split(b"\n\n", 1)[1])
    x, y, z, _ = grid((36, 24, 66), 1.5)
    density = np.maximum(0, law["density"]["a"] + law["density"]["b"] * np.frombuffer(raw, "<i2").reshape(x.shape))
    piece = law["modulus"][0]
    stiffness = RegularGridInterpolator((z[:, 0, 0], y[0, :, 0], x[0, 0, :]), piece["b"] * density ** piece["c"])
    at = [(i + 0.5, j + 0.5, k + 0.5) for i in range(STEPS) for j in range(STEPS) for k in range(STEPS)
          if i + j + k + 1.5 < STEPS]
    means = 0
    for shares in np.array(at) / STEPS:
        points = np.einsum("c,tcx->tx", [1 - shares.sum(), *shares], model.points[model.tets])
        means = means + stiffness(points[:, ::-1]) / len(at)
    return np.maximum(means, law["least_modulus_mpa"])


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--program", default=ROOT / "build/release/bin/scantet")
    parser.add_argument("--page", type=pathlib.Path, default=ROOT / "docs/materials.md")
    arguments = parser.parse_args()
    whole = json.loads((PAGES / "femur.json").read_text())
    law = whole["scan"]
    del law["bins"]
    rows = []
    with tempfile.TemporaryDirectory(prefix="scantet_materials_") as name:
        folder = pathlib.Path(name)
        write_scans(folder)
        models = {}
        for choice in ("modulus", "density", "hu", "voxels", "nodes"):
            law["integrate"] = choice
            (folder / "femur.json").write_text(json.dumps(whole))
            models[choice] = Model("femur", str(pathlib.Path(arguments.program).resolve()), folder)
        of_all = {choice: (m.cells["youngs_modulus_mpa"], np.linalg.norm(m.fields["DISP"][:, :3], axis=1).max())
                  for choice, m in models.items()}
        exact, volumes = of_all["modulus"][0], models["modulus"].volumes
        rule = sampled(models["modulus"], folder, law)
        for choice, (stiffness, moved) in {**of_all, "the rule": (rule, None)}.items():
            off = np.sqrt((volumes * (stiffness - exact) ** 2).sum() / (volumes * exact ** 2).sum())
            mean = (volumes * stiffness).sum() / volumes.sum()
            rows.append(f"| {choice if choice == 'the rule' else f'`{choice}`'} | {mean:.0f} | {100 * off:.1f} % | {f'{moved:.3f}' if moved else '–'} |")
    table = "\n".join(["| `integrate` | mean E, MPa | difference | largest displacement, mm |", "| --- | --- | --- | --- |", *rows])
    print(table)
    text = arguments.page.read_text()
    arguments.page.write_text(re.sub(r"\| `integrate` \| mean E.*?\n(?=\n)", lambda _: table + "\n", text, flags=re.S))


if __name__ == "__main__":
    main()
