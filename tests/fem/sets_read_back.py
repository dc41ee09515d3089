"""Named sets as other programs find them in each file: meshio, h5py, scipy's netCDF, Gmsh and CalculiX.

sets_read_back.py SCANTET SAMPLES; exit status 77 (skipped) where a program or module is missing.
"""
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import xml.etree.ElementTree as xml

try:
    import h5py
    import meshio
    import numpy as np
    from scipy.io import netcdf_file
except ImportError as error:
    print(error)
    sys.exit(77)
if not all(map(shutil.which, ("gmsh", "ccx"))):
    sys.exit(77)

SETS = ["foot=patch(sole)", "tip=normal(0,0,1,40)", "core=elements: ball(0,0,0,4)", "both=elements: z < 0"]


def run(*command, cwd):
    done = subprocess.run([str(c) for c in command], cwd=cwd, capture_output=True, text=True, timeout=300)
    assert done.returncode == 0, (command, done.stdout, done.stderr)
    return done.stdout + done.stderr


def sets_of_inp(path):
    """The sets by what follows the keyword, members from 0; CalculiX checks that it reads the same."""
    found = {}
    members = None
    for line in path.read_text().splitlines():
        if line.startswith("*"):
            match = re.match(r"\*(NSET, NSET|ELSET, ELSET|SURFACE, NAME)=(\w+)", line)
            members = found.setdefault((match[1][0], match[2]), []) if match else None
        elif members is not None and not line.startswith("E") and "EALL" not in line:
            items = [line] if "S" in line else line.split(",")
            members += [item if "S" in item else int(item) - 1 for item in items if item.strip() and not item.strip().isalpha()
                        and not item.strip().startswith("REGION")]
    return {(kind, name.removeprefix("ELEMENTS_") if kind == "E" else name): rest for (kind, name), rest in found.items()}


def check_vtk(folder, name, sets):
    mesh = meshio.read(folder / name)
    for key in ("foot", "tip"):
        assert list(np.flatnonzero(mesh.point_data["set_" + key])) == sets["N", key.upper()], (name, key)
    for key in ("foot", "tip", "core", "both"):
        assert list(np.flatnonzero(mesh.cell_data["set_" + key][0])) == sets["E", key.upper()], (name, key)
    assert "set_core" not in mesh.point_data


def check_med(folder, sets):
    with h5py.File(folder / "s.med") as file:
        step = file["ENS_MAA/mesh/-0000000000000000001-0000000000000000001"]
        def members(kind, families):
            found = {}
            for family in file["FAS/mesh"][kind].values():
                number = family.attrs["NUM"]
                for name in family["GRO/NOM"]:
                    text = bytes(int(c) for c in name).split(b"\0")[0].decode()
                    found.setdefault(text, []).extend(np.flatnonzero(families == number))
            return {name: sorted(all_of) for name, all_of in found.items()}
        nodes = members("NOEUD", step["NOE/FAM"][:])
        tets = members("ELEME", step["MAI/TE4/FAM"][:])
        triangles = members("ELEME", step["MAI/TR3/FAM"][:])
        assert len(nodes["boundary"]) == len(sets["N", "BOUNDARY"])
        for key in ("foot", "tip"):
            assert nodes[key] == sets["N", key.upper()], key
            assert len(triangles[key]) == len(sets["S", key.upper()]), key
        for key in ("foot", "tip", "core", "both"):
            assert tets[key] == sets["E", key.upper()], key
        assert len(tets["region_1"]) == step["MAI/TE4/FAM"].size  # every tet is still of its region
        assert triangles["sole"] == triangles["foot"]
    mesh = meshio.read(folder / "s.med")
    assert any("core" in names for names in mesh.cell_tags.values())


def check_xdmf(folder, sets):
    with h5py.File(folder / "s.h5") as file:
        for key in ("foot", "tip"):
            assert list(np.flatnonzero(file["set/nodes/" + key][:])) == sets["N", key.upper()]
            assert int(file["set/facets/" + key][:].sum()) == len(sets["S", key.upper()])
        for key in ("foot", "tip", "core", "both"):
            assert list(np.flatnonzero(file["set/elements/" + key][:])) == sets["E", key.upper()]
    root = xml.parse(folder / "s.xdmf").getroot()
    names = [a.get("Name") for a in root.iter("Attribute")]
    assert names.count("set_foot") == 3 and names.count("set_core") == 1, names


def check_exodus(folder, sets):
    file = netcdf_file(str(folder / "s.e"), mmap=False)
    def names(variable):
        return ["".join(c.decode() for c in row).rstrip("\0") for row in file.variables[variable][:]]
    def members(kind, name):
        index = names(kind + "_names").index(name) + 1
        prefix = {"ns": "node_ns", "ss": "elem_ss", "els": "elem_els"}[kind]
        return sorted(int(i) - 1 for i in file.variables[f"{prefix}{index}"][:])
    number = file.variables["elem_num_map"][:] if "elem_num_map" in file.variables else file.variables["elem_map"][:]
    for key in ("foot", "tip"):
        assert members("ns", key) == sets["N", key.upper()], key
        assert len(members("ss", key)) == len(sets["S", key.upper()]), key
    for key in ("foot", "tip", "core", "both"):
        assert sorted(int(number[i]) - 1 for i in members("els", key)) == sets["E", key.upper()], key
    file.close()


