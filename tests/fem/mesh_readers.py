"""Mesh files of every format, read by programs that share nothing with scantet. Names of regions and surfaces are as the
files have them."""
import re
import subprocess
import xml.etree.ElementTree as xml

import h5py
import meshio
import numpy as np
from scipy.io import netcdf_file
from scipy.spatial import cKDTree
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader

from mesh_model import EDGES, Model, by_name, curves_in, flags, is_own_set

def read_xdmf(folder, stem="m"):
    names = {grid.get("Name"): {int(i.get("Value")): i.get("Name") for i in grid.findall("Information")}
             for grid in xml.parse(folder / f"{stem}.xdmf").getroot().iter("Grid")}
    with h5py.File(folder / f"{stem}.h5") as file:
        def grid(name, values):
            return by_name(file[name + "/topology"][:], [names[name][n] for n in file[f"{name}/{values}"][:]])
        triangles = file["boundary/topology"][:]
        sets = {kind: {name: np.flatnonzero(values[:]) for name, values in file["set/" + kind].items()} if "set" in file else {}
                for kind in ("nodes", "facets", "elements")}
        fields = {name: values[:] for name, values in file["mesh/fields"].items()} if "mesh/fields" in file else {}
        return Model(file["mesh/geometry"][:], file["mesh/topology"][:], [names["mesh"][r] for r in file["mesh/region"][:]],
                     grid("boundary", "boundary"), sets["nodes"], sets["elements"],
                     {name: triangles[members] for name, members in sets["facets"].items()}, fields,
                     grid("curve", "curve") if "curve" in file else {})


def read_vtk(folder, name):
    mesh = meshio.read(folder / name)
    cells = {key: values[0] for key, values in mesh.cell_data.items()}
    return Model(mesh.points, mesh.cells[0].data, [f"region_{r}" for r in cells["region"]], None, flags(mesh.point_data),
                 flags(cells), None, {"value": cells["value"]})


def read_msh(folder):
    mesh = meshio.read(folder / "m.msh")
    names = {int(tag): name for name, (tag, _) in mesh.field_data.items()}
    def gathered(kind):
        blocks = [i for i, block in enumerate(mesh.cells) if block.type.startswith(kind)]
        if not blocks:
            return np.empty((0, 1), int), np.array([], str), {}
        data = {key: np.concatenate([np.ravel(values[i]) for i in blocks]) for key, values in mesh.cell_data.items()}
        return (np.concatenate([mesh.cells[i].data for i in blocks]),
                np.array([names[int(tag)] for tag in data["gmsh:physical"]]), data)
    tets, regions, data = gathered("tetra")
    corners, groups, _ = gathered("vertex")
    assert set(groups) <= {"corners"}
    return Model(mesh.points, tets, regions, by_name(*gathered("triangle")[:2]), flags(mesh.point_data, np.ravel), None, None,
                 {"value": data["value"]}, by_name(*gathered("line")[:2]), None, np.ravel(corners))


def read_msh2(folder):
    """By hand, as meshio 5.3 fails on values of elements in this version."""
    sections = re.findall(r"\$(\w+)\n(.*?)\$End\1\n", (folder / "m.msh2").read_text(), re.S)
    rows = lambda text: [line.split() for line in text.splitlines()]
    of = {name: rows(text) for name, text in sections if not name.endswith("Data")}
    names = {int(tag): name.strip('"') for _, tag, name in of["PhysicalNames"][1:]}
    rows = of["Elements"][1:]
    types = {4: "tets", 11: "tets", 2: "triangles", 9: "triangles", 1: "lines", 8: "lines", 15: "points"}
    kinds = np.array([types[int(row[1])] for row in rows])
    tags = np.array([names[int(row[3])] for row in rows])
    def elements(kind):
        return np.array([[int(x) - 1 for x in row[5:]] for row, k in zip(rows, kinds) if k == kind]), tags[kinds == kind]
    tets, regions = elements("tets")
    if tets.shape[1] == 10:
        tets = tets[:, [0, 1, 2, 3, 4, 5, 6, 7, 9, 8]]
    triangles = elements("triangles")[0]
    model = Model([[float(x) for x in row[1:]] for row in of["Nodes"][1:]], tets, regions, by_name(*elements("triangles")), {}, {},
                  {}, {}, by_name(*elements("lines")), None, np.ravel(elements("points")[0]).astype(int))
    for kind, text in sections:
        if not kind.endswith("Data"):
            continue
        lines = text.splitlines()
        name, values = lines[1].strip('"'), np.array([float(line.split()[1]) for line in lines[8:]])
        if kind == "NodeData":
            model.nodes[name.removeprefix("set_")] = np.flatnonzero(values)
            continue
        is_tet, is_triangle = (kinds[:len(values)] == k for k in ("tets", "triangles"))
        if not name.startswith("set_"):
            assert len(values) == len(rows), name
            model.fields[name] = values[is_tet]
        else:
            for of_kind, members in ((model.elements, np.flatnonzero(values[is_tet])),
                                     (model.facets, triangles[values[is_triangle] == 1])):
                if len(members):
                    of_kind[name.removeprefix("set_")] = members
    return model


