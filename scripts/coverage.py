"""coverage.py BUILD: which lines and functions the tests of a build with --coverage ran, per module. Uses gcovr."""
import collections
import json
import os
import pathlib
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent


def module_of(file):
    parts = pathlib.PurePath(file).parts
    return parts[2] if parts[:2] == ("src", "scantet") else "/".join(parts[:2])


def share(covered, total):
    return f"{100 * covered / total:5.1f} %" if total else "   – "


def main():
    build = pathlib.Path(sys.argv[1]).resolve()
    summary = build / "coverage.json"
    subprocess.run(["gcovr", "--root", str(ROOT), "--filter", f"{ROOT}/src/", "--filter", f"{ROOT}/plugins/", "-j",
                    str(os.cpu_count()), "--json-summary", str(summary), str(build)], check=True)
    modules = collections.defaultdict(lambda: [0, 0, 0, 0])
    names = ("line_covered", "line_total", "function_covered", "function_total")
    files = json.loads(summary.read_text())["files"]
    for file in files:
        for at, name in enumerate(names):
            modules[module_of(file["filename"])][at] += file[name]
            modules["all"][at] += file[name]
    print("files with the least share of lines run:")
    for file in sorted((f for f in files if f["line_total"] >= 20), key=lambda f: f["line_covered"] / f["line_total"])[:15]:
        print(f"  {share(file['line_covered'], file['line_total'])}  {file['filename']}")
    print(f"\n{'module':20} {'lines':>7} {'run':>8} {'functions':>10} {'run':>8}")
    for name in sorted(modules, key=lambda n: (n == "all", "/" in n, n)):
        lines_run, lines, functions_run, functions = modules[name]
        print(f"{name:20} {lines:7} {share(lines_run, lines):>8} {functions:10} {share(functions_run, functions):>8}")


main()
