"""Damaged inputs through the program. Standard library only.

    fuzz.py [--count N] [--seed S] [--jobs N] [--minutes M] [--kinds A,B,...] [--sanitized] [--broken FOLDER] PROGRAM FOLDER

Each kind of input has a few sound files (fuzz_kinds.py); a mutation flips bits, cuts, splices, repeats or, in text, swaps
numbers. Sound outcomes are the exit statuses 0, 2, 3, 4 and 5 with a message where there is an error. Faults: a signal,
status 1, no message, more than 10 s of processor time, more memory (of the program or of its child) than 200 MB and four
times what the same command takes for the sound file, files left over, what a sanitizer finds in the program. What it finds
in a child that reads for the program is counted as "contained": these children are there because libraries fail on such
files, and all that is taken from them is checked. A damaged plugin is code: it may loop, and its crash is status 1 with a
message.

The same seed makes the same files, on any number of jobs; kinds take turns, so that a run that is ended early, by --minutes,
SIGINT or SIGTERM, has all of them in its table. FOLDER/table is kept up to date, FOLDER/faults has the inputs that made one,
FOLDER/contained those with which a sanitizer found something in a child.
"""
import argparse
import collections
import dataclasses
import multiprocessing
import queue
import random
import re
import shutil
import signal
import sys
import time
from pathlib import Path

from fork_runner import Runner
from fuzz_kinds import CHECK, ROOT, kinds

MOST_S = 10
MOST_TIMES, SPARE_BYTES = 4, 200_000_000  # of memory
SANITIZED_TIMES, SANITIZED_SPARE = 20, 6  # times as much of each for a program that sanitizers watch
TURN = 50  # runs of a kind before the next
NUMBERS = [b"0", b"-1", b"1", b"2", b"7", b"255", b"65536", b"2147483647", b"2147483648", b"-2147483649", b"1e308",
           b"1e400", b"-1e-308", b"nan", b"inf", b"99999999999999999999", b"0.5", b"3 3", b"", b"%d", b"%n%s", b"A" * 300]
NESTS = [b"[", b"(", b"{\"a\":", b"<a>", b"-"]
COLUMNS = ["signal", "status 1", "slow", "memory", "left over", "no message", "found"]
CONTAINED = "contained"  # no fault


def damage(data, rng, text):
    data = bytearray(data)
    for _ in range(rng.choice([1, 1, 2, 5, 20])):
        how = rng.random()
        size = len(data)
        if size == 0:
            return bytes(rng.randbytes(10))
        near = min(size, rng.choice([64, 512, 4096, size]))
        at = rng.randrange(near)
        if text and how < 0.02:  # deep nesting, where a reader may call itself
            data[at:at] = rng.choice(NESTS) * rng.choice([200, 100_000])
        elif text and how < 0.5:
            places = list(re.finditer(rb"[-+]?[0-9][0-9.eE+-]*", bytes(data[:near])))
            if places:
                place = rng.choice(places)
                data[place.start():place.end()] = rng.choice(NUMBERS)
        elif how < 0.65:
            data[at] ^= 1 << rng.randrange(8)
        elif how < 0.75:
            data[at:at + 4] = rng.choice([b"\xff\xff\xff\xff", b"\0\0\0\0", b"\xff\xff\xff\x7f", b"\0\0\0\x80"])
        elif how < 0.85:
            other = rng.randrange(size)
            length = rng.choice([1, 4, 16, 200])
            data[at:at + length] = data[other:other + length]
        elif how < 0.92:
            del data[at:at + rng.choice([1, 2, 8, 100])]
        elif how < 0.97:
            data[at:at] = data[at:at + rng.choice([1, 8, 64])] * rng.choice([1, 2, 50])
        else:
            del data[rng.randrange(size):]
    return bytes(data)


@dataclasses.dataclass
class Row:
    """What became of the runs of a kind."""
    runs: int = 0
    statuses: collections.Counter = dataclasses.field(default_factory=collections.Counter)
    faults: collections.Counter = dataclasses.field(default_factory=collections.Counter)
    seconds: float = 0  # the most
    memory: int = 0

    def add(self, other):
        self.runs += other.runs
        self.statuses.update(other.statuses)
        self.faults.update(other.faults)
        self.seconds = max(self.seconds, other.seconds)
        self.memory = max(self.memory, other.memory)

    def text(self, name):
        shown = " ".join(f"{code}:{times}" for code, times in sorted(self.statuses.items(), key=str))
        return (f"{name:16} {self.runs:6}  {shown:40}" +
                "".join(f" {self.faults[column]:10}" for column in [*COLUMNS, CONTAINED]) +
                f" {self.seconds:6.1f} {self.memory / 1e6:6.0f}")


