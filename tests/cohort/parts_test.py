"""The parts of a cohort, without meshing."""
import json
import math
import multiprocessing
import os
import pathlib
import struct
import zlib

import numpy as np
import pytest

from scantet_cohort import command_line, dataset, figures, files, hashing, mesh_options, plan, thumbnail, workflow
from scantet_cohort.errors import CohortError
from scantet_cohort.event_log import EventLog
from scantet_cohort.layout import Layout
from scantet_cohort.scans import Choice, find_scans


def touch(root, *names):
    for name in names:
        (root / name).parent.mkdir(parents=True, exist_ok=True)
        (root / name).write_bytes(name.encode())


def bids(root):
    touch(root, "dataset_description.json", "sub-01/anat/sub-01_T1w.nii.gz", "sub-01/anat/sub-01_T1w.json", "sub-02/ses-a/anat/sub-02_ses-a_T1w.nii",
          "sub-02/ses-b/anat/sub-02_ses-b_acq-fast_T2w.nii.gz", "derivatives/x/sub-01/anat/sub-01_T1w.nii.gz")
    return root


def names(root, **choice):
    return [scan.name for scan in find_scans(root, root / "out", Choice(**choice))]


def test_scans_of_a_dataset_are_chosen_by_their_names(tmp_path):
    bids(tmp_path)
    assert names(tmp_path) == ["sub-01_T1w", "sub-02_ses-a_T1w", "sub-02_ses-b_acq-fast_T2w"]
    assert names(tmp_path, participants=["02"]) == ["sub-02_ses-a_T1w", "sub-02_ses-b_acq-fast_T2w"]
    assert names(tmp_path, sessions=["b"]) == ["sub-02_ses-b_acq-fast_T2w"]
    assert names(tmp_path, suffixes=["T1w"]) == ["sub-01_T1w", "sub-02_ses-a_T1w"]
    assert names(tmp_path, entities={"acq": "fast"}) == ["sub-02_ses-b_acq-fast_T2w"]
    scan = find_scans(tmp_path, tmp_path / "out", Choice(sessions=["b"]))[0]
    assert (scan.folder, scan.stem) == ("sub-02/ses-b/anat", "sub-02_ses-b_acq-fast_desc-T2w")


@pytest.mark.parametrize("choice, told", [({"participants": ["01", "09"]}, "participant 09"), ({"suffixes": ["bold"]}, "no scan")])
def test_what_is_not_there_is_told(tmp_path, choice, told):
    with pytest.raises(CohortError, match=told):
        names(bids(tmp_path), **choice)


def test_the_description_of_another_dataset_is_not_replaced(tmp_path):
    layout = Layout(tmp_path / "out")
    dataset.write_dataset(layout, bids(tmp_path), {"version": "scantet 1", "options": []})  # its description is no JSON
    dataset.check_output(layout.output)
    with pytest.raises(CohortError, match="dataset of its own"):
        dataset.check_output(tmp_path)


@pytest.mark.parametrize("text", ["[1]", "[" * 100_000, "null"])
def test_a_description_that_is_none_is_as_if_missing(tmp_path, text):
    (tmp_path / "dataset_description.json").write_text(text)
    dataset.write_dataset(Layout(tmp_path / "out"), tmp_path, {"version": "scantet 1", "options": []})
    assert files.read_json(tmp_path / "out" / "dataset_description.json")["BIDSVersion"] == "1.8.0"


def test_a_pipe_is_not_waited_for(tmp_path):
    os.mkfifo(tmp_path / "dataset_description.json")
    assert files.read_json(tmp_path / "dataset_description.json") is None


def test_a_plain_folder_will_do(tmp_path):
    touch(tmp_path, "a.nrrd", "clinic one/b.nii.gz", "notes.txt", "out/old.nrrd")
    scans = find_scans(tmp_path, tmp_path / "out", Choice())
    assert [(scan.name, scan.stem) for scan in scans] == [("a", "a"), ("clinic_one_b", "clinic_one_b")]
    with pytest.raises(CohortError, match="no BIDS dataset"):
        names(tmp_path, suffixes=["T1w"])
    touch(tmp_path, "a.mha")
    with pytest.raises(CohortError, match="same name"):
        names(tmp_path)


def test_options_are_the_same_in_any_order(tmp_path):
    config = tmp_path / "job.json"
    config.write_text(json.dumps({"level": [-300, 60], "size": 5, "as-grey": True, "median": None}))
    collect = mesh_options.collect
    assert collect("", ["--level", "-300", "--size=3"], None) == collect("--size 3", ["--level", "-300"], None)
    assert collect("", [], config) == ["--as-grey", "--level", "-300", "--level", "60", "--size", "5"]
    assert collect("--size 3", [], config)[-1] == "3"
    for words in (["--output", "a.vtu"], ["-o", "a.vtu"], ["--report=x.json"], ["--certificate", "a.json"], ["--threads", "2"], ["60"]):
        with pytest.raises(CohortError):
            collect("", words, None)


