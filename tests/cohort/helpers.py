"""Cohorts for tests: small datasets, and running the command over them."""
import hashlib
import json
import os
import pathlib
import subprocess
from typing import Any, Dict, List

PROGRAM = os.environ["SCANTET_PROGRAM"]
OPTIONS = ("--level", "60", "--size", "3")


def words(study: pathlib.Path, output: pathlib.Path, *more: str, level: str = "participant",
          options: "tuple[str, ...]" = OPTIONS) -> List[str]:
    cores = ("--n-cpus", "2") if level == "participant" else ()
    return [PROGRAM, "cohort", str(study), str(output), level, *cores, *more, *(("--", *options) if options else ())]


def run(*arguments: Any, **keywords: Any) -> "subprocess.CompletedProcess[str]":
    return subprocess.run(words(*arguments, **keywords), capture_output=True, text=True, timeout=200, check=False)


def results(output: pathlib.Path) -> Dict[str, Dict[str, Any]]:
    """The verdicts by key."""
    found = [json.loads(path.read_text()) for path in sorted(output.glob(".scantet/results/*/*.json"))]
    return {result["key"]: result for result in found}


def hashes(output: pathlib.Path) -> Dict[str, str]:
    """Checksums of the meshes as they are on the disk, by name."""
    return {path.name: hashlib.sha256(path.read_bytes()).hexdigest() for path in sorted(output.glob("sub-*/**/*_mesh.vtu"))}


def events(output: pathlib.Path, *kinds: str) -> List[Dict[str, Any]]:
    lines = [line for path in sorted(output.glob("logs/jobs/*/*.jsonl")) for line in path.read_text().splitlines()]
    return [event for event in map(json.loads, lines) if event["event"] in kinds]
