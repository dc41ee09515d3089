#!/usr/bin/env python3
"""Other meshers' meshes of the same scans, verified: prints the table of docs/certificate.md.

    other_meshers.py [--build FOLDER] [--skull FILE]

CGAL's Mesh_3 meshes the image itself (benchmarks/cgal_mesh.cpp; configure with -DSCANTET_BUILD_BENCHMARKS=ON). TetGen and gmsh fill
a surface: that of VTK's flying edges (marching cubes) at the same level, closed at the border of the image with its smallest value,
each triangle as it comes. Needs Debian's python3-vtk9, tetgen and gmsh; run it with /usr/bin/python3.
"""
import argparse
import re
import subprocess
import sys
import tempfile
from pathlib import Path

from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkIdList
from vtkmodules.vtkFiltersCore import vtkFlyingEdges3D
from vtkmodules.vtkIOImage import vtkNrrdReader
from vtkmodules.vtkImagingCore import vtkImageConstantPad

ROOT = Path(__file__).resolve().parent.parent


def surface_of(scan, level):
    """Vertices (world, mm) and triangles of the level set by marching cubes, of an image along the axes of the world."""
    reader = vtkNrrdReader()
    reader.SetFileName(str(scan))
    reader.Update()
    image = reader.GetOutput()
    low = image.GetScalarRange()[0]
    pad = vtkImageConstantPad()
    pad.SetInputData(image)
    extent = image.GetExtent()
    pad.SetOutputWholeExtent(*(end + (-1 if n % 2 == 0 else 1) for n, end in enumerate(extent)))
    pad.SetConstant(low)
    edges = vtkFlyingEdges3D()
    edges.SetInputConnection(pad.GetOutputPort())
    edges.SetValue(0, level)
    edges.ComputeNormalsOff()
    edges.Update()
    found = edges.GetOutput()
    points = vtk_to_numpy(found.GetPoints().GetData())
    triangles = []
    corners = vtkIdList()
    cells = found.GetPolys()
    cells.InitTraversal()
    while cells.GetNextCell(corners):
        triangles.append(tuple(corners.GetId(n) for n in range(3)))
    return points, triangles


def write_off(path, points, triangles):
    with open(path, "w", encoding="ascii") as out:
        out.write(f"OFF\n{len(points)} {len(triangles)} 0\n")
        for p in points:
            out.write(" ".join(repr(float(x)) for x in p) + "\n")
        for t in triangles:
            out.write("3 {} {} {}\n".format(*t))


def write_stl(path, points, triangles):
    with open(path, "w", encoding="ascii") as out:
        out.write("solid s\n")
        for t in triangles:
            out.write("facet normal 0 0 0\nouter loop\n")
            for v in t:
                out.write("vertex {} {} {}\n".format(*(repr(float(x)) for x in points[v])))
            out.write("endloop\nendfacet\n")
        out.write("endsolid s\n")


def run(words, folder, seconds=500):
    done = subprocess.run([str(w) for w in words], cwd=folder, capture_output=True, text=True, timeout=seconds, check=False)
    return done.returncode, done.stdout + done.stderr


def ours(scantet, scan, level, size, folder, how):
    return run([scantet, "mesh", scan, "--level", level, "--size", size, "-o", "m.vtu", "--quiet", *how], folder)[1], "m.vtu"


def cgal(program, scan, level, size, folder):
    return run([program, scan, level, size, "m.vtu"], folder)[1], "m.vtu"


def tetgen(surface, size, folder):
    write_off(folder / "s.off", *surface)
    volume = size ** 3 / 6 / 2 ** 0.5 * 2  # twice the regular tetrahedron of that edge
    words = run(["tetgen", f"-pq1.8a{volume}Yg", "s.off"], folder)[1]  # Y: the surface stays; g: a Medit file
    return words, "s.1.mesh"


def gmsh(surface, size, folder):
    write_stl(folder / "s.stl", *surface)
    (folder / "s.geo").write_text(f'Merge "s.stl";\nSurface Loop(1) = {{1}};\nVolume(1) = {{1}};\nPhysical Volume(1) = {{1}};\n'
                                  f"Mesh.MeshSizeMax = {size};\nMesh.Optimize = 1;\n", encoding="ascii")
    return run(["gmsh", "-3", "-nopopup", "s.geo", "-o", "s.msh"], folder)[1], "s.msh"


def row(text, name):
    found = re.search(rf"^{name} +(.*)$", text, re.MULTILINE)
    return found.group(1) if found else "–"


def short(text):
    text = re.sub(r", proved \(largest near \([^)]*\)\)| at \([^)]*\)", "", text)
    return re.sub(r" with a collar.*", "", text)


def verify(scantet, mesh, scan, level, folder):
    if not (folder / mesh).exists():
        return None
    status, text = run([scantet, "verify", mesh, "--against", scan, "--level", level], folder)
    if status not in (0, 4):
        return None
    lost = re.findall(r"^(?:wrong|not proved): .* \[([a-z_.]+)\]", text, re.MULTILINE)
    return [row(text, "grade"), short(row(text, "facets")), short(row(text, "mesh to level")), short(row(text, "level to mesh")),
            ", ".join(f"`{code}`" for code in lost) or "nothing"]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--build", type=Path, default=ROOT / "build/release")
    parser.add_argument("--skull", type=Path, help="the paper's head CT, at level 2.9")
    arguments = parser.parse_args()
    scantet = arguments.build.resolve() / "bin/scantet"
    samples = ROOT / "sample_volumes"
    cases = [(samples / "sphere.nrrd", 127.5, 2), (samples / "torus.nrrd", 300.5, 1), (samples / "tanglecube.nrrd", 0.1, 2)]
    if arguments.skull:
        cases.append((arguments.skull.resolve(), 2.9, 2))
    print("| scan | mesher | grade | facets with a collar | mesh to level | level to mesh | what is lost |")
    print("| --- | --- | --- | --- | --- | --- | --- |")
    for scan, level, size in cases:
        surface = surface_of(scan, level)
        meshers = {
            "scantet": lambda folder: ours(scantet, scan, level, size, folder, []),
            "scantet --certify refine": lambda folder: ours(scantet, scan, level, size, folder, ["--certify", "refine"]),
            "CGAL Mesh_3": lambda folder: cgal(arguments.build.resolve() / "bin/cgal_mesh", scan, level, size, folder),
            "TetGen, of marching cubes": lambda folder: tetgen(surface, size, folder),
            "gmsh, of marching cubes": lambda folder: gmsh(surface, size, folder),
        }
        for name, make in meshers.items():
            with tempfile.TemporaryDirectory() as kept:
                folder = Path(kept)
                try:
                    words, mesh = make(folder)
                    found = verify(scantet, mesh, scan, level, folder)
                except subprocess.TimeoutExpired:
                    words, found = "no mesh in 500 s", None
                if found is None:
                    lines = [line.strip() for line in words.splitlines() if re.search(r"rror|cannot|Failed|no mesh", line)]
                    found = ["no mesh", "–", "–", "–", (lines or ["no file"])[-1].replace("|", "/")]
                print(f"| {scan.name}, {size} mm | {name} | {' | '.join(found)} |", flush=True)
    return 0


if __name__ == "__main__":
    sys.exit(main())
