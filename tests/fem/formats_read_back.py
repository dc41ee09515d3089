"""The matrix of formats: each mesh format, one region, three labels and 116, first and second order, read back by programs
that share nothing with scantet, and compared: counts, coordinates, volume of each region, orientation, nodes on edges,
names, boundaries, curves and corners, sets and fields.

formats_read_back.py SCANTET SAMPLES [labels]; exit status 77 (skipped) where a module is missing. `labels`: also 116 labels.
"""
import pathlib
import struct
import subprocess
import sys
import tempfile

try:
    import h5py
    import meshio
    import numpy as np
    from scipy.spatial import cKDTree
    from mesh_model import EDGES, volumes
    from mesh_readers import (read_elmer, read_exodus, read_feb, read_bdf, read_inp, read_med, read_medit,
                              read_mesh_complete, read_msh, read_msh2, read_vtk, read_vtm, read_xdmf)
except ModuleNotFoundError as error:
    print(error)
    sys.exit(77)

FORMATS = "vtu vtk msh msh2 mesh inp feb bdf e med xdmf vtm elmer mesh-complete stls stl ply".split()


def run(*command, cwd):
    done = subprocess.run([str(c) for c in command], cwd=cwd, capture_output=True, text=True, timeout=900)
    assert done.returncode in (0, 4), (command, done.stdout, done.stderr)


def same_rows(a, b, corners):
    """Facets, each once, with the same sense of rotation and the same nodes on edges."""
    def canonical(rows):
        rows = np.asarray(rows)
        turned = []
        for row in rows:
            first = int(np.argmin(row[:3]))
            order = [(first + i) % 3 for i in range(3)]
            turned.append(tuple(row[order]) + (tuple(row[[3 + i for i in order]]) if len(row) == 6 else ()))
        return sorted(turned)
    return canonical(a[:, :corners]) == canonical(b[:, :corners])


