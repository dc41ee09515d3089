"""Datasets and output folders of strangers: none runs code, stops the scans of others, touches their meshes or gets into the page."""
import base64
import hashlib
import json
import os
import pathlib
import re
import urllib.parse

import pytest
from helpers import results as verdicts
from helpers import run
from kubernetes_test import cluster  # noqa: F401  a fixture
from make_subjects import make_dataset, nifti, voxels

from scantet_cohort import command_line, figures, files, page, results
from scantet_cohort.layout import Layout
from scantet_cohort.results import Entry
from scantet_cohort.scans import Scan

KEY = "0123456789abcdef" * 2
HOSTILE = "\"'><img src=x onerror=alert(1)>"
MODULES = ("argparse", "json", "numpy", "scantet_cohort", "sitecustomize", "snakemake/__init__", "snakemake/__main__", "yaml")


def lay_traps(folder, trace):
    for name in MODULES:
        path = folder / f"{name}.py"
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(f"open({str(trace)!r}, 'a').write(__file__ + '\\n')\n")


@pytest.mark.parametrize("inherited", ["", "/nowhere:"])
def test_no_code_comes_from_the_dataset_or_the_output_folder(tmp_path, monkeypatch, inherited):
    study, output, trace = tmp_path / "study", tmp_path / "out", tmp_path / "trace"
    make_dataset(study, 1, 16)
    lay_traps(study, trace)
    lay_traps(output, trace)
    monkeypatch.chdir(study)
    monkeypatch.setenv("PYTHONPATH", inherited)  # an empty part of it means the working folder
    done = run(pathlib.Path("."), output)
    assert not trace.exists(), trace.read_text()
    assert done.returncode == 0, done.stdout + done.stderr
    assert run(pathlib.Path("."), output, level="group", options=()).returncode == 0 and not trace.exists()


def test_no_code_comes_from_the_output_folder_on_a_cluster(cluster, tmp_path):  # noqa: F811
    """Its jobs have no environment but what their manifest says."""
    output, trace = tmp_path / "out", tmp_path / "trace"
    make_dataset(tmp_path / "study", 1, 16)
    lay_traps(output, trace)
    done = run(tmp_path / "study", output, "--profile", "kubernetes")
    assert not trace.exists(), trace.read_text()
    assert done.returncode == 0, done.stdout + done.stderr
    assert len(list(cluster.glob("*/manifest.json"))) == 2


def test_bytes_that_are_no_text_stop_nobody(tmp_path):
    """In the name of a good scan, in that of a bad one, and in what the program quotes of it."""
    study, output = tmp_path / "study", tmp_path / "out"
    make_dataset(study, 1, 16)
    odd = os.fsdecode(b"\xe9\x1b[31m\n")
    (study / "sub-02" / "anat").mkdir(parents=True)
    good, bad = (study / "sub-02" / "anat" / f"sub-02_acq-{odd}_{ending}" for ending in ("T1w.nii.gz", "T2w.mha"))
    good.write_bytes(nifti(voxels(2, 16)))
    bad.write_bytes(b"ObjectType = Image\nNDims = 3\nDimSize = 2 2 2\nElementType = \xe9\nElementDataFile = LOCAL\n" + bytes(8))
    done = run(study, output)
    assert done.returncode == 4 and "2 meshed, 1 quarantined" in done.stdout, done.stdout + done.stderr
    assert "Traceback" not in done.stderr and "\x1b" not in done.stdout and "ElementType" in done.stdout
    rows = (output / "quarantine.tsv").read_text(encoding="utf-8").splitlines()
    assert len(rows) == 2 and rows[1].count("\t") == 3 and "\\xe9" in rows[1]
    assert str(good) in [item["scan"]["path"] for item in files.read_json(output / ".scantet" / "manifest.json")["scans"]]
    assert "0 to be meshed" in run(study, output, "--dry-run").stdout
    assert run(study, output, level="group", options=()).returncode == 0
    links = re.findall(r'href="([^"]+)"', (output / "group.html").read_text(encoding="utf-8"))
    assert len(links) == 4
    for link in links:
        assert os.path.isfile(os.fsencode(output) + b"/" + urllib.parse.unquote_to_bytes(link))
    assert len((output / "group.tsv").read_text(encoding="utf-8").splitlines()) == 4


def entry_of(stem):
    return Entry(Scan(stem, pathlib.Path("/nowhere"), "01", "", "T1w", "sub-01/anat", stem), "", KEY)


@pytest.mark.parametrize("stem", ["sub-0?_desc-T1w", "sub-*_desc-T1w", "sub-[0-9][0-9]_desc-T1w"])
def test_a_name_in_quarantine_is_no_pattern(tmp_path, stem):
    folder = tmp_path / "sub-01" / "anat"
    folder.mkdir(parents=True)
    for name in ("sub-01_desc-T1w_mesh.vtu", "sub-01_desc-T1w_report.json", f"{stem}_mesh.vtu", f"{stem}_report.html"):
        (folder / name).touch()
    results.publish(Layout(tmp_path), entry_of(stem), {"verdict": "quarantined"})
    assert sorted(path.name for path in folder.iterdir()) == ["sub-01_desc-T1w_mesh.vtu", "sub-01_desc-T1w_report.json"]


