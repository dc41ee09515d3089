"""Makes projects of README's C++ and CMake, of the library's and of ITK's: simulator.cpp and simulator.cmake, pipeline.cpp
and pipeline.cmake, in the folder given, with the scan that the pipeline opens."""
import pathlib
import shutil
import sys

from blocks import blocks_of
from example_inputs import write_inputs

root, folder = sys.argv[1], pathlib.Path(sys.argv[2])
# The mesh of README's ball is looked at: 4189 cubic mm, so there are more than a thousand tets of 1 mm. So has the scan.
PROJECTS = {"": ("simulator", "result.mesh.tets.size() > 1000"),
            "itk": ("pipeline", "mesher->GetOutput()->GetNumberOfCells() > 1000")}
blocks = blocks_of(root, "README.md")
shutil.rmtree(folder, ignore_errors=True)
folder.mkdir(parents=True)
write_inputs(folder)
for host, (name, is_good) in PROJECTS.items():
    cpp = [line for block in blocks if block.kind == "cpp" and block.host() == host for line in block.lines]
    cmake = [line for block in blocks if block.kind == "cmake" and block.host() == host for line in block.lines]
    if not cpp or not cmake:
        sys.exit(f"README.md has no C++ or no CMake for the {name}")
    includes = [line for line in cpp if line.startswith("#include")]
    statements = ["  " + line for line in cpp if not line.startswith("#include")]
    end = [f"  return {is_good} ? 0 : 1;", "}"]
    (folder / f"{name}.cpp").write_text("\n".join([*includes, "", "int main() {", *statements, *end]) + "\n")
    (folder / f"{name}.cmake").write_text("\n".join(cmake) + "\n")