def table(rows):
    total = Row()
    for row in rows.values():
        total.add(row)
    head = (f"{'kind':16} {'runs':>6}  {'statuses':40}" + "".join(f" {column:>10}" for column in [*COLUMNS, CONTAINED]) +
            f" {'most s':>6} {'MB':>6}")
    return "\n".join([head, *(row.text(name) for name, row in rows.items()), total.text("all")]) + "\n"


class Worker:
    """Every `jobs`-th of the runs, from `index` on."""

    def __init__(self, index, options):
        self.options = options
        self.index = index
        self.times = SANITIZED_TIMES if options.sanitized else 1
        self.folder = options.folder / f"work{index}"
        self.folder.mkdir(parents=True)
        self.kinds = kinds(options.program, self.folder, options.broken)
        self.runners = {}
        self.sound_memory = {}

    def runner(self, name):
        if name not in self.runners:
            program = Path(self.options.program).with_name(name)
            most_s = 2 * MOST_S * self.times
            self.runners[name] = Runner(program, self.options.folder / f"runner{self.index}" / name, most_s,
                                        self.options.sanitized)
        return self.runners[name]

    def run_on(self, data, name, command):
        """Runs the command on a file of this name and content; what it writes is taken away again."""
        typed = data[:100_000].decode("utf-8", "replace").replace("\0", "?") if name.endswith(".txt") else ""
        (self.folder / name).write_bytes(data)
        before = {path.name for path in self.folder.iterdir()}
        program, words = (CHECK, command[1:]) if command[0] == CHECK else (Path(self.options.program).name, command)
        done = self.runner(program).run([w.replace("FILE", name).replace("TEXT", typed) for w in words], self.folder)
        after = {path.name for path in self.folder.iterdir()}
        done.left = [extra for extra in after - before if done.code not in (0, 4) or extra.startswith(".scantet-")]
        for extra in after - before:
            (self.folder / extra).unlink()
        (self.folder / name).unlink(missing_ok=True)
        return done

    def most_memory(self, kind, name, command):
        """Bytes that a run may take; of a file that never was sound, by the kind's sound ones."""
        names = [name] if name in kind.files else list(kind.files) or [name]
        most = 0
        for sound in names:
            key = (id(kind), sound, *command)
            if key not in self.sound_memory:
                done = self.run_on(kind.files.get(sound, kind.broken.get(sound)), sound, command)
                if sound in kind.files and done.code not in (0, 4) and command[0] != CHECK:
                    raise RuntimeError(f"{sound}, undamaged: {done}")
                self.sound_memory[key] = done.memory
            most = max(most, self.sound_memory[key])
        return MOST_TIMES * most + SPARE_BYTES * (SANITIZED_SPARE if self.options.sanitized else 1)

    def faults_of(self, kind, done, most_memory):
        faults = []
        if done.code is not None and done.code < 0:
            faults.append("signal")
        if done.findings and not kind.is_code:
            faults.append("found")
        if done.code == 1 and not kind.is_code:
            faults.append("status 1")
        if (done.code is None or done.seconds > MOST_S * self.times) and not kind.is_code:
            faults.append("slow")
        if done.memory > most_memory and not kind.is_code:
            faults.append("memory")
        if done.left:
            faults.append("left over")
        if done.code not in (0, 4, None) and (b"error: " not in done.errors or done.errors.strip().endswith(b"error:")):
            faults.append("no message")
        return faults

    def one(self, label, n):
        kind = self.kinds[label]
        rng = random.Random(f"{self.options.seed} {label} {n}")
        files = {**kind.files, **kind.broken}
        name = rng.choice(sorted(files))
        data = damage(files[name], rng, kind.text)
        command = rng.choice(kind.commands)
        most_memory = self.most_memory(kind, name, command)
        done = self.run_on(data, name, command)
        faults = self.faults_of(kind, done, most_memory)
        if faults or done.contained:
            place = self.options.folder / ("faults" if faults else CONTAINED) / "_".join([label, str(n), *faults]).replace(" ", "_")
            place.mkdir(parents=True)
            (place / Path(name).name).write_bytes(data)
            (place / "command").write_text(f"{done.command!r}\nstatus {done.code}, {done.seconds:.1f} s, {done.memory} bytes"
                                           f"\n{done.errors.decode('utf-8', 'replace')}\n" +
                                           "\n".join(done.findings + done.contained))
        if done.contained:
            faults.append(CONTAINED)
        status = "killed" if done.code is None else done.code
        counts = kind.is_code or done.code is None
        return Row(1, collections.Counter([status]), collections.Counter(faults), 0 if counts else done.seconds,
                   0 if counts else done.memory)

    def close(self):
        for runner in self.runners.values():
            runner.close()


