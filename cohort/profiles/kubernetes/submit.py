#!/usr/bin/python3
"""Submits a job script of Snakemake to Kubernetes and prints the job's name.

From the environment: SCANTET_IMAGE, an image that has scantet, Snakemake and NumPy; SCANTET_CLAIM, the claim of a volume that all
pods may write and that this machine has, too; SCANTET_MOUNT, where the volume is, here and in the pods. A job of the same name
that is not at its end, as after Snakemake was killed, is not submitted once more: each name holds the key of its scan and the
output folder."""
import hashlib
import json
import os
import pathlib
import subprocess
import sys
from typing import Any, Dict

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))  # PYTHONSAFEPATH is set, which leaves it out
from status import state_of


def name_of(properties: Dict[str, Any]) -> str:
    """Of small letters, digits and hyphens, at most 63."""
    place = hashlib.sha256(os.getcwd().encode()).hexdigest()[:8]
    wildcards = properties.get("wildcards", {})
    return f"scantet-{place}-{wildcards.get('key') or wildcards.get('chunk') or properties.get('rule', 'job')}"[:63].lower()


def manifest(name: str, script: str, properties: Dict[str, Any]) -> Dict[str, Any]:
    """The script itself is in it, as Snakemake's file is gone when Snakemake is."""
    resources = properties.get("resources", {})
    room = {"cpu": str(properties.get("threads", 1)), "memory": f"{resources.get('mem_mb', 2000)}Mi"}
    volume, mount = "study", os.environ["SCANTET_MOUNT"]
    variables = {"HOME": "/tmp", **{key: os.environ[key] for key in ("SCANTET_PROGRAM",) if key in os.environ}}
    container = {"name": "scantet", "image": os.environ["SCANTET_IMAGE"], "command": ["/bin/sh", "-c", script],
                 "env": [{"name": key, "value": value} for key, value in variables.items()],
                 "workingDir": os.getcwd(), "resources": {"requests": room, "limits": room},
                 "volumeMounts": [{"name": volume, "mountPath": mount}]}
    pod = {"restartPolicy": "Never", "containers": [container],
           "securityContext": {"runAsUser": os.getuid(), "runAsGroup": os.getgid()},
           "volumes": [{"name": volume, "persistentVolumeClaim": {"claimName": os.environ["SCANTET_CLAIM"]}}]}
    return {"apiVersion": "batch/v1", "kind": "Job", "metadata": {"name": name, "labels": {"app": "scantet"}},
            "spec": {"backoffLimit": 0, "activeDeadlineSeconds": 60 * int(resources.get("runtime", 60)),
                     "ttlSecondsAfterFinished": 86400, "template": {"metadata": {"labels": {"app": "scantet"}}, "spec": pod}}}


def main() -> int:
    for variable in ("SCANTET_IMAGE", "SCANTET_CLAIM", "SCANTET_MOUNT"):
        if not os.environ.get(variable):
            sys.exit(f"{variable} is not set; docs/cohort.md says what it is")
    script = pathlib.Path(sys.argv[-1]).read_text(encoding="utf-8")
    mark = "# properties = "  # what Snakemake writes into the second line
    properties = json.loads(next(line for line in script.splitlines() if line.startswith(mark))[len(mark):])
    name = name_of(properties)
    state = state_of(name)
    if state in ("success", "failed"):  # of an earlier try
        subprocess.run(["kubectl", "delete", "job", name], check=True, stdout=subprocess.DEVNULL)
    if state != "running":
        subprocess.run(["kubectl", "create", "-f", "-"], input=json.dumps(manifest(name, script, properties)), text=True, check=True,
                       stdout=subprocess.DEVNULL)
    print(name)
    return 0


if __name__ == "__main__":
    sys.exit(main())
