"""Runs of one program, each in a process of its own with limits on files and processor time. Where a C compiler is there,
the processes are forks of one that has loaded the program's libraries (fork_server.c); else each is started anew.
Standard library only.

A sanitizer of a sanitized program writes what it finds into a folder, whatever process of the run finds it: the children
in which the program reads files have no standard error, and their exit status is the program's to judge. What is found
in one of them is told apart: it is there that libraries may fail.
"""
import dataclasses
import os
import resource
import select
import shutil
import signal
import struct
import subprocess
from pathlib import Path

SERVER = Path(__file__).with_name("fork_server.c")
SUPPRESSIONS = Path(__file__).resolve().parent.parent / "tests" / "lsan.supp"
MOST_FILE_BYTES = 1 << 28
FINDING_STATUS = 99
# A run that has used next to no processor time in so long is waiting for something that does not come.
STALL_S, STALL_USED_S = 120, 0.3


@dataclasses.dataclass
class Run:
    command: list
    process: int
    code: int | None  # none: killed, as it took too long
    seconds: float  # of processors
    memory: int  # largest resident bytes
    errors: bytes = b""
    findings: list = dataclasses.field(default_factory=list)  # texts of sanitizers, about the process itself
    contained: list = dataclasses.field(default_factory=list)  # the same, about its children
    left: list = dataclasses.field(default_factory=list)  # files that it should not have left


def sanitizer_environment(log):
    """log: the beginning of the names of files. What is said of the order of libraries is of no meaning: the server's
    library, which comes first, replaces nothing that a sanitizer does."""
    common = f"log_path={log}:exitcode={FINDING_STATUS}"
    return {"ASAN_OPTIONS": f"{common}:verify_asan_link_order=0:allocator_may_return_null=1:detect_stack_use_after_return=1",
            "UBSAN_OPTIONS": f"{common}:print_stacktrace=1:halt_on_error=1",
            "LSAN_OPTIONS": f"suppressions={SUPPRESSIONS}:print_suppressions=0"}


def used_by(process):
    """Seconds of processors that a process and its children have used so far; 0 if it is gone."""
    try:
        fields = Path(f"/proc/{process}/stat").read_text().rsplit(")", 1)[1].split()
        own = sum(int(field) for field in fields[11:15]) / os.sysconf("SC_CLK_TCK")
        tasks = [task.read_text().split() for task in Path(f"/proc/{process}/task").glob("*/children")]
        return own + sum(used_by(child) for children in tasks for child in children)
    except (OSError, IndexError):
        return 0


class Runner:
    """folder: for the library that makes a server of the program, for what runs say and sanitizers find. most_cpu_s: of
    one process of a run, which is killed then."""

    def __init__(self, program, folder, most_cpu_s, is_sanitized=False):
        folder.mkdir(parents=True, exist_ok=True)
        self.program = str(program)
        self.most_cpu_s = most_cpu_s
        self.errors = folder / "stderr"
        self.findings = folder / "findings"
        self.findings.mkdir(exist_ok=True)
        self.environment = {**os.environ, **(sanitizer_environment(self.findings / "found") if is_sanitized else {})}
        self.server = None
        compiler = shutil.which("cc") or shutil.which("gcc")
        if compiler:
            library = folder / "fork_server.so"
            subprocess.run([compiler, "-shared", "-fPIC", "-O1", "-Wall", "-Wextra", "-Werror", "-o", library, SERVER, "-ldl"], check=True)
            # Not OpenVDB, in a folder of its own there: the log4cplus that it brings along starts threads when it is loaded
            # and waits for them at exit(), and a fork has none of them.
            plugins = Path(program).resolve().parent.parent / "lib" / "scantet" / "plugins"
            self.server = subprocess.Popen([self.program], stdin=subprocess.PIPE, stdout=subprocess.PIPE, bufsize=0,
                                           start_new_session=True,
                                           env={**self.environment, "LD_PRELOAD": str(library), "LD_BIND_NOW": "1",
                                                "FORK_SERVER_OPENS": ":".join(map(str, sorted(plugins.glob("*.so"))))})

    def run(self, words, folder):
        """The program with these words in this folder."""
        done = self.ask(words, folder) if self.server else self.start(words, folder)
        if done.code == -signal.SIGKILL and done.seconds > self.most_cpu_s - 1:
            done.code = None
        done.errors = self.errors.read_bytes()
        for file in sorted(self.findings.iterdir()):
            is_own = file.suffix == f".{done.process}"
            (done.findings if is_own else done.contained).append(file.read_text(errors="replace"))
            file.unlink()
        return done

    def ask(self, words, folder):
        text = b"".join(str(w).encode("utf-8", "surrogateescape") + b"\0"
                        for w in [folder, self.errors, self.most_cpu_s, self.program, *words])
        self.server.stdin.write(struct.pack("<I", len(text)) + text)
        child, = struct.unpack("<i", self.answer(4))
        killed = self.wait_or_kill(child, lambda: select.select([self.server.stdout], [], [], STALL_S)[0])
        status, user, system, kilobytes = struct.unpack("<4q", self.answer(32))
        return Run([self.program, *words], child, None if killed else os.waitstatus_to_exitcode(status),
                   (user + system) / 1e6, kilobytes * 1024)

    def answer(self, size):
        got = b""
        while len(got) < size:
            more = self.server.stdout.read(size - len(got))
            if not more:
                raise RuntimeError("the fork server has ended")
            got += more
        return got

    @staticmethod
    def wait_or_kill(child, is_done):
        """is_done: waits for STALL_S. Whether the child stalled and was killed."""
        used = 0
        while not is_done():
            now = used_by(child)
            if now - used < STALL_USED_S:
                os.kill(child, signal.SIGKILL)
                return True
            used = now
        return False

    def limit(self):
        resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
        resource.setrlimit(resource.RLIMIT_FSIZE, (MOST_FILE_BYTES, MOST_FILE_BYTES))
        resource.setrlimit(resource.RLIMIT_CPU, (self.most_cpu_s, self.most_cpu_s))

    def start(self, words, folder):
        command = [self.program, *words]
        with open(self.errors, "wb") as errors:
            child = subprocess.Popen(command, cwd=folder, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL,
                                     stderr=errors, preexec_fn=self.limit, env=self.environment)
        ended = os.pidfd_open(child.pid)
        killed = self.wait_or_kill(child.pid, lambda: select.select([ended], [], [], STALL_S)[0])
        os.close(ended)
        _, status, usage = os.wait4(child.pid, 0)
        child.returncode = 0
        return Run(command, child.pid, None if killed else os.waitstatus_to_exitcode(status), usage.ru_utime + usage.ru_stime,
                   usage.ru_maxrss * 1024)

    def close(self):
        """Ends the server."""
        if self.server:
            self.server.stdin.close()
            self.server.wait()
            self.server.stdout.close()
            self.server = None
