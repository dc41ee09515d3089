"""The files that an input of the program is made of. src/scantet/io/input_files.cpp has the same for the program; to ask it
would take a process a scan in every run."""
import os
import pathlib
import re
from typing import Iterator, List

NAMING = ("data file", "datafile", "elementdatafile")  # lines of headers that name voxels: two of NRRD, one of MetaImage
LONGEST_HEAD = 1 << 20  # bytes, which no header exceeds


def _header_lines(header: pathlib.Path) -> Iterator[str]:
    """Without the blanks around them. No more is read than is asked for."""
    left = LONGEST_HEAD
    with open(header, "rb") as file:
        while line := file.readline(left):
            left -= len(line)
            yield os.fsdecode(line).strip(" \t\r\n")


def _numbered(pattern: pathlib.Path) -> List[pathlib.Path]:
    """What has the pattern's name with any number in the place of "%...d", which is more than the pattern means."""
    before, _, behind = pattern.name.partition("%")
    _, place, behind = behind.partition("d")
    fits = re.compile(re.escape(before) + "[0-9 -]+" + re.escape(behind))
    try:
        return [pattern.parent / name for name in os.listdir(pattern.parent) if place and fits.fullmatch(name)]
    except (OSError, ValueError):
        return []


def _named_by(header: pathlib.Path) -> List[pathlib.Path]:
    """The voxel files of a text header: one, or those that fit a pattern, or all lines behind LIST."""
    lines = _header_lines(header)
    for line in lines:
        if not line:
            break
        parts = [part.strip(" \t\r") for part in re.split("[:=]", line, maxsplit=1)]
        if len(parts) < 2 or parts[0].lower() not in NAMING:
            continue
        name = parts[1]
        if name.startswith("LIST"):
            return [header.parent / each for each in lines]
        if "%" in name:
            return _numbered(header.parent / re.split(r"[ \t]", name)[0])
        return [header.parent / name]
    return []


def _voxel_files(path: pathlib.Path) -> List[pathlib.Path]:
    """Beside the file itself, as far as names go."""
    ending = path.suffix.lower()
    if ending in (".nhdr", ".mhd", ".nrrd", ".mha"):
        return _named_by(path)
    if ending == ".hdr":
        return [path.with_suffix(".img"), path.with_suffix(".img.gz")]
    if ending == ".img":
        return [path.with_suffix(".hdr")]
    if ending == ".gz" and path.with_suffix("").suffix.lower() == ".img":
        return [path.with_suffix("").with_suffix(".hdr")]
    return []


def members(path: pathlib.Path) -> List[pathlib.Path]:
    """By name: the file itself and those of its voxels, or all in a folder of DICOM slices. Raises OSError if it cannot be
    read."""
    if path.is_dir():
        return sorted(member for member in path.iterdir() if member.is_file())
    return sorted([path, *(file for file in _voxel_files(path) if os.path.isfile(file))], key=str)
