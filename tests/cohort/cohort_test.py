"""A cohort of nine scans from end to end, on two cores."""
import json
import re
import shutil

import pytest
from helpers import events, hashes, results, run
from make_subjects import make_dataset

from scantet_cohort import workflow


@pytest.fixture(scope="module")
def study(tmp_path_factory):
    """Subjects 01 to 06 are well, 07 is empty, 08 is cut off, 09 is a copy of 01."""
    folder = tmp_path_factory.mktemp("study")
    make_dataset(folder, 8, 24, corrupt=1, hopeless=1)
    (folder / "sub-09" / "anat").mkdir(parents=True)
    shutil.copy(folder / "sub-01" / "anat" / "sub-01_T1w.nii.gz", folder / "sub-09" / "anat" / "sub-09_T1w.nii.gz")
    return folder


@pytest.fixture(scope="module")
def meshed(study, tmp_path_factory):
    output = tmp_path_factory.mktemp("meshed") / "out put"
    done = run(study, output)
    assert done.returncode == 4, done.stdout + done.stderr
    return output, done


def test_bad_scans_are_told_and_the_rest_is_meshed(meshed):
    output, done = meshed
    assert "7 meshed, 2 quarantined" in done.stdout
    rows = [line.split("\t") for line in (output / "quarantine.tsv").read_text().splitlines()]
    assert [row[0] for row in rows] == ["scan", "sub-07_T1w", "sub-08_T1w"]
    assert "has the value 0" in rows[1][3] and "truncated or damaged" in rows[2][3] and rows[1][2] == rows[2][2] == "3"
    sums = hashes(output)
    assert len(sums) == 7
    told = {event["mesh_sha256"] for event in events(output, "meshed")}
    assert told == set(sums.values()) and len(told) == 6


def test_every_file_has_its_place(meshed):
    output, _ = meshed
    assert sorted(path.name for path in (output / "sub-01" / "anat").iterdir()) == [
        "sub-01_desc-T1w_mesh.vtu", "sub-01_desc-T1w_report.html", "sub-01_desc-T1w_report.json"]
    described = json.loads((output / "dataset_description.json").read_text())
    assert described["DatasetType"] == "derivative" and described["GeneratedBy"][0]["Name"] == "scantet"
    assert json.loads((output / "sub-02/anat/sub-02_desc-T1w_report.json").read_text())["audit"]["passed"]


def test_equal_scans_are_meshed_once(meshed):
    output, _ = meshed
    sums = hashes(output)
    assert sums["sub-01_desc-T1w_mesh.vtu"] == sums["sub-09_desc-T1w_mesh.vtu"]
    assert len(results(output)) == 8
    keys = [event["key"] for event in events(output, "begun")]
    assert len(keys) == len(set(keys))
    meshed_keys = [event["key"] for event in events(output, "meshed")]
    assert len(meshed_keys) == len(set(meshed_keys)) == 6


def test_light_scans_are_not_all_planned(meshed):
    output, _ = meshed
    assert 0 < len(events(output, "planned")) <= workflow.PLANNED_FIRST
    plans = [json.loads(path.read_text()) for path in (output / ".scantet").rglob("*.json") if "plans" in path.parts]
    heaviest = max(plan["plan"]["memory_bytes"] for plan in plans if not plan.get("guessed"))
    assert {plan["plan"]["memory_bytes"] for plan in plans if plan.get("guessed")} == {2 * heaviest}


def test_the_machine_is_timed_once(meshed):
    output, _ = meshed
    plans = [json.loads(path.read_text()) for path in (output / ".scantet" / "plans").rglob("*.json")]
    trials = {plan["features"]["trial_s"] for plan in plans if not plan.get("guessed")}
    assert trials == {json.loads((output / ".scantet" / "trial.json").read_text())["trial_s"]}


def test_nothing_is_meshed_twice(study, meshed):
    output, _ = meshed
    before = (hashes(output), len(events(output, "begun", "planned", "quarantined")))
    again = run(study, output, options=("--size", "3", "--level", "60"))
    assert again.returncode == 4 and "9 scans, 0 to be meshed" in again.stdout
    assert (hashes(output), len(events(output, "begun", "planned", "quarantined"))) == before


