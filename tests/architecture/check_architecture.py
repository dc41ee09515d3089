"""Checks the source tree against the rules of docs/architecture.md. Standard library only.

    check_architecture.py CHECK ROOT [clang-format program]

CHECK is one of arrows, page, core, headers, face, tests, sizes, format. Prints one line for each fault (file:line: what; remedy) and ends
with status 1 if there is any. check_architecture_test.py shows each check a tree with its faults.
"""
import re
import subprocess
import sys
from pathlib import Path

MAX_LINES = {".h": 200, ".cpp": 400}
MAX_FUNCTION_LINES = 60
REASON_WITHIN = 15  # lines from the top
CODE_FOLDERS = ("src", "tests", "sample_volumes", "benchmarks", "plugins", "examples", "bindings")
INCLUDE = re.compile(r'^\s*#\s*include\s*([<"])([^>"]+)[>"]')
CORE = ("delaunay", "sampling", "surface", "refine", "optimize")  # what knows an object through its Domain alone
TESTED = (*CORE, "topology")  # where each algorithm has a unit test of its own name
IMAGE_LIBRARIES = re.compile(r"\b(itk|vtk|openvdb)", re.IGNORECASE)


def code_files(root):
    for folder in CODE_FOLDERS:
        for path in sorted((root / folder).rglob("*")):
            if path.suffix in MAX_LINES and path.is_file():
                yield path


def read_lines(path):
    return path.read_text(encoding="utf-8").splitlines()


def includes(path):
    """(line number, '<' or '"', included name) of each #include."""
    for number, line in enumerate(read_lines(path), 1):
        match = INCLUDE.match(line)
        if match:
            yield number, match.group(1), match.group(2)


def is_private(name):
    return name.endswith("_impl.h") or "/detail/" in name


class Modules:
    """What the CMakeLists.txt of src/scantet/* declare.

    A folder may hold several modules: a file belongs to the one that lists the .cpp of its name (x_impl.h goes with
    x.cpp), or else to the one named after the folder. A folder that declares none is a program: it may include all.
    """

    def __init__(self, root):
        self.source_root = root / "src"
        self.needs = {}
        self.declared_in = {}
        self.owner = {}
        for lists in sorted((self.source_root / "scantet").glob("*/CMakeLists.txt")):
            text = re.sub(r"#[^\n]*", "", lists.read_text(encoding="utf-8"))
            for body in re.findall(r"scantet_module\s*\(([^)]*)\)", text):
                self.add(lists, body.split())

    def add(self, lists, words):
        name = words[0]
        values = {"SOURCES": [], "NEEDS": [], "PRIVATE": []}
        key = None
        for word in words[1:]:
            if word in values:
                key = word
            else:
                values[key].append(word)
        self.needs[name] = values["NEEDS"]
        self.declared_in[name] = lists
        for source in values["SOURCES"]:
            self.owner[lists.parent.name, Path(source).stem] = name

    def of(self, relative):
        """The module of scantet/<folder>/…/<file>, or None for a program."""
        parts = Path(relative).parts
        folder, stem = parts[1], Path(relative).stem.removesuffix("_impl")
        owner = self.owner.get((folder, stem), folder)
        return owner if owner in self.needs else None

    def files(self):
        """(path, module) of each file of a module."""
        for path in sorted((self.source_root / "scantet").rglob("*")):
            module = self.of(path.relative_to(self.source_root)) if path.suffix in MAX_LINES else None
            if module:
                yield path, module


def check_arrows(root):
    """A module includes the modules it declares in NEEDS, and no other; the arrows make no circle."""
    modules = Modules(root)
    used = {name: set() for name in modules.needs}
    for path, module in modules.files():
        for number, _, name in includes(path):
            if not name.startswith("scantet/"):
                continue
            target = modules.of(name)
            if target is None:
                yield f"{path}:{number}: includes {name}, which is in no module; a program's headers are its own"
            elif target != module:
                used[module].add(target)
                if target not in modules.needs[module]:
                    yield (f"{path}:{number}: module {module} includes {name} of module {target}; "
                           f"declare {target} in its NEEDS if the arrow is right, else remove the include")
    for name, needs in modules.needs.items():
        lists = modules.declared_in[name]
        for need in needs:
            if need not in modules.needs:
                yield f"{lists}: module {name} needs {need}, which is no module"
            elif need not in used[name]:
                yield f"{lists}: module {name} declares that it needs {need}, and includes nothing of it; remove it"
        if name in reachable(modules.needs, name):
            yield f"{lists}: module {name} needs itself, by way of {', '.join(needs)}"