def read_medit(folder, order):
    """Of second order by Gmsh, for meshio 5.0 knows no such elements."""
    text = (folder / "m.mesh").read_text()
    if order == 1:
        mesh = meshio.read(folder / "m.mesh")
        references = mesh.cell_data["medit:ref"]
    else:
        command = ["gmsh", "m.mesh", "-save", "-format", "msh22", "-o", "of_mesh.msh"]
        done = subprocess.run(command, cwd=folder, capture_output=True, text=True, timeout=300)
        assert done.returncode == 0 and "Error" not in done.stdout + done.stderr, done
        mesh = meshio.read(folder / "of_mesh.msh")
        references = mesh.cell_data["gmsh:geometrical"]
    comment = r"# triangle reference (\d+): (?:(\S+), )?between regions (\d+) \(behind\) and (\d+)"
    between = {int(number): name or f"boundary_{b}_{c}" for number, name, b, c in re.findall(comment, text)}
    curve = {int(number): name for number, name in re.findall(r"# edge reference (\d+): (\S+), of regions", text)}
    def gathered(kind, name_of):
        blocks = [i for i, block in enumerate(mesh.cells) if block.type.startswith(kind)]
        if not blocks:
            return np.empty((0, 1), int), np.array([], str)
        return (np.concatenate([mesh.cells[i].data for i in blocks]),
                [name_of(int(n)) for i in blocks for n in np.ravel(references[i])])
    section = re.search(r"\nCorners\n(\d+)\n((?:\d+\n)*)", text)
    numbers = [int(n) - 1 for n in section[2].split()] if section else []
    assert not section or int(section[1]) == len(numbers)
    begin = text.index("\nVertices\n") + len("\nVertices\n")
    vertices = text[begin:].split("\n", len(mesh.points) + 1)[1:-1]
    corners = [[float(x) for x in vertices[n].split()[:3]] for n in numbers]  # Gmsh numbers nodes anew
    return Model(mesh.points, *gathered("tetra", lambda r: f"region_{r}"), by_name(*gathered("triangle", between.get)),
                 curves=by_name(*gathered("line", curve.get)),
                 corners=cKDTree(mesh.points).query(corners)[1] if corners else [])


