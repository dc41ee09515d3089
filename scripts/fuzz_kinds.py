"""The kinds of input that fuzz.py damages: sound files of each, and the commands that read them. Standard library only.

The files are made here, by the program, or taken from sample_volumes and from a folder of files that once did harm.
"""
import dataclasses
import gzip
import subprocess
from pathlib import Path

from fuzz_files import (CONFIG, CUTS, DECK_TEMPLATE, EDGE_LINES, FORMULAS, HOLDS, LABEL_CHOICES, LABEL_TABLES, LOADS, PLACES,
                        SIZE_FORMULAS, SIZE_PLACES, dicom, dicom_segmentation, dicom_slice, gipl, inr, materials, nifti_pair,
                        packed_mesh, points, probabilities, segmentation, size_image, surfaces, tiff, tiled_tiff, vtk_image)

ROOT = Path(__file__).resolve().parent.parent
SAMPLES = ROOT / "sample_volumes"
BALL = str(SAMPLES / "sphere.nrrd")
CHECK = "scantet-check"  # as the first word of a command: that program, beside the other
LIMITED = ["--max-vertices", "2000", "-o", "out.vtu", "--quiet"]
BALL_MESH = ["mesh", BALL, "--level", "127.5", "--size", "5", *LIMITED]


@dataclasses.dataclass
class Kind:
    files: dict  # of bytes by name, which may be in a folder
    commands: list  # of words: FILE stands for the file's name, TEXT for what is in it
    text: bool = False  # numbers in it are swapped
    broken: dict = dataclasses.field(default_factory=dict)  # more files, which the program need not take
    is_code: bool = False  # may loop, take memory, and crash with a message


class Maker:
    """Runs the program in the folder of the inputs."""

    def __init__(self, program, folder):
        self.program = program
        self.folder = folder

    def run(self, *words):
        done = subprocess.run([self.program, *words], cwd=self.folder, capture_output=True, check=False)
        if done.returncode not in (0, 4):  # 4: a mesh, and more to be said of it
            raise RuntimeError(f"{words}: {done}")

    def made(self, name, *words):
        self.run(*words, name)
        return (self.folder / name).read_bytes()


def sample(*names):
    return {name: (SAMPLES / name).read_bytes() for name in names}


def unpacked(name):
    return gzip.decompress((SAMPLES / name).read_bytes())


def broken_files(folder):
    """{extension: {name: bytes}} of files that once did harm."""
    found = {}
    for path in sorted(folder.rglob("*")):
        if path.is_file() and not path.name.endswith(".argv.json") and path.name != "in.nrrd":
            name = f"{path.parent.name if path.parent != folder else 'broken'}_{path.name}"
            found.setdefault(path.suffix, {})[name] = path.read_bytes()
    return found


def of_scans(folder, broken):
    def read(size, file="FILE"):
        return [["mesh", file, "--level", "50", "--size", size, *LIMITED], ["info", file, "--level", "50"],
                ["info", file, "--json"]]
    grey = read("5")
    small = read("1")
    for n in (1, 2):
        (folder / f"v{n}.raw").write_bytes(bytes([0, 0, 0, 0, 0, 200, 200, 0, 0, 0, 0, 0]))
    detached = b"NDims = 3\nDimSize = 4 3 2\nElementType = MET_UCHAR\nElementDataFile = v%d.raw 1 2 1\n"
    listed = (b"NRRD0004\ntype: unsigned char\ndimension: 3\nsizes: 4 3 2\nspacings: 1 1 1\nencoding: raw\n"
              b"data file: LIST\nv1.raw\nv2.raw\n")
    for place in ("series", "head", "voxels"):
        (folder / place).mkdir()
    for n in (0, 1, 3):
        (folder / "series" / f"{n}.dcm").write_bytes(dicom_slice(n))
    head, voxels = nifti_pair()
    (folder / "head" / "a.img").write_bytes(voxels)
    (folder / "voxels" / "a.hdr").write_bytes(head)
    return {
        "nrrd": Kind(sample("sphere.nrrd", "ellipsoid_sheared.nrrd"), grey, True, broken.get(".nrrd", {})),
        "meta": Kind(sample("bar.mha", "ellipsoid_sheared.mha"), grey, True, broken.get(".mha", {})),
        "meta apart": Kind({"a.mhd": detached}, small, True, broken.get(".mhd", {})),
        "nifti": Kind(sample("islands.nii.gz", "ellipsoid_flipped.nii.gz"), grey),
        "plain nifti": Kind({"a.nii": unpacked("islands.nii.gz")}, grey),
        "gipl": Kind({"a.gipl": gipl()}, small),
        "inr": Kind({"a.inr": inr(), "b.inr.gz": gzip.compress(inr(), mtime=0)}, small, True),
        "vtk image": Kind({"a.vtk": vtk_image()}, small, True),
        "nrrd apart": Kind({"a.nhdr": listed}, small, True),
        "nifti head": Kind({"head/a.hdr": head}, read("2", "head/a.hdr")),
        "nifti voxels": Kind({"voxels/a.img": voxels}, read("2", "voxels/a.hdr")),
        "tiff": Kind({"a.tif": tiff(), "b.tif": tiled_tiff()}, grey),
        "dicom": Kind({"a.dcm": dicom()}, grey),
        "dicom series": Kind({"series/2.dcm": dicom_slice(2)}, read("2", "series")),
    }


