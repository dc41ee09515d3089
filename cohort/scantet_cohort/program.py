"""The program that meshes, and running it."""
import dataclasses
import os
import pathlib
import shutil
import subprocess
import tempfile
import time
from typing import List, Optional, Sequence

from scantet_cohort.errors import CohortError


def find_program() -> pathlib.Path:
    """`scantet cohort` names itself in SCANTET_PROGRAM; otherwise the one in PATH."""
    name = os.environ.get("SCANTET_PROGRAM") or shutil.which("scantet")
    if not name:
        raise CohortError("the program scantet was not found", "start this with `scantet cohort`")
    return pathlib.Path(name).resolve()


def version_of(program: pathlib.Path) -> str:
    done = subprocess.run([str(program), "--version"], capture_output=True, text=True, check=False)
    if done.returncode != 0:
        raise CohortError(f"{program} --version failed: {done.stderr.strip()}", "install scantet again")
    return done.stdout.strip()


@dataclasses.dataclass(frozen=True)
class Run:
    """How a run of the program ended, and what it took."""

    status: int  # exit status; minus the signal's number if a signal ended it
    messages: List[str]  # the lines on the standard error stream
    seconds: float
    cpu_seconds: float
    memory_bytes: int

    def reason(self) -> str:
        """The errors in one line, with the hint."""
        prefix = "scantet: "
        lines = [line[len(prefix):] if line.startswith(prefix) else line for line in self.messages]
        told = [line for line in lines if line.startswith(("error:", "hint:", "unmet:"))] or lines[-2:]
        if self.status < 0:
            told.insert(0, f"ended by signal {-self.status}")
        return "; ".join(line.split("error: ", 1)[-1] for line in told) or f"exit status {self.status}"


def run_program(words: Sequence[str], folder: Optional[str] = None) -> Run:
    """Runs the program and measures it alone, not what ran before it. In the folder, if there is such a one. Messages quote
    files, so their bytes need be no text."""
    begin = time.monotonic()
    with tempfile.TemporaryFile("w+", encoding="utf-8", errors="backslashreplace") as errors:
        process = subprocess.Popen(list(words), stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=errors,
                                   cwd=folder if folder and os.path.isdir(folder) else None)
        _, status, usage = os.wait4(process.pid, 0)
        process.returncode = os.waitstatus_to_exitcode(status)
        errors.seek(0)
        messages = [line.rstrip("\n") for line in errors]
    return Run(process.returncode, messages, time.monotonic() - begin, usage.ru_utime + usage.ru_stime,
               usage.ru_maxrss * 1024)
