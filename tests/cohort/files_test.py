"""Which files of scans and options count, and that all files of a mesh reach their places."""
import gzip
import hashlib
import json
import os
import pathlib
import re
import subprocess
import sys
import zlib

import numpy as np
import pytest
from helpers import OPTIONS, PROGRAM, events, results, run
from make_subjects import make_dataset, nifti, voxels

from scantet_cohort import hashing, input_files, mesh_files, mesh_options

SIDE = 16
NRRD = f"NRRD0004\ntype: short\ndimension: 3\nspace: left-posterior-superior\nsizes: {SIDE} {SIDE} {SIDE}\nendian: little\n" \
       "space directions: (1,0,0) (0,1,0) (0,0,1)\nspace origin: (0,0,0)\nencoding: {encoding}\n{data}\n"
META = f"ObjectType = Image\nNDims = 3\nDimSize = {SIDE} {SIDE} {SIDE}\nElementType = MET_SHORT\nElementSpacing = 1 1 1\n" \
       "{data}\n"


def body(number):
    """Voxels of 16 bits, a slice each."""
    return [plane.astype("<i2").tobytes() for plane in np.round(voxels(number, SIDE))]


def nrrd(number=1, factor=1.0):
    values = (np.round(voxels(number, SIDE)) * factor).astype("<i2").tobytes()
    return NRRD.format(encoding="raw", data="").encode() + values


def write(folder, files):
    for name, content in files.items():
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        (folder / name).write_bytes(content if isinstance(content, bytes) else content.encode())


def nhdr(number):
    return {"ct.nhdr": NRRD.format(encoding="gzip", data="data file: ct.raw.gz"), "ct.raw.gz": gzip.compress(b"".join(body(number)), mtime=0)}


def listed(number):
    planes = body(number)
    names = [f"slices/p{index}.raw" for index in range(SIDE)]
    header = NRRD.format(encoding="raw", data="data file: LIST 2\n" + "\n".join(names))
    return {"ct.nhdr": header, **dict(zip(names, planes))}


def numbered(number):
    header = META.format(data=f"ElementDataFile = p%02d.raw 1 {SIDE} 1")
    return {"ct.mhd": header, **{f"p{index + 1:02d}.raw": plane for index, plane in enumerate(body(number))}}


def packed(number):
    data = zlib.compress(b"".join(body(number)))
    header = META.format(data=f"CompressedData = True\nCompressedDataSize = {len(data)}\nElementDataFile = ct.zraw")
    return {"ct.mha": header, "ct.zraw": data}


def pair(number):
    whole = bytearray(gzip.decompress(nifti(voxels(number, SIDE))))
    whole[344:348] = b"ni1\0"
    whole[108:112] = bytes(4)  # where the voxels begin in their file
    return {"ct.hdr": bytes(whole[:348]), "ct.img": bytes(whole[352:])}


def alone(number):
    return {"ct.nrrd": nrrd(number)}


@pytest.mark.parametrize("kind", [nhdr, listed, numbered, packed, pair, alone])
def test_the_files_of_a_scan_are_those_that_the_program_reads(tmp_path, kind):
    write(tmp_path, kind(1))
    (scan,) = [path for path in tmp_path.glob("ct.*") if path.suffix in (".nhdr", ".mhd", ".mha", ".hdr", ".nrrd")]
    assert len(input_files.members(scan)) == len(kind(1))
    before = hashing.Checksums(tmp_path / "hashes.json").of([scan], 1)[0]
    subprocess.run([PROGRAM, "mesh", str(scan), *OPTIONS, "--quiet", "--report", str(tmp_path / "report.json")], check=True)
    assert json.loads((tmp_path / "report.json").read_text())["input"]["sha256"] == before
    write(tmp_path, {name: content for name, content in kind(2).items() if name != scan.name or kind is alone})
    assert hashing.Checksums(tmp_path / "hashes.json").of([scan], 1)[0] != before


