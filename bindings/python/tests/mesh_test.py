"""Meshes of files and arrays: the command's bytes, shared memory, every option."""
import ast
import gc
import json
import os
import pathlib
import re

import numpy as np
import pytest
import scantet

JOBS = {
    "grey": ("sphere.nrrd", {"level": 127.5, "size": 1.5}),
    "levels": ("sphere.nrrd", {"level": [100, 150], "size": 2, "min_dihedral": 11}),
    "labels": ("labels_octants.nrrd", {"labels": "all", "size": 3}),
    "chosen labels": ("labels_tubes.nrrd", {"labels": [1, 2], "size": 2, "min_edge": "3%"}),
}


def words_of(options):
    words = []
    for keyword, value in options.items():
        texts = value if isinstance(value, list) and keyword != "labels" else [value]
        for text in texts:
            if isinstance(text, list):
                text = ",".join(map(str, text))
            words += ["--" + keyword.replace("_", "-"), str(text)]
    return words


@pytest.mark.filterwarnings("ignore::scantet.UnmetWarning")
@pytest.mark.parametrize("job", JOBS)
def test_bytes_are_those_of_the_command(job, samples, command, sha256, tmp_path):
    name, options = JOBS[job]
    mesh = scantet.mesh(samples / name, output=[tmp_path / "run.vtu"], **options)
    command("mesh", samples / name, *words_of(options), "-o", tmp_path / "command.vtu", "-o", tmp_path / "command.mesh",
            "-o", tmp_path / "command.msh")
    for kind in ("vtu", "mesh", "msh"):
        mesh.save(tmp_path / f"python.{kind}")
        assert sha256(tmp_path / f"python.{kind}") == sha256(tmp_path / f"command.{kind}"), kind
    assert sha256(tmp_path / "run.vtu") == sha256(tmp_path / "command.vtu")
    assert mesh.written == [str(tmp_path / "run.vtu")]


def test_an_array_gives_the_mesh_of_its_file(samples):
    scan = scantet.read(samples / "ellipsoid_oblique.nrrd")
    of_file = scantet.mesh(samples / "ellipsoid_oblique.nrrd", level=0.5 * (scan.min + scan.max), size=3)
    of_array = scantet.mesh(np.array(scan.values), affine=scan.affine, level=0.5 * (scan.min + scan.max), size=3)
    assert np.array_equal(of_file.vertices, of_array.vertices)
    assert np.array_equal(of_file.tets, of_array.tets)


def test_options_are_those_of_the_command(command):
    text = command("mesh", "--help").stdout
    known = set(re.findall(r"^  (?:-\w, )?--([a-z0-9-]+)", text, re.MULTILINE)) - {"help"}
    assert len(known) > 40
    assert not set(scantet.options()) & {"image", "affine", "axes", "progress"}
    assert set(scantet.options()) == {name.replace("-", "_") for name in known}


def test_unknown_option_has_the_nearest_name(samples):
    with pytest.raises(TypeError, match="did you mean min_dihedral") as caught:
        scantet.mesh(samples / "sphere.nrrd", level=1, min_dihedal=10)
    assert isinstance(caught.value, scantet.UsageError)
    assert caught.value.code == "usage.unknown_option"


def test_errors_have_code_and_remedy(samples, tmp_path):
    with pytest.raises(scantet.InputError) as caught:
        scantet.mesh(tmp_path / "none.nrrd", level=1)
    assert caught.value.code == "input.not_found"
    assert caught.value.remedy and str(caught.value).endswith(caught.value.remedy)
    with pytest.raises(scantet.UsageError, match="level is missing") as caught:
        scantet.mesh(samples / "sphere.nrrd")
    assert "--" not in str(caught.value)
    with pytest.raises(scantet.UsageError, match="level is missing") as caught:
        scantet.mesh(np.arange(1000.0).reshape(10, 10, 10))
    assert "memory:image" not in caught.value.remedy and "what info says" in caught.value.remedy
    with pytest.raises(scantet.UsageError, match="size"):
        scantet.mesh(samples / "sphere.nrrd", level=127.5, size=-1)
    with pytest.raises(OSError):
        scantet.mesh(samples / "sphere.nrrd", level=127.5, size=3, output=tmp_path / "no folder" / "a.vtu")
    with pytest.raises(scantet.UsageError, match="number") as caught:
        scantet.mesh(samples / "sphere.nrrd", level=127.5, size={})
    with pytest.raises(scantet.InputError, match="NaN"):
        scantet.mesh(np.full((4, 4, 4), np.nan), level=1)