DIAGRAM_ARROW = re.compile(r"^\s*(\w+) --> ([\w &]+)$", re.MULTILINE)
TABLE_ROW = re.compile(r"^\| `(\w+)` \|[^|]*\| ([^|]*) \|", re.MULTILINE)


def check_page(root):
    """The diagram and the table of docs/architecture.md say what the CMakeLists.txt declare. The diagram leaves out
    what follows from other arrows."""
    page = root / "docs/architecture.md"
    text = page.read_text(encoding="utf-8")
    needs = Modules(root).needs
    drawn = {(name, target.strip()) for name, targets in DIAGRAM_ARROW.findall(text) for target in targets.split("&")}
    direct = {(name, need) for name in needs for need in needs[name]
              if not any(need in reachable(needs, other) for other in needs[name] if other != need)}
    for name, need in sorted(direct - drawn):
        yield f"{page}: the diagram lacks {name} --> {need}"
    for name, need in sorted(drawn - direct):
        yield f"{page}: the diagram has {name} --> {need}, which is not declared, or follows from other arrows"
    listed = {name: {word for word in re.findall(r"\w+", words)} for name, words in TABLE_ROW.findall(text)}
    for name in needs:
        if listed.get(name) != set(needs[name]):
            yield f"{page}: the table's row of {name} does not list what it may include: {', '.join(needs[name])}"


def reachable(needs, start):
    found, todo = set(), list(needs[start])
    while todo:
        name = todo.pop()
        if name not in found:
            found.add(name)
            todo += needs.get(name, [])
    return found


def check_core(root):
    """The modules that mesh do not know that images exist."""
    for path in sorted(path for folder in CORE for path in (root / "src/scantet" / folder).rglob("*")):
        if not path.is_file():
            continue
        for number, line in enumerate(read_lines(path), 1):
            match = IMAGE_LIBRARIES.search(line)
            if match:
                yield f"{path}:{number}: {path.parent.name}/ names {match.group(0)}; the mesher knows a Domain and nothing of images"


def check_headers(root):
    """A header that other modules may include shows no third party, and no header that does."""
    for path in sorted((root / "src/scantet").rglob("*.h")):
        relative = path.relative_to(root / "src").as_posix()
        if is_private(relative) or relative.startswith(("scantet/cli/", "scantet/adapters/")):
            continue
        for number, kind, name in includes(path):
            if kind == "<" and is_third_party(name):
                yield f"{path}:{number}: a header of no *_impl.h includes <{name}>; move it to a .cpp or to a *_impl.h"
            elif kind == '"' and not name.startswith("scantet/"):
                yield f'{path}:{number}: includes "{name}"; write the path from src/: "scantet/<module>/<file>.h"'
            elif kind == '"' and is_private(name):
                yield f"{path}:{number}: includes {name}, which may show third parties; a *_impl.h or a .cpp may"


def is_third_party(name):
    return re.search(r"[./]", name) is not None  # no header of the C++ standard library has either


FACE_ONLY = ("plugins/**/*", "examples/**/*", "tests/install/**/*", "tests/contract/domain_contract.*", "tests/contract/plugin_case.h")
HEADER_LIST = re.compile(r"set\(scantet_(\w+)_headers\s([^)]*)\)")
UMBRELLA = "scantet/scantet.h"
MADE = {"scantet/base/version.h"}  # by CMake
WITHOUT_NAMES = {UMBRELLA, "scantet/base/api.h"}


def public_headers(root):
    """{"user": {"scantet/base/error.h", …}, "plugin": …, "adapter": …}, as cmake/PublicHeaders.cmake lists them."""
    text = re.sub(r"#[^\n]*", "", (root / "cmake/PublicHeaders.cmake").read_text(encoding="utf-8"))
    return {kind: {"scantet/" + name for name in names.split()} for kind, names in HEADER_LIST.findall(text)}


