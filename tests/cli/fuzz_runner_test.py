"""What scripts/fork_runner.py says of runs: fuzz_runner_test.py SCRIPTS. A small program stands for scantet built with a
sanitizer: its child reads, has no standard error, and its status is not the program's."""
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

sys.path.insert(0, sys.argv[1])
from fork_runner import Runner  # noqa: E402

SOURCE = r"""
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>
static void touch(int overflows) {
  char* bytes = malloc(8);
  volatile int at = overflows ? 8 : 7;
  bytes[at] = 1;
  free(bytes);
}
int main(int count, char** words) {
  const char* what = count > 1 ? words[1] : "";
  if (strcmp(what, "loop") == 0) for (volatile int i = 0;; ++i) {}
  const pid_t child = fork();
  if (child == 0) {
    dup2(open("/dev/null", O_RDWR), 2);
    touch(strcmp(what, "child overflow") == 0);
    _exit(0);
  }
  waitpid(child, NULL, 0);
  fputs("scantet: error: the file is damaged\n", stderr);
  touch(strcmp(what, "overflow") == 0);
  return 3;
}
"""


class FuzzRunner(unittest.TestCase):
    def setUp(self):
        self.folder = Path(tempfile.mkdtemp())
        self.addCleanup(shutil.rmtree, self.folder)
        (self.folder / "a.c").write_text(SOURCE)
        subprocess.run(["cc", "-fsanitize=address", "-o", self.folder / "a", self.folder / "a.c"], check=True)

    def look(self, has_server):
        runner = Runner(self.folder / "a", self.folder / "runner", 2, is_sanitized=True)
        self.addCleanup(runner.close)
        if not has_server:
            runner.close()  # then runs are started anew
        sound, own, of_child, looped = (runner.run([word], self.folder)
                                        for word in ("sound", "overflow", "child overflow", "loop"))
        for run in (sound, own, of_child):
            self.assertIn(b"error: the file is damaged", run.errors)
        self.assertEqual([sound.code, own.code, of_child.code], [3, 99, 3])
        self.assertEqual([len(run.findings) for run in (sound, own, of_child)], [0, 1, 0])
        self.assertEqual([len(run.contained) for run in (sound, own, of_child)], [0, 0, 1])
        for text in own.findings + of_child.contained:
            self.assertIn("heap-buffer-overflow", text)
        self.assertIsNone(looped.code, "killed by its limit of processor time")
        self.assertEqual(looped.findings, [])

    def test_findings_are_seen_and_those_of_children_told_apart(self):
        self.look(has_server=True)

    def test_so_they_are_without_the_server(self):
        self.look(has_server=False)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
