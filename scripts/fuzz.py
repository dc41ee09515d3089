"""Damaged inputs through the program. Standard library only.

    fuzz.py PROGRAM N SEED FOLDER

Each kind of input has a few sound files, made here or taken from sample_volumes; a mutation flips bits, cuts, splices,
repeats or, in text, swaps numbers. Sound outcomes are the exit statuses 0, 2, 3, 4 and 5 with a message where there is
an error. Faults: a signal, status 1, no message, more than 10 s of processor time, more memory (of the program or of its
child) than 200 MB and four times what the same command takes for the sound file, files left over. A damaged plugin is
code: it may loop, and its crash is status 1 with a message.
"""
import collections
import gzip
import math
import os
import random
import re
import shutil
import signal
import struct
import subprocess
import sys
from pathlib import Path

from fork_runner import Runner

MOST_S = 10
MOST_TIMES, SPARE_BYTES = 4, 200_000_000  # of memory
ROOT = Path(__file__).resolve().parent.parent
SAMPLES = ROOT / "sample_volumes"
NUMBERS = [b"0", b"-1", b"1", b"2", b"7", b"255", b"65536", b"2147483647", b"2147483648", b"-2147483649", b"1e308",
           b"1e400", b"-1e-308", b"nan", b"inf", b"99999999999999999999", b"0.5", b"3 3", b"", b"%d", b"%n%s", b"A" * 300]


def damage(data, rng, text):
    data = bytearray(data)
    for _ in range(rng.choice([1, 1, 2, 5, 20])):
        how = rng.random()
        size = len(data)
        if size == 0:
            return bytes(rng.randbytes(10))
        near = min(size, rng.choice([64, 512, 4096, size]))
        at = rng.randrange(near)
        if text and how < 0.5:
            places = list(re.finditer(rb"[-+]?[0-9][0-9.eE+-]*", bytes(data[:near])))
            if places:
                place = rng.choice(places)
                data[place.start():place.end()] = rng.choice(NUMBERS)
        elif how < 0.65:
            data[at] ^= 1 << rng.randrange(8)
        elif how < 0.75:
            data[at:at + 4] = rng.choice([b"\xff\xff\xff\xff", b"\0\0\0\0", b"\xff\xff\xff\x7f", b"\0\0\0\x80"])
        elif how < 0.85:
            other = rng.randrange(size)
            length = rng.choice([1, 4, 16, 200])
            data[at:at + length] = data[other:other + length]
        elif how < 0.92:
            del data[at:at + rng.choice([1, 2, 8, 100])]
        elif how < 0.97:
            data[at:at] = data[at:at + rng.choice([1, 8, 64])] * rng.choice([1, 2, 50])
        else:
            del data[rng.randrange(size):]
    return bytes(data)


CUBE = [(x, y, z) for z in (0, 8) for y in (0, 8) for x in (0, 8)]
SIDES = [(0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5)]
TRIANGLES = [t for a, b, c, d in SIDES for t in ((a, b, c), (a, c, d))]


def lines(rows):
    return "".join(" ".join(map(str, row)) + "\n" for row in rows).encode()


def surfaces():
    off = b"OFF\n8 12 0\n" + lines(CUBE) + lines((3, *t) for t in TRIANGLES)
    obj = lines(("v", *p) for p in CUBE) + lines(("f", *(i + 1 for i in t)) for t in TRIANGLES)
    ply = (b"ply\nformat ascii 1.0\nelement vertex 8\nproperty float x\nproperty float y\nproperty float z\n"
           b"element face 12\nproperty list uchar int vertex_indices\nend_header\n" + off.split(b"\n", 2)[2])
    stl = b"cube".ljust(80) + struct.pack("<I", len(TRIANGLES))
    for t in TRIANGLES:
        stl += struct.pack("<12fH", 0, 0, 0, *(c for i in t for c in CUBE[i]), 0)
    return {"a.off": off, "a.obj": obj, "a.ply": ply, "a.stl": stl}


def points():
    golden = 2.399963
    rows = []
    for k in range(200):
        z = 1 - (2 * k + 1) / 200
        r = (1 - z * z) ** 0.5
        rows.append((10 * r * math.cos(golden * k), 10 * r * math.sin(golden * k), 10 * z))
    xyz = lines(rows)
    ply = (b"ply\nformat ascii 1.0\nelement vertex 200\nproperty float x\nproperty float y\nproperty float z\n"
           b"end_header\n" + xyz)
    return {"a.xyz": xyz, "b.ply": ply}