def read_inp(folder):
    sections = []
    for line in (folder / "m.inp").read_text().splitlines():
        if line.startswith("**"):
            continue
        if line.startswith("*"):
            words = [w.strip().split("=") for w in line[1:].split(",")]
            sections.append((words[0][0], {w[0]: w[-1] for w in words[1:]}, []))
        else:
            sections[-1][2].append([w.strip() for w in line.split(",") if w.strip()])
    points, tets, regions, numbers = [], [], [], []
    nodes, elements, surfaces = {}, {}, {}
    for keyword, options, lines in sections:
        if keyword == "NODE":
            points = [[float(x) for x in line[1:]] for line in lines]
        elif keyword == "ELEMENT":
            numbers += [int(line[0]) for line in lines]
            tets += [[int(x) - 1 for x in line[1:]] for line in lines]
            regions += [options["ELSET"].lower()] * len(lines)
        elif keyword == "NSET":
            nodes[options["NSET"].lower()] = np.array([int(x) - 1 for line in lines for x in line])
        elif keyword == "ELSET" and options["ELSET"] != "EALL":
            elements[options["ELSET"].lower().removeprefix("elements_")] = np.array([int(x) - 1 for line in lines for x in line])
        elif keyword == "SURFACE":
            surfaces[options["NAME"].lower()] = [(int(tet) - 1, face) for tet, face in lines]
    order = np.argsort(numbers)
    tets, regions = np.array(tets)[order], np.array(regions)[order]
    corners = {"S1": [0, 1, 2], "S2": [0, 3, 1], "S3": [1, 3, 2], "S4": [2, 3, 0]}
    between = {frozenset(e): 4 + i for i, e in enumerate(EDGES)}
    def facet(tet, face):
        at = corners[face]
        if tets.shape[1] == 10:
            at = at + [between[frozenset((at[i], at[(i + 1) % 3]))] for i in range(3)]
        return tets[tet][at][[0, 2, 1] + ([5, 4, 3] if tets.shape[1] == 10 else [])]
    surfaces = {name: np.array([facet(*f) for f in faces]) for name, faces in surfaces.items()}
    is_patch = lambda name: name.startswith("boundary_") or name == "sole"
    return Model(points, tets, regions, {n: s for n, s in surfaces.items() if is_patch(n)},
                 {n: m for n, m in nodes.items() if is_own_set(n)}, elements,
                 {n: s for n, s in surfaces.items() if not is_patch(n)}, **curves_in(nodes))


def read_feb(folder):
    root = xml.parse(folder / "m.feb").getroot()
    mesh = root.find("Mesh")
    numbers = lambda text: [int(x) - 1 for x in text.replace("\n", " ").split(",")]
    points = [[float(x) for x in node.text.split(",")] for node in mesh.find("Nodes")]
    tets, regions = {}, {}
    part_of = {}
    for part in mesh.findall("Elements"):
        part_of[part.get("name")] = [int(e.get("id")) - 1 for e in part]
        for e in part:
            tets[int(e.get("id")) - 1] = numbers(e.text)
            regions[int(e.get("id")) - 1] = part.get("name")
    value = np.full(len(tets), np.nan)
    for data in root.find("MeshData"):
        value[np.array(part_of[data.get("elem_set")])] = [float(e.text) for e in data]
        assert [int(e.get("lid")) for e in data] == list(range(1, len(data) + 1))
    domains = {d.get("name") for d in root.find("MeshDomains")}
    assert domains == set(part_of), domains
    surfaces = {s.get("name"): np.array([numbers(e.text) for e in s]) for s in mesh.findall("Surface")}
    is_patch = lambda name: name.startswith("boundary_") or name == "sole"
    nodes = {s.get("name"): np.array(numbers(s.text)) for s in mesh.findall("NodeSet")}
    curves = {edge.get("name"): np.array([numbers(e.text) for e in edge]) for edge in mesh.findall("Edge")}
    assert {e.tag for edge in mesh.findall("Edge") for e in edge} <= {"line3" if len(tets[0]) == 10 else "line2"}
    return Model(points, [tets[i] for i in range(len(tets))], [regions[i] for i in range(len(tets))],
                 {n: s for n, s in surfaces.items() if is_patch(n)}, {n: m for n, m in nodes.items() if is_own_set(n)},
                 {s.get("name"): np.array(numbers(s.text)) for s in mesh.findall("ElementSet")},
                 {n: s for n, s in surfaces.items() if not is_patch(n)}, {"value": value}, curves,
                 corners=nodes.get("corners", []))