def test_files_among_options_count_by_what_they_hold(tmp_path):
    one, two = tmp_path / "one.txt", tmp_path / "two.txt"
    one.write_text("1 Left\n")
    two.write_text("1 Left\n")
    sums = [mesh_options.identity(["--label-names", str(path)]) for path in (one, two)]
    assert sums[0] == sums[1] and sums[0][1].startswith("sha256:")
    two.write_text("1 Right\n")
    assert mesh_options.identity(["--label-names", str(two)]) != sums[0]


def test_keys_follow_from_input_options_formats_and_version():
    parts = {"checksum": "a", "options": ["--level", "1"], "formats": [".vtu"], "version": "scantet 1", "base": "mesh"}
    key = hashing.key_of(**parts)
    assert key == hashing.key_of(**parts)
    changes = [{"checksum": "b"}, {"options": ["--level", "2"]}, {"formats": [".msh"]}, {"version": "scantet 2"}, {"base": "a_mesh"}]
    assert len({key, *(hashing.key_of(**{**parts, **change}) for change in changes)}) == 6


def test_checksums_are_remembered_until_the_file_changes(tmp_path):
    scan, memory = tmp_path / "a.nii", tmp_path / "hashes.json"
    scan.write_text("one")
    first = hashing.Checksums(memory).of([scan], 1)
    assert first == [hashing.file_sha256(scan)]
    known = json.loads(memory.read_text())
    known[str(scan)]["sha256"] = "remembered"
    memory.write_text(json.dumps(known))
    assert hashing.Checksums(memory).of([scan], 1) == ["remembered"]
    scan.write_text("another")
    assert hashing.Checksums(memory).of([scan], 1) == [hashing.file_sha256(scan)]
    missing = hashing.Checksums(memory).of([tmp_path / "none.nii"], 1)[0]
    assert isinstance(missing, OSError)


def test_robust_scores_find_what_is_far():
    scores = figures.robust_scores([10, 11, 12, 13, 14, None, 100])
    assert scores[5] is None and scores[6] > figures.FAR and max(map(abs, scores[:5])) < figures.FAR
    assert scores[0] == pytest.approx(-0.6745 * 2.5 / 1.5)  # median 12.5, MAD 1.5
    assert figures.robust_scores([7, 7, 7]) == [0, 0, 0]
    rare = figures.robust_scores([1, 1, 1, 1, 1, 1, 1, 1, 1, 4])  # MAD is 0: the mean takes its place
    assert rare[-1] == pytest.approx(3 / (1.2533 * 0.3)) and rare[-1] > figures.FAR


def ball(count):
    """Triangles of a ball of 10 mm."""
    u, v = np.meshgrid(np.linspace(0, 2 * math.pi, count), np.linspace(0, math.pi, count), indexing="ij")
    p = 10 * np.stack([np.cos(u) * np.sin(v), np.sin(u) * np.sin(v), np.cos(v)], axis=-1)
    a, b, c, d = p[:-1, :-1], p[1:, :-1], p[1:, 1:], p[:-1, 1:]
    return np.concatenate([np.stack([a, b, c], 2).reshape(-1, 3, 3), np.stack([a, c, d], 2).reshape(-1, 3, 3)])


def pixels(png):
    begin = png.index(b"IDAT") + 4
    (length,) = struct.unpack(">I", png[begin - 8:begin - 4])
    rows = np.frombuffer(zlib.decompress(png[begin:begin + length]), np.uint8).reshape(thumbnail.SIDE, -1)
    return rows[:, 1:].reshape(thumbnail.SIDE, thumbnail.SIDE, 2)


