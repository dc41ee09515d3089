"""Makes a project of README's C++ and CMake: simulator.cpp and simulator.cmake, in the folder given."""
import pathlib
import sys

from blocks import blocks_of

root, folder = sys.argv[1], pathlib.Path(sys.argv[2])
blocks = blocks_of(root, "README.md")
cpp = [line for block in blocks if block.kind == "cpp" for line in block.lines]
cmake = [line for block in blocks if block.kind == "cmake" for line in block.lines]
if not cpp or not cmake:
    sys.exit("README.md has no C++ or no CMake")
includes = [line for line in cpp if line.startswith("#include")]
statements = ["  " + line for line in cpp if not line.startswith("#include")]
folder.mkdir(parents=True, exist_ok=True)
# The mesh of README's ball, `result`, is looked at: 4189 cubic mm, so there are more than a thousand tets of 1 mm.
end = ["  return result.mesh.tets.size() > 1000 ? 0 : 1;", "}"]
(folder / "simulator.cpp").write_text("\n".join([*includes, "", "int main() {", *statements, *end]) + "\n")
(folder / "simulator.cmake").write_text("\n".join(cmake) + "\n")