def test_headers_that_name_what_is_not_there_are_files_alone(tmp_path):
    for name, line in (("a.nhdr", "data file: none.raw"), ("b.mhd", "ElementDataFile = LOCAL"), ("c.nhdr", "data file: p%d.raw 1 9 1"),
                       ("d.nhdr", "data file: p%.raw"), ("e.mhd", "no header"), ("f.nrrd", "kind: x\n\ndata file: a.nhdr")):
        write(tmp_path, {name: line})
        assert input_files.members(tmp_path / name) == [tmp_path / name]
    (tmp_path / "series").mkdir()
    write(tmp_path / "series", {"only.dcm": "one"})
    assert hashing.input_sha256(tmp_path / "series") == hashing.file_sha256(tmp_path / "series" / "only.dcm")


def test_scans_that_differ_in_their_voxel_files_have_meshes_of_their_own(tmp_path):
    write(tmp_path / "study" / "a", nhdr(1))
    write(tmp_path / "study" / "b", nhdr(2))
    assert run(tmp_path / "study", tmp_path / "out", "--no-pages").returncode == 0
    meshes = [path.read_bytes() for path in (tmp_path / "out").glob("sub-*/*_mesh.vtu")]
    assert len(meshes) == 2 and meshes[0] != meshes[1]


def test_files_that_options_name_get_absolute_paths(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    write(tmp_path, {"atlas.nrrd": "1", "series/a.dcm": "2", "60": "3", "two words.nrrd": "4"})
    collect = mesh_options.collect
    for words, told in (
            (["--field", "v=atlas.nrrd"], f"v={tmp_path}/atlas.nrrd"), (["--field=v=atlas.nrrd:fraction=3"], f"v={tmp_path}/atlas.nrrd:fraction=3"),
            (["--field", "v=series:1.2.3:mean"], f"v={tmp_path}/series:1.2.3:mean"), (["--tissue", "series"], f"{tmp_path}/series"),
            (["--set", "hot=elements: z > 0 and scan(\"atlas.nrrd\") > 3"], f"hot=elements: z > 0 and scan(\"{tmp_path}/atlas.nrrd\") > 3"),
            (["--size-where", "scan(two words.nrrd ) > 3=1"], f"scan(\"{tmp_path}/two words.nrrd\") > 3=1"),
            (["--set", "a=scan('none.nrrd') > 3"], "a=scan('none.nrrd') > 3"), (["--level", "60"], "60"), (["--size", "60"], "60"),
            (["--size", "atlas.nrrd"], f"{tmp_path}/atlas.nrrd"), (["--size", "1 + 0.2*d"], "1 + 0.2*d")):
        assert collect("", words, None) == [words[0].split("=")[0], told]


def test_files_count_wherever_options_name_them(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    write(tmp_path, {**nhdr(1), "job.json": json.dumps({"scan": {"file": "law.nrrd"}, "places": [{"where": "scan(where.nrrd) > 1"}]})})
    cases = [(["--field", "v=ct.nhdr:std"], "ct.raw.gz"), (["--set", "a=scan(\"ct.nhdr\") > 3"], "ct.raw.gz"),
             (["--size-where", "scan('ct.nhdr') > 3=1"], "ct.raw.gz"), (["--size", "ct.nhdr"], "ct.raw.gz"), (["--tissue", "ct.nhdr"], "ct.nhdr"),
             (["--materials", "job.json"], "law.nrrd"), (["--materials", "job.json"], "where.nrrd"), (["--materials", "job.json"], "job.json")]
    for words, name in cases:
        write(tmp_path, {"law.nrrd": "1", "where.nrrd": "1"})
        before = mesh_options.identity(mesh_options.collect("", words, None))
        assert before[1] not in words[1] and str(tmp_path) not in before[1]
        (tmp_path / name).write_bytes((tmp_path / name).read_bytes() + b" ")
        assert mesh_options.identity(mesh_options.collect("", words, None)) != before, (words, name)
    assert mesh_options.identity(["--set", "foot=z < -3", "--level", "60"]) == ["--set", "foot=z < -3", "--level", "60"]


@pytest.fixture
def place(tmp_path, monkeypatch):
    """A folder to begin cohorts in, with a study of two equal scans and another, and files for options."""
    monkeypatch.chdir(tmp_path)
    make_dataset(tmp_path / "study", 3, SIDE)
    first, second = [tmp_path / f"study/sub-{number}/anat/sub-{number}_T1w.nii.gz" for number in ("01", "02")]
    second.write_bytes(first.read_bytes())
    law = {"file": "atlas.nrrd", "density": {"a": 1, "b": 0}, "modulus": [{"a": 1000, "b": 0}], "bins": {"number": 3}}
    write(tmp_path, {"atlas.nrrd": centred(nrrd()), "size.nrrd": centred(nrrd(1, 0).replace(bytes(2), b"\4\0")), "job.json": json.dumps({"scan": law})})
    return tmp_path


def centred(data):
    """Where the subjects are."""
    return data.replace(b"space origin: (0,0,0)", b"space origin: (%g,%g,%g)" % ((-(SIDE - 1) / 2,) * 3))


@pytest.mark.parametrize("options", [
    ("--size", "size.nrrd"), ("--size", "4", "--field", "v=atlas.nrrd"), ("--size", "4", "--space", "ras"),
    ("--size", "4", "--set", "hot=scan(\"atlas.nrrd\") > 30"), ("--size", "4", "--materials", "job.json"),
    ("--size", "4", "--materials", "job.json", "--deck", "static", "--set", "foot=z < -2", "--set", "top=z > 2", "--hold", "foot", "--load", "top=0.1")])
def test_options_that_name_files_or_need_a_mesh_file_quarantine_nothing(place, options):
    words = ("--participant-label", "01", "--no-pages", "--mesh-format", ".inp", ".vtu")
    done = run(place / "study", place / "out", *words, options=("--level", "60", *options))
    assert done.returncode == 0 and "1 meshed" in done.stdout, done.stdout + done.stderr
    again = run(place / "study", place / "out", *words, options=("--level", "60", *options))
    assert "0 to be meshed" in again.stdout
    (place / "atlas.nrrd").write_bytes(centred(nrrd(1, 0.9)))
    again = run(place / "study", place / "out", *words, "--dry-run", options=("--level", "60", *options))
    wanted = 1 if {"hot=scan(\"atlas.nrrd\") > 30", "v=atlas.nrrd", "job.json"} & set(options) else 0
    assert f"{wanted} to be meshed" in again.stdout


def test_a_scan_that_changes_meanwhile_is_told(place):
    scan = place / "study/sub-03/anat/sub-03_T1w.nii.gz"
    other = scan.with_name("other")
    other.write_bytes(nifti(voxels(7, SIDE)))
    program = place / "program"
    program.write_text(f'#!/bin/sh\ncase "$*" in *--plan*|--version) ;; *) mv "{other}" "{scan}" ;; esac\nexec "{PROGRAM}" "$@"\n')
    program.chmod(0o755)
    command = [sys.executable, "-m", "scantet_cohort", "study", "out", "participant", "--n-cpus", "1", "--participant-label", "03", "--",
               "--level", "60", "--size", "size.nrrd"]
    done = subprocess.run(command, env={**os.environ, "SCANTET_PROGRAM": str(program)}, capture_output=True, text=True, timeout=200, check=False)
    assert done.returncode == 4 and "has changed since" in done.stdout, done.stdout + done.stderr


FORMATS = (".xdmf", ".vtm", ".elmer", ".stls", ".mesh-complete")
DECK = ("--level", "60", "--size", "4", "--materials", "job.json", "--deck", "static", "--set", "foot=z < -2", "--set", "top=z > 2",
        "--hold", "foot", "--load", "top=0.1")


def names(folder):
    return sorted(str(path.relative_to(folder)) for path in folder.rglob("*") if path.is_file())


@pytest.fixture
def whole(place):
    done = run(place / "study", place / "out", "--mesh-format", *FORMATS, ".inp", options=DECK)
    assert done.returncode == 0 and "3 meshed" in done.stdout, done.stdout + done.stderr
    return place


def test_formats_of_several_files_are_published_whole(whole):
    for number in ("01", "02", "03"):
        stem = f"sub-{number}_desc-T1w_mesh"
        anat = whole / f"out/sub-{number}/anat"
        assert {f"{stem}.xdmf", f"{stem}.h5", f"{stem}.vtm", f"{stem}.inp", f"{stem}_static.inp", f"{stem}_static.py", f"{stem}.elmer/mesh.nodes",
                f"{stem}.stls/top.stl", f"{stem}.mesh-complete/mesh-complete.mesh.vtu"} <= set(names(anat))
        assert set(re.findall(r">([^<>]+\.h5):", (anat / f"{stem}.xdmf").read_text())) == {f"{stem}.h5"}
        blocks = re.findall(r'file="([^"]+)"', (anat / f"{stem}.vtm").read_text())
        assert blocks and all((anat / block).is_file() for block in blocks)
        assert f"INPUT={stem}.inp" in (anat / f"{stem}_static.inp").read_text()
        told = json.loads((anat / f"sub-{number}_desc-T1w_report.json").read_text())["files"]
        published = {hashlib.sha256((anat / name).read_bytes()).hexdigest() for name in names(anat)}
        assert {file["sha256"] for file in told if not file["path"].endswith("thumbnail.stl")} <= published
    again = run(whole / "study", whole / "out", "--mesh-format", *FORMATS, ".inp", options=DECK)
    assert again.returncode == 0 and "0 to be meshed" in again.stdout
    assert run(whole / "study", whole / "out", level="group", options=()).returncode == 0
    rows = json.loads((whole / "out/group.json").read_text())["scans"]
    assert all((whole / "out" / row["mesh"]).exists() and row["mesh_sha256"] for row in rows)
    (elmer,) = whole.glob("out/.scantet/store/*/*/sub-03*.elmer")
    (elmer / "mesh.nodes").write_bytes(b"")
    assert "1 to be meshed" in run(whole / "study", whole / "out", "--mesh-format", *FORMATS, ".inp", options=DECK).stdout


def test_folders_hold_nothing_of_an_older_mesh_and_what_is_not_ours_stays(whole):
    anat = whole / "out/sub-01/anat"
    stls = anat / "sub-01_desc-T1w_mesh.stls"
    (stls / "notes.txt").write_text("mine")
    chosen = ("--participant-label", "01", "--mesh-format", *FORMATS)
    assert run(whole / "study", whole / "out", *chosen, options=(*OPTIONS, "--set", "foot=z < -2")).returncode == 0
    left = names(stls)
    assert "notes.txt" in left and "foot.stl" in left and "top.stl" not in left
    scan = whole / "study/sub-01/anat/sub-01_T1w.nii.gz"
    scan.write_bytes(scan.read_bytes()[:200])
    assert run(whole / "study", whole / "out", *chosen).returncode == 4
    assert names(anat) == ["sub-01_desc-T1w_mesh.stls/notes.txt"]


def test_one_folder_as_the_only_format_is_enough_and_equal_scans_share_it(place):
    done = run(place / "study", place / "out", "--no-pages", "--mesh-format", ".elmer")
    assert done.returncode == 0, done.stdout + done.stderr
    assert len(results(place / "out")) == 2 == len(events(place / "out", "meshed"))
    one, two = [place / f"out/sub-{number}/anat/sub-{number}_desc-T1w_mesh.elmer/mesh.nodes" for number in ("01", "02")]
    assert one.samefile(two)


def test_checksums_of_meshes_count_all_their_files():
    made = ["m.xdmf", "m.h5", "m.vtu", "m.blocks/a.vtu", "m.vtm", "m.elmer/mesh.nodes", "m.elmer.txt"]
    assert mesh_files.files_of("m.xdmf", made) == ["m.h5", "m.xdmf"] and mesh_files.files_of("m.vtu", made) == ["m.vtu"]
    assert mesh_files.files_of("m.vtm", made) == ["m.blocks/a.vtu", "m.vtm"] and mesh_files.files_of("m.elmer", made) == ["m.elmer/mesh.nodes"]
    assert pathlib.PurePath(mesh_files.public_name("mesh", "mesh.vtu")).name == "mesh_mesh.vtu"
