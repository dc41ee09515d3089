"""Starts Snakemake over the packaged workflow: on a cluster first for plans, then for meshes. Here plans are made without it."""
import concurrent.futures
import ctypes
import dataclasses
import hashlib
import importlib.util
import os
import pathlib
import signal
import subprocess
import sys
from typing import List, Optional, Sequence

from scantet_cohort import files, plan
from scantet_cohort.errors import CohortError
from scantet_cohort.input_files import members
from scantet_cohort.job import Job
from scantet_cohort.layout import Layout

FOLDER = pathlib.Path(__file__).resolve().parent.parent
ATTEMPTS = 3
PLANS_A_JOB = 16
JOBS_AT_ONCE = 2000
PLANNED_FIRST = 4  # scans, the largest files
LIGHT_SECONDS = 60  # of meshing: a plan beside it is no trifle
PLAN_MB = 2000  # at most, of one


@dataclasses.dataclass(frozen=True)
class Machine:
    """What jobs may take, and who starts them."""

    cpus: int
    mem_mb: Optional[int]  # of this machine for all jobs, of one job with a profile
    profile: Optional[str]
    threads: int  # a scan may use
    dry_run: bool = False


def check_modules() -> None:
    """Raises CohortError if what jobs need is not installed."""
    for module, package in (("snakemake", "snakemake"), ("numpy", "python3-numpy")):
        if importlib.util.find_spec(module) is None:
            raise CohortError(f"{sys.executable} has no module {module}", f"apt-get install {package}")


def find_profile(name: str) -> str:
    """The folder of one that comes with scantet, by its name, or of one's own, or of one where Snakemake looks for them. Raises
    CohortError if there is none."""
    own = FOLDER / "profiles"
    settings = [pathlib.Path(os.environ.get("XDG_CONFIG_HOME") or pathlib.Path.home() / ".config"), pathlib.Path("/etc/xdg")]
    for folder in [*([] if "/" in name else [own]), pathlib.Path.cwd(), *(place / "snakemake" for place in settings)]:
        if (folder / name / "config.yaml").is_file():
            return str((folder / name).resolve())
    known = ", ".join(sorted((path.parent.name for path in own.glob("*/config.yaml")), reverse=True))
    raise CohortError(f"--profile: no profile {name}", f"give {known}, or a folder with a file config.yaml")


def machine_memory_mb() -> int:
    for line in pathlib.Path("/proc/meminfo").read_text().splitlines():
        if line.startswith("MemAvailable:"):
            return int(line.split()[1]) // 1024
    return 4096


def _end_with_parent() -> None:
    """Snakemake ends, once its running jobs have, when this program is killed."""
    ctypes.CDLL(None).prctl(1, signal.SIGTERM)


def run_snakemake(layout: Layout, machine: Machine, name: str, targets: Sequence[str],
                  more: Sequence[str] = ()) -> int:
    """Runs the workflow for the targets; its output goes into logs/. Returns its exit status."""
    list_file = layout.inner / f"{name}.targets"
    files.write_whole(list_file, "\n".join(targets) + "\n")
    words = [sys.executable, "-m", "snakemake", "--snakefile", str(FOLDER / "workflow" / "Snakefile"),
             "--directory", str(layout.output), "--nolock", "--rerun-triggers", "mtime", "--rerun-incomplete",
             "--keep-going", "--scheduler", "greedy", "--quiet", "progress", "rules", "--nocolor"]
    if machine.profile:
        words += ["--profile", find_profile(machine.profile)]
    else:
        words += ["--cores", str(machine.cpus), "--resources", f"mem_mb={machine.mem_mb or machine_memory_mb()}"]
    limit = machine.mem_mb if machine.profile else None
    words += ["--config", f"output={layout.output}", f"targets={list_file}", f"attempts={ATTEMPTS}",
              f"threads={machine.threads}", f"mem_mb={limit or 0}", *more]
    log = layout.output / "logs" / f"snakemake_{name}.log"
    log.parent.mkdir(parents=True, exist_ok=True)
    environment = {**os.environ, "PYTHONPATH": str(FOLDER), "PYTHONSAFEPATH": "1"}
    with open(log, "a") as file:
        process = subprocess.Popen(words, stdin=subprocess.DEVNULL, stdout=file, stderr=subprocess.STDOUT,
                                   cwd=layout.output, env=environment, preexec_fn=_end_with_parent)
        try:
            return process.wait()
        except KeyboardInterrupt:
            process.wait()
            raise


def _input_bytes(layout: Layout, key: str) -> int:
    path = (files.read_json(layout.job(key)) or {}).get("path")
    try:
        return sum(file.stat().st_size for file in members(pathlib.Path(path))) if path else 0
    except OSError:
        return 0


def _plan_here(layout: Layout, machine: Machine, keys: Sequence[str]) -> None:
    """Plans on this machine, the largest files first. Where those are light, the others count as twice as heavy."""
    memory_mb = machine.mem_mb or machine_memory_mb()
    ordered = sorted(keys, key=lambda key: (-_input_bytes(layout, key), key))
    first, rest = ordered[:PLANNED_FIRST], ordered[PLANNED_FIRST:]
    with concurrent.futures.ThreadPoolExecutor(max(1, min(machine.cpus, memory_mb // PLAN_MB))) as pool:
        list(pool.map(lambda key: Job(str(layout.output), key).plan(), first))
        known = [files.read_json(layout.plan(key)) for key in first]
        plans = [told for told in known if told]
        seconds = max((told["features"]["processor_s"] for told in plans), default=LIGHT_SECONDS)
        memory = 2 * max((told["plan"]["memory_bytes"] for told in plans), default=0)
        if len(plans) == len(first) and seconds < LIGHT_SECONDS / 2 and machine.cpus * memory / 1e6 < memory_mb / 2:
            guess = {"plan": {"memory_bytes": memory}, "features": {"processor_s": 2 * seconds}, "guessed": True}
            for key in rest:
                files.write_json(layout.plan(key), guess)
        else:
            list(pool.map(lambda key: Job(str(layout.output), key).plan(), rest))


def make_plans(layout: Layout, machine: Machine, keys: Sequence[str]) -> None:
    missing = [key for key in keys if not layout.plan(key).exists()]
    if not missing:
        return
    if not machine.profile:
        _plan_here(layout, machine, missing)
        return
    targets = []
    for chunk in (missing[begin:begin + PLANS_A_JOB] for begin in range(0, len(missing), PLANS_A_JOB)):
        text = "\n".join(chunk) + "\n"
        name = hashlib.sha256(text.encode()).hexdigest()[:16]
        files.write_whole(layout.inner / "chunks" / f"{name}.txt", text)
        (layout.inner / "chunks" / f"{name}.done").unlink(missing_ok=True)
        targets.append(f".scantet/chunks/{name}.done")
    run_snakemake(layout, machine, "plan", targets)


def make_meshes(layout: Layout, machine: Machine, keys: Sequence[str]) -> int:
    """One job a key, those that take longest first, so many at a time that Snakemake chooses quickly among them. Returns
    Snakemake's exit status, the first that is not 0; stops where it was ended from outside."""
    ordered = sorted(keys, key=lambda key: (-plan.seconds(layout, key), key))
    failed = 0
    for begin in range(0, len(ordered), JOBS_AT_ONCE):
        targets = [f".scantet/results/{key[:2]}/{key}.json" for key in ordered[begin:begin + JOBS_AT_ONCE]]
        status = run_snakemake(layout, machine, "mesh", targets)
        failed = failed or status
        if status < 0:
            break
    return failed
