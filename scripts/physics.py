"""Models that CalculiX solves as the program writes them, beside their formulas, at several sizes.

    scripts/physics.py [--program FILE] [--page docs/fem.md] [--volumes DIR]

Needs ccx (Debian's calculix-ccx). Prints a table for each problem, and writes them into the page; without skull.nrrd among the
volumes the weight on the skull is left out. Exit status 1 if the error of a problem does not fall with the size as it should, the
two solvers of CalculiX differ on the skull, or the solver warns of anything.
"""
import argparse
import array
import gzip
import json
import math
import os
import pathlib
import re
import subprocess
import sys
import tempfile

import numpy as np
import scipy.ndimage

import solver_iterations

E, NU, RHO = 1000.0, 0.3, 1.0  # MPa, -, g/cm³
SHELL = ["implicit:max(x^2+y^2+z^2-400, 100-x^2-y^2-z^2)", "--bounds=-22,-22,-22,22,22,22"]  # radii 10 and 20 mm
OCTANT = ["--cut", "px: x > 0", "--cut", "py: y > 0", "--cut", "pz: z > 0",
          "--set", "sx=patch(px)", "--set", "sy=patch(py)", "--set", "sz=patch(pz)",
          "--set", "inner=patch(boundary_1_0) and ball(0, 0, 0, 15)", "--set", "outer=patch(boundary_1_0) minus ball(0, 0, 0, 15)"]


class Lab:
    """A folder in which models are made and solved."""

    def __init__(self, program, folder):
        self.program, self.folder, self.order = program, pathlib.Path(folder), 1

    def run(self, *command):
        done = subprocess.run([str(c) for c in command], cwd=self.folder, capture_output=True, text=True, timeout=3600)
        text = done.stdout + done.stderr
        if done.returncode != 0:
            sys.exit(f"{' '.join(map(str, command))}\nended with status {done.returncode}:\n{text[-3000:]}")
        return text

    def solve(self, deck, size, source, *options, held=None):
        """Meshes, solves, and returns the nodes and the rows of the deck's table, by node. Elements are of self.order.

        held: the name of a set, and of a place the values that its nodes are held at; in place of what --hold holds.
        """
        template = pathlib.Path(__file__).resolve().parent.parent / f"src/scantet/decks/templates/ccx_{deck}.inp"
        text = re.sub(r"\*NODE PRINT.*\n.*\n", "", template.read_text())
        what = {"static": "U", "heat": "NT", "electro": "NT"}.get(deck)
        if what:
            text = text.replace("*END STEP", f"*NODE PRINT, NSET=NALL\n{what}\n*END STEP")  # with all of its digits
        if held:
            text = text.replace("*BOUNDARY\n{{hold}}\n", "").replace("{{load}}", "*INCLUDE, INPUT=held.inp\n{{load}}")
        (self.folder / "template.inp").write_text(text)
        self.run(self.program, "mesh", *source, "--size", size, "--order", self.order, *options, "--materials", "materials.json", "--deck", deck,
                 "--deck-template", "template.inp", "--quiet", "-o", "m.inp")
        lines = (self.folder / "m.inp").read_text().split("*ELEMENT")[0].splitlines()
        nodes = {int(l.split(",")[0]): tuple(map(float, l.split(",")[1:])) for l in lines if re.match(r" *\d+,", l)}
        if held:
            name, exact = held
            rows = re.search(rf"(?m)^\*NSET, NSET={name}\n((?:[\d ,]+\n)+)", (self.folder / "m.inp").read_text()).group(1)
            first = 1 if deck == "static" else 11  # degree of freedom
            with (self.folder / "held.inp").open("w") as file:
                file.write("*BOUNDARY\n")
                for node in map(int, re.findall(r"\d+", rows)):
                    file.writelines(f"{node}, {way}, {way}, {v:.13e}\n" for way, v in enumerate(exact(nodes[node]), first))
        _, rows = self.solved(f"m_{deck}")
        return nodes, rows

    def solved(self, deck):
        """What CalculiX says of a deck, and the rows of its table, by node; ends the run if it warns."""
        log = self.run("ccx", "-i", deck)
        if "WARNING" in log or "ERROR" in log:
            sys.exit(f"the solver warns:\n{log[-3000:]}")
        rows = {}
        for line in (self.folder / f"{deck}.dat").read_text().splitlines():
            words = line.split()
            if len(words) > 1 and words[0].isdigit():
                rows.setdefault(int(words[0]), [float(w) for w in words[1:]])
        return log, rows

    def materials(self, *conductivities):
        common = {"youngs_modulus_mpa": E, "poissons_ratio": NU, "density_g_per_cm3": RHO}
        regions = {str(n + 1): {**common, "conductivity": k} for n, k in enumerate(conductivities)}
        (self.folder / "materials.json").write_text(json.dumps({"regions": regions}))