def test_nothing_gets_into_the_page(tmp_path):
    row = {"scan": HOSTILE, "verdict": HOSTILE, "exit_status": HOSTILE, "message": HOSTILE, "key": KEY, "robust_z": 4.0, "robust_z_figure": None,
           **{name: 1 for name in (*(figure.name for figure in figures.FIGURES), *figures.COSTS)}}
    rows = [{**row, "mesh": None, "report": None}, {**row, "mesh": HOSTILE, "report": HOSTILE}]
    (tmp_path / ".scantet" / "store" / KEY[:2] / KEY).mkdir(parents=True)
    (tmp_path / ".scantet" / "store" / KEY[:2] / KEY / "thumbnail.png").touch()
    shown = page.make_page(Layout(tmp_path), rows, {"version": HOSTILE, "options": [HOSTILE]})
    assert "<img src=x" not in shown and shown.count("onerror=alert(1)") > 10
    assert len(re.findall("<img ", shown)) == 1 and not re.search(r'"[^">]*onerror=[^"]*>', re.sub(r'"[^"]*"', '""', shown))
    (script,) = re.findall(r"<script>(.*?)</script>", shown, re.DOTALL)
    (allowed,) = re.findall(r"script-src ([^;]*);", shown)
    assert allowed == f"'sha256-{base64.b64encode(hashlib.sha256(script.encode()).digest()).decode()}'"


@pytest.mark.parametrize("change", [
    {"key": "../../../../secret"}, {"key": KEY + "\n"}, {"key": KEY.upper()}, {"key": 7}, {"sha256": None}, {"scan": None},
    {"scan": {**entry_of("a").scan.as_json(), "folder": "//example.org"}}, {"scan": {**entry_of("a").scan.as_json(), "name": 7}},
])
def test_a_manifest_that_no_cohort_wrote_is_refused(tmp_path, capsys, change):
    layout = Layout(tmp_path)
    results.save_manifest(layout, [entry_of("a")])
    assert results.load_manifest(layout) == [entry_of("a")]
    manifest = files.read_json(layout.manifest)
    manifest["scans"][0].update(change)
    files.write_json(layout.manifest, manifest)
    assert command_line.main(["study", str(tmp_path), "group"]) == 3
    assert "manifest.json is damaged" in capsys.readouterr().err and not (tmp_path / "group.html").exists()


@pytest.mark.parametrize("text", ["[1]", '"scans"', '{"scans": 1}', '{"scans": [1]}', '{"other": []}'])
def test_a_manifest_that_is_none_is_refused(tmp_path, text):
    files.write_whole(tmp_path / ".scantet" / "manifest.json", text)
    assert command_line.main(["study", str(tmp_path), "group"]) == 3


@pytest.mark.parametrize("change", [
    {"verdict": HOSTILE}, {"exit_status": HOSTILE}, {"message": 7}, {"seconds": HOSTILE}, {"memory_bytes": None}, {"mesh": 7}, {"files": 7},
    {"files": {"mesh.vtu": 7}}, {"files": {"mesh.vtu": {"bytes": 5}}}, {"files": {"mesh/../../../../../secret": {"bytes": 4}}},
    {"files": {"/secret": {"bytes": 4}}}, {"files": {"none\0": {"bytes": 4}}},
])
def test_a_verdict_that_no_job_wrote_is_none(tmp_path, change):
    layout = Layout(tmp_path / "out")
    (layout.store(KEY) / "mesh").mkdir(parents=True)
    for path in (layout.store(KEY) / "mesh.vtu", tmp_path / "secret", tmp_path / "out" / "secret"):
        path.write_text("text")
    verdict = {"verdict": "meshed", "exit_status": 0, "message": "", "mesh": "mesh.vtu", "files": {"mesh.vtu": {"sha256": "", "bytes": 4}}}
    files.write_json(layout.result(KEY), verdict)
    assert results.verdict_on(layout, KEY) == verdict
    change = json.loads(json.dumps(change).replace('"/secret"', json.dumps(str(tmp_path / "secret"))))
    files.write_json(layout.result(KEY), {**verdict, **change})
    assert results.verdict_on(layout, KEY) is None


def test_what_a_stranger_kept_under_a_key_is_made_again(tmp_path):
    study, output = tmp_path / "study", tmp_path / "out"
    make_dataset(study, 1, 16)
    assert run(study, output).returncode == 0
    (key,) = verdicts(output)
    layout = Layout(output)
    (layout.inner / "taken").write_text("text")
    for folder in (layout.store(key) / "mesh", output / "sub-01" / "anat" / "sub-01_desc-T1w_mesh"):
        folder.mkdir()  # the way out leads through it
    forged = {**verdicts(output)[key], "files": {"mesh/../../../../taken": {"sha256": "", "bytes": 4}}}
    for path in (layout.result(key), layout.store(key) / "result.json"):
        files.write_json(path, forged)
    done = run(study, output)
    assert done.returncode == 0 and "1 to be meshed" in done.stdout and "1 meshed" in done.stdout, done.stdout + done.stderr
    assert not (tmp_path / "taken").exists()


def test_figures_are_numbers():
    report = {"mesh": {"tets": HOSTILE, "vertices": [1], "volume_mm3": float("nan"), "regions": 7}, "distance": HOSTILE, "bounds": [HOSTILE],
              "topology": {"components": 10 ** 400, "cavities": 2}}
    assert figures.figures_of(report) == {**{figure.name: None for figure in figures.FIGURES}, "cavities": 2}
