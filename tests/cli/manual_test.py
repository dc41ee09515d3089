"""Manual pages and completions, as man and the shells themselves take them: manual_test.py PROGRAM MANUAL_FOLDER."""
import gzip
import os
import pathlib
import pty
import re
import select
import shutil
import subprocess
import sys
import tempfile
import time
import unittest

PROGRAM, MANUAL = sys.argv[1], pathlib.Path(sys.argv[2])


def said(*words, **more):
    return subprocess.run(words, capture_output=True, text=True, check=True, timeout=60, **more).stdout


def options_of_commands():
    """What `scantet options` lists: for each command its options, with their dashes."""
    options, command = {}, None
    for line in said(PROGRAM, "options").splitlines():
        if line.startswith("## scantet "):
            command = line.split()[2]
            options[command] = set()
        elif line.startswith("| `"):
            options[command].update(re.findall(r"(?<![\w-])--?[a-z][a-z-]*", line.split("`")[1]))
    return options


def needs(tool):
    return unittest.skipUnless(shutil.which(tool), f"{tool} is not installed")


class Manual(unittest.TestCase):
    def pages(self):
        return {"scantet": said(PROGRAM, "man"),
                **{f"scantet-{command}": said(PROGRAM, "man", command) for command in options_of_commands()}}

    def test_every_option_of_every_command_has_its_paragraph(self):
        for command, options in options_of_commands().items():
            page = said(PROGRAM, "man", command).replace("\\-", "-").replace("\\fB", "").replace("\\fR", "")
            terms = re.findall(r"^\.TP\n(-.*)$", page, re.MULTILINE)
            listed = {word for term in terms for word in re.findall(r"(?<![\w-])--?[a-z][a-z-]*", term)}
            self.assertEqual(listed, options | {"-h", "--help"}, command)

    def test_what_is_installed_is_what_the_program_prints(self):
        for name, page in self.pages().items():
            with gzip.open(MANUAL / f"{name}.1.gz", "rt") as stored:
                self.assertEqual(stored.read(), page, name)

    @needs("man")
    def test_man_has_no_warnings(self):
        environment = {**os.environ, "LC_ALL": "C.UTF-8", "MANROFFSEQ": "", "MANWIDTH": "80"}
        for name, page in self.pages().items():
            done = subprocess.run(["man", "--warnings", "-E", "UTF-8", "-Tutf8", "-l", "-"], input=page, text=True,
                                  capture_output=True, env=environment, timeout=60)
            self.assertEqual((done.returncode, done.stderr), (0, ""), name)
            self.assertGreater(len(done.stdout), 1000, name)

    @needs("mandoc")
    def test_mandoc_has_no_warnings(self):
        for name, page in self.pages().items():  # there is no date, so that the same source makes the same page
            done = subprocess.run(["mandoc", "-T", "lint", "-W", "warning"], input=page, text=True, capture_output=True,
                                  timeout=60)
            faults = [line for line in done.stdout.splitlines() if "missing date" not in line]
            self.assertEqual(faults, [], name)