def of_labels(folder):
    mesh = ["mesh", "FILE", "--size", "3", *LIMITED]
    maps = [mesh, mesh + ["--labels", "all"], ["info", "FILE"], ["info", "FILE", "--labels", "all"]]
    (folder / "labels.seg.nrrd").write_bytes(segmentation())
    named = ["info", "labels.seg.nrrd", "--labels"]
    return {
        "segmentation": Kind({"a.seg.nrrd": segmentation()}, maps, True),
        "dicom seg": Kind({"a.dcm": dicom_segmentation(b"BINARY")}, maps),
        "dicom shares": Kind({"a.dcm": dicom_segmentation(b"FRACTIONAL")}, [mesh, ["info", "FILE"]]),
        "probabilities": Kind(probabilities(), [mesh, ["info", "FILE"], mesh + ["--tissue", "FILE"]]),
        "label choice": Kind(LABEL_CHOICES, [named + ["FILE"]], True),
        "label table": Kind(LABEL_TABLES, [named + ["all", "--label-names", "FILE"]], True),
    }


def of_shapes(maker, boundary, broken):
    shape = ["mesh", "FILE", "--size", "5", *LIMITED]
    auto = ["mesh", "FILE", "--size", "auto", *LIMITED]
    solids = {name: data for end in (".off", ".obj", ".ply", ".stl") for name, data in broken.get(end, {}).items()}
    (maker.folder / "cube.off").write_bytes(surfaces()["a.off"])
    plugins = Path(maker.program).resolve().parent.parent / "lib" / "scantet" / "plugins"
    return {
        "surface": Kind(surfaces(), [shape, shape + ["--repair"], ["info", "FILE"]], True, solids),
        "surface auto": Kind({}, [auto, auto + ["--repair"]], True, {**boundary, **surfaces(), **solids}),
        "points": Kind(points(), [shape, ["info", "FILE"]], True),
        "vdb": Kind({"a.vdb": maker.made("a.vdb", "convert", BALL)},
                    [["mesh", "FILE", "--level", "50", "--size", "5", *LIMITED], ["info", "FILE", "--level", "50"],
                     ["info", "FILE", "--json"]], False, broken.get(".vdb", {})),
        "edge lines": Kind(EDGE_LINES, [["mesh", "cube.off", "--sharp-edges", "FILE", "--size", "5", *LIMITED],
                                   ["info", "cube.off", "--sharp-edges", "FILE"]], True),
        "formula": Kind(FORMULAS, [["mesh", "implicit:TEXT", "--bounds", "-3,-3,-3,3,3,3", "--size", "1", *LIMITED]],
                        True),
        "plugin": Kind({"a.so": (plugins / "implicit.so").read_bytes()},
                       [["info", "implicit:sphere", "--bounds", "-2,-2,-2,2,2,2", "--plugin", "./FILE"],
                        ["info", BALL, "--plugin", "./FILE"]], is_code=True),
    }