def check_face(root):
    """Public headers include the standard library and public headers, nothing else; only adapters show third parties.
    The umbrella has what users need, all of it. Plugins and examples include public headers alone."""
    lists = public_headers(root)
    page = root / "cmake/PublicHeaders.cmake"
    shown = set().union({UMBRELLA}, *lists.values())
    for name in sorted(shown - MADE):
        path = root / "src" / name
        if not path.is_file():
            yield f"{page}: {name} is listed, and is no file of src/"
            continue
        yield from private_includes(path, shown, "a public header")
        for number, kind, included in includes(path):
            if kind == "<" and is_third_party(included) and name not in lists["adapter"]:
                yield f"{path}:{number}: a public header includes <{included}>; only scantet/adapters/ show third parties"
            if included in lists["adapter"] and name not in lists["adapter"]:
                yield f"{path}:{number}: includes {included}, which shows third parties to all who include this"
    yield from shown_namespaces(root, shown - lists["adapter"] - MADE - WITHOUT_NAMES)
    yield from unexplained_headers(root, set().union(*lists.values()))
    umbrella = root / "src" / UMBRELLA
    included = {name for _, _, name in includes(umbrella)} if umbrella.is_file() else set()
    for name in sorted(included ^ lists["user"]):
        yield f"{umbrella}: {'lacks' if name in lists['user'] else 'includes'} {name}; see scantet_user_headers in {page.name}"
    for path in sorted(path for pattern in FACE_ONLY for path in root.glob(pattern) if path.suffix in MAX_LINES):
        yield from private_includes(path, shown, "what others could write")


def unexplained_headers(root, listed):
    """A header that no other public one includes is there for itself: docs/architecture.md says what for."""
    page = root / "docs/architecture.md"
    listed = {name for name in listed if (root / "src" / name).is_file()}
    included = {name for header in listed for _, _, name in includes(root / "src" / header)}
    named = set(re.findall(r"`([\w/]+\.h)`", page.read_text(encoding="utf-8")))
    for name in sorted(listed - included):
        if name.removeprefix("scantet/") not in named:
            yield f"{page}: does not say what {name} is public for; say so, or make it private (cmake/PublicHeaders.cmake)"


def shown_namespaces(root, shown):
    """What a public header declares can be linked, what others declare cannot."""
    for path in sorted((root / "src/scantet").rglob("*.h")):
        name = path.relative_to(root / "src").as_posix()
        marked = re.search(r"^namespace SCANTET_API ", path.read_text(encoding="utf-8"), re.MULTILINE) is not None
        if name in shown and path.is_file() and not marked:
            yield f"{path}: a public header has no `namespace SCANTET_API scantet`, so nobody can link what it declares"
        elif name not in shown and marked:
            yield f"{path}: shows what it declares by SCANTET_API, and is not public (cmake/PublicHeaders.cmake)"


def private_includes(path, shown, who):
    for number, _, name in includes(path):
        if name.startswith("scantet/") and name not in shown:
            yield f"{path}:{number}: {who} includes {name}, which is not public (cmake/PublicHeaders.cmake)"


def check_tests(root):
    """Each source of an algorithm has a unit test of its own name, which is built."""
    for folder in TESTED:
        lists = root / "tests/unit" / folder / "CMakeLists.txt"
        built = lists.read_text(encoding="utf-8").split() if lists.exists() else []
        for path in sorted((root / "src/scantet" / folder).glob("*.cpp")):
            if f"{path.stem}_test.cpp" not in built:
                yield f"{path}: has no unit test; write {lists.parent}/{path.stem}_test.cpp, and list it there"