def test_unmet_bounds_are_warnings(samples):
    with pytest.warns(scantet.UnmetWarning, match="dihedral"):
        mesh = scantet.mesh(samples / "sphere.nrrd", level=127.5, size=3, max_dihedral=110, optimize="exude")
    assert mesh.findings


@pytest.fixture(scope="module")
def ball():
    grid = np.mgrid[-10:11, -10:11, -10:11].astype(float)
    return scantet.mesh(8 - np.sqrt((grid**2).sum(axis=0)), affine=[[1, 0, 0, -10], [0, 1, 0, -10], [0, 0, 1, -10],
                                                                  [0, 0, 0, 1]], level=0, size=2, as_grey=True)


def test_arrays_share_memory_and_keep_it(ball):
    again = type(ball)(ball._result, ras=False)
    for name in ("tets", "tet_regions", "boundary_facets", "facet_regions", "vertex_dimension", "facet_patches"):
        first, second = getattr(ball, name), getattr(again, name)
        assert len(first) and np.shares_memory(first, second), name
        assert not first.flags.writeable and not first.flags.owndata
    assert np.shares_memory(ball.vertices, again.vertices)
    grid = np.mgrid[-4:5, -4:5, -4:5].astype(float)
    mesh = scantet.mesh(3 - np.sqrt((grid**2).sum(axis=0)), level=0, size=1, as_grey=True)
    tets, copy = mesh.tets, mesh.tets.copy()
    del mesh
    gc.collect()
    assert np.array_equal(tets, copy)


def test_the_mesh_is_sound(ball):
    corners = ball.vertices[ball.tets]
    volumes = np.linalg.det(corners[:, 1:] - corners[:, :1]) / 6
    assert volumes.min() > 0
    assert volumes.sum() == pytest.approx(4 / 3 * np.pi * 8**3, rel=0.05)
    assert volumes.sum() == pytest.approx(ball.report["mesh"]["volume_mm3"], rel=1e-12)
    on_boundary = np.unique(ball.boundary_facets)
    assert np.all(ball.vertex_dimension[on_boundary] < 3)
    assert set(ball.tet_regions) == {1} == set(ball.region_names)
    assert ball.findings == [] and ball.report["audit"]["passed"]
    assert "dihedral" in str(ball) and repr(ball).startswith("<scantet.Mesh")


def test_space(ball, samples, tmp_path, command, sha256):
    assert np.array_equal(ball.points("ras"), ball.vertices * [-1, -1, 1])
    turned = scantet.mesh(samples / "sphere.nrrd", level=127.5, size=3, space="ras")
    assert turned.space == "ras" and np.array_equal(turned.vertices, turned.points("ras"))
    turned.save(tmp_path / "python.vtu")
    command("mesh", samples / "sphere.nrrd", "--level", "127.5", "--size", "3", "--space", "ras", "-o",
            tmp_path / "command.vtu")
    assert sha256(tmp_path / "python.vtu") == sha256(tmp_path / "command.vtu")


def test_files_and_reports(ball, tmp_path):
    for name in ("a.vtu", "a.msh", "a.stl", "a.json", "a.csv", "a.svg", "a.html"):
        ball.save(tmp_path / name)
        assert (tmp_path / name).stat().st_size > 0
    again = scantet.read_mesh(tmp_path / "a.vtu")
    assert np.array_equal(again.vertices, ball.vertices) and np.array_equal(again.tets, ball.tets)
    assert again.report["mesh"]["tets"] == len(ball.tets)
    with pytest.raises(scantet.UsageError):
        ball.save(tmp_path / "a.doc")