def of_meshes(maker, boundary):
    labels = ["--labels", "all"]
    maker.run("mesh", "labels.seg.nrrd", *labels, "--size", "1", "-o", "labels.vtu")
    ten = maker.made("ten.vtu", "mesh", BALL, "--level", "127.5", "--size", "6", "--order", "2", "-o")
    curved = {"a.vtu": ten, **{f"a.{end}": maker.made(f"a.{end}", "convert", "ten.vtu") for end in ("msh", "inp")}}
    ends = ("vtu", "vtk", "msh", "msh2", "mesh", "inp")
    meshes = {f"a.{end}": maker.made(f"a.{end}", "convert", "ball.vtu") for end in ends}
    against = ["--level", "127.5", "--require", "bounded"]
    return {
        "mesh": Kind(meshes, [["report", "FILE"], ["convert", "FILE", "out.inp"]], True),
        "mesh verified": Kind(meshes, [["verify", "FILE", "--against", BALL, *against], ["diff", "FILE", "ball.vtu"]],
                              True),
        "packed mesh": Kind({"a.vtu": packed_mesh()}, [["report", "FILE"], ["convert", "FILE", "out.msh"]], True),
        "second order": Kind(curved, [["report", "FILE"], ["convert", "FILE", "out.inp"], ["diff", "FILE", "ten.vtu"]], True),
        "labels verified": Kind({"a.vtu": (maker.folder / "labels.vtu").read_bytes()},
                                [["verify", "FILE", "--against", "labels.seg.nrrd", *labels, "--require", "bounded"]], True),
        "labels against": Kind({"a.seg.nrrd": segmentation()},
                               [["verify", "labels.vtu", "--against", "FILE", *labels, "--require", "bounded"]], True),
        "boundary": Kind(boundary, [["verify", "ball.vtu", "--against", "FILE", "--require", "bounded"],
                                    ["mesh", "FILE", "--size", "5", *LIMITED]], True),
        # read_mesh() refuses these by their names
        "boundary as mesh": Kind({}, [["report", "FILE"], ["convert", "FILE", "out.inp"]], True, boundary),
    }


def of_jobs(maker, broken):
    certificate = ["mesh", BALL, "--level", "127.5", "--size", "6", "-o", "certified.vtu", "--certify", "bounded",
                   "--certificate"]
    maker.run("mesh", "cube.off", "--size", "4", "-o", "cube.vtu")
    certificates = {"a.json": maker.made("a.json", *certificate),
                    "b.json": maker.made("b.json", "verify", "cube.vtu", "--against", "cube.off", "--require", "bounded",
                                         "--json")}
    (maker.folder / "stiff.json").write_bytes(materials(BALL)["b.json"])
    deck = [*BALL_MESH, "--materials", "stiff.json", "--set", "foot=z < -8", "--set", "tip=z > 8", "--deck", "static",
            "-o", "out.inp"]
    return {
        "field": Kind({"a.nrrd": size_image(), "b.seg.nrrd": segmentation()},
                      [BALL_MESH + ["--field", "hu=FILE"], BALL_MESH + ["--field", "share=FILE:fraction=1"],
                       BALL_MESH + ["--field", "middle=FILE:median"]], True),
        "deck template": Kind({"a.inp": DECK_TEMPLATE}, [deck + ["--hold", "foot", "--deck-template", "FILE"]], True),
        "hold": Kind(HOLDS, [deck + ["--hold", "TEXT"]], True),
        "load": Kind(LOADS, [deck + ["--hold", "foot", "--load", "TEXT"]], True),
        "size image": Kind({"a.nrrd": size_image()},
                           [["mesh", BALL, "--level", "127.5", "--size", "FILE", *LIMITED],
                            BALL_MESH + ["--boundary-size", "FILE"]], True),
        "size formula": Kind(SIZE_FORMULAS,
                             [["mesh", BALL, "--level", "127.5", "--size", "TEXT", *LIMITED]], True),
        "places": Kind(PLACES, [BALL_MESH + ["--set", "TEXT"]], True),
        "places of sizes": Kind(SIZE_PLACES,
                                [BALL_MESH + ["--size-where", "TEXT"]], True),
        "cuts": Kind(CUTS, [BALL_MESH + ["--cut", "TEXT"]], True),
        "materials": Kind(materials(BALL),
                          [BALL_MESH + ["--materials", "FILE"], BALL_MESH + ["--materials", "FILE", "-o", "out.inp"]],
                          True),
        "certificate": Kind(certificates, [["verify", "--certificate", "FILE"], [CHECK, "FILE"]], True),
        "config": Kind({"a.json": CONFIG}, [["mesh", BALL, "--level", "127.5", "--size", "5", "--config", "FILE",
                                 "--max-vertices", "2000", "--quiet"]], True, broken.get(".json", {})),
    }


def kinds(program, folder, broken_folder):
    """All kinds by their names. Writes into the folder what their commands read beside the damaged file."""
    maker = Maker(program, folder)
    broken = broken_files(broken_folder)
    maker.run("mesh", BALL, "--level", "127.5", "--size", "6", "-o", "ball.vtu")
    boundary = {f"a.{end}": maker.made(f"a.{end}", "convert", "ball.vtu") for end in ("stl", "ply")}
    return {**of_scans(folder, broken), **of_labels(folder), **of_shapes(maker, boundary, broken), **of_meshes(maker, boundary),
            **of_jobs(maker, broken)}