def check_sizes(root):
    """Headers have at most 200 lines, sources and Python files 400, and functions of C++ 60, or the file says why at its
    top, on a line with 'reason:'."""
    for path in [*code_files(root), *python_files(root)]:
        lines = read_lines(path)
        if any("reason:" in line for line in lines[:REASON_WITHIN]):
            continue
        limit = MAX_LINES.get(path.suffix, MAX_LINES[".cpp"])
        if len(lines) > limit:
            yield f"{path}: {len(lines)} lines, limit {limit}; split it, or give the 'reason:' in the comment at its top"
        if path.suffix == ".py":
            continue
        for first, last in functions("\n".join(lines)):
            if last - first >= MAX_FUNCTION_LINES:
                yield (f"{path}:{first}: a function of {last - first + 1} lines, limit {MAX_FUNCTION_LINES}; part it, or give the "
                       "'reason:' in the comment at the file's top")


def python_files(root):
    for folder in (*CODE_FOLDERS, "scripts", "cohort"):
        yield from sorted((root / folder).rglob("*.py"))


# What hides braces: raw strings, comments, strings, characters (but for the ' between digits).
HIDING = re.compile(r'R"(\w*)\(.*?\)\1"|//[^\n]*|/\*.*?\*/|"(?:\\.|[^"\\\n])*"|(?<![0-9a-fA-F])\'(?:\\.|[^\'\\\n])+\'', re.DOTALL)
DIRECTIVE = re.compile(r"^[ \t]*#(?:\\\n|[^\n])*", re.MULTILINE)
HOLDS_FUNCTIONS = re.compile(r"(?:template\s*<.*>\s*)?(?:inline\s+)?(?:namespace|class|struct|union|enum)\b|extern$", re.DOTALL)
BREAK = re.compile(r"[{};]|\b(?:public|private|protected):")


def functions(text):
    """(first line, last line) of each function of a C++ source; one within another is part of that."""
    def blank(match):
        return re.sub(r"[^\n]", " ", match.group(0))
    text = DIRECTIVE.sub(blank, HIDING.sub(blank, text))
    head = position = 0  # head: behind what ended before the declaration that is being read
    while found := BREAK.search(text, position):
        position = found.end()
        declaration = text[head:found.start()].strip()
        if found.group(0) != "{" or HOLDS_FUNCTIONS.match(declaration):
            head = position
            continue
        position = closing(text, found.start())
        is_value = declaration.endswith("=") or text[position:].lstrip()[:1] in (",", "{", ")", ";")
        if "(" in declaration and not is_value:
            yield text.count("\n", 0, text.index(declaration, head)) + 1, text.count("\n", 0, position) + 1
            head = position


def closing(text, opening):
    """The place behind the brace that closes the one at `opening`."""
    depth = 0
    for match in re.compile(r"[{}]").finditer(text, opening):
        depth += 1 if match.group(0) == "{" else -1
        if depth == 0:
            return match.end()
    return len(text)


def check_format(root, program="clang-format"):
    """Files are as clang-format lays them out."""
    try:
        version = subprocess.run([program, "--version"], capture_output=True, text=True, check=True).stdout.strip()
    except OSError:
        yield f"{program} cannot be run; install clang-format (scripts/install_deps.sh test)"
        return
    result = subprocess.run([program, "--dry-run", "--Werror", *map(str, code_files(root))], capture_output=True,
                            text=True, check=False)
    unformatted = sorted(set(re.findall(r"^(.+?):\d+:\d+: error: ", result.stderr, re.MULTILINE)))
    for path in unformatted:
        yield f"{path}: not formatted; run clang-format -i on it ({version})"
    if result.returncode and not unformatted:
        yield f"{program} failed: {result.stderr.strip()}"


CHECKS = {"arrows": check_arrows, "page": check_page, "core": check_core, "headers": check_headers, "face": check_face, "tests": check_tests,
          "sizes": check_sizes, "format": check_format}


def main(arguments):
    most = 3 if arguments[:1] == ["format"] else 2
    if not 2 <= len(arguments) <= most or arguments[0] not in CHECKS:
        print(__doc__, file=sys.stderr)
        return 2
    root = Path(arguments[1]).resolve()
    if not (root / "src/scantet").is_dir():
        print(f"{root}: no source tree (src/scantet is missing)", file=sys.stderr)
        return 2
    faults = list(CHECKS[arguments[0]](root, *arguments[2:]))
    for fault in faults:
        print(fault.replace(f"{root}/", ""), file=sys.stderr)
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
