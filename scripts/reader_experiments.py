#!/usr/bin/env python3
"""Our readers of NIfTI and DICOM beside the libraries that could take their place, on sound and damaged files.

    reader_experiments.py PROGRAM [FOLDER]     PROGRAM: scantet; needs libnifti2-dev, libgdcm-dev, a compiler
                                               FOLDER: more NIfTI files (build/fuzzers/corpus/nii)

NIfTI: nifti_image_read of the format's own library. DICOM: gdcm::IPPSorter, which sorts slices and tells their spacing,
where we stack by positions (reading/dicom_series.cpp). For each file: what each does within 10 s and 4 GiB. Prints
tables; docs/readers.md has them with the conclusion.
"""
import collections
import gzip
import os
import random
import resource
import signal
import struct
import subprocess
import sys
import tempfile
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE))
from fuzz import SAMPLES, damage  # noqa: E402

MOST_S, MOST_BYTES, MUTATIONS = 10, 4 << 30, 400


def limit():
    resource.setrlimit(resource.RLIMIT_AS, (MOST_BYTES, MOST_BYTES))
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))


def outcome(*words):
    """("read", text), ("refused", ""), or what went wrong."""
    try:
        done = subprocess.run([str(word) for word in words], capture_output=True, timeout=MOST_S, preexec_fn=limit)
    except subprocess.TimeoutExpired:
        return "more than 10 s", ""
    if done.returncode < 0:
        return signal.Signals(-done.returncode).name, ""
    return ("read" if done.returncode == 0 else "refused"), done.stdout.decode(errors="replace").strip()


def build(folder, source, compiler, *flags):
    program = folder / Path(source).stem
    subprocess.run([compiler, "-O1", "-w", str(HERE.parent / "benchmarks/readers" / source), "-o", str(program), *flags],
                   check=True)
    return program