def work(index, options, wanted, results, stop):
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    signal.signal(signal.SIGTERM, signal.SIG_IGN)
    try:
        worker = Worker(index, options)
        each = -(-options.count // len(wanted))  # rounded up: never fewer in all
        for turn in range(0, each, TURN):
            for label in wanted:
                row = Row()
                for n in range(turn, min(turn + TURN, each)):
                    if n % options.jobs == index and not stop.is_set():
                        row.add(worker.one(label, n))
                results.put((label, row))
        worker.close()
        results.put((None, None))
    except Exception as error:  # the others go on, and the run fails
        results.put((None, repr(error)))
        raise


def run_all(options, wanted):
    """{kind: Row}, and what broke the runs themselves."""
    results = multiprocessing.Queue()
    stop = multiprocessing.Event()
    workers = [multiprocessing.Process(target=work, args=(index, options, wanted, results, stop))
               for index in range(options.jobs)]
    for worker in workers:
        worker.start()
    for ending in (signal.SIGINT, signal.SIGTERM):
        signal.signal(ending, lambda *_: stop.set())
    rows = {label: Row() for label in wanted}
    end = time.monotonic() + 60 * options.minutes if options.minutes else float("inf")
    troubles = []
    left = options.jobs
    while left:
        if time.monotonic() > end:
            stop.set()
        try:
            label, row = results.get(timeout=1)
        except queue.Empty:
            continue
        if label is None:
            left -= 1
            troubles += [row] if row else []
            continue
        rows[label].add(row)
        (options.folder / "table").write_text(table(rows))
    for worker in workers:
        worker.join()
    return rows, troubles


def read_options():
    parser = argparse.ArgumentParser(description="Damaged inputs through the program.")
    parser.add_argument("--count", type=int, default=2000, help="damaged files in all, at least (default %(default)s)")
    parser.add_argument("--seed", default="1", help="which ones (default %(default)s)")
    parser.add_argument("--jobs", type=int, default=1, help="processes side by side (default %(default)s)")
    parser.add_argument("--minutes", type=float, default=0, help="ends after so long; default: never")
    parser.add_argument("--kinds", default="", help="names with commas between; default: all")
    parser.add_argument("--sanitized", action="store_true", help="the program is built with sanitizers")
    shared = ROOT.parent / "shared" / "broken"
    parser.add_argument("--broken", type=Path, default=shared if shared.is_dir() else ROOT / "tests" / "fuzz" / "corpus",
                        help="folder of files that once did harm (default %(default)s)")
    parser.add_argument("program")
    parser.add_argument("folder", type=Path, help="made anew: what runs need, the table and what made a fault")
    options = parser.parse_args()
    options.program = str(Path(options.program).resolve())
    options.folder = options.folder.resolve()
    if options.jobs < 1 or options.count < 1:
        parser.error("--jobs and --count are from 1 on")
    return options


def main():
    options = read_options()
    shutil.rmtree(options.folder, ignore_errors=True)
    probe = options.folder / "probe"
    probe.mkdir(parents=True)
    known = list(kinds(options.program, probe, options.broken))
    wanted = options.kinds.split(",") if options.kinds else known
    if not set(wanted) <= set(known):
        sys.exit("--kinds: choose of " + ", ".join(known))
    rows, troubles = run_all(options, wanted)
    print(table(rows), end="")
    faults = sum(row.faults[column] for row in rows.values() for column in COLUMNS)
    if faults:
        print(f"{faults} faults, kept in {options.folder}/faults", file=sys.stderr)
    for trouble in troubles:
        print(f"a job ended early: {trouble}", file=sys.stderr)
    return 1 if faults or troubles else 0


if __name__ == "__main__":
    sys.exit(main())