def compare(model, reference, label):
    assert model.points.shape == reference.points.shape, (label, model.points.shape, reference.points.shape)
    far, number = cKDTree(reference.points).query(model.points)
    assert far.max() < 1e-9 and len(np.unique(number)) == len(number), (label, far.max())
    tets = number[model.tets]
    assert tets.shape == reference.tets.shape, (label, tets.shape)
    ours, theirs = np.lexsort(np.sort(tets[:, :4]).T), np.lexsort(np.sort(reference.tets[:, :4]).T)
    assert (np.sort(tets[ours][:, :4]) == np.sort(reference.tets[theirs][:, :4])).all(), label
    back = np.empty(len(tets), int)
    back[ours] = theirs  # of each tet read, its number in the reference
    assert (volumes(reference.points, tets) > 0).all(), (label, "a tet is turned over")
    if tets.shape[1] == 10:  # each node beside its edge: the pair of corners is that of the reference
        key = lambda t: {frozenset((t[a], t[b])): t[4 + e] for e, (a, b) in enumerate(EDGES)}
        for i in range(0, len(tets), max(1, len(tets) // 500)):
            assert key(tets[i]) == key(reference.tets[back[i]]), (label, i)
    same = np.char.lower(model.regions.astype(str)) == np.char.lower(reference.regions.astype(str)[back])
    assert same.all(), (label, set(model.regions), set(reference.regions))
    for region in np.unique(reference.regions):
        a = volumes(model.points, model.tets[np.char.lower(model.regions.astype(str)) == region]).sum()
        b = volumes(reference.points, reference.tets[reference.regions == region]).sum()
        assert abs(a - b) <= 1e-9 * b, (label, region, a, b)
    corners = 6 if tets.shape[1] == 10 else 3
    for what in ("surfaces", "facets"):
        found, expected = getattr(model, what), getattr(reference, what)
        if found is None:
            continue
        assert set(found) == set(expected), (label, what, set(found) ^ set(expected))
        for name in expected:
            width = min(corners, np.asarray(found[name]).shape[1])
            assert same_rows(number[np.asarray(found[name])], np.asarray(expected[name]), width), (label, what, name)
    compare_curves(model, reference, number, label)
    for what, renumber in (("nodes", number), ("elements", back)):
        found, expected = getattr(model, what), getattr(reference, what)
        if found is None:
            continue
        assert set(found) == set(expected), (label, what, set(found) ^ set(expected))
        for name in expected:
            assert sorted(renumber[np.asarray(found[name], int)]) == sorted(expected[name]), (label, what, name)
    for name, values in (model.fields or {}).items():
        assert np.array_equal(values, reference.fields[name][back]), (label, name)


def edges_of(rows):
    """Edges, each with its node between, whichever way they go."""
    return sorted((*sorted(row[:2]), *row[2:]) for row in np.asarray(rows).tolist())


def compare_curves(model, reference, number, label):
    for what in ("curves", "curve_nodes"):
        found = getattr(model, what)
        if found is None:
            continue
        assert set(found) == set(reference.curves), (label, what, set(found) ^ set(reference.curves))
        for name, rows in reference.curves.items():
            if what == "curves":
                assert edges_of(number[found[name]]) == edges_of(rows), (label, name)
            else:
                assert sorted(number[found[name]]) == sorted(np.unique(rows)), (label, name)
    if model.corners is not None:
        assert sorted(number[np.asarray(model.corners, int)]) == sorted(reference.corners), label


def check_curves(reference):
    """Edges of curves are those where surfaces meet, under the names of the regions there; corners are where a vertex has not
    two edges of one curve."""
    patches = {}
    for name, rows in reference.surfaces.items():
        for row in np.asarray(rows):
            for i in range(3):
                patches.setdefault(tuple(sorted((row[i], row[(i + 1) % 3]))), set()).add(name)
    regions = lambda name: {1, 0} if name == "sole" else {int(n) for n in name.split("_")[1:]}
    expected = {}
    for edge, names in patches.items():
        if len(names) > 1:
            around = sorted(set().union(*map(regions, names)))
            expected.setdefault("_".join(["curve", *map(str, around)]), []).append(edge)
    assert set(reference.curves) == set(expected)
    at = {}
    for name, edges in expected.items():
        found = np.asarray(reference.curves[name])
        assert edges_of(found[:, :2]) == sorted(edges), name
        for v in found[:, :2].ravel():
            at.setdefault(v, []).append(name)
        if found.shape[1] == 3:  # the node between is nearer to the middle than the ends are
            p = reference.points[found]
            middle = np.linalg.norm(p[:, 2] - (p[:, 0] + p[:, 1]) / 2, axis=1)
            assert (middle < 0.5 * np.linalg.norm(p[:, 0] - p[:, 1], axis=1)).all(), name
    reference.corners = [v for v, names in at.items() if len(names) != 2 or len(set(names)) != 1]


def check_surface_files(folder, reference):
    """.stl, .ply and the folder of .stl: the flat triangles between corners."""
    expected = {name: reference.points[np.asarray(rows)[:, :3]] for name, rows in reference.surfaces.items()}
    area = lambda p: 0.5 * np.linalg.norm(np.cross(p[:, 1] - p[:, 0], p[:, 2] - p[:, 0]), axis=1).sum()
    def stl(path):
        data = path.read_bytes()
        count = struct.unpack("<I", data[80:84])[0]
        assert len(data) == 84 + 50 * count
        rows = np.frombuffer(data[84:], np.dtype([("n", "<3f4"), ("p", "<9f4"), ("a", "<u2")]))
        return rows["p"].reshape(-1, 3, 3).astype(float)
    for name, triangles in expected.items():
        read = stl(folder / "m.stls" / (name + ".stl"))
        assert len(read) == len(triangles) and abs(area(read) - area(triangles)) < 1e-5 * area(triangles), name
    for name, rows in reference.facets.items():
        assert len(stl(folder / "m.stls" / (name + ".stl"))) == len(rows)
    assert len(list((folder / "m.stls").iterdir())) == len(expected) + len(reference.facets)
    total = np.concatenate(list(expected.values()))
    whole = stl(folder / "m.stl")
    mesh = meshio.read(folder / "m.ply")
    for read in (whole, mesh.points[mesh.cells[0].data]):
        assert len(read) == len(total) and abs(area(read) - area(total)) < 1e-5 * area(total)


def check_scantet(scantet, folder, reference, formats):
    """What scantet reads back itself, converted to XDMF. Patches of names of their own come back as sets of facets."""
    for name in formats:
        run(scantet, "convert", folder / f"m.{name}", folder / "back.xdmf", cwd=folder)
        model = read_xdmf(folder, "back")
        label = "scantet convert m." + name
        named = {n: rows for n, rows in reference.surfaces.items() if not n.startswith("boundary_")}
        for what in ("nodes", "elements", "facets"):
            setattr(model, what, {n.lower(): m for n, m in getattr(model, what).items()} if name != "mesh" else None)
        if name in ("vtu", "vtk"):
            assert not model.facets
            model.facets = None
        for surface, rows in named.items() if model.facets is not None else []:
            assert same_rows(model.facets.pop(surface), np.asarray(rows), 3), (label, surface)
        if named:
            model.surfaces = model.curves = None
        if name in ("mesh", "inp"):
            assert not model.fields
        compare(model, reference, label)


def write_labels(path, count):
    """So many cells around points in a ball, as a label map of 1 mm."""
    size, radius = 40, 18.0
    random = np.random.default_rng(5)
    seeds = np.empty((0, 3))
    while len(seeds) < count:  # apart from each other, so that each cell is a few voxels wide
        point = random.uniform(-radius, radius, 3)
        if np.linalg.norm(point) < radius - 1 and (len(seeds) == 0 or np.linalg.norm(seeds - point, axis=1).min() > 4.1):
            seeds = np.vstack([seeds, point])
    axis = np.arange(size) - (size - 1) / 2
    grid = np.stack(np.meshgrid(axis, axis, axis, indexing="ij"), -1)
    labels = cKDTree(seeds).query(grid)[1] + 1
    labels[np.linalg.norm(grid, axis=-1) > radius] = 0
    assert set(np.unique(labels)) == set(range(count + 1))
    header = (f"NRRD0004\ntype: uchar\ndimension: 3\nspace: left-posterior-superior\nsizes: {size} {size} {size}\n"
              "space directions: (1,0,0) (0,1,0) (0,0,1)\nencoding: raw\n"
              f"space origin: ({axis[0]},{axis[0]},{axis[0]})\n\n")
    path.write_bytes(header.encode() + labels.astype(np.uint8).transpose(2, 1, 0).tobytes())


def check_case(scantet, name, arguments, sets, order):
    with tempfile.TemporaryDirectory() as folder:
        folder = pathlib.Path(folder)
        outputs = [x for f in FORMATS for x in ("-o", f"m.{f}")]
        run(scantet, "mesh", *arguments(folder), "--order", order, *[x for s in sets for x in ("--set", s)], *outputs, cwd=folder)
        reference = read_xdmf(folder)
        check_curves(reference)
        readers = {"vtu": lambda: read_vtk(folder, "m.vtu"), "vtk": lambda: read_vtk(folder, "m.vtk"),
                   "msh": lambda: read_msh(folder), "msh2": lambda: read_msh2(folder),
                   "mesh": lambda: read_medit(folder, order), "inp": lambda: read_inp(folder), "feb": lambda: read_feb(folder),
                   "bdf": lambda: read_bdf(folder), "e": lambda: read_exodus(folder), "med": lambda: read_med(folder),
                   "vtm": lambda: read_vtm(folder, reference), "elmer": lambda: read_elmer(folder),
                   "mesh-complete": lambda: read_mesh_complete(folder)}
        for extension in readers:
            compare(readers[extension](), reference, f"{name}, order {order}, {extension}")
        check_surface_files(folder, reference)
        check_scantet(scantet, folder, reference, ("vtu", "vtk", "msh", "msh2", "mesh", "inp"))
        print(f"{name}, order {order}: {len(reference.tets)} tets, {len(np.unique(reference.regions))} regions, "
              f"{len(reference.surfaces)} surfaces, {len(reference.curves)} curves, {len(reference.corners)} corners, "
              f"{len(reference.facets)} sets of facets: {' '.join(FORMATS)}", flush=True)


def main():
    scantet, samples = (str(pathlib.Path(a).resolve()) for a in sys.argv[1:3])  # the program runs in another folder
    of_samples = lambda *words: lambda folder: [w.replace("SAMPLES", samples) for w in words]
    field = ["--field", "value=SAMPLES/sphere.nrrd:mean"]
    cases = [("one region", of_samples("SAMPLES/sphere.nrrd", "--level", "100.5", "--size", "4", "--cut", "sole: z > -5", *field),
              ["foot=facets: patch(sole)", "tip=normal(0,0,1,40)", "core=elements: ball(0,0,0,4)", "low=nodes: z < 0"]),
             ("three labels", of_samples("SAMPLES/labels_voronoi.nrrd", "--labels", "1-3", "--size", "4", *field),
              ["tip=normal(0,0,1,60)", "core=elements: x < 0", "low=nodes: z < 0"])]
    if "labels" in sys.argv[3:]:
        def arguments(folder):
            write_labels(folder / "labels.nrrd", 116)
            return ["labels.nrrd", "--labels", "all", "--size", "4", "--field", f"value={samples}/sphere.nrrd:mean"]
        cases.append(("116 labels", arguments, ["tip=normal(0,0,1,40)", "core=elements: x < 0", "low=nodes: z < 0"]))
    for name, arguments, sets in cases:
        for order in (1, 2):
            check_case(scantet, name, arguments, sets, order)


main()