def test_notebooks(ball):
    assert "<svg" in ball._repr_html_() and "tetrahedra" in ball._repr_html_()
    assert "<iframe srcdoc=" in ball.page()._repr_html_()


def test_other_libraries(ball, monkeypatch):
    meshio_mesh = pytest.importorskip("meshio") and ball.to_meshio()
    assert np.array_equal(meshio_mesh.cells_dict["tetra"], ball.tets)
    grid = pytest.importorskip("vtkmodules.vtkCommonDataModel") and ball.to_vtk()
    assert grid.GetNumberOfCells() == len(ball.tets) and grid.GetNumberOfPoints() == len(ball.vertices)
    assert grid.GetCell(7).GetPointId(2) == ball.tets[7, 2]


def test_plan_and_info(samples, command):
    plan = scantet.mesh(samples / "sphere.nrrd", level=127.5, size=1, plan=True)
    assert isinstance(plan, dict) and plan
    info = scantet.info(samples / "sphere.nrrd", level=127.5)
    assert info == json.loads(command("info", samples / "sphere.nrrd", "--level", "127.5", "--json").stdout)


def test_verify(samples, tmp_path):
    mesh = scantet.mesh(samples / "sphere.nrrd", level=127.5, size=1.5)
    mesh.save(tmp_path / "ours.vtu")
    found = scantet.verify(tmp_path / "ours.vtu", samples / "sphere.nrrd", 127.5)
    assert found and found.grade == "certified" and "certified" in str(found)
    assert not scantet.verify(tmp_path / "ours.vtu", samples / "sphere.nrrd", 60)
    mesh.save(tmp_path / "ours.stl")
    solid = scantet.mesh(tmp_path / "ours.stl", size=3)
    solid.save(tmp_path / "solid.vtu")
    assert scantet.verify(tmp_path / "solid.vtu", tmp_path / "ours.stl", require="bounded").grade == "bounded"
    with pytest.raises(TypeError, match="did you mean against"):
        scantet.verify(tmp_path / "ours.vtu", agianst="x", level=1)


def test_config_and_formulas(samples, tmp_path):
    (tmp_path / "job.json").write_text('{"level": 127.5, "size": 9}')
    a = scantet.mesh(samples / "sphere.nrrd", config=tmp_path / "job.json", size=2.5)
    b = scantet.mesh(samples / "sphere.nrrd", level=127.5, size=2.5)
    assert np.array_equal(a.vertices, b.vertices)


@pytest.mark.skipif("SCANTET_PREFIX" in os.environ, reason="plugins of others may be installed there")
def test_stub_has_what_there_is():
    stub = pathlib.Path(scantet.__file__).with_name("__init__.pyi").read_text()
    ast.parse(stub)
    keywords = stub[stub.index("def mesh("):stub.index(") -> Mesh: ...\ndef info")]
    named = set(re.findall(r"^    (\w+): ", keywords, re.MULTILINE)) - {"image", "affine", "axes", "progress"}
    assert named == set(scantet.options())
    for name in scantet.__all__:
        assert re.search(rf"^(class|def) {name}\b", stub, re.MULTILINE), name
    for kind in (scantet.Mesh, scantet.Scan, scantet.Domain):
        body = re.search(rf"^class {kind.__name__}:\n((?:    .*\n)+)", stub, re.MULTILINE).group(1)
        shown = set(re.findall(r"^    (?:def )?(\w+)[:(]", body, re.MULTILINE))
        assert {name for name in vars(kind) if not name.startswith("_")} == shown - {"_repr_html_"}


def test_the_package_is_the_one_that_is_tested():
    prefix = os.environ.get("SCANTET_PREFIX", os.environ["PYTHONPATH"])
    assert pathlib.Path(prefix) in pathlib.Path(scantet.__file__).parents
    maps = pathlib.Path("/proc/self/maps").read_text()
    loaded = {pathlib.Path(line.split()[-1]) for line in maps.splitlines() if "libscantet" in line}
    folder = pathlib.Path(os.environ["SCANTET_PROGRAM"]).resolve().parents[1]
    assert loaded and all(folder in path.parents for path in loaded)
