"""The jobs that Snakemake starts: plans for a few scans, or the mesh of one.

`python3 -m scantet_cohort.job plan OUTPUT KEY...` and `... mesh OUTPUT KEY THREADS ATTEMPT ATTEMPTS`. The exit status is 0
whenever there is a verdict, also where the scan is bad; otherwise the scheduler tries again."""
import json
import os
import pathlib
import shutil
import socket
import sys
from typing import Any, Dict, List

from scantet_cohort import files, hashing, mesh_files
from scantet_cohort.event_log import EventLog
from scantet_cohort.layout import Layout
from scantet_cohort.program import Run, run_program

UNMET = 4  # a mesh was written, but a bound is unmet or the audit found a fault
ABOUT_THE_SCAN = (2, 3)  # exit statuses that come again however often it is tried


class Job:
    def __init__(self, output: str, key: str) -> None:
        self.layout = Layout(pathlib.Path(output))
        self.key = key
        self.settings: Dict[str, Any] = files.read_json(self.layout.settings) or {}
        self.scan: Dict[str, Any] = files.read_json(self.layout.job(key)) or {}
        self.log = EventLog(self.layout.job_log(key))

    def words(self) -> List[str]:
        return [self.settings["program"], "mesh", self.scan["path"], *self.settings["options"], "--quiet"]

    def outputs(self, path: pathlib.Path) -> List[str]:
        """A mesh of each format, called as the path is."""
        return [word for ending in self.settings["formats"] for word in ("-o", f"{path}{ending}")]

    def run(self, words: List[str]) -> Run:
        """In the folder where the cohort was begun, if it is here: files of materials may name scans from there."""
        return run_program(words, self.settings["folder"])

    def quarantine(self, run: Run, stage: str) -> None:
        reason = {"exit_status": run.status, "message": run.reason(), "stage": stage}
        files.write_json(self.layout.result(self.key), {**self._head("quarantined"), **reason})
        self.log.write("quarantined", key=self.key, scan=self.scan["path"], **reason)

    def _head(self, verdict: str) -> Dict[str, Any]:
        return {"key": self.key, "verdict": verdict, "input_sha256": self.scan["sha256"],
                "version": self.settings["version"], "options": self.settings["options"]}

    def plan(self) -> None:
        """What meshing will take; a scan that cannot be opened is quarantined now."""
        if self.layout.plan(self.key).exists() or self.layout.result(self.key).exists():
            return
        target = files.temporary_name(self.layout.plan(self.key)).with_suffix(".json")
        target.parent.mkdir(parents=True, exist_ok=True)
        run = self._run_plan(target)
        if run.status == 0:
            target.replace(self.layout.plan(self.key))
            self.log.write("planned", key=self.key, seconds=round(run.seconds, 3))
        elif run.status in ABOUT_THE_SCAN:
            self.quarantine(run, "plan")
        else:  # meshing may still work; what it takes is guessed
            self.log.write("plan_failed", key=self.key, exit_status=run.status, message=run.reason())

    def _run_plan(self, target: pathlib.Path) -> Run:
        """The first plan that comes to its end times the machine, the others wait for that and take it over."""
        outputs = self.outputs(target.with_suffix(""))  # none is written, but options may make no sense without
        words = [*self.words(), *outputs, "--plan", "--threads", "1", "--report", str(target)]
        trial = files.read_json(self.layout.trial)
        if not trial:
            with files.locked(self.layout.trial.with_suffix(".lock")):
                trial = files.read_json(self.layout.trial)
                if not trial:
                    return self._run_first_plan(words, target)
        os.environ["SCANTET_TRIAL"] = str(trial["trial_s"])
        return self.run(words)

    def _run_first_plan(self, words: List[str], target: pathlib.Path) -> Run:
        run = self.run(words)
        if run.status == 0:
            files.write_json(self.layout.trial, {"trial_s": json.loads(target.read_text())["features"]["trial_s"]})
        return run

    def mesh(self, threads: int, attempt: int, attempts: int) -> int:
        """Meshes the scan unless that is done; under a lock, so that a job that outlived its scheduler is waited for."""
        with files.locked(self.layout.lock(self.key)):
            if self.layout.result(self.key).exists():
                return 0
            store = self.layout.store(self.key)
            kept = files.read_json(store / "result.json")
            if kept:  # the job was killed, or the scheduler took the verdict away, after the mesh was there
                files.write_json(self.layout.result(self.key), kept)
                return 0
            store.parent.mkdir(parents=True, exist_ok=True)
            for left in [*store.parent.glob(f".{self.key}.*.tmp"), store]:  # of jobs that were killed
                shutil.rmtree(left, ignore_errors=True)
            folder = files.temporary_name(store)
            folder.mkdir()
            try:
                return self._mesh_in(folder, threads, attempt, attempts)
            finally:
                shutil.rmtree(folder, ignore_errors=True)

    def _mesh_in(self, folder: pathlib.Path, threads: int, attempt: int, attempts: int) -> int:
        mesh = self.scan["base"] + self.settings["formats"][0]
        reports = ["report.json"] + (["report.html"] if self.settings["pages"] else [])
        outputs = [*self.outputs(folder / self.scan["base"]), "-o", str(folder / "thumbnail.stl")]
        outputs += [word for name in reversed(reports) for word in ("--report", str(folder / name))]
        self.log.write("begun", key=self.key, scan=self.scan["path"], threads=threads, attempt=attempt)
        run = self.run([*self.words(), "--threads", str(threads), *outputs])
        written = (folder / "report.json").exists() and (folder / mesh).exists()
        if run.status == 0 or (run.status == UNMET and written):
            return self._keep(run, folder, mesh, reports, threads, attempt)
        if run.status in (*ABOUT_THE_SCAN, UNMET) or attempt >= attempts:
            self.quarantine(run, "mesh")
            return 0
        self.log.write("failed", key=self.key, attempt=attempt, exit_status=run.status, message=run.reason())
        return 1

    def _is_unchanged(self, report: Dict[str, Any]) -> bool:
        """Whether the scan still is what its checksum says. The report's checksum is of what was read: files of sizes,
        fields and tissues, too, if there are any."""
        if report["input"]["sha256"] == self.scan["sha256"]:
            return True
        try:
            return bool(hashing.input_sha256(pathlib.Path(self.scan["path"])) == self.scan["sha256"])
        except OSError:
            return False

    def _keep(self, run: Run, folder: pathlib.Path, mesh: str, reports: List[str], threads: int, attempt: int) -> int:
        from scantet_cohort import thumbnail  # takes NumPy, which planning does without

        report = json.loads((folder / "report.json").read_text(encoding="utf-8"))
        if not self._is_unchanged(report):
            changed = Run(3, ["error: the scan has changed since its checksum was taken; run the cohort again"], 0, 0, 0)
            self.quarantine(changed, "mesh")
            return 0
        surface = folder / "thumbnail.stl"
        (folder / "thumbnail.png").write_bytes(thumbnail.picture(thumbnail.read_stl(surface)))
        surface.unlink()
        told = {os.path.relpath(file["path"], folder): file["sha256"] for file in report["files"]}  # by the program itself
        made = [name for name in told if (folder / name).is_file() and name not in reports]
        sums = {name: {"sha256": told.get(name), "bytes": (folder / name).stat().st_size}
                for name in [*made, *reports, "thumbnail.png"]}
        mesh_sha256 = hashing.joint_sha256([(name, told[name]) for name in mesh_files.files_of(mesh, made)])
        verdict = "flagged" if run.status == UNMET else "meshed"
        result = {
            **self._head(verdict), "exit_status": run.status, "message": run.reason() if run.status else "",
            "mesh": mesh, "mesh_sha256": mesh_sha256, "files": sums,
            "seconds": round(run.seconds, 3), "cpu_seconds": round(run.cpu_seconds, 3), "memory_bytes": run.memory_bytes,
            "threads": threads, "attempt": attempt, "host": socket.gethostname()}
        files.write_json(folder / "result.json", result)
        folder.rename(self.layout.store(self.key))
        files.write_json(self.layout.result(self.key), result)
        self.log.write(verdict, key=self.key, scan=self.scan["path"], exit_status=run.status,
                       seconds=round(run.seconds, 3), memory_bytes=run.memory_bytes, mesh_sha256=mesh_sha256)
        return 0


def main(words: List[str]) -> int:
    kind, output, rest = words[0], words[1], words[2:]
    if kind == "plan":
        for key in rest:
            Job(output, key).plan()
        return 0
    key, threads, attempt, attempts = rest
    return Job(output, key).mesh(int(threads), int(attempt), int(attempts))


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
