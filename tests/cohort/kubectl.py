#!/usr/bin/python3
"""What stands for kubectl in kubernetes_test.py: runs jobs on this machine, with the environment that their pod would have.

It knows `create -f -`, `get job NAME --output json` and `delete job NAME`, keeps a folder a job in $STAND_IN, and refuses a
manifest that has not what Kubernetes asks for."""
import json
import os
import pathlib
import re
import subprocess
import sys

JOBS = pathlib.Path(os.environ["STAND_IN"])


def create(text):
    job = json.loads(text)
    assert (job["apiVersion"], job["kind"]) == ("batch/v1", "Job")
    name, pod = job["metadata"]["name"], job["spec"]["template"]["spec"]
    assert re.fullmatch(r"[a-z0-9]([-a-z0-9]*[a-z0-9])?", name) and len(name) <= 63, name
    assert pod["restartPolicy"] in ("Never", "OnFailure")
    container, = pod["containers"]
    mounts = {volume["name"] for volume in pod["volumes"]}
    assert all(mount["name"] in mounts for mount in container["volumeMounts"])
    assert any(container["workingDir"].startswith(mount["mountPath"]) for mount in container["volumeMounts"])
    for room in container["resources"].values():
        assert re.fullmatch(r"[1-9][0-9]*", room["cpu"]) and re.fullmatch(r"[1-9][0-9]*Mi", room["memory"]), room
    folder = JOBS / name
    if folder.exists():
        sys.exit(f'Error from server (AlreadyExists): jobs.batch "{name}" already exists')
    folder.mkdir(parents=True)
    (folder / "manifest.json").write_text(text)
    environment = {"PATH": "/usr/bin:/bin", **{pair["name"]: pair["value"] for pair in container["env"]}}
    waits = 'status=$?; echo $status > "$0/status.part"; mv "$0/status.part" "$0/status"'
    subprocess.Popen(["/bin/sh", "-c", '"$@" > "$0/log" 2>&1; ' + waits, str(folder), *container["command"]], env=environment,
                     cwd=container["workingDir"], start_new_session=True, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL,
                     stderr=subprocess.DEVNULL)


def get(name):
    folder = JOBS / name
    if not folder.exists():
        sys.exit(f'Error from server (NotFound): jobs.batch "{name}" not found')
    ended = folder / "status"
    if not ended.exists():
        return {"status": {"active": 1}}
    return {"status": {"conditions": [{"type": "Complete" if ended.read_text() == "0\n" else "Failed", "status": "True"}]}}


words = sys.argv[1:]
if words == ["create", "-f", "-"]:
    create(sys.stdin.read())
elif words[:2] == ["get", "job"] and words[3:] == ["--output", "json"]:
    print(json.dumps(get(words[2])))
elif words[:2] == ["delete", "job"]:
    (JOBS / words[2]).rename(JOBS / f"deleted_{words[2]}_{os.getpid()}")
else:
    sys.exit(f"unknown command {words}")