def error_of(nodes, rows, exact):
    """The root mean square of the error over that of the exact values, at the nodes."""
    off = size = 0.0
    for node, row in rows.items():
        wanted = exact(nodes[node])
        off += sum((a - b) ** 2 for a, b in zip(row, wanted))
        size += sum(b * b for b in wanted)
    return math.sqrt(off / size)


def pressed_shell(lab, size):
    """Lamé's solution: a pressure within."""
    inner, outer, pressure = 10.0, 20.0, 5.0
    lab.materials(1)
    nodes, rows = lab.solve("static", size, SHELL, *OCTANT, "--hold", "sx=x", "--hold", "sy=y", "--hold", "sz=z",
                            "--load", f"inner={pressure}")

    def exact(p):
        r = math.sqrt(sum(c * c for c in p))
        scale = pressure * inner ** 3 / (outer ** 3 - inner ** 3)
        u = scale * ((1 - 2 * NU) / E * r + (1 + NU) / (2 * E) * outer ** 3 / r ** 2)
        return [u * c / r for c in p]
    return len(nodes), error_of(nodes, rows, exact)


def warm_shell(lab, size):
    """Heat from within: the temperature falls with 1/r."""
    lab.materials(0.5)
    nodes, rows = lab.solve("heat", size, SHELL, *OCTANT, "--hold", "inner=100", "--hold", "outer=0")
    return len(nodes), error_of(nodes, rows, lambda p: [100 * (20 / math.sqrt(sum(c * c for c in p)) - 1)])


def head(path, radii, step):
    """A scan of an octant: 30 mm less the distance from the middle of a head, in voxels of so many mm. Returns the options for its shells."""
    ways = [step * c for c in range(-round(1 / step), round((radii[-1] + 2) / step))]
    values = (30 - math.sqrt(x * x + y * y + z * z) for z in ways for y in ways for x in ways)
    header = (f"NRRD0005\ntype: float\ndimension: 3\nspace: left-posterior-superior\nsizes: {len(ways)} {len(ways)} {len(ways)}\n"
              f"space directions: ({step},0,0) (0,{step},0) (0,0,{step})\nspace origin: ({ways[0]},{ways[0]},{ways[0]})\n"
              "endian: little\nencoding: raw\n\n")
    path.write_bytes(header.encode() + array.array("f", values).tobytes())
    return [word for radius in radii for word in ("--level", f"{30 - radius:g}")]