def test_the_command_line_makes_the_same_bytes(study, meshed, tmp_path):
    import hashlib
    import subprocess

    from helpers import OPTIONS, PROGRAM
    output, _ = meshed
    subprocess.run([PROGRAM, "mesh", str(study / "sub-02/anat/sub-02_T1w.nii.gz"), *OPTIONS, "--quiet", "-o", str(tmp_path / "a.vtu")], check=True)
    assert hashlib.sha256((tmp_path / "a.vtu").read_bytes()).hexdigest() == hashes(output)["sub-02_desc-T1w_mesh.vtu"]


def test_the_group_has_one_page_and_table(study, meshed):
    output, _ = meshed
    done = run(study, output, level="group", options=())
    assert done.returncode == 0, done.stderr
    table = [line.split("\t") for line in (output / "group.tsv").read_text().splitlines()]
    column = table[0].index
    assert [row[column("verdict")] for row in table[1:]] == ["quarantined"] * 2 + ["meshed"] * 7
    scores = [abs(float(row[column("robust_z")])) for row in table[3:]]
    assert scores == sorted(scores, reverse=True)
    page = (output / "group.html").read_text()
    assert page.count("data:image/png;base64,") == 7
    assert not re.search(r'(src|href)="(https?:)?//', page)
    for link in re.findall(r'href="([^"]+)"', page):
        assert (output / link).is_file()
    rows = json.loads((output / "group.json").read_text())["scans"]
    assert [row["scan"] for row in rows] == [row[0] for row in table[1:]]


def test_the_same_scans_give_the_same_table_but_for_times(study, meshed, tmp_path):
    output, _ = meshed
    assert run(study, tmp_path).returncode == 4
    assert hashes(tmp_path) == hashes(output)
    tables = []
    for folder in (output, tmp_path):
        assert run(study, folder, level="group", options=()).returncode == 0
        rows = [line.split("\t") for line in (folder / "group.tsv").read_text().splitlines()]
        tables.append([row[: rows[0].index("seconds")] for row in rows])
    assert tables[0] == tables[1]


def test_a_mesh_that_misses_a_bound_is_kept_and_flagged(study, tmp_path):
    chosen = ("--participant-label", "sub-01", "02")
    done = run(study, tmp_path, *chosen, options=("--level", "60", "--size", "4", "--min-dihedral", "50"))
    assert done.returncode == 4 and "2 flagged" in done.stdout and "dihedral" in done.stdout
    assert len(hashes(tmp_path)) == 2
    done = run(study, tmp_path, *chosen, "--no-pages", "--mesh-format", "stl", ".mesh", options=("--level", "5000"))
    assert done.returncode == 4 and "2 quarantined" in done.stdout and not hashes(tmp_path)


def test_a_dry_run_makes_nothing(study, tmp_path):
    done = run(study, tmp_path / "out", "--dry-run")
    assert done.returncode == 0 and "8 to be meshed; nothing was" in done.stdout
    assert not list((tmp_path / "out").glob("sub-*"))


@pytest.mark.parametrize("more, options, told", [
    ((), ("--levle", "60"), "did you mean --level"),
    ((), ("--output", "a.vtu"), "--output is no option"),
    (("--bids-filter", "acq"), ("--level", "60"), "ENTITY=VALUE"),
    (("--n-cpus", "0"), ("--level", "60"), "--n-cpus 0"),
    (("--colour",), ("--level", "60"), "--colour"),
    (("--mesh-format", ".foo"), ("--level", "60"), "--mesh-format: scan.foo: unknown extension .foo"),
    (("--profile", "nope"), ("--level", "60"), "no profile nope"),
    (("--config", "none.json"), (), "none.json cannot be read"),
    (("--dry-run",), ("--levle", "60"), "did you mean --level"),
    (("--dry-run", "--profile", "nope"), ("--level", "60"), "slurm, kubernetes, or a folder"),
])
def test_wrong_use_is_told_before_any_work(study, tmp_path, more, options, told):
    done = run(study, tmp_path / "out", *more, options=options)
    assert done.returncode == 2 and told in done.stderr and "hint: " in done.stderr
    assert "Traceback" not in done.stderr and not (tmp_path / "out" / ".scantet" / "results").exists()


def test_a_group_without_a_cohort_is_told(study, tmp_path):
    done = run(study, tmp_path, level="group", options=())
    assert done.returncode == 3 and "participant level first" in done.stderr
