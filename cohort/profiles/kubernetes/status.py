#!/usr/bin/python3
"""Says what has become of a job of Kubernetes: running, success or failed. A job that is gone counts as success, for then
Snakemake looks for its output, which tells. While the cluster does not answer, the job counts as running."""
import json
import subprocess
import sys


def state_of(name: str) -> str:
    """Also "gone"."""
    done = subprocess.run(["kubectl", "get", "job", name, "--output", "json"], capture_output=True, text=True, check=False)
    if done.returncode != 0:
        return "gone" if "NotFound" in done.stderr else "running"
    conditions = json.loads(done.stdout).get("status", {}).get("conditions", [])
    true = {condition["type"] for condition in conditions if condition["status"] == "True"}
    return "success" if "Complete" in true else "failed" if "Failed" in true else "running"


if __name__ == "__main__":
    print(state_of(sys.argv[1]).replace("gone", "success"))