class Completion(unittest.TestCase):
    def script(self, shell):
        path = pathlib.Path(self.folder.name) / f"scantet.{shell}"
        path.write_text(said(PROGRAM, "completion", shell))
        self.assertEqual(path.read_text(), (MANUAL / f"completion.{shell}").read_text())
        return str(path)

    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()

    def tearDown(self):
        self.folder.cleanup()

    def in_bash(self, *words):
        """What bash's function offers for the last word."""
        typed = " ".join(f"'{word}'" for word in ("scantet", *words))
        return set(said("bash", "-c", f"source {self.script('bash')}; COMP_WORDS=({typed}); COMP_CWORD={len(words)}; "
                        "_scantet; printf '%s\\n' \"${COMPREPLY[@]}\"", cwd=self.folder.name).split())

    def test_bash_offers_every_option(self):
        said("bash", "-n", self.script("bash"))
        for command, options in options_of_commands().items():
            self.assertEqual(self.in_bash(command, "-"), options | {"-h", "--help"}, command)

    def test_bash_offers_commands_words_and_files(self):
        self.assertLessEqual({"mesh", "help", "man", "completion", "--version"}, self.in_bash(""))
        self.assertEqual(self.in_bash("mesh", "--space", ""), {"lps", "ras"})
        self.assertEqual(self.in_bash("mesh", "--space", "=", "r"), {"ras"})
        self.assertEqual(self.in_bash("mesh", "--inside", "a"), {"above", "automatic"})
        self.assertEqual(self.in_bash("mesh", "--alpha", ""), set())
        (pathlib.Path(self.folder.name) / "head.nii.gz").touch()
        for words in (["mesh", "hea"], ["mesh", "-o", "hea"], ["report", "x.vtu", "hea"], ["mesh", "--size", "hea"]):
            self.assertEqual(self.in_bash(*words), {"head.nii.gz"}, words)
        self.assertEqual(self.in_bash("completion", ""), {"bash", "zsh", "fish"})

    def type_into(self, shell, setting_up, typed, expected):
        """Starts the shell on a terminal, types, and waits until it shows what is expected."""
        child, terminal = pty.fork()
        if child == 0:
            os.environ.update(PS1="$ ", TERM="dumb", INPUTRC="/dev/null")
            os.execlp(shell[0], *shell)
        seen = ""

        def wait_for(text):
            nonlocal seen
            end = time.monotonic() + 30
            while text not in seen and time.monotonic() < end:
                if select.select([terminal], [], [], 0.1)[0]:
                    seen += os.read(terminal, 4096).decode(errors="replace")
            self.assertIn(text, seen)
        try:
            os.write(terminal, f"{setting_up}; echo rea''dy\n".encode())
            wait_for("\nready")
            os.write(terminal, typed.encode() + b"\t")
            wait_for(expected)
        finally:
            os.write(terminal, b"\x03exit\n")
            os.close(terminal)
            os.waitpid(child, 0)

    def test_a_tab_in_bash_completes(self):
        self.type_into(["bash", "--norc", "--noprofile", "-i"], f"source {self.script('bash')}", "scantet mesh --facet-d",
                       "scantet mesh --facet-distance ")

    @needs("zsh")
    def test_a_tab_in_zsh_completes(self):
        (pathlib.Path(self.folder.name) / "_scantet").write_text(said(PROGRAM, "completion", "zsh"))
        setting_up = f"fpath=({self.folder.name} $fpath); autoload -Uz compinit; compinit -u -d {self.folder.name}/dump"
        self.type_into(["zsh", "-f", "-i"], setting_up, "scantet verify --vertex-t", "olerance")
        self.type_into(["zsh", "-f", "-i"], setting_up, "scantet mesh --space r", "as")

    @needs("fish")
    def test_fish_completes(self):
        script = self.script("fish")
        said("fish", "-n", script)

        def offered(line):
            home = {**os.environ, "HOME": self.folder.name}
            text = said("fish", "--no-config", "-c", f"source {script}; complete -C '{line}'", env=home)
            return {each.split("\t")[0] for each in text.splitlines()}
        for command, options in options_of_commands().items():
            longs = {option for option in options if option.startswith("--")}
            self.assertEqual(offered(f"scantet {command} --"), longs | {"--help"}, command)
        self.assertEqual(offered("scantet mesh --space "), {"lps", "ras"})
        self.assertLessEqual({"mesh", "verify"}, offered("scantet "))

    @needs("zsh")
    def test_zsh_takes_the_script(self):
        script = self.script("zsh")
        said("zsh", "-n", script)
        text = pathlib.Path(script).read_text()
        for options in options_of_commands().values():
            for option in options:
                self.assertRegex(text, re.escape(option) + r"[=+]?\[")
        # As an autoloaded function: what _arguments is given for `scantet mesh` is well-formed.
        said("zsh", "-f", "-c", f"autoload -Uz compinit; compinit -u -d {self.folder.name}/dump; source {script}; "
             "[[ ${_comps[scantet]} == _scantet ]]")


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
