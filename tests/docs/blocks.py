"""The examples of the documentation: fenced blocks of Markdown pages."""
import dataclasses
import pathlib


@dataclasses.dataclass
class Block:
    page: str  # its path under the project's folder
    line: int  # of the opening fence
    kind: str  # the fence's language, empty for none
    lines: list  # of the content

    def place(self, offset=0):
        return f"{self.page}:{self.line + offset}"

    def text(self):
        return "".join(line + "\n" for line in self.lines)

    def host(self):
        """Whose lines of Python or C++ these are: "paraview", "vtk", "slicer", "itk", or "" for scantet's own. Each has a
        test of its own that runs them as written."""
        marks = {"paraview": "paraview.simple", "vtk": "vtkscantet", "slicer": "slicer.", "itk": "#include <itk"}
        if self.kind == "cmake":
            marks = {"itk": "find_package(ITK"}
        return next((host for host, mark in marks.items() if mark in self.text()), "")


def pages_of(root):
    """Every page that is for readers of the project."""
    root = pathlib.Path(root)
    pages = [root / "README.md", *sorted((root / "docs").rglob("*.md")), root / "sample_volumes" / "README.md"]
    return [str(page.relative_to(root)) for page in pages]


def blocks_of(root, page):
    """The page's blocks. Raises ValueError for a fence without end, or a block made by indentation."""
    blocks = []
    block = None
    before = ""
    for number, line in enumerate((pathlib.Path(root) / page).read_text().splitlines(), 1):
        if line.startswith("```"):
            if block is None:
                block = Block(page, number, line[3:].strip(), [])
            else:
                blocks.append(block)
                block = None
        elif block is not None:
            block.lines.append(line)
        elif line.startswith("    ") and not before:
            raise ValueError(f"{page}:{number}: a block without a fence; give it one, with a language")
        before = line.strip()
    if block is not None:
        raise ValueError(f"{block.place()}: the fence has no end")
    return blocks
