"""Damaged inputs through the program. Standard library only.

    fuzz.py PROGRAM N SEED FOLDER

Each kind of input has a few sound files, made here or taken from sample_volumes; a mutation flips bits, cuts, splices,
repeats or, in text, swaps numbers. Sound outcomes are the exit statuses 0, 2, 3, 4 and 5 with a message where there is
an error. Faults: a signal, status 1, no message, more than 10 s of processor time or 1 GiB (of the program or of its
child), files left over. A damaged plugin is code: it may loop, and its crash is status 1 with a message.
"""
import collections
import gzip
import math
import os
import random
import re
import resource
import shutil
import signal
import struct
import subprocess
import sys
import time
from pathlib import Path

MOST_S = 10
MOST_BYTES = 1 << 30
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


def dicom():
    def element(group, number, kind, value):
        value += (b"\0" if kind == b"UI" else b" ") * (len(value) % 2)
        long = kind in (b"OB", b"OW")
        head = struct.pack("<HH2s", group, number, kind)
        return head + (struct.pack("<HI", 0, len(value)) if long else struct.pack("<H", len(value))) + value
    syntax = element(2, 0x10, b"UI", b"1.2.840.10008.1.2.1")
    meta = element(2, 2, b"UI", b"1.2.840.10008.5.1.4.1.1.7.2") + element(2, 3, b"UI", b"1.2.3") + syntax
    meta = element(2, 0, b"UL", struct.pack("<I", len(meta))) + meta
    def short(value):
        return struct.pack("<H", value)
    body = (element(8, 0x16, b"UI", b"1.2.840.10008.5.1.4.1.1.7.2") + element(8, 0x18, b"UI", b"1.2.3") +
            element(0x28, 2, b"US", short(1)) + element(0x28, 4, b"CS", b"MONOCHROME2") + element(0x28, 8, b"IS", b"3") +
            element(0x28, 0x10, b"US", short(8)) + element(0x28, 0x11, b"US", short(8)) +
            element(0x28, 0x30, b"DS", b"1\\1") + element(0x28, 0x100, b"US", short(8)) +
            element(0x28, 0x101, b"US", short(8)) + element(0x28, 0x102, b"US", short(7)) +
            element(0x28, 0x103, b"US", short(0)) +
            element(0x7fe0, 0x10, b"OB", bytes((200 if i % 8 in (3, 4) and 83 < i < 110 else 10) for i in range(192))))
    return b"\0" * 128 + b"DICM" + meta + body


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
    return {
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


def limit():
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
    resource.setrlimit(resource.RLIMIT_FSIZE, (1 << 28, 1 << 28))


def run(command, folder):
    """(status, processor time, largest resident bytes, standard error); the status is None after three times MOST_S on
    the wall."""
    errors = folder.parent / "stderr"
    with open(errors, "wb") as err:
        start = time.monotonic()
        child = subprocess.Popen(command, cwd=folder, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=err,
                                 preexec_fn=limit)
        killed = False
        while True:
            pid, status, usage = os.wait4(child.pid, os.WNOHANG)
            if pid != 0:
                break
            if time.monotonic() - start > 3 * MOST_S and not killed:
                child.kill()
                killed = True
            time.sleep(0.002)
    child.returncode = 0
    code = None if killed else os.waitstatus_to_exitcode(status)
    return code, usage.ru_utime + usage.ru_stime, usage.ru_maxrss * 1024, errors.read_bytes()


def faults_of(kind, code, seconds, memory, err, left):
    faults = []
    is_code = kind == "plugin"
    if code is not None and code < 0:
        faults.append("signal")
    if code == 1 and not is_code:
        faults.append("status 1")
    if (code is None or seconds > MOST_S) and not is_code:
        faults.append("slow")
    if memory > MOST_BYTES and not is_code:
        faults.append("memory")
    if left:
        faults.append("left over")
    if code not in (0, 4, None) and (b"error: " not in err or err.strip().endswith(b"error:")):
        faults.append("no message")
    return faults


def main():
    program, count, seed, out = str(Path(sys.argv[1]).resolve()), int(sys.argv[2]), int(sys.argv[3]), Path(sys.argv[4])
    out = out.resolve()
    shutil.rmtree(out, ignore_errors=True)
    folder = out / "work"
    folder.mkdir(parents=True)
    inputs = kinds(program, folder)
    wanted = os.environ.get("KINDS", "").split(",") if os.environ.get("KINDS") else list(inputs)
    always = {path.name for path in folder.iterdir()}
    total = collections.Counter()
    print(f"{'kind':14} {'runs':>5}  {'statuses':34} {'signals':>7} {'>10 s':>5} {'>1 GiB':>6} {'left':>4} {'mute':>4}", flush=True)
    for kind in wanted:
        files, commands, text = inputs[kind]
        statuses = collections.Counter()
        found = collections.Counter()
        runs = max(1, count // len(wanted))
        for n in range(runs):
            rng = random.Random(f"{seed} {kind} {n}")
            name = rng.choice(sorted(files))
            data = damage(files[name], rng, text)
            words = rng.choice(commands)
            typed = data.decode("utf-8", "replace").replace("\0", "?") if name.endswith(".txt") else ""
            command = [program] + [w.replace("FILE", name).replace("TEXT", typed) for w in words]
            (folder / name).write_bytes(data)
            before = {path.name for path in folder.iterdir()}
            code, seconds, memory, err = run(command, folder)
            after = {path.name for path in folder.iterdir()}
            wrote = code in (0, 4)
            left = [extra for extra in after - before if not wrote or extra.endswith(".part")]
            for extra in after - always - {name}:
                (folder / extra).unlink()
            statuses["killed" if code is None else code] += 1
            faults = faults_of(kind, code, seconds, memory, err, left)
            found.update(faults)
            if faults:
                place = out / "faults" / f"{kind.replace(' ', '_')}_{n}_{'_'.join(faults).replace(' ', '')}"
                place.mkdir(parents=True)
                (place / name).write_bytes(data)
                (place / "command").write_text(repr(command) + "\n" + err.decode("utf-8", "replace"))
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