def read_bdf(folder):
    text = (folder / "m.bdf").read_text()
    mesh = meshio.read(folder / "m.bdf")
    names = {int(n): name for n, name in re.findall(r"\$ property (\d+): (\S+)", text)}
    tets = [i for i, block in enumerate(mesh.cells) if block.type.startswith("tetra")]
    triangles = [i for i, block in enumerate(mesh.cells) if block.type.startswith("triangle")]
    found = {}
    for match in re.finditer(r"\$ set \d+: (\w+), (\w+)\nSET1    (.{8})((?:.*\n)(?:        .*\n)*)", text):
        digits = match[4].replace("\n        ", "").replace("\n", "")
        found[match[2], match[1]] = np.array([int(digits[i:i + 8]) - 1 for i in range(0, len(digits), 8)])
    # Cards by hand for numbers and properties, which meshio leaves out.
    cards = [line for line in text.splitlines() if line.startswith(("CTETRA", "CTRIA"))]
    field = lambda line, i: int(line[8 * i:8 * i + 8])
    tet_cards = [line for line in cards if line.startswith("CTETRA")]
    order = np.argsort([field(line, 1) for line in tet_cards])
    regions = np.array([names[field(line, 2)] for line in tet_cards])[order]
    all_tets = np.concatenate([mesh.cells[i].data for i in tets])[order]
    shells = [line for line in cards if line.startswith("CTRIA")]
    patches = np.array([names[field(line, 2)] for line in shells])
    corners = np.concatenate([mesh.cells[i].data for i in triangles])
    number = np.array([field(line, 1) for line in shells]) - 1 - len(all_tets)
    by_number = corners[np.argsort(number)]
    return Model(mesh.points, all_tets, regions, {p: corners[patches == p] for p in np.unique(patches)},
                 {n: m for (kind, n), m in found.items() if kind == "nodes" and is_own_set(n)},
                 {n: m for (kind, n), m in found.items() if kind == "tetrahedra"},
                 {n: by_number[m - len(all_tets)] for (kind, n), m in found.items() if kind == "triangles"},
                 **curves_in({n: m for (kind, n), m in found.items() if kind == "nodes"}))


def read_exodus(folder):
    file = netcdf_file(str(folder / "m.e"), mmap=False)
    text = lambda row: b"".join(row.tolist()).rstrip(b"\0").decode() if len(row) else ""
    names = lambda variable: [text(row) for row in file.variables[variable][:]]
    points = np.stack([file.variables["coord" + a][:] for a in "xyz"], 1)
    blocks = names("eb_names")
    tets = np.concatenate([file.variables[f"connect{i + 1}"][:] for i in range(len(blocks))]) - 1
    regions = np.concatenate([[name] * file.dimensions[f"num_el_in_blk{i + 1}"] for i, name in enumerate(blocks)])
    number = file.variables["elem_num_map" if "elem_num_map" in file.variables else "elem_map"][:] - 1
    values = np.concatenate([file.variables[f"vals_elem_var1eb{i + 1}"][0] for i in range(len(blocks))])
    sides = {1: [0, 1, 3], 2: [1, 2, 3], 3: [0, 3, 2], 4: [0, 2, 1]}
    between = {frozenset(e): 4 + i for i, e in enumerate(EDGES)}
    def facet(element, side):
        at = sides[side]
        if tets.shape[1] == 10:
            at = at + [between[frozenset((at[i], at[(i + 1) % 3]))] for i in range(3)]
        return tets[element - 1][at]
    surfaces = {name: np.array([facet(e, s) for e, s in zip(file.variables[f"elem_ss{i + 1}"][:], file.variables[f"side_ss{i + 1}"][:])])
                for i, name in enumerate(names("ss_names"))}
    nodes = {name: file.variables[f"node_ns{i + 1}"][:] - 1 for i, name in enumerate(names("ns_names"))}
    elements = {name: np.sort(number[file.variables[f"elem_els{i + 1}"][:] - 1]) for i, name in enumerate(names("els_names"))}
    assert names("name_elem_var") == ["value"]
    order = np.argsort(number)
    file.close()
    is_patch = lambda name: name.startswith("boundary_") or name == "sole"
    return Model(points, tets[order], regions[order], {n: s for n, s in surfaces.items() if is_patch(n)},
                 {n: m for n, m in nodes.items() if is_own_set(n)}, elements,
                 {n: s for n, s in surfaces.items() if not is_patch(n)}, {"value": values[order]}, **curves_in(nodes))


