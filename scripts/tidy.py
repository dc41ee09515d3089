"""Runs clang-tidy with the tree's .clang-tidy over every source, or over those named, and prints what it finds.

usage: tidy.py [--database DIR] [--jobs N] [--cache DIR] [--summary] [PART...]

--database  the build folder with compile_commands.json; default build/asan-ubsan
--cache     results by what they follow from (the file, the headers of this tree that it includes, the flags, the
            configuration), so that only what changed is checked again; default build/tidy
--summary   counts by check and by folder instead of the findings
PART        sources whose path starts with one of these, such as src/scantet/base
Status 1 if anything is found.
"""
import argparse
import collections
import concurrent.futures
import hashlib
import json
import os
import pathlib
import re
import shlex
import subprocess
import sys
import time

ROOT = pathlib.Path(__file__).resolve().parent.parent
INCLUDE = re.compile(rb'^\s*#\s*include\s*[<"]([^>"]+)[>"]', re.MULTILINE)
FINDING = re.compile(r"^(/[^:]+):(\d+):(\d+): (?:warning|error): (.*) \[([^\]]+)\]$")


def included(path, folders, seen):
    """The file and what it includes of this tree, all the way down."""
    if path in seen:
        return
    seen.add(path)
    for name in INCLUDE.findall(path.read_bytes()):
        for folder in (path.parent, *folders):
            file = (folder / name.decode()).resolve()
            if file.is_file():
                if ROOT in file.parents:
                    included(file, folders, seen)
                break


def key_of(source, words, version):
    folders = [pathlib.Path(word[2:]) for word in words if word.startswith("-I")]
    files = set()
    included(source, folders, files)
    key = hashlib.sha256(version)
    for folder in (source.parent, *source.parent.parents):
        if (folder / ".clang-tidy").is_file():
            key.update((folder / ".clang-tidy").read_bytes())
    key.update(" ".join(word.replace(str(ROOT), "") for word in words).encode())
    for file in sorted(files):
        key.update(str(file.relative_to(ROOT)).encode() + file.read_bytes())
    return key.hexdigest()


def check(source, words, database, cache, version):
    """The findings of one source: [file, line, column, what, check]."""
    key = key_of(source, words, version)
    kept = cache / (key + ".json")
    if kept.exists():
        return json.loads(kept.read_text())
    run = subprocess.run(["clang-tidy", "--quiet", "-p", str(database), str(source)], capture_output=True, text=True)
    found = [[str(pathlib.Path(m[1]).resolve()).replace(str(ROOT) + "/", ""), int(m[2]), int(m[3]), m[4],
              m[5].replace(",-warnings-as-errors", "")] for m in map(FINDING.match, run.stdout.splitlines()) if m]
    if run.returncode != 0 and not found:
        return [[str(source.relative_to(ROOT)), 0, 0, (run.stderr or run.stdout).strip()[-500:], "clang-tidy-failed"]]
    if key_of(source, words, version) != key:  # edited meanwhile
        return found
    cache.mkdir(parents=True, exist_ok=True)
    part = kept.with_suffix(f".{os.getpid()}")
    part.write_text(json.dumps(found))
    part.rename(kept)
    return found


def folder_of(file):
    parts = pathlib.PurePath(file).parts
    return "/".join(parts[:3] if parts[:2] == ("src", "scantet") else parts[:2][: max(1, len(parts) - 1)])


def main():
    parser = argparse.ArgumentParser(usage=__doc__)
    parser.add_argument("--database", default="build/asan-ubsan")
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    parser.add_argument("--cache", default=os.environ.get("SCANTET_TIDY_CACHE", "build/tidy"))
    parser.add_argument("--summary", action="store_true")
    parser.add_argument("parts", nargs="*")
    wanted = parser.parse_args()
    os.chdir(ROOT)
    database, cache = pathlib.Path(wanted.database), pathlib.Path(wanted.cache)
    version = subprocess.run(["clang-tidy", "--version"], capture_output=True).stdout
    jobs = {}
    for entry in json.loads((database / "compile_commands.json").read_text()):
        source = (pathlib.Path(entry["directory"]) / entry["file"]).resolve()
        name = str(source).replace(str(ROOT) + "/", "")
        if not name.startswith(("/", "build/")) and (not wanted.parts or name.startswith(tuple(wanted.parts))):
            jobs.setdefault(source, shlex.split(entry["command"])[1:-4])
    found = set()
    start = time.monotonic()
    with concurrent.futures.ThreadPoolExecutor(wanted.jobs) as pool:
        running = [pool.submit(check, source, words, database, cache, version) for source, words in jobs.items()]
        for done, future in enumerate(concurrent.futures.as_completed(running), 1):
            new = {tuple(finding) for finding in future.result()} - found
            found |= new
            if not wanted.summary:
                for file, line, column, what, name in sorted(new):
                    print(f"{file}:{line}:{column}: {what} [{name}]", flush=True)
            if sys.stderr.isatty():
                print(f"\r{done} of {len(jobs)} sources", end="", file=sys.stderr)
    if wanted.summary:
        for title, at in (("check", lambda f: f[4]), ("folder", lambda f: folder_of(f[0]))):
            for name, count in collections.Counter(map(at, found)).most_common():
                print(f"{count:6} {title} {name}")
    print(f"{len(jobs)} sources, {len(found)} findings, {time.monotonic() - start:.0f} s")
    return 1 if found or not jobs else 0


if __name__ == "__main__":
    sys.exit(main())
