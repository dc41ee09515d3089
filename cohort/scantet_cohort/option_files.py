"""The files that options of `scantet mesh` name: as a whole value, behind NAME=, within scan("..."), in a file of materials."""
import os
import pathlib
import re
from typing import Callable, List

from scantet_cohort import files, hashing

FILES = {"--boundary-size", "--deck-template", "--label-names", "--labels", "--materials", "--plugin", "--sharp-edges", "--size"}
PLACES = {"--set", "--size-where"}
NO_FILE = re.compile(r"[-+0-9., ]*|auto|all")  # even if there is one of that name
SCAN = re.compile(r"""\bscan *\([ \t]*(?:"([^"]*)"|'([^']*)'|([^)]*?))[ \t]*\)""")

NewName = Callable[[str], str]


def _scan_renamed(name: str, new: NewName) -> str:
    """What follows the file behind a colon stays: a measure, or which series of a folder it is."""
    parts = name.split(":")
    for count in range(len(parts), 0, -1):
        head = ":".join(parts[:count])
        if os.path.exists(head):
            return ":".join([new(head), *parts[count:]])
    return name


def _place_renamed(text: str, new: NewName) -> str:
    def renamed(match: "re.Match[str]") -> str:
        name = next((group for group in match.groups() if group), "")
        found = _scan_renamed(name, new)
        quote = "'" if '"' in found else '"'
        return match[0] if found == name else f"scan({quote}{found}{quote})"
    return SCAN.sub(renamed, text)


def renamed(option: str, value: str, new: NewName) -> str:
    """The option's value with new names for the files that it names, as far as they exist."""
    if option == "--field":
        name, sign, scan = value.partition("=")
        return name + sign + _scan_renamed(scan, new)
    if option == "--tissue":
        return _scan_renamed(value, new)
    if option in PLACES:
        return _place_renamed(value, new)
    may_be = option in FILES or "/" in value or "." in value  # plugins have options, too
    return new(value) if may_be and not NO_FILE.fullmatch(value) and os.path.exists(value) else value


def _scans_of_materials(path: str) -> List[str]:
    """The files of scans that a file of materials names, for its law and for places."""
    held = files.read_json(pathlib.Path(path))
    names: List[str] = []

    def note(name: str) -> str:
        names.append(name)
        return name
    law, places = (held.get("scan"), held.get("places")) if isinstance(held, dict) else (None, None)
    if isinstance(law, dict):
        _scan_renamed(str(law.get("file", "")), note)
    for place in places if isinstance(places, list) else []:
        _place_renamed(str(place.get("where", "")) if isinstance(place, dict) else "", note)
    return names


def by_content(option: str, value: str) -> str:
    """The option's value with checksums in the place of files. Raises OSError if one cannot be read."""
    def checksum(name: str) -> str:
        named = [name, *(_scans_of_materials(name) if option == "--materials" else [])]
        told = "sha256:" + "+".join(hashing.input_sha256(pathlib.Path(each)) for each in named)
        return f"{pathlib.Path(name).name} {told}" if option == "--tissue" else told  # it is the region's name, too
    return renamed(option, value, checksum)


def absolute(option: str, value: str) -> str:
    """The option's value with absolute paths."""
    return renamed(option, value, os.path.abspath)
