"""The worked examples of docs/tutorials: makes their scans, meshes, solves, and draws their pictures.

    scripts/tutorials.py [--program FILE] [--check]     all of it; --check compares the figures with those of the pages
    scripts/tutorials.py --scans FOLDER                 the scans and tables alone

Each page has one command of scantet in a block `sh`; it is run as it stands there. What CalculiX (ccx) makes of it is
drawn as docs/tutorials/NAME.png, and its figures are put into the page's last block `text`.
"""
import argparse
import gzip
import pathlib
import re
import shlex
import shutil
import subprocess
import sys
import tempfile

import numpy as np

from drawing import save_png, side_by_side

ROOT = pathlib.Path(__file__).resolve().parent.parent
PAGES = ROOT / "docs/tutorials"


def grid(half, step):
    """Places (x, y, z) of voxel centres around the origin, z slowest, and the frame."""
    axes = [step * (np.arange(round(2 * h / step) + 1)) - h for h in half]
    z, y, x = np.meshgrid(*axes[::-1], indexing="ij")
    return x, y, z, step


def write_nrrd(path, values, places):
    x, y, z, step = places
    kind = {"int16": "short", "uint8": "uchar"}[values.dtype.name]
    sizes = " ".join(str(n) for n in values.shape[::-1])
    header = (f"NRRD0005\ntype: {kind}\ndimension: 3\nspace: left-posterior-superior\nsizes: {sizes}\n"
              f"space directions: ({step},0,0) (0,{step},0) (0,0,{step})\n"
              f"space origin: ({x.min():g},{y.min():g},{z.min():g})\nendian: little\nencoding: gzip\n\n")
    path.write_bytes(header.encode() + gzip.compress(values.tobytes(), mtime=0))


def femur(folder):
    """A ball on a neck on a shaft, in HU: a dense shell, spongy bone that grows denser towards the head, soft tissue."""
    places = grid((36, 24, 66), 1.5)
    x, y, z, step = places

    def rod(a, b, radius_a, radius_b):  # how deep inside, in mm
        a, b = np.array(a), np.array(b)
        axis = b - a
        along = np.clip(((x - a[0]) * axis[0] + (y - a[1]) * axis[1] + (z - a[2]) * axis[2]) / ((axis @ axis) or 1), 0, 1)
        off = np.sqrt(sum((c - p - along * d) ** 2 for c, p, d in zip((x, y, z), a, axis)))
        return radius_a + along * (radius_b - radius_a) - off

    shaft = rod((-12, 0, -90), (-12, 0, 30), 13, 15)
    neck = rod((-10, 0, 22), (14, 0, 40), 13, 11)
    ball = rod((14, 0, 40), (14, 0, 40), 19, 19)
    deep = np.log(sum(np.exp(part / 2) for part in (shaft, neck, ball))) * 2  # joined smoothly
    shell = np.where(z < 10, 4.5, np.clip(4.5 - (z - 10) / 8, 1.8, 4.5))
    spongy = 220 + 330 * np.clip((z - 5) / 40, 0, 1)
    inside = np.clip(deep / step + 0.5, 0, 1)
    dense = np.clip((shell - deep) / step + 0.5, 0, 1)
    values = inside * (dense * 1500 + (1 - dense) * spongy)
    write_nrrd(folder / "femur.nrrd", np.round(values).astype(np.int16), places)


def head(folder):
    """Labels of a head: scalp, skull, fluid, and a folded layer of grey matter around white."""
    places = grid((80, 95, 85), 2.5)
    x, y, z, _ = places
    r = np.sqrt((x / 74) ** 2 + (y / 90) ** 2 + (z / 80) ** 2)  # 1 on the scalp
    mm = (1 - r) * 80  # about how deep
    folds = 2 * np.sin(x / 6) * np.sin(y / 6) * np.sin(z / 6)
    labels = np.select([mm < 0, mm < 6, mm < 13, mm < 18 + folds, mm < 26 + 2 * folds], [0, 1, 2, 3, 4], 5)
    write_nrrd(folder / "head.nrrd", labels.astype(np.uint8), places)


def vessel(folder):
    """Labels of an artery with an aneurysm: its wall and the lumen."""
    places = grid((11, 11, 18), 0.5)
    x, y, z, _ = places
    bulge = np.exp(-(z / 5) ** 2)
    off = np.sqrt((x - 1.5 * bulge) ** 2 + y ** 2)
    lumen = 3.5 + 2.5 * bulge
    labels = np.where(off < lumen, 2, np.where(off < lumen + 1.5, 1, 0))
    write_nrrd(folder / "vessel.nrrd", labels.astype(np.uint8), places)


SCANS = {"femur": femur, "head": head, "vessel": vessel}


def write_scans(folder):
    for name, make in SCANS.items():
        make(folder)
        for table in PAGES.glob(f"{name}.*"):
            if table.suffix in (".json", ".txt"):
                shutil.copy(table, folder)


def results_of(path):
    """The fields of an .frd file of CalculiX: by name, a row a node."""
    fields, name, rows = {}, None, []
    for line in path.read_text().splitlines():
        if line.startswith(" -4"):
            name, rows = line.split()[1], []
        elif line.startswith(" -1") and name:
            rows.append([float(line[i:i + 12]) for i in range(13, len(line.rstrip()), 12)])
        elif line.startswith(" -3") and name:
            fields[name], name = np.array(rows), None
    return fields


def run(words, folder):
    done = subprocess.run(words, cwd=folder, capture_output=True, text=True, timeout=600)
    if done.returncode != 0:
        sys.exit(f"{shlex.join(words)}\nended with status {done.returncode}:\n{done.stdout}{done.stderr}")
    return done.stdout + done.stderr


