"""Where everything is in the output folder. What is for people is in plain sight, the machinery in `.scantet`."""
import dataclasses
import pathlib


@dataclasses.dataclass(frozen=True)
class Layout:
    output: pathlib.Path

    @property
    def inner(self) -> pathlib.Path:
        return self.output / ".scantet"

    @property
    def manifest(self) -> pathlib.Path:
        """Which scans there are, with their keys: what the last participant level saw."""
        return self.inner / "manifest.json"

    @property
    def settings(self) -> pathlib.Path:
        """What jobs need to know: program, options, formats."""
        return self.inner / "settings.json"

    @property
    def hashes(self) -> pathlib.Path:
        """Checksums of inputs by path, size and time, so that no scan is read twice for its checksum."""
        return self.inner / "hashes.json"

    @property
    def run_lock(self) -> pathlib.Path:
        return self.inner / "run.lock"

    @property
    def log(self) -> pathlib.Path:
        return self.output / "logs" / "cohort.jsonl"

    def job_log(self, key: str) -> pathlib.Path:
        return self.output / "logs" / "jobs" / key[:2] / f"{key}.jsonl"

    def job(self, key: str) -> pathlib.Path:
        """The scan's path and identity, for its jobs."""
        return self.inner / "jobs" / key[:2] / f"{key}.json"

    @property
    def trial(self) -> pathlib.Path:
        """What the trial of the machine took in the first plan, for the others."""
        return self.inner / "trial.json"

    def plan(self, key: str) -> pathlib.Path:
        return self.inner / "plans" / key[:2] / f"{key}.json"

    def result(self, key: str) -> pathlib.Path:
        """The verdict on a key; once it is there, the key is done."""
        return self.inner / "results" / key[:2] / f"{key}.json"

    def store(self, key: str) -> pathlib.Path:
        """The folder with the files made for a key."""
        return self.inner / "store" / key[:2] / key

    def lock(self, key: str) -> pathlib.Path:
        return self.inner / "locks" / key[:2] / f"{key}.lock"
