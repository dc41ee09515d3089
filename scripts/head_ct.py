#!/usr/bin/env python3
"""Writes the CT of a head that Debian's package invesalius-examples has as an NRRD file.

    scripts/head_ct.py FILE.nrrd

256 × 256 × 108 voxels of 0.957 × 0.957 × 1.5 mm, Hounsfield units as 16-bit integers; bone is above about 226. Needs
nothing but Python and the package.
"""
import argparse
import pathlib
import plistlib
import tarfile

ARCHIVE = pathlib.Path("/usr/share/doc/invesalius-examples/examples/Cranium.inv3")


def member(archive, name):
    """The bytes of the file of that name, in whatever folder of the archive."""
    found = next(entry for entry in archive.getmembers() if entry.name.endswith("/" + name))
    return archive.extractfile(found).read()


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("file", type=pathlib.Path)
    options = parser.parse_args()
    if not ARCHIVE.exists():
        raise SystemExit(f"there is no {ARCHIVE}: install Debian's invesalius-examples")
    with tarfile.open(ARCHIVE) as archive:
        about = plistlib.loads(member(archive, "main.plist"))
        voxels = member(archive, about["matrix"]["filename"])
    sizes = about["matrix"]["shape"][::-1]
    axes = " ".join("(" + ",".join(str(mm) if n == axis else "0" for n in range(3)) + ")"
                    for axis, mm in enumerate(about["spacing"]))
    header = ("NRRD0004\ntype: short\ndimension: 3\nspace: left-posterior-superior\n"
              f"sizes: {sizes[0]} {sizes[1]} {sizes[2]}\nspace directions: {axes}\nspace origin: (0,0,0)\n"
              "endian: little\nencoding: raw\n\n")
    options.file.write_bytes(header.encode() + voxels)


if __name__ == "__main__":
    main()
