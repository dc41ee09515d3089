"""Where the scans are, and the program that Python is compared with."""
import hashlib
import os
import pathlib
import subprocess

import pytest

ROOT = pathlib.Path(__file__).resolve().parents[3]


@pytest.fixture
def samples():
    return ROOT / "sample_volumes"


@pytest.fixture
def command():
    """Runs the program with words; the completed process."""
    program = os.environ["SCANTET_PROGRAM"]

    def run(*words, status=0):
        done = subprocess.run([program, *map(str, words)], capture_output=True, text=True, check=False, timeout=300)
        assert done.returncode == status, done.stderr
        return done
    return run


@pytest.fixture
def sha256():
    return lambda path: hashlib.sha256(pathlib.Path(path).read_bytes()).hexdigest()