class Model:
    """A page's mesh, and what the solver found."""

    def __init__(self, name, program, folder):
        import meshio
        page = (PAGES / f"{name}.md").read_text()
        command = shlex.split(re.search(r"```sh\n(.*)\n```", page).group(1))
        run([program, *command[1:], "--quiet"], folder)
        deck = command[command.index("--deck") + 1]
        log = run(["ccx", "-i", f"{name}_{deck}"], folder)
        if "WARNING" in log or "ERROR" in log:
            sys.exit(f"the solver warns:\n{log[-3000:]}")
        mesh = meshio.read(folder / f"{name}.vtu")
        self.points, self.tets = mesh.points, mesh.cells_dict["tetra"]
        self.cells = {key: values[0] for key, values in mesh.cell_data.items()}
        self.fields = results_of(folder / f"{name}_{deck}.frd")
        self.sets = {key: values > 0 for key, values in mesh.point_data.items() if key.startswith("set_")}
        corners = self.points[self.tets]
        self.volumes = np.einsum("ij,ij->i", np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]),
                                 corners[:, 3] - corners[:, 0]) / 6

    def size(self):
        return [f"nodes                          {len(self.points):,}", f"tetrahedra                     {len(self.tets):,}"]

    def of_nodes(self, values):
        """The mean of each tet's corners."""
        return values[self.tets].mean(axis=1)

    def von_mises(self):
        xx, yy, zz, xy, yz, zx = self.fields["STRESS"].T[:6]
        return np.sqrt(((xx - yy) ** 2 + (yy - zz) ** 2 + (zz - xx) ** 2) / 2 + 3 * (xy ** 2 + yz ** 2 + zx ** 2))


def femur_figures(model):
    modulus = model.cells["youngs_modulus_mpa"]
    moved = np.linalg.norm(model.fields["DISP"][:, :3], axis=1)
    stress = model.of_nodes(model.von_mises())
    half = model.points[model.tets].mean(axis=1)[:, 1] > 0
    force = model.fields["FORC"][model.sets["set_foot"], :3].sum(axis=0)
    lines = [*model.size(),
             f"stiffness                      {modulus.min():.0f} to {modulus.max():.0f} MPa, {len(np.unique(modulus))} materials",
             f"largest displacement           {moved.max():.3f} mm",
             f"von Mises stress, 99 % below   {np.percentile(stress, 99):.1f} MPa",
             f"force on the clamp             {', '.join(f'{f:.1f}' for f in force)} N along x, y, z"]
    return lines, side_by_side(model, [(half, modulus, 0, modulus.max()), (half, stress, 0, np.percentile(stress, 99))], "y")


def head_figures(model):
    potential = model.fields["NDTEMP"][:, 0]
    density = model.of_nodes(np.linalg.norm(model.fields["FLUX"][:, :3], axis=1)) * 1e6  # A/m²
    brain = model.cells["region"] >= 4
    field = density / np.array([0, 0.43, 0.01, 1.79, 0.33, 0.126])[model.cells["region"]]  # V/m
    half = model.points[model.tets].mean(axis=1)[:, 0] > 0
    current = model.fields["RFL"][model.sets["set_cathode"], 0].sum()
    order = np.argsort(field[brain])
    below = np.searchsorted(np.cumsum(model.volumes[brain][order]), 0.99 * model.volumes[brain].sum())
    strong = field[brain][order][below]
    lines = [*model.size(),
             f"potential of the anode         {1000 * potential.max():.0f} mV at most",
             f"current at the cathode         {1000 * abs(current):.3f} mA",
             f"field in grey and white matter {strong:.3f} V/m, 99 % of the volume below"]
    return lines, side_by_side(model, [(half, model.cells["region"], 0, 5), (half & brain, field, 0, strong)], "x")


def vessel_figures(model):
    moved = np.linalg.norm(model.fields["DISP"][:, :3], axis=1)
    stress = model.of_nodes(model.von_mises())
    half = model.points[model.tets].mean(axis=1)[:, 1] > 0
    most = np.percentile(stress, 99)
    lines = [*model.size(),
             f"largest displacement           {moved.max():.3f} mm",
             f"von Mises stress, 99 % below   {most:.3f} MPa"]
    return lines, side_by_side(model, [(half, stress, 0, most), (half, model.of_nodes(moved), 0, moved.max())], "y")


FIGURES = {"femur": femur_figures, "head": head_figures, "vessel": vessel_figures}


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--program", default=ROOT / "build/release/bin/scantet")
    parser.add_argument("--scans", type=pathlib.Path)
    parser.add_argument("--check", action="store_true")
    parser.add_argument("names", nargs="*", default=list(SCANS))
    arguments = parser.parse_args()
    if arguments.scans:
        write_scans(arguments.scans)
        return 0
    differ = 0
    with tempfile.TemporaryDirectory(prefix="scantet_tutorials_") as name:
        folder = pathlib.Path(name)
        write_scans(folder)
        for name in arguments.names:
            lines, picture = FIGURES[name](Model(name, str(pathlib.Path(arguments.program).resolve()), folder))
            print(name, *lines, sep="\n  ")
            page = PAGES / f"{name}.md"
            before, _, after = page.read_text().rpartition("```text\n")
            text = before + "```text\n" + "".join(line + "\n" for line in lines) + after[after.index("```\n"):]
            if arguments.check:
                if page.read_text() != text:
                    differ += 1
                    print(f"{page}: has other figures", file=sys.stderr)
            else:
                page.write_text(text)
                save_png(PAGES / f"{name}.png", picture)
    return 1 if differ else 0


if __name__ == "__main__":
    sys.exit(main())