def read_med(folder):
    with h5py.File(folder / "m.med") as file:
        step = file["ENS_MAA/mesh/-0000000000000000001-0000000000000000001"]
        points = step["NOE/COO"][:].reshape(3, -1).T
        second = "T10" in step["MAI"]
        def cells(kind):
            if kind not in step["MAI"]:
                return np.empty((0, 1), int), np.array([], int)
            group = step["MAI/" + kind]
            families = group["FAM"][:]
            return group["NOD"][:].reshape(-1, len(families)).T - 1, families
        tets, of_tets = cells("T10" if second else "TE4")
        triangles, of_triangles = cells("TR6" if second else "TR3")
        # MED goes round the other way: its corners 0, 2, 1, 3, its edges 02, 12, 01, 03, 23, 13 of ours.
        tets = tets[:, [0, 2, 1, 3] + ([6, 5, 4, 7, 9, 8] if second else [])]
        groups = lambda kind: {int(f.attrs["NUM"]): [bytes(int(c) for c in n).split(b"\0")[0].decode() for n in f["GRO/NOM"]]
                               for f in file["FAS/mesh"][kind].values()}
        of_elements, of_nodes = groups("ELEME"), groups("NOEUD")
        members = lambda families, of: {name: np.flatnonzero([name in of.get(int(f), []) for f in families])
                                        for name in {n for f in np.unique(families) for n in of.get(int(f), [])}}
        lines, of_lines = cells("SE3" if second else "SE2")
        nodes = members(step["NOE/FAM"][:], of_nodes)
        in_tets, in_triangles = members(of_tets, of_elements), members(of_triangles, of_elements)
        is_region = lambda name: name.startswith("region_")
        regions = np.empty(len(tets), object)
        for name in filter(is_region, in_tets):
            regions[in_tets[name]] = name
        is_patch = lambda name: name.startswith("boundary_") or name == "sole"
        values = next(iter(file["CHA/value"].values()))
        values = next(iter(values.values()))
        values = next(iter(values.values()))["CO"][:]
        return Model(points, tets, regions.astype(str), {n: triangles[m] for n, m in in_triangles.items() if is_patch(n)},
                     {n: m for n, m in nodes.items() if is_own_set(n)},
                     {n: m for n, m in in_tets.items() if not is_region(n)},
                     {n: triangles[m] for n, m in in_triangles.items() if not is_patch(n)}, {"value": values},
                     {n: lines[m] for n, m in members(of_lines, of_elements).items()}, corners=nodes.get("corners", []))


def block_of(path):
    mesh = meshio.read(path)
    return mesh, np.ravel(mesh.point_data["GlobalNodeID"])[mesh.cells[0].data] - 1


def read_vtm(folder, reference):
    listed = {d.get("file") for d in xml.parse(folder / "m.vtm").getroot().iter("DataSet")}
    present = {"m.blocks/" + str(p.relative_to(folder / "m.blocks")) for p in (folder / "m.blocks").rglob("*.vtu")}
    assert listed == present, listed ^ present
    points = np.full_like(reference.points, np.nan)
    tets = np.zeros_like(reference.tets)
    regions = np.empty(len(tets), object)
    value = np.full(len(tets), np.nan)
    for path in (folder / "m.blocks/regions").iterdir():
        mesh, cells = block_of(path)
        numbers = np.ravel(mesh.cell_data["GlobalElementID"][0]) - 1
        points[np.ravel(mesh.point_data["GlobalNodeID"]) - 1] = mesh.points
        tets[numbers], regions[numbers] = cells, path.stem
        value[numbers] = np.ravel(mesh.cell_data["value"][0])
    surfaces = {path.stem: block_of(path)[1] for path in (folder / "m.blocks/boundaries").iterdir()}
    model = Model(points, tets, regions.astype(str), surfaces, {}, {}, {}, {"value": value}, {}, None, [])
    for path in (folder / "m.blocks").glob("curves/*"):
        mesh, cells = block_of(path)
        if path.stem == "corners":
            model.corners = np.ravel(cells)
            continue
        model.curves[path.stem] = cells
        tets_of = tets[np.ravel(mesh.cell_data["GlobalElementID"][0]) - 1]
        assert (cells[:, :, None] == tets_of[:, None, :]).any(2).all(), path
    for path in (folder / "m.blocks/sets").iterdir():
        name, kind = path.stem.rsplit("_", 1)
        mesh, cells = block_of(path)
        if kind == "nodes":
            model.nodes[name] = np.sort(np.ravel(cells))
        elif kind == "facets":
            model.facets[name] = cells
        else:
            model.elements[name] = np.sort(np.ravel(mesh.cell_data["GlobalElementID"][0]) - 1)
    return model


