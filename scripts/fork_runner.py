"""Runs of one program, each in a process of its own with limits on files. Where a C compiler is there, the processes are
forks of one that has loaded the program's libraries (fork_server.c); else each is started anew. Standard library only.
"""
import dataclasses
import os
import resource
import select
import shutil
import signal
import struct
import subprocess
import time
from pathlib import Path

SERVER = Path(__file__).with_name("fork_server.c")
MOST_FILE_BYTES = 1 << 28


@dataclasses.dataclass
class Run:
    command: list
    code: int | None  # none: killed, as it took too long
    seconds: float  # of processors
    memory: int  # largest resident bytes
    errors: bytes
    left: list  # files that it should not have left


def limit():
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
    resource.setrlimit(resource.RLIMIT_FSIZE, (MOST_FILE_BYTES, MOST_FILE_BYTES))


class Runner:
    """folder: for the library that makes a server of the program, and for what runs say."""

    def __init__(self, program, folder):
        self.program = program
        self.errors = folder / "stderr"
        self.library = folder / "fork_server.so"
        self.server = None
        compiler = shutil.which("cc") or shutil.which("gcc")
        if compiler:
            subprocess.run([compiler, "-shared", "-fPIC", "-O1", "-Wall", "-Wextra", "-Werror", "-o", self.library, SERVER, "-ldl"], check=True)
            self.server = subprocess.Popen([program], stdin=subprocess.PIPE, stdout=subprocess.PIPE, bufsize=0,
                                           env={**os.environ, "LD_PRELOAD": str(self.library)})

    def run(self, words, folder, most_s):
        """The program with these words in this folder, killed after most_s on the clock."""
        done = self.ask(words, folder, most_s) if self.server else self.start(words, folder, most_s)
        return dataclasses.replace(done, errors=self.errors.read_bytes())

    def ask(self, words, folder, most_s):
        text = b"".join(str(w).encode("utf-8", "surrogateescape") + b"\0"
                        for w in [folder, self.errors, self.program, *words])
        self.server.stdin.write(struct.pack("<I", len(text)) + text)
        child, = struct.unpack("<i", self.answer(4))
        killed = not select.select([self.server.stdout], [], [], most_s)[0]
        if killed:
            os.kill(child, signal.SIGKILL)
        status, user, system, kilobytes = struct.unpack("<4q", self.answer(32))
        return Run([self.program, *words], None if killed else os.waitstatus_to_exitcode(status),
                   (user + system) / 1e6, kilobytes * 1024, b"", [])

    def answer(self, size):
        got = b""
        while len(got) < size:
            more = self.server.stdout.read(size - len(got))
            if not more:
                raise RuntimeError("the fork server has ended")
            got += more
        return got

    def start(self, words, folder, most_s):
        command = [self.program, *words]
        with open(self.errors, "wb") as errors:
            begin = time.monotonic()
            child = subprocess.Popen(command, cwd=folder, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL,
                                     stderr=errors, preexec_fn=limit)
            killed = False
            while True:
                pid, status, usage = os.wait4(child.pid, os.WNOHANG)
                if pid != 0:
                    break
                if time.monotonic() - begin > most_s and not killed:
                    child.kill()
                    killed = True
                time.sleep(0.002)
        child.returncode = 0
        code = None if killed else os.waitstatus_to_exitcode(status)
        return Run(command, code, usage.ru_utime + usage.ru_stime, usage.ru_maxrss * 1024, b"", [])