def shells_series(radii, conductivities, narrow, terms):
    """The potential in a ball of shells, of currents that enter around one pole and leave around the other.

    Their density at the surface is the sum of (2n + 1) narrow^n P_n(cos theta) over odd n. In each shell the potential is a sum of
    (a (r/R)^n + b (R/r)^(n + 1)) P_n, with a and b such that it and the current go on from shell to shell.
    """
    scale = radii[-1]
    parts = []
    for n in range(1, terms, 2):
        a, b, shells = 1.0, 0.0, []
        for i, (radius, conductivity) in enumerate(zip(radii, conductivities)):
            shells.append((a, b))
            t = radius / scale
            rising, falling = a * t ** n, b * t ** -(n + 1)
            flow = conductivity * (n * rising - (n + 1) * falling)
            if i + 1 < len(radii):
                value, flow = rising + falling, flow / conductivities[i + 1]
                a = ((n + 1) * value + flow) / (2 * n + 1) * t ** -n
                b = (n * value - flow) / (2 * n + 1) * t ** (n + 1)
        share = (2 * n + 1) * narrow ** n * scale / flow
        parts.append([(a * share, b * share) for a, b in shells])

    def exact(p):
        r = math.sqrt(sum(c * c for c in p))
        if r == 0:
            return [0.0]
        shell = sum(r > radius for radius in radii[:-1])
        t, cosine = r / scale, p[2] / r
        total, before, legendre = 0.0, 1.0, cosine
        for n in range(1, terms):
            if n % 2:
                a, b = parts[n // 2][shell]
                total += (a * t ** n + b * t ** -(n + 1)) * legendre
            before, legendre = legendre, ((2 * n + 1) * cosine * legendre - n * before) / (n + 1)
        return [total]
    return exact


def head_currents(lab, size):
    """Currents through brain, skull and scalp from pole to pole: the classical series of Legendre's polynomials."""
    radii, conductivities = (14, 17, 21), (0.33e-3, 0.01e-3, 0.43e-3)  # mm, S/mm
    levels = head(lab.folder / "head.nrrd", radii, size / 8)
    lab.materials(*conductivities[::-1])
    exact = shells_series(radii, conductivities, 0.75, 80)
    surface = "patch(boundary_1_0)" + "".join(f" or patch(pz_region_{n})" for n in (1, 2, 3))
    nodes, rows = lab.solve("electro", size, ["head.nrrd", *levels], *OCTANT[:6], "--set", f"outer={surface}", held=("OUTER", exact))
    return len(nodes), error_of(nodes, {n: row for n, row in rows.items() if math.hypot(*nodes[n]) < radii[0]}, exact)


def bent_rod(lab, size):
    """Saint-Venant's flexure of a round rod, which is Timoshenko's cantilever in three dimensions."""
    radius, length, force = 2.0, 20.0, 1.0
    lab.materials(1)
    scale = force / (E * math.pi * radius ** 4 / 4)

    def exact(p):
        x, y, z = p
        warp = x * y * y - (0.75 + NU / 2) * radius ** 2 * x + (x ** 3 - 3 * x * y * y) / 4
        return [scale * (NU / 2 * (length - z) * (x * x - y * y) + length * z * z / 2 - z ** 3 / 6),
                scale * NU * (length - z) * x * y, -scale * (x * (length * z - z * z / 2) + warp)]
    rod = [f"implicit:max(x^2+y^2-{radius ** 2:g}, abs(z-{length / 2:g})-{length})", f"--bounds=-3,-3,{-length},3,3,{2 * length}", "--cut", "low: z > 0", "--cut", f"high: z < {length}",
           "--set", "tip=patch(high)", "--set", "foot=patch(low)"]
    nodes, rows = lab.solve("static", size, rod, "--load", f"tip={force},0,0", held=("FOOT", exact))
    near = {node: row for node, row in rows.items() if nodes[node][2] <= length / 2}
    return len(nodes), error_of(nodes, near, exact)


def bar_frequency(lab, size):
    """The first bending of a bar of 4 x 4 x 40 mm held at one end, beside Euler and Bernoulli's."""
    lab.materials(1)
    box = ["implicit:max(max(abs(x), abs(y)), abs(z)/10) - 2", "--bounds=-3,-3,-21,3,3,21", "--sharp-edges", "30"]
    _, rows = lab.solve("modal", size, box, "--set", "foot=z < -19.999", "--hold", "foot")
    nodes = len(re.findall(r"(?m)^ *\d+,", (lab.folder / "m.inp").read_text().split("*ELEMENT")[0]))
    beam = 3.5160 / (2 * math.pi * 40 ** 2) * math.sqrt(E * 4 ** 4 / 12 / (RHO * 1e-9 * 16))
    return nodes, rows[1][2] / beam - 1


def cells(path, skull, level, wanted):
    """Writes equal tetrahedra: the cells of a grid whose middles are in the skull, its largest component, each cut into six.

    The grid is such that the nodes are as many as wanted, within 3 %. Returns them and its step, mm.
    """
    header, packed = skull.read_bytes().split(b"\n\n", 1)
    words = header.decode()
    voxels = [int(n) for n in re.search(r"sizes: (.*)", words).group(1).split()]
    spacing = [float(row.split(",")[i]) for i, row in enumerate(re.findall(r"\(([^)]*)\)", re.search(r"space directions: (.*)", words).group(1)))]
    values = np.frombuffer(gzip.decompress(packed), "<f4").reshape(voxels, order="F")
    step = 3.0
    for _ in range(12):
        middles = np.meshgrid(*[(np.arange(-d, n * d + d, step) + step / 2) / d for n, d in zip(voxels, spacing)], indexing="ij")
        solid = scipy.ndimage.map_coordinates(values, middles, order=1, mode="grid-constant", cval=0) > level
        parts, _ = scipy.ndimage.label(solid)  # of cells that share a face
        chosen = np.argwhere(parts == 1 + np.argmax(np.bincount(parts[solid])[1:]))
        corners = np.unique((chosen[:, None] + np.indices((2, 2, 2)).reshape(3, 8).T).reshape(-1, 3), axis=0)
        if abs(len(corners) / wanted - 1) < 0.03:
            break
        step *= (len(corners) / wanted) ** (1 / 3)
    else:
        sys.exit(f"no grid of the skull has {wanted} nodes")
    number = {tuple(c): n + 1 for n, c in enumerate(corners.tolist())}
    found = {n: tuple(step * i - d for i, d in zip(c, spacing)) for c, n in number.items()}
    ways = [(0, 1, 2), (1, 2, 0), (2, 0, 1), (0, 2, 1), (2, 1, 0), (1, 0, 2)]  # along the axes, from corner to corner of a cell
    lines = []
    for cell in chosen.tolist():
        for w, way in enumerate(ways):
            at, tet = list(cell), [number[tuple(cell)]]
            for axis in way:
                at[axis] += 1
                tet.append(number[tuple(at)])
            lines.append(tet if w < 3 else [tet[0], tet[2], tet[1], tet[3]])
    with path.open("w") as file:
        file.write("*NODE, NSET=NALL\n" + "".join(f"{v}, {p[0]:.9g}, {p[1]:.9g}, {p[2]:.9g}\n" for v, p in found.items()))
        file.write("*ELEMENT, TYPE=C3D4, ELSET=EALL\n" + "".join(f"{e + 1}, {', '.join(map(str, t))}\n" for e, t in enumerate(lines)))
    return found, step


def weight(lab, skull):
    """The paper's skull under its weight by both solvers of CalculiX, beside cells of the same shape. Returns a part of the page, and what is wrong."""
    mesh = lab.folder / "skull.inp"
    nodes = solver_iterations.mesh_nodes(str(lab.program), str(skull), solver_iterations.SKULL_LEVEL, 3, ["--outside", "0"], str(mesh))
    uniform, step = cells(lab.folder / "cells.inp", skull, solver_iterations.SKULL_LEVEL, len(nodes))
    page = ["## A skull under its weight", "",
            "The paper's skull at 3 mm (`--level 2.9 --outside 0 --components largest`), the lowest nodes held, by CalculiX's iterative and its direct solver (the deck is that of "
            f"`scripts/solver_iterations.py`), beside a uniform mesh of the same shape: the cells of a grid of {step:.3g} mm whose middles are in the skull, each cut into six equal tets, with as many nodes "
            "and the same hold. The solver warns of no element.", "",
            "| mesh | nodes | of them held | iterations of `ITERATIVE SCALING` | largest displacement, mm | by the direct solver |",
            "| --- | ---: | ---: | ---: | ---: | ---: |"]
    failed, taken = [], []
    for name, nodes in (("skull", nodes), ("cells", uniform)):
        mesh, deck = lab.folder / f"{name}.inp", lab.folder / f"{name}_weight.inp"
        held = solver_iterations.write_deck(str(mesh), nodes, str(deck), of_nodes=True)
        iterative = deck.read_text().replace("*NODE PRINT, NSET=HELD", "*NODE PRINT, NSET=NALL")
        largest = []
        for text in (iterative, iterative.replace(", SOLVER=ITERATIVE SCALING", "")):
            deck.write_text(text)
            log, rows = lab.solved(deck.stem)
            if text is iterative:
                iterations = solver_iterations.last_iteration(log)
                taken.append(iterations)
            largest.append(max(math.hypot(*row) for row in rows.values()))
        print(f"Weight, {name}: {len(nodes)} nodes, {held} held, {iterations} iterations, {largest[0]:.6g} mm, by the direct solver "
              f"{largest[1]:.6g} mm", flush=True)
        page.append(f"| {name} | {len(nodes):,} | {held:,} | {iterations:,} | {largest[0]:.4g} | {largest[1]:.4g} |")
        if not abs(largest[0] / largest[1] - 1) < 1e-3:
            failed.append(f"the two solvers on the {name}")
    return page + ["", f"The skull's mesh takes {taken[0] / taken[1]:.2f} times the iterations of the equal tets, so that most of them are due to its shape. "
                   "Rough scans beside the skull: [algorithm.md](algorithm.md).", ""], failed


PROBLEMS = [
    ("A spherical shell under pressure", pressed_shell, (6, 4, 3, 2, 1.5), (1.5, 2),
     "Radii 10 and 20 mm, an octant with its three planes held, 5 MPa within (`--deck static`): displacements beside Lamé's."),
    ("A rod bent by a force", bent_rod, (2, 1.4, 1, 0.7), (1.5, 2.5),
     "A cantilever, round, of radius 2 and length 20 mm, 1 N across its end, spread evenly by the deck (`--deck static`); its foot is held at Saint-Venant's solution, which has Timoshenko's "
     "deflections and the warping of the sections: displacements beside that in the half nearer the foot, where it no longer matters how the force is spread."),
    ("Heat through a spherical shell", warm_shell, (6, 4, 3, 2, 1.5), (1.5, 2),
     "The same shell, 100 degrees within and 0 around it (`--deck heat`): temperatures beside 1/r."),
    ("Currents through a head of three shells", head_currents, (2.8, 2, 1.4, 1), (1.5, 2.3),
     "Distances from the middle of a head, in voxels of an eighth of the size, and three nested levels (`--level`): brain, skull and scalp, radii 14, 17 and 21 mm, 0.33, 0.01 and 0.43 S/m; an octant, "
     "cut (`--deck electro`). Currents enter around one pole and leave around the other, spread as the sum of (2n + 1) 0.75^n P_n over odd n. The scalp's surface and the equator are held at the classical "
     "potential of the ball of three shells, a series of Legendre's polynomials: potentials in the brain beside it."),
    ("The lowest frequency of a bar", bar_frequency, (2, 1.4, 1), (1, None),
     "4 x 4 x 40 mm, held at one end (`--deck modal`): above the first bending of Euler and Bernoulli's beam by this share. Tets of first order are too stiff in bending; "
     "those of second order come down to the bar itself, whose frequency is not quite the beam's: it also shears, and its foot is held all over."),
]


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--program", default="build/release/bin/scantet")
    parser.add_argument("--page")
    parser.add_argument("--volumes", default=os.environ.get("SCANTET_VOLUMES", "../shared/volumes"))
    options = parser.parse_args()
    program = pathlib.Path(options.program).resolve()
    page = ["# Models beside their formulas", "",
            "Made by `scripts/physics.py --page docs/fem.md` (step `physics` of `scripts/check.sh`): each model is written by `scantet mesh --deck` and solved by CalculiX as it is.",
            "An error is the root mean square over that of the exact values, at all nodes, with elements of four and of ten nodes (`--order`); its slope that over size, from the first to the last.", ""]
    failed = []
    with tempfile.TemporaryDirectory() as folder:
        lab = Lab(program, folder)
        for title, problem, sizes, least_slopes, text in PROBLEMS:
            found, slopes = {}, []
            for lab.order, least in zip((1, 2), least_slopes):
                errors = found[lab.order] = [problem(lab, size) for size in sizes]
                slopes.append(math.log(abs(errors[0][1] / errors[-1][1])) / math.log(sizes[0] / sizes[-1]))
                print(f"{title}, order {lab.order}: " + ", ".join(f"{s:g} mm {100 * e:.3g} %" for s, (_, e) in zip(sizes, errors))
                      + f"; slope {slopes[-1]:.2f}", flush=True)
                if not all(math.isfinite(e) for _, e in errors) or (least is not None and slopes[-1] < least):
                    failed.append(f"{title}, order {lab.order}")
            page += [f"## {title}", "", text, "",
                     "| size, mm | nodes, order 1 | error | nodes, order 2 | error |", "| ---: | ---: | ---: | ---: | ---: |"]
            page += [f"| {size:g} | {one[0]:,} | {100 * one[1]:.3g} % | {two[0]:,} | {100 * two[1]:.3g} % |"
                     for size, one, two in zip(sizes, found[1], found[2])]
            page += ["", "Slope " + " and ".join(f"{s:.2f}" for s, least in zip(slopes, least_slopes) if least is not None) + ".", ""]
        skull = pathlib.Path(options.volumes).resolve() / "skull.nrrd"
        if skull.exists():
            part, wrong = weight(lab, skull)
            page += part
            failed += wrong
        else:
            print(f"{skull} is not there: the weight on a skull is left out")
    if options.page:
        written = pathlib.Path(options.page)
        _, heading, rest = (written.read_text() if written.exists() else "").partition(solver_iterations.HEADING)  # that script's
        written.write_text("\n".join(page).rstrip() + "\n" + ("\n" + heading + rest if heading else ""))
    if failed:
        sys.exit(f"not as it should be: {'; '.join(failed)}")


if __name__ == "__main__":
    main()