def check_feb(folder, sets):
    mesh = xml.parse(folder / "s.feb").getroot().find("Mesh")
    def members(kind, name):
        element = next(e for e in mesh.findall(kind) if e.get("name") == name)
        return [int(i) - 1 for i in element.text.replace("\n", " ").split(",")] if kind != "Surface" else list(element)
    for key in ("foot", "tip"):
        assert members("NodeSet", key) == sets["N", key.upper()]
        assert len(members("Surface", key)) == len(sets["S", key.upper()])
    for key in ("foot", "tip", "core", "both"):
        assert members("ElementSet", key) == sets["E", key.upper()]


def check_bdf(folder, sets):
    text = (folder / "s.bdf").read_text()
    found = {}
    for match in re.finditer(r"\$ set \d+: (\w+), (\w+)\nSET1    (.{8})((?:.*\n)(?:        .*\n)*)", text):
        digits = match[4].replace("\n        ", "").replace("\n", "")
        found[match[1], match[2]] = [int(digits[i:i + 8]) - 1 for i in range(0, len(digits), 8)]
    for key in ("foot", "tip"):
        assert found[key, "nodes"] == sets["N", key.upper()]
        assert len(found[key, "triangles"]) == len(sets["S", key.upper()])
    for key in ("foot", "tip", "core", "both"):
        assert found[key, "tetrahedra"] == sets["E", key.upper()]


def check_gmsh(folder, sets):
    mesh = meshio.read(folder / "s.msh")
    log = run("gmsh", "s.msh", "-check", cwd=folder)
    assert "Error" not in log and "Warning" not in log, log
    # Gmsh writes an element once for each physical group in version 2.2.
    run("gmsh", "s.msh", "-save", "-format", "msh22", "-o", "copy.msh", cwd=folder)
    copy = meshio.read(folder / "copy.msh")
    count = {}
    for block, tags in zip(copy.cells, copy.cell_data["gmsh:physical"]):
        for tag in tags:
            count[block.type, int(tag)] = count.get((block.type, int(tag)), 0) + 1
    for key in ("foot", "tip", "core", "both"):
        tag = int(mesh.field_data[key][0])
        assert count["tetra", tag] == len(sets["E", key.upper()]), key
        if key in ("foot", "tip"):
            assert count["triangle", tag] == len(sets["S", key.upper()]), key


def check_ccx(folder, sets):
    (folder / "deck.inp").write_text("""*INCLUDE, INPUT=s.inp
*MATERIAL, NAME=M
*ELASTIC
1000., 0.3
*SOLID SECTION, ELSET=EALL, MATERIAL=M
*BOUNDARY
FOOT, 1, 3
*STEP
*STATIC
*DSLOAD
TIP, P, 1.
*NODE PRINT, NSET=FOOT
U
*NODE PRINT, NSET=TIP
U
*EL PRINT, ELSET=ELEMENTS_CORE
S
*END STEP
""")
    log = run("ccx", "deck", cwd=folder)
    assert "WARNING" not in log and "ERROR" not in log, log
    tables = (folder / "deck.dat").read_text().split("for set ")
    found = {t.split()[0]: [int(l.split()[0]) - 1 for l in t.splitlines()[1:] if re.match(r"\s+\d+\s+\S+", l)] for t in tables[1:]}
    assert found["FOOT"] == sets["N", "FOOT"] and found["TIP"] == sets["N", "TIP"], found
    assert sorted(dict.fromkeys(found["ELEMENTS_CORE"])) == sets["E", "CORE"]


def main():
    scantet, samples = sys.argv[1:3]
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        files = [f"s.{e}" for e in "inp feb e med msh msh2 vtu vtk xdmf bdf mesh".split()]
        arguments = [x for f in files for x in ("-o", f)] + [x for s in SETS for x in ("--set", s)]
        run(scantet, "mesh", f"{samples}/sphere.nrrd", "--level", "100.5", "--size", "4", "--cut", "sole: z > -5", *arguments,
            cwd=folder)
        sets = sets_of_inp(folder / "s.inp")
        assert sets["S", "FOOT"] == sets["S", "SOLE"] and len(sets["N", "FOOT"]) > 20, sets.keys()
        for check in (check_med, check_xdmf, check_exodus, check_feb, check_bdf, check_gmsh, check_ccx):
            check(folder, sets)
            print(check.__name__)
        check_vtk(folder, "s.vtu", sets)
        check_vtk(folder, "s.vtk", sets)
        for copy in ("s.inp", "s.msh", "s.vtu"):  # sets change nothing of what scantet reads back
            run(scantet, "convert", copy, "back.vtu", cwd=folder)
            back = meshio.read(folder / "back.vtu")
            assert set(back.cell_data["region"][0]) == {1}, copy


main()