def tiff():
    pages = 3
    side = 8
    data = bytearray(struct.pack("<2sHI", b"II", 42, 8))
    for page in range(pages):
        at = len(data)
        tags = [(256, 4, side), (257, 4, side), (258, 3, 8), (259, 3, 1), (262, 3, 1), (273, 4, at + 2 + 12 * 9 + 4),
                (277, 3, 1), (278, 4, side), (279, 4, side * side)]
        data += struct.pack("<H", len(tags))
        for tag, kind, value in tags:
            data += struct.pack("<HHII", tag, kind, 1, value)
        end = len(data) + 4 + side * side
        data += struct.pack("<I", end if page + 1 < pages else 0)
        data += bytes((200 if 2 < i % side < 6 and 2 < i // side < 6 and page == 1 else 10) for i in range(side * side))
    return bytes(data)


def element(group, number, kind, value):
    value += (b"\0" if kind in (b"UI", b"OB") else b" ") * (len(value) % 2)
    long = kind in (b"OB", b"OW", b"SQ")
    head = struct.pack("<HH2s", group, number, kind)
    return head + (struct.pack("<HI", 0, len(value)) if long else struct.pack("<H", len(value))) + value


def sequence(group, number, items):
    return element(group, number, b"SQ", b"".join(struct.pack("<HHI", 0xfffe, 0xe000, len(item)) + item
                                                  for item in items))


def short(value):
    return struct.pack("<H", value)


def dicom_file(kind, body):
    meta = (element(2, 2, b"UI", kind) + element(2, 3, b"UI", b"1.2.3") +
            element(2, 0x10, b"UI", b"1.2.840.10008.1.2.1"))
    meta = element(2, 0, b"UL", struct.pack("<I", len(meta))) + meta
    return b"\0" * 128 + b"DICM" + meta + element(8, 0x16, b"UI", kind) + element(8, 0x18, b"UI", b"1.2.3") + body


def dicom():
    body = (element(0x28, 2, b"US", short(1)) + element(0x28, 4, b"CS", b"MONOCHROME2") + element(0x28, 8, b"IS", b"3") +
            element(0x28, 0x10, b"US", short(8)) + element(0x28, 0x11, b"US", short(8)) +
            element(0x28, 0x30, b"DS", b"1\\1") + element(0x28, 0x100, b"US", short(8)) +
            element(0x28, 0x101, b"US", short(8)) + element(0x28, 0x102, b"US", short(7)) +
            element(0x28, 0x103, b"US", short(0)) +
            element(0x7fe0, 0x10, b"OB", bytes((200 if i % 8 in (3, 4) and 83 < i < 110 else 10) for i in range(192))))
    return dicom_file(b"1.2.840.10008.5.1.4.1.1.7.2", body)


def dicom_segmentation(kind):
    """Two segments of 8 x 8 pixels in four slices, of which the first segment has three."""
    places = [(1, 0), (1, 1), (1, 2), (2, 1), (2, 2), (2, 3)]
    binary = kind == b"BINARY"
    pixels = [1 if 1 < i % 8 < 6 and 1 < i // 8 < 6 and (i % 8 < 4) == (segment == 1) else 0
              for segment, _ in places for i in range(64)]
    data = (bytes(sum(pixels[n + bit] << bit for bit in range(8)) for n in range(0, len(pixels), 8)) if binary
            else bytes(255 * pixel for pixel in pixels))
    body = (element(0x28, 2, b"US", short(1)) + element(0x28, 8, b"IS", str(len(places)).encode()) +
            element(0x28, 0x10, b"US", short(8)) + element(0x28, 0x11, b"US", short(8)) +
            element(0x28, 0x100, b"US", short(1 if binary else 8)) + element(0x62, 1, b"CS", kind) +
            sequence(0x62, 2, [element(0x62, 4, b"US", short(n)) + element(0x62, 5, b"LO", b"part") +
                               element(0x62, 0xd, b"US", struct.pack("<3H", 40000, 30000, 20000)) for n in (1, 2)]) +
            element(0x62, 0xe, b"US", short(255)) +
            sequence(0x5200, 0x9229, [sequence(0x20, 0x9116, [element(0x20, 0x37, b"DS", b"1\\0\\0\\0\\1\\0")]) +
                                      sequence(0x28, 0x9110, [element(0x28, 0x30, b"DS", b"1\\1")])]) +
            sequence(0x5200, 0x9230, [sequence(0x20, 0x9113, [element(0x20, 0x32, b"DS", b"0\\0\\%d" % (2 * k))]) +
                                      sequence(0x62, 0xa, [element(0x62, 0xb, b"US", short(segment))])
                                      for segment, k in places]) +
            element(0x7fe0, 0x10, b"OB", data))
    return dicom_file(b"1.2.840.10008.5.1.4.1.1.66.4", body)


def in_box(i):
    return all(1 < n < 6 for n in (i % 8, i // 8 % 8, i // 64))


def segmentation():
    """Of 3D Slicer: two layers, with two segments and one."""
    keys = b"".join(b"Segment%d_ID:=s\nSegment%d_Name:=part\nSegment%d_Color:=0.5 1 0\nSegment%d_Layer:=%d\n"
                    b"Segment%d_LabelValue:=%d\n" % (n, n, n, n, layer, n, label)
                    for n, (layer, label) in enumerate([(0, 1), (0, 2), (1, 1)]))
    return (b"NRRD0004\ntype: unsigned char\ndimension: 4\nspace: left-posterior-superior\nsizes: 2 8 8 8\n"
            b"space directions: none (1,0,0) (0,1,0) (0,0,1)\nkinds: list domain domain domain\nencoding: raw\n"
            b"space origin: (0,0,0)\n" + keys + b"\n" +
            bytes(value for i in range(512)
                  for value in ((1 + (i % 8) // 4 if in_box(i) else 0), (1 if in_box(i) and i // 64 == 3 else 0))))


def probabilities():
    """Two maps in one NIfTI file of either version."""
    values = struct.pack("<1024f", *(float(in_box(i % 512) and (i % 8 < 4) == (i < 512)) for i in range(1024)))
    first = bytearray(352)
    struct.pack_into("<i", first, 0, 348)
    struct.pack_into("<8h", first, 40, 4, 8, 8, 8, 2, 1, 1, 1)
    struct.pack_into("<2h", first, 70, 16, 32)
    struct.pack_into("<8f", first, 76, *[1.0] * 8)
    struct.pack_into("<f", first, 108, 352)
    first[344:347] = b"n+1"
    second = bytearray(544)
    struct.pack_into("<i8s2h8q", second, 0, 540, b"n+2\0\r\n\x1a\n", 16, 32, 4, 8, 8, 8, 2, 1, 1, 1)
    struct.pack_into("<8d", second, 104, *[1.0] * 8)
    struct.pack_into("<q", second, 168, 544)
    return {"a.nii": bytes(first) + values, "b.nii": bytes(second) + values}


def vtk_image():
    values = lines([[200 if i % 6 in (2, 3) and 60 < i < 150 else 1] for i in range(216)])
    return (b"# vtk DataFile Version 3.0\nimage\nASCII\nDATASET STRUCTURED_POINTS\nDIMENSIONS 6 6 6\nSPACING 1 1 1\n"
            b"ORIGIN 0 0 0\nPOINT_DATA 216\nSCALARS v float 1\nLOOKUP_TABLE default\n" + values)


def made(program, folder, name, *words):
    subprocess.run([program, *words, name], cwd=folder, capture_output=True, check=True)
    return (folder / name).read_bytes()


def kinds(program, folder):
    """{kind: (sound files, words of the command with FILE, is it text)}."""
    def sample(*names):
        return {name: (SAMPLES / name).read_bytes() for name in names}
    mesh = ["mesh", "FILE", "--level", "50", "--size", "5", "--max-vertices", "2000", "-o", "out.vtu", "--quiet"]
    info = ["info", "FILE", "--level", "50"]
    surface = ["mesh", "FILE", "--size", "5", "--max-vertices", "2000", "-o", "out.vtu", "--quiet"]
    ball = str(SAMPLES / "sphere.nrrd")
    meshes = {f"a.{end}": made(program, folder, f"a.{end}", "mesh", ball, "--level", "127.5", "--size", "6", "-o")
              for end in ("vtu", "vtk", "msh", "msh2", "mesh", "inp")}
    grid = {"a.vdb": made(program, folder, "a.vdb", "convert", ball)}
    plugins = Path(program).resolve().parent.parent / "lib" / "scantet" / "plugins"
    plugin = {"a.so": (plugins / "implicit.so").read_bytes()}
    detached = b"NDims = 3\nDimSize = 4 3 2\nElementType = MET_UCHAR\nElementDataFile = v%d.raw 1 2 1\n"
    for n in (1, 2):
        (folder / f"v{n}.raw").write_bytes(b"abcdefghijkl")
    formula = {"a.txt": b"x^4-5*x^2+y^4-5*y^2+z^4-5*z^2+11.8", "b.txt": b"(1.5-sqrt(x^2+y^2))^2+z^2-0.25"}
    config = b'{"seeding": "bulk", "output": ["out.vtu"], "seed": 3}'
    labels = ["mesh", "FILE", "--size", "3", "--max-vertices", "2000", "-o", "out.vtu", "--quiet"]
    of_labels = [labels, labels + ["--labels", "all"], ["info", "FILE"], ["info", "FILE", "--labels", "all"]]
    (folder / "labels.seg.nrrd").write_bytes(segmentation())
    table = {"a.lut": b"1 One 255 0 0 0\n2 Two 0 255 0 0\n", "b.tsv": b"index\tname\tcolor\n1\tOne\t#ff0000\n2\tTwo\t#00ff00\n",
             "c.label": b"1 255 0 0 1 1 1 \"One\"\n2-3 4 \"Two\"\n"}
    named = ["info", "labels.seg.nrrd", "--labels"]
    edges = {"a.obj": lines(("v", *p) for p in CUBE) + b"l 1 2 4 3 1\nl -1 5\n",
             "b.polylines": b"5 0 0 0 8 0 0 8 8 0 0 8 0 0 0 0\n2 0 0 0 0 0 8\n"}
    (folder / "cube.off").write_bytes(surfaces()["a.off"])
    return {
        "segmentation": ({"a.seg.nrrd": segmentation()}, of_labels, True),
        "dicom seg": ({"a.dcm": dicom_segmentation(b"BINARY"), "b.dcm": dicom_segmentation(b"FRACTIONAL")}, of_labels, False),
        "probabilities": (probabilities(), [labels, ["info", "FILE"], labels + ["--tissue", "FILE"]], False),
        "label table": (table, [named + ["FILE"], named + ["all", "--label-names", "FILE"]], True),
        "edge lines": (edges, [["mesh", "cube.off", "--sharp-edges", "FILE", "--size", "5", "--max-vertices", "2000", "-o",
                                "out.vtu", "--quiet"], ["info", "cube.off", "--sharp-edges", "FILE"]], True),
        "nrrd": (sample("sphere.nrrd", "ellipsoid_sheared.nrrd"), [mesh, info, info], True),
        "meta": ({**sample("bar.mha", "ellipsoid_sheared.mha"), "c.mhd": detached}, [mesh, info, info], True),
        "nifti": (sample("islands.nii.gz", "ellipsoid_flipped.nii.gz"), [mesh, info, info], False),
        "plain nifti": ({"a.nii": unpacked("islands.nii.gz")}, [mesh, info, info], False),
        "vtk image": ({"a.vtk": vtk_image()}, [mesh, info, info], True),
        "tiff": ({"a.tif": tiff()}, [mesh, info, info], False),
        "dicom": ({"a.dcm": dicom()}, [mesh, info, info], False),
        "vdb": (grid, [mesh, info, ["info", "FILE", "--json"]], False),
        "mesh": (meshes, [["report", "FILE"], ["convert", "FILE", "out.inp"]], True),
        "surface": (surfaces(), [surface, surface + ["--repair"], ["info", "FILE"]], True),
        "points": (points(), [surface, ["info", "FILE"]], True),
        "formula": (formula, [["mesh", "implicit:TEXT", "--bounds", "-3,-3,-3,3,3,3", "--size", "1", "-o", "out.vtu",
                               "--max-vertices", "2000", "--quiet"]], True),
        "size formula": ({"a.txt": b"1.5 + 0.2*d", "b.txt": b"max(2, abs(x)/3)"},
                         [["mesh", ball, "--level", "127.5", "--size", "TEXT", "--max-vertices", "2000", "-o",
                           "out.vtu", "--quiet"]], True),
        "config": ({"a.json": config},
                   [["mesh", ball, "--level", "127.5", "--size", "5", "--config", "FILE", "--max-vertices", "2000",
                     "--quiet"]], True),
        "plugin": (plugin, [["info", "implicit:sphere", "--bounds", "-2,-2,-2,2,2,2", "--plugin", "./FILE"],
                            ["info", ball, "--plugin", "./FILE"]], False),
    }


def unpacked(name):
    return gzip.decompress((SAMPLES / name).read_bytes())


def run_on(data, name, words, runner, folder):
    """Runs the program with these words on a file of this name and content; what it writes is taken away again."""
    typed = data.decode("utf-8", "replace").replace("\0", "?") if name.endswith(".txt") else ""
    (folder / name).write_bytes(data)
    before = {path.name for path in folder.iterdir()}
    # Killed after twelve times MOST_S on the clock only, as the machine may be busy.
    done = runner.run([w.replace("FILE", name).replace("TEXT", typed) for w in words], folder, 12 * MOST_S)
    after = {path.name for path in folder.iterdir()}
    done.left = [extra for extra in after - before if done.code not in (0, 4) or extra.endswith(".part")]
    for extra in after - before:
        (folder / extra).unlink()
    return done


def faults_of(kind, done, most_memory):
    """most_memory: bytes that the run may take."""
    faults = []
    is_code = kind == "plugin"
    if done.code is not None and done.code < 0:
        faults.append("signal")
    if done.code == 1 and not is_code:
        faults.append("status 1")
    if (done.code is None or done.seconds > MOST_S) and not is_code:
        faults.append("slow")
    if done.memory > most_memory and not is_code:
        faults.append("memory")
    if done.left:
        faults.append("left over")
    if done.code not in (0, 4, None) and (b"error: " not in done.errors or done.errors.strip().endswith(b"error:")):
        faults.append("no message")
    return faults


def main():
    program, count, seed, out = str(Path(sys.argv[1]).resolve()), int(sys.argv[2]), int(sys.argv[3]), Path(sys.argv[4])
    out = out.resolve()
    shutil.rmtree(out, ignore_errors=True)
    folder = out / "work"
    folder.mkdir(parents=True)
    runner = Runner(program, out)
    inputs = kinds(program, folder)
    wanted = os.environ.get("KINDS", "").split(",") if os.environ.get("KINDS") else list(inputs)
    total = collections.Counter()
    print(f"{'kind':14} {'runs':>5}  {'statuses':34} {'signals':>7} {'>10 s':>5} {'memory':>6} {'left':>4} {'mute':>4}", flush=True)
    for kind in wanted:
        files, commands, text = inputs[kind]
        statuses = collections.Counter()
        found = collections.Counter()
        most_memory = {}
        runs = max(1, count // len(wanted))
        for n in range(runs):
            rng = random.Random(f"{seed} {kind} {n}")
            name = rng.choice(sorted(files))
            data = damage(files[name], rng, text)
            words = rng.choice(commands)
            if (name, *words) not in most_memory:
                most_memory[name, *words] = MOST_TIMES * run_on(files[name], name, words, runner, folder).memory + SPARE_BYTES
            done = run_on(data, name, words, runner, folder)
            statuses["killed" if done.code is None else done.code] += 1
            faults = faults_of(kind, done, most_memory[name, *words])
            found.update(faults)
            if faults:
                place = out / "faults" / f"{kind.replace(' ', '_')}_{n}_{'_'.join(faults).replace(' ', '')}"
                place.mkdir(parents=True)
                (place / name).write_bytes(data)
                (place / "command").write_text(repr(done.command) + "\n" + done.errors.decode("utf-8", "replace"))
        for name in files:
            (folder / name).unlink(missing_ok=True)
        total.update(found)
        shown = " ".join(f"{code}:{times}" for code, times in sorted(statuses.items(), key=str))
        print(f"{kind:14} {runs:5}  {shown:34} {found['signal'] + found['status 1']:7} {found['slow']:5} "
              f"{found['memory']:6} {found['left over']:4} {found['no message']:4}", flush=True)
    if total:
        print(f"{sum(total.values())} faults, kept in {out}/faults", file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    signal.signal(signal.SIGPIPE, signal.SIG_DFL)
    sys.exit(main())
