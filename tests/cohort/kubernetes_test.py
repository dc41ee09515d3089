"""The profile for Kubernetes against a stand-in for kubectl (kubectl.py): no cluster is here. It makes the meshes that this
machine makes without it; a job that fails is tried again; one that still runs is not submitted twice."""
import json
import os
import pathlib
import shutil
import subprocess
import sys
import time

import pytest
from helpers import hashes, run
from make_subjects import make_dataset

HERE = pathlib.Path(__file__).parent
PROFILE = HERE.parents[1] / "cohort" / "profiles" / "kubernetes"


@pytest.fixture
def cluster(tmp_path, monkeypatch):
    """A folder with a job each."""
    programs = tmp_path / "programs"
    programs.mkdir()
    shutil.copy(HERE / "kubectl.py", programs / "kubectl")
    (programs / "kubectl").chmod(0o755)
    for name, value in (("PATH", f"{programs}:{os.environ['PATH']}"), ("STAND_IN", str(tmp_path / "jobs")),
                        ("SCANTET_IMAGE", "registry.example/scantet"), ("SCANTET_CLAIM", "study"), ("SCANTET_MOUNT", str(tmp_path))):
        monkeypatch.setenv(name, value)
    return tmp_path / "jobs"


def test_the_meshes_are_those_of_this_machine(cluster, tmp_path):
    make_dataset(tmp_path / "study", 3, 24, corrupt=1)
    here, there = tmp_path / "here", tmp_path / "there"
    assert run(tmp_path / "study", here).returncode == 4
    done = run(tmp_path / "study", there, "--profile", "kubernetes")
    assert done.returncode == 4, done.stdout + done.stderr
    assert "2 meshed, 1 quarantined" in done.stdout
    assert hashes(there) == hashes(here) and len(hashes(here)) == 2
    manifests = [json.loads(path.read_text()) for path in cluster.glob("*/manifest.json")]
    assert len(manifests) == 3, "a job of the plans, which find the empty scan, and one of each other scan"
    container = manifests[0]["spec"]["template"]["spec"]["containers"][0]
    assert container["image"] == "registry.example/scantet"


def submit(folder, properties, command):
    script = folder / "script.sh"
    script.write_text(f"#!/bin/sh\n# properties = {json.dumps(properties)}\n{command}\n")
    done = subprocess.run([sys.executable, str(PROFILE / "submit.py"), str(script)], cwd=folder, capture_output=True, text=True, check=True)
    return done.stdout.strip()


def state(name):
    return subprocess.run([sys.executable, str(PROFILE / "status.py"), name], capture_output=True, text=True, check=True).stdout.strip()


def wait_for(name, wanted):
    for _ in range(200):
        if state(name) == wanted:
            return
        time.sleep(0.05)
    raise AssertionError(f"{name} is {state(name)}, not {wanted}")


def test_a_job_that_runs_is_not_submitted_twice_and_one_that_failed_is(cluster, tmp_path):
    work = tmp_path / "work"
    work.mkdir()
    properties = {"rule": "mesh", "wildcards": {"key": "0123456789abcdef" * 2}, "threads": 2, "resources": {"mem_mb": 700, "runtime": 5}}
    command = "echo begun >> runs; while [ ! -e go ]; do sleep 0.05; done; test -e well"
    name = submit(work, properties, command)
    assert state(name) == "running" and submit(work, properties, command) == name
    spec = json.loads((cluster / name / "manifest.json").read_text())["spec"]
    assert spec["activeDeadlineSeconds"] == 300
    assert spec["template"]["spec"]["containers"][0]["resources"]["limits"] == {"cpu": "2", "memory": "700Mi"}
    (work / "go").touch()
    wait_for(name, "failed")
    (work / "well").touch()
    assert submit(work, properties, command) == name
    wait_for(name, "success")
    assert (work / "runs").read_text() == "begun\n" * 2
    assert state("scantet-never-was") == "success"


def test_what_it_needs_is_said(cluster, tmp_path, monkeypatch):
    monkeypatch.delenv("SCANTET_CLAIM")
    done = subprocess.run([sys.executable, str(PROFILE / "submit.py"), "/nowhere"], capture_output=True, text=True, check=False)
    assert done.returncode == 1 and "SCANTET_CLAIM is not set" in done.stderr