def nifti(size=(8, 8, 8), kind=16, bits=32, data=None, origin=0.0, pixdim=1.0, offset=352.0, magic=b"n+1\0"):
    header = bytearray(348)
    struct.pack_into("<i", header, 0, 348)
    struct.pack_into("<8h", header, 40, 3, *size, 1, 1, 1, 1)
    struct.pack_into("<hh", header, 70, kind, bits)
    struct.pack_into("<8f", header, 76, 1, pixdim, pixdim, pixdim, 1, 1, 1, 1)
    struct.pack_into("<f", header, 108, offset)
    struct.pack_into("<f", header, 112, 1)
    struct.pack_into("<hh", header, 252, 0, 1)
    for row in range(3):
        struct.pack_into("<4f", header, 280 + 16 * row, *[1 if c == row else 0 for c in range(3)], origin)
    header[344:348] = magic
    if data is None:
        data = struct.pack("<512f", *[20.0 - (i % 8 - 4) ** 2 - (i // 8 % 8 - 4) ** 2 - (i // 64 - 4) ** 2
                                      for i in range(512)])
    return bytes(header) + bytes(4) + data


def nifti_cases():
    sound = nifti()
    packed = gzip.compress(sound)
    flipped = bytearray(packed)
    flipped[-6] ^= 0xff  # the checksum of the data
    return {
        "sound": ("a.nii", sound),
        "sound, compressed": ("a.nii.gz", packed),
        "half of the voxels are missing": ("a.nii", sound[:-1024]),
        "compressed, half of the stream is missing": ("a.nii.gz", packed[:len(packed) // 2]),
        "compressed, the checksum is wrong": ("a.nii.gz", bytes(flipped)),
        "32767 voxels each way, none there": ("a.nii", nifti((32767, 32767, 32767), data=b"")),
        "a negative size": ("a.nii", nifti((8, -8, 8))),
        "the affine map has no numbers": ("a.nii", nifti(origin=float("nan"))),
        "the affine map is infinite": ("a.nii", nifti(origin=float("inf"))),
        "voxels begin before the file": ("a.nii", nifti(offset=-1e9)),
        "voxels begin 1e30 bytes on": ("a.nii", nifti(offset=1e30)),
        "the header alone": ("a.nii", sound[:348]),
    }


def element(group, number, kind, value):
    value += (b"\0" if kind == b"UI" else b" ") * (len(value) % 2)
    long = kind in (b"OB", b"OW")
    head = struct.pack("<HH2s", group, number, kind)
    return head + (struct.pack("<HI", 0, len(value)) if long else struct.pack("<H", len(value))) + value


def slice_at(position, orientation=(1, 0, 0, 0, 1, 0), name="1"):
    def text(values):
        return "\\".join(f"{value:g}" for value in values).encode()

    def short(value):
        return struct.pack("<H", value)
    kind = b"1.2.840.10008.5.1.4.1.1.2"
    uid = b"1.2.3." + name.encode()
    meta = element(2, 2, b"UI", kind) + element(2, 3, b"UI", uid) + element(2, 0x10, b"UI", b"1.2.840.10008.1.2.1")
    meta = element(2, 0, b"UL", struct.pack("<I", len(meta))) + meta
    pixels = bytes(200 if 2 < i % 8 < 6 and 2 < i // 8 < 6 else 10 for i in range(64))
    body = (element(8, 0x16, b"UI", kind) + element(8, 0x18, b"UI", uid) + element(8, 0x60, b"CS", b"CT") +
            element(0x20, 0xd, b"UI", b"1.2.3") + element(0x20, 0xe, b"UI", b"1.2.3.4") +
            element(0x20, 0x32, b"DS", text(position)) + element(0x20, 0x37, b"DS", text(orientation)) +
            element(0x28, 2, b"US", short(1)) + element(0x28, 4, b"CS", b"MONOCHROME2") +
            element(0x28, 0x10, b"US", short(8)) + element(0x28, 0x11, b"US", short(8)) +
            element(0x28, 0x30, b"DS", b"1\\1") + element(0x28, 0x100, b"US", short(8)) +
            element(0x28, 0x101, b"US", short(8)) + element(0x28, 0x102, b"US", short(7)) +
            element(0x28, 0x103, b"US", short(0)) + element(0x7fe0, 0x10, b"OB", pixels))
    return b"\0" * 128 + b"DICM" + meta + body


def dicom_cases():
    def stack(positions, **more):
        return {f"{i}.dcm": slice_at(p, name=str(i), **more) for i, p in enumerate(positions)}
    even = [(0, 0, 2.5 * z) for z in range(6)]
    tilted = stack([(0, 0.5 * z, 2 * z) for z in range(6)])
    turned = {**stack(even), "x.dcm": slice_at((0, 0, 20), orientation=(1, 0, 0, 0, 0, 1), name="x")}
    cut = {**stack(even), "3.dcm": slice_at(even[3], name="3")[:-40]}
    ends = {**stack(even), "3.dcm": slice_at(even[3], name="3")[:300]}
    return {
        "six even slices": stack(even),
        "the same, names in another order": {f"{7 * i % 6}.dcm": slice_at(p, name=str(i)) for i, p in enumerate(even)},
        "a tilted gantry": tilted,
        "one slice is missing": stack(even[:3] + even[4:]),
        "uneven by a tenth": stack([(0, 0, z) for z in (0, 2.5, 5.25, 7.5, 10)]),
        "uneven by a thousandth": stack([(0, 0, z) for z in (0, 2.5, 5.0024, 7.5, 10)]),
        "two volumes at one place": stack(even + even),
        "a slice of another orientation": turned,
        "pixels cut off in one slice": cut,
        "one slice ends within an element": ends,
        "a text file beside": {**stack(even), "notes.txt": b"not a slice\n" * 20},
    }


def table(title, rows):
    print(f"\n{title}\n")
    for case, theirs, ours in rows:
        print(f"| {case} | {theirs} | {ours} |")


def told(result):
    return result[0] + (f": {result[1].splitlines()[0]}" if result[0] == "read" and result[1] else "")


def main():
    program = Path(sys.argv[1]).resolve()
    with tempfile.TemporaryDirectory(prefix="scantet_readers_") as name:
        folder = Path(name)
        library = build(folder, "nifti_library.c", "cc", "-I/usr/include/nifti", "-lnifti2", "-lznz", "-lz", "-lm")
        sorter = build(folder, "gdcm_sorter.cpp", "c++", "-I/usr/include/gdcm-3.0", "-lgdcmMSFF", "-lgdcmDSED",
                       "-lgdcmCommon")
        rows = []
        for case, (file, data) in nifti_cases().items():
            (folder / file).write_bytes(data)
            rows.append((case, told(outcome(library, folder / file)), outcome(program, "info", folder / file)[0]))
            (folder / file).unlink()
        table("NIfTI | library | scantet", rows)
        counts = {"library": collections.Counter(), "scantet": collections.Counter()}
        both = collections.Counter()
        rng = random.Random(19)
        samples = [gzip.decompress((SAMPLES / "islands.nii.gz").read_bytes()), nifti()]
        for i in range(MUTATIONS):
            data = damage(samples[i % 2], rng, False)
            (folder / "a.nii").write_bytes(data)
            results = outcome(library, folder / "a.nii")[0], outcome(program, "info", folder / "a.nii")[0]
            counts["library"][results[0]] += 1
            counts["scantet"][results[1]] += 1
            both[results] += 1
        print(f"\n{MUTATIONS} mutations (seed 19), library / scantet: "
              + "; ".join(f"{a} / {b}: {n}" for (a, b), n in both.most_common()))
        if len(sys.argv) > 2:
            files, both = sorted(Path(sys.argv[2]).iterdir()), collections.Counter()
            for file in files:
                (folder / "a.nii").write_bytes(file.read_bytes())
                both[outcome(library, folder / "a.nii")[0], outcome(program, "info", folder / "a.nii")[0]] += 1
            print(f"\n{len(files)} files of {sys.argv[2]}, library / scantet: "
                  + "; ".join(f"{a} / {b}: {n}" for (a, b), n in both.most_common()))
        rows = []
        for case, files in dicom_cases().items():
            series = folder / "series"
            series.mkdir()
            for file, data in files.items():
                (series / file).write_bytes(data)
            rows.append((case, told(outcome(sorter, series)), outcome(program, "info", series)[0]))
            for file in files:
                (series / file).unlink()
            series.rmdir()
        table("DICOM | gdcm::IPPSorter | scantet", rows)


if __name__ == "__main__":
    main()