@pytest.mark.parametrize("count", [6, 40, 200])
def test_a_ball_is_drawn_round_and_without_holes(count):
    image = thumbnail.picture(ball(count))
    assert image == thumbnail.picture(ball(count))
    covered = pixels(image)[:, :, 1] > 127
    disc = math.pi / 4 * (0.94 * thumbnail.SIDE) ** 2
    assert covered.sum() == pytest.approx(disc, rel=0.12 if count == 6 else 0.03)
    row = np.flatnonzero(covered[thumbnail.SIDE // 2])
    assert len(row) == row[-1] - row[0] + 1


def test_an_stl_file_is_read(tmp_path):
    triangles = ball(5)
    record = np.zeros(len(triangles), np.dtype([("n", "<f4", 3), ("c", "<f4", (3, 3)), ("a", "<u2")]))
    record["c"] = triangles
    (tmp_path / "a.stl").write_bytes(bytes(80) + struct.pack("<I", len(record)) + record.tobytes())
    assert np.allclose(thumbnail.read_stl(tmp_path / "a.stl"), triangles, atol=1e-5)
    assert len(thumbnail.picture(np.zeros((0, 3, 3)))) > 0


def test_resources_follow_from_the_plan(tmp_path):
    layout, key = Layout(tmp_path), "ab" * 16
    files.write_json(layout.plan(key), {"plan": {"memory_bytes": 8e9}, "features": {"processor_s": 4000}})
    assert plan.threads(str(tmp_path), key, 8) == 3 and plan.threads(str(tmp_path), key, 2) == 2
    assert plan.memory_mb(str(tmp_path), key, 1, None) == 10200
    assert plan.memory_mb(str(tmp_path), key, 2, None) == 15300 and plan.memory_mb(str(tmp_path), key, 2, 12000) == 12000
    assert plan.minutes(str(tmp_path), key, 1) == 205
    assert plan.threads(str(tmp_path), "cd" * 16, 8) == 1  # no plan: a guess


def append(path, number):
    log = EventLog(path)
    for index in range(200):
        log.write("tried", number=number, index=index, text="x" * 500)


def test_many_processes_log_whole_lines(tmp_path):
    with multiprocessing.Pool(4) as pool:
        pool.starmap(append, [(tmp_path / "log.jsonl", number) for number in range(4)])
    read = [json.loads(line) for line in (tmp_path / "log.jsonl").read_text().splitlines()]
    assert len({(event["number"], event["index"]) for event in read}) == len(read) == 800


def test_a_lock_has_one_holder(tmp_path):
    with files.locked(tmp_path / "a.lock") as first, files.locked(tmp_path / "a.lock", wait=False) as second:
        assert first and not second
    with files.locked(tmp_path / "a.lock", wait=False) as third:
        assert third


def test_files_are_whole_or_not_there(tmp_path):
    files.write_json(tmp_path / "deep" / "a.json", {"a": 1})
    assert files.read_json(tmp_path / "deep" / "a.json") == {"a": 1}
    (tmp_path / "half.json").write_text('{"a"')
    assert files.read_json(tmp_path / "half.json") is None and files.read_json(tmp_path / "none.json") is None
    files.link_or_copy(tmp_path / "half.json", tmp_path / "b" / "link.json")
    files.link_or_copy(tmp_path / "half.json", tmp_path / "b" / "link.json")
    assert [path.name for path in (tmp_path / "b").iterdir()] == ["link.json"]
    assert sorted(path.name for path in pathlib.Path(tmp_path / "deep").iterdir()) == ["a.json"]


def test_what_is_not_installed_is_told(monkeypatch):
    workflow.check_modules()
    monkeypatch.setattr(workflow.importlib.util, "find_spec", lambda name: None)
    with pytest.raises(CohortError, match="no module snakemake") as told:
        workflow.check_modules()
    assert told.value.remedy == "apt-get install snakemake"


def test_profiles_are_found(tmp_path, monkeypatch):
    assert workflow.find_profile("slurm").endswith("/profiles/slurm")
    touch(tmp_path, "of_my_own/config.yaml", "snakemake/of_snakemake/config.yaml", "of_nobody/notes.txt")
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("XDG_CONFIG_HOME", str(tmp_path))
    assert workflow.find_profile("of_my_own") == workflow.find_profile(str(tmp_path / "of_my_own")) == str(tmp_path / "of_my_own")
    assert workflow.find_profile("of_snakemake") == str(tmp_path / "snakemake" / "of_snakemake")
    for name in ("nope", "of_nobody"):
        with pytest.raises(CohortError, match=f"no profile {name}") as told:
            workflow.find_profile(name)
        assert told.value.status == 2 and told.value.remedy == "give slurm, kubernetes, or a folder with a file config.yaml"


@pytest.mark.parametrize("words, told", [(["study", "out"], "participant|group"), (["study", "out", "each"], "participant|group: invalid choice")])
def test_the_third_argument_is_called_by_its_values(words, told, capsys):
    assert command_line.main(words) == 2
    assert told in capsys.readouterr().err


def test_an_output_that_cannot_be_written_has_a_hint(monkeypatch, capsys):
    def full(words):
        raise OSError(28, "No space left on device", "out/log")
    monkeypatch.setattr(command_line, "_run", full)
    assert command_line.main([]) == 5
    assert "free space" in capsys.readouterr().err
