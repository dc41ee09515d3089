"""Cohorts that are killed: the command, the scheduler, the job, the program."""
import os
import pathlib
import signal
import stat
import subprocess
import sys
import time

import pytest
from helpers import OPTIONS, PROGRAM, events, hashes, results, run, words
from make_subjects import make_dataset

COUNT = 8


@pytest.fixture(scope="module")
def study(tmp_path_factory):
    folder = tmp_path_factory.mktemp("study")
    make_dataset(folder, COUNT, 24, corrupt=1)
    return folder


@pytest.fixture(scope="module")
def undisturbed(study, tmp_path_factory):
    output = tmp_path_factory.mktemp("undisturbed")
    assert run(study, output).returncode == 4
    return hashes(output)


def processes(output: pathlib.Path, part: str) -> "list[int]":
    """Processes of this cohort whose command line has `part`."""
    found = []
    for entry in pathlib.Path("/proc").iterdir():
        try:
            line = (entry / "cmdline").read_bytes().decode(errors="replace")
        except (OSError, ValueError):
            continue
        if entry.name.isdigit() and str(output) in line and part in line:
            found.append(int(entry.name))
    return found


def wait_until(condition, seconds=60):
    end = time.monotonic() + seconds
    while not condition():
        assert time.monotonic() < end, "it takes too long"
        time.sleep(0.02)


def kill_all(pids):
    for pid in pids:
        try:
            os.kill(pid, signal.SIGKILL)
        except ProcessLookupError:
            pass


@pytest.mark.parametrize("victim", ["command", "scheduler", "all"])
def test_a_killed_cohort_goes_on_where_it_was(study, undisturbed, tmp_path, victim):
    with subprocess.Popen(words(study, tmp_path), stdout=subprocess.PIPE, stderr=subprocess.STDOUT) as command:
        wait_until(lambda: len(events(tmp_path, "meshed")) >= 2 or command.poll() is not None)
        parts = {"command": ["scantet_cohort\0"], "scheduler": ["snakemake"], "all": ["scantet_cohort", "snakemake", "scantet"]}[victim]
        kill_all(pid for part in parts for pid in processes(tmp_path, part))
        command.communicate(timeout=120)
    assert command.returncode != 4
    done = run(study, tmp_path)
    assert done.returncode == 4, done.stdout + done.stderr
    assert hashes(tmp_path) == undisturbed and len(undisturbed) == COUNT - 1
    keys = [event["key"] for event in events(tmp_path, "meshed")]
    assert len(keys) == len(set(keys)) == COUNT - 1
    assert not list(tmp_path.glob(".scantet/store/*/.*.tmp"))


def fake_program(path: pathlib.Path, what: str) -> pathlib.Path:
    """A program that does `what` before it becomes scantet, when it is to mesh."""
    path.write_text(f'#!/bin/sh\ncase "$*" in *--plan*|--version) ;; *) {what} ;; esac\nexec "{PROGRAM}" "$@"\n')
    path.chmod(path.stat().st_mode | stat.S_IXUSR)
    return path


def run_with(program: pathlib.Path, study, output, *more: str) -> "subprocess.CompletedProcess[str]":
    command = [sys.executable, "-m", "scantet_cohort", str(study), str(output), "participant", "--n-cpus", "2", *more, "--", *OPTIONS]
    return subprocess.run(command, env={**os.environ, "SCANTET_PROGRAM": str(program)}, capture_output=True, text=True,
                          timeout=200, check=False)


def test_a_program_that_is_killed_is_tried_again_with_more_memory(study, tmp_path):
    once = f'mkdir "{tmp_path}/killed" 2>/dev/null && kill -9 $$'
    done = run_with(fake_program(tmp_path / "program", once), study, tmp_path / "out", "--participant-label", "01", "02")
    assert done.returncode == 0, done.stdout + done.stderr
    failed = events(tmp_path / "out", "failed")
    assert [event["exit_status"] for event in failed] == [-9]
    assert sorted(result["attempt"] for result in results(tmp_path / "out").values()) == [1, 2]


def test_one_that_never_succeeds_is_quarantined_and_can_be_tried_again(study, tmp_path):
    program = fake_program(tmp_path / "program", "echo 'scantet: error: out of memory' >&2; exit 6")
    chosen = ("--participant-label", "03")
    done = run_with(program, study, tmp_path / "out", *chosen)
    assert done.returncode == 4 and "1 quarantined" in done.stdout
    (result,) = results(tmp_path / "out").values()
    assert (result["exit_status"], result["message"]) == (6, "out of memory")
    assert len(events(tmp_path / "out", "begun")) == 3
    fake_program(program, "")
    assert "0 to be meshed" in run_with(program, study, tmp_path / "out", *chosen).stdout
    assert run_with(program, study, tmp_path / "out", *chosen, "--retry-quarantined").returncode == 0


def test_a_mesh_that_a_power_cut_spoiled_is_made_again(study, undisturbed, tmp_path):
    chosen = ("--participant-label", "01")
    assert run(study, tmp_path, *chosen).returncode == 0
    (mesh,) = tmp_path.glob(".scantet/store/*/*/mesh.vtu")
    mesh.write_bytes(b"")
    assert run(study, tmp_path, *chosen).returncode == 0
    name = "sub-01_desc-T1w_mesh.vtu"
    assert hashes(tmp_path) == {name: undisturbed[name]}


def test_two_at_once_are_refused(study, tmp_path):
    first = subprocess.Popen(words(study, tmp_path), stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    wait_until(lambda: (tmp_path / "logs" / "cohort.jsonl").exists())
    second = run(study, tmp_path)
    assert first.wait(timeout=120) == 4
    assert second.returncode == 2 and "another scantet cohort works on" in second.stderr