def read_elmer(folder):
    read = lambda name: [line.split() for line in (folder / "m.elmer" / name).read_text().splitlines()]
    names = {int(line[3]): line[1] for line in read("mesh.names") if line[0] == "$"}
    points = [[float(x) for x in line[2:]] for line in read("mesh.nodes")]
    elements, boundary = read("mesh.elements"), read("mesh.boundary")
    header = [int(x) for line in read("mesh.header") for x in line]
    tets = np.array([[int(x) - 1 for x in line[3:]] for line in elements])
    assert header[:3] == [len(points), len(tets), len(boundary)] and header[3] == 2, header
    assert {line[2] for line in elements} == {"510" if tets.shape[1] == 10 else "504"}
    corners = np.array([[int(x) - 1 for x in line[5:]] for line in boundary])
    for side in (2, 3):  # the tets that a boundary element names have its nodes
        parents = np.array([int(line[side]) for line in boundary])
        with_one = parents > 0
        inside = (corners[with_one][:, :, None] == tets[parents[with_one] - 1][:, None, :]).any(2)
        assert inside.all()
    patches = np.array([names[int(line[1])] for line in boundary])
    return Model(points, tets, [names[int(line[1])] for line in elements], {p: corners[patches == p] for p in np.unique(patches)})


def read_mesh_complete(folder):
    folder = folder / "m.mesh-complete"
    mesh = meshio.read(folder / "mesh-complete.mesh.vtu")
    cells = {key: np.ravel(values[0]) for key, values in mesh.cell_data.items()}
    assert (np.ravel(mesh.point_data["GlobalNodeID"]) == np.arange(1, len(mesh.points) + 1)).all()
    assert (cells["GlobalElementID"] == np.arange(1, len(mesh.cells[0].data) + 1)).all()
    def polygons(path):
        reader = vtkXMLPolyDataReader()
        reader.SetFileName(str(path))
        reader.Update()
        data = reader.GetOutput()
        at = vtk_to_numpy(data.GetPolys().GetConnectivityArray()).reshape(-1, 6 if mesh.cells[0].type == "tetra10" else 3)
        behind = vtk_to_numpy(data.GetCellData().GetArray("GlobalElementID")) - 1
        corners = vtk_to_numpy(data.GetPointData().GetArray("GlobalNodeID"))[at] - 1
        assert (corners[:, :, None] == mesh.cells[0].data[behind][:, None, :]).any(2).all(), path
        return corners
    files = {path.stem: polygons(path) for path in (folder / "mesh-surfaces").iterdir()}
    is_patch = lambda name: name.startswith("boundary_") or name == "sole"
    surfaces = {n: s for n, s in files.items() if is_patch(n)}
    exterior = polygons(folder / "mesh-complete.exterior.vtp")
    outer = np.concatenate([s for n, s in surfaces.items() if n == "sole" or n.endswith("_0")])
    assert {tuple(sorted(t)) for t in exterior.tolist()} == {tuple(sorted(t)) for t in outer.tolist()}
    walls = polygons(folder / "walls_combined.vtp")
    assert len(walls) == len(exterior) - len(surfaces.get("sole", []))
    return Model(mesh.points, mesh.cells[0].data, [f"region_{r}" for r in cells["ModelRegionID"]], surfaces,
                 flags({k: np.ravel(v) for k, v in mesh.point_data.items()}), flags(cells),
                 {n: s for n, s in files.items() if not is_patch(n)}, {"value": cells["value"]})
