"""Files that once made the program crash, hang or take all memory, each with the commands that did:
broken_files_test.py PROGRAM CORPUS SAMPLES. What it says of them may change, but not that it ends, soon, with a message, and
leaves nothing half done."""
import os
import shutil
import signal
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

PROGRAM, CORPUS, SAMPLES = sys.argv[1], Path(sys.argv[2]), Path(sys.argv[3])
LIMITED = ["--max-vertices", "2000", "-o", "out.vtu", "--quiet"]
SCANS = [["mesh", "FILE", "--level", "50", "--size", "5", *LIMITED], ["info", "FILE", "--json"]]
SURFACES = [["mesh", "FILE", "--size", size, *LIMITED, *repair] for size in ("5", "auto") for repair in ([], ["--repair"])]
CONFIGS = [["mesh", str(SAMPLES / "sphere.nrrd"), "--level", "127.5", "--config", "FILE", *LIMITED]]
COMMANDS = {".mha": SCANS, ".mhd": SCANS, ".nii": SCANS, ".nrrd": SCANS, ".vdb": SCANS, ".json": CONFIGS,
            ".obj": SURFACES, ".off": SURFACES, ".ply": SURFACES, ".stl": SURFACES}
KNOWN = (0, 2, 3, 4)  # done, wrong use, bad input, a mesh that lacks something
MOST_S = 120  # for machines that do other things; of the ones that hung none came to an end
MOST_BYTES = 1 << 30


class BrokenFiles(unittest.TestCase):
    def setUp(self):
        self.folder = Path(tempfile.mkdtemp())
        self.addCleanup(shutil.rmtree, self.folder)

    def run_on(self, words):
        """Return: (status, the most memory, in bytes, what it says)."""
        with open(self.folder / "errors", "wb") as errors:
            process = subprocess.Popen([PROGRAM, *words], cwd=self.folder, stdout=subprocess.DEVNULL, stderr=errors)
        signal.signal(signal.SIGALRM, lambda *_: process.kill())
        signal.alarm(MOST_S)
        _, status, usage = os.wait4(process.pid, 0)
        signal.alarm(0)
        process.returncode = os.waitstatus_to_exitcode(status)
        return process.returncode, 1024 * usage.ru_maxrss, (self.folder / "errors").read_text(errors="replace")

    def test_each_ends_with_a_message(self):
        files = sorted(path for path in CORPUS.rglob("*") if path.is_file())
        self.assertGreater(len(files), 20)
        for path in files:
            name = "x" + path.suffix
            shutil.copy(path, self.folder / name)
            for command in COMMANDS[path.suffix]:
                with self.subTest(file=path.name, command=command):
                    status, memory, errors = self.run_on([name if word == "FILE" else word for word in command])
                    self.assertIn(status, KNOWN, errors)
                    self.assertLess(memory, MOST_BYTES)
                    if status not in (0, 4):
                        self.assertRegex(errors, r"scantet: error: .+")
                        self.assertFalse((self.folder / "out.vtu").exists())
                    left = {entry.name for entry in self.folder.iterdir()}
                    self.assertLessEqual(left, {name, "errors", "out.vtu"})
                    (self.folder / "out.vtu").unlink(missing_ok=True)
            (self.folder / name).unlink()


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
