"""Runs every example of the documentation and of the program's help, or checks that another test does.

Kinds of blocks: sh (commands of scantet, run one by one in a folder with small inputs), inp (a deck, solved by CalculiX),
cpp and cmake (must be what a test builds), python (run by bindings/python/tests/run_examples.py, and those of VTK, ParaView and
3D Slicer by bindings/vtk/tests, bindings/paraview/tests and tests/install/slicer_test.py; README has to have some of each), text (no example). Any other kind is a fault: write the test for it first.
"""
import argparse
import os
import pathlib
import re
import shlex
import shutil
import subprocess
import sys
import tempfile

from blocks import blocks_of, pages_of
from example_inputs import write_inputs

# Inputs that scantet itself makes of the others.
PREPARATIONS = (
    "scantet mesh head.nii.gz --level 60 --size 4 -o ours.vtu -o theirs.msh -o skull.stl",
    "scantet convert cloud.nrrd cloud.vdb",
)


class Examples:
    def __init__(self, arguments, folder):
        self.root = pathlib.Path(arguments.root)
        self.ccx = arguments.ccx
        self.folder = folder
        self.environment = {**os.environ, "OMP_NUM_THREADS": "1",
                            "PATH": os.path.dirname(arguments.program) + os.pathsep + os.environ["PATH"]}
        self.built = [path.read_text() for folder in ("tests/install/plugin", "bindings/vtk/example")
                      for path in sorted((self.root / folder).iterdir())]
        self.faults = []
        self.counts = {}
        self.hosts = set()  # of README's lines

    def fault(self, place, what):
        self.faults.append(f"{place}: {what}")
        print(self.faults[-1], file=sys.stderr, flush=True)

    def run(self, words, place):
        """Whether the command ended well."""
        done = subprocess.run(words, cwd=self.folder, env=self.environment, stdin=subprocess.DEVNULL, text=True,
                              capture_output=True, timeout=120)
        if done.returncode != 0:
            self.fault(place, f"{shlex.join(words)}: exit status {done.returncode}: {done.stderr or done.stdout}")
        return done.returncode == 0

    def run_sh(self, block):
        for offset, line in enumerate(block.lines, 1):
            words = shlex.split(line, comments=True)
            if not words:
                continue
            if words[0] != "scantet" or line.endswith("\\"):
                self.fault(block.place(offset), f"not one command of scantet: {line}")
            else:
                self.run(words, block.place(offset))

    def run_inp(self, block):
        if not self.ccx:
            print(f"{block.place()}: not solved: ccx (CalculiX) was not found")
            return
        (self.folder / "deck.inp").write_text(block.text())
        if not self.run([self.ccx, "-i", "deck"], block.place()):
            return
        printed = (self.folder / "deck.dat").read_text()
        numbers = re.findall(r"[-+]\d\.\d+E[-+]\d+", printed)
        if not any(float(number) != 0 for number in numbers):
            self.fault(block.place(), f"no displacement is printed: {printed[:300]}")
        if not (self.folder / "deck.frd").read_text().strip().endswith("9999"):
            self.fault(block.place(), "the results for viewers are not whole")

    def run_built(self, block):
        """README's are built by docs.simulator_builds_and_runs."""
        if block.page != "README.md" and block.text() not in self.built:
            self.fault(block.place(), "no test builds this block: it must be a file of tests/install/plugin or of bindings/vtk/example")

    def run_text(self, block):
        for offset, line in enumerate(block.lines, 1):
            if re.match(r"\s*(\$ )?scantet (mesh|info|report|convert|plugins)\b", line):
                self.fault(block.place(offset), f"can be run, so its block must be sh: {line}")

    def run_help(self):
        """An example in help is a line with what it does, from #, and the command below it."""
        for command in ("mesh", "info", "report", "convert", "plugins", "cohort"):
            help_text = subprocess.run(["scantet", command, "--help"], env=self.environment, text=True,
                                       capture_output=True, check=True).stdout
            found = re.findall(r"^  # .*\n  (scantet .*)$", help_text, re.MULTILINE)
            if not found:
                self.fault(f"scantet {command} --help", "it shows no example")
            for example in found:
                self.run(shlex.split(example), f"scantet {command} --help")

    def run_pages(self):
        kinds = {"sh": self.run_sh, "inp": self.run_inp, "cpp": self.run_built, "cmake": self.run_built,
                 "text": self.run_text,
                 "python": lambda block: None,  # run by python.examples
                 "mermaid": lambda block: None}  # a diagram, which the architecture tests read
        for page in pages_of(self.root):
            try:
                blocks = blocks_of(self.root, page)
            except ValueError as error:
                self.fault("a page", error)
                continue
            for block in blocks:
                self.counts[block.kind] = self.counts.get(block.kind, 0) + 1
                if page == "README.md" and block.kind in ("python", "cpp"):
                    self.hosts.add(block.host())
                if block.kind in kinds:
                    kinds[block.kind](block)
                else:
                    self.fault(block.place(), f"unknown kind of block: {block.kind!r}")


def main():
    parser = argparse.ArgumentParser()
    for name in ("root", "program", "plugin", "level-set-maker"):
        parser.add_argument("--" + name, required=True)
    parser.add_argument("--ccx", default="")
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory(prefix="scantet_docs_") as name:
        folder = pathlib.Path(name)
        write_inputs(folder)
        shutil.copy(arguments.plugin, folder / "ellipsoid.so")
        examples = Examples(arguments, folder)
        examples.run(["/usr/bin/python3", str(examples.root / "scripts/tutorials.py"), "--scans", "."], "scripts/tutorials.py")
        shutil.copy(pathlib.Path(arguments.root) / "sample_volumes" / "tanglecube.nrrd", folder)
        examples.run([arguments.level_set_maker, "liver.vdb"], "liver.vdb")
        for command in PREPARATIONS:
            examples.run(shlex.split(command), "preparation")
        examples.run_help()
        examples.run_pages()
    print("blocks:", ", ".join(f"{count} {kind}" for kind, count in sorted(examples.counts.items())))
    for kind in ("sh", "inp", "cpp"):
        if kind not in examples.counts:
            examples.fault("the pages", f"no {kind} block was found")
    for host in {"", "vtk", "paraview", "slicer", "itk"} - examples.hosts:
        examples.fault("README.md", f"it has no lines for {host or 'Python'}")
    return 1 if examples.faults else 0


if __name__ == "__main__":
    sys.exit(main())
