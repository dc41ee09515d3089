"""Checksums of inputs, and the keys that outputs are kept under."""
import concurrent.futures
import hashlib
import json
import pathlib
from typing import Any, Dict, List, Sequence, Tuple

from scantet_cohort import files
from scantet_cohort.input_files import members


def file_sha256(path: pathlib.Path) -> str:
    digest = hashlib.sha256()
    with open(path, "rb") as file:
        while block := file.read(1 << 20):
            digest.update(block)
    return digest.hexdigest()


def joint_sha256(sums: Sequence[Tuple[str, str]]) -> str:
    """Of files by their names and checksums: of one its checksum; of several that of the list that sha256sum prints of them."""
    if len(sums) == 1:
        return sums[0][1]
    lines = "".join(f"{checksum}  {name}\n" for name, checksum in sums)
    return hashlib.sha256(lines.encode(errors="surrogateescape")).hexdigest()


def input_sha256(path: pathlib.Path) -> str:
    """As the program has it of a scan alone. Raises OSError."""
    return joint_sha256([(part.name, file_sha256(part)) for part in members(path)])


def _stamp(path: pathlib.Path) -> List[int]:
    """What changes when the input does, without reading more of it than a header."""
    stamps: List[int] = []
    for member in members(path):
        status = member.stat()
        stamps += [status.st_size, status.st_mtime_ns, status.st_ino]
    return stamps


class Checksums:
    """Checksums that are remembered between runs by the inputs' sizes and times."""

    def __init__(self, memory: pathlib.Path) -> None:
        self._memory = memory
        known = files.read_json(memory)
        self._known: Dict[str, Any] = known if isinstance(known, dict) else {}

    def of(self, paths: Sequence[pathlib.Path], workers: int) -> List["str | OSError"]:
        """The checksum of each, or why it could not be read."""
        with concurrent.futures.ThreadPoolExecutor(max(1, workers)) as pool:
            sums = list(pool.map(self._one, paths))
        files.write_whole(self._memory, json.dumps(self._known))
        return sums

    def _one(self, path: pathlib.Path) -> "str | OSError":
        try:
            stamp = _stamp(path)
            known = self._known.get(str(path))
            if known and known["stamp"] == stamp:
                return str(known["sha256"])
            checksum = input_sha256(path)
        except OSError as error:
            return error
        self._known[str(path)] = {"stamp": stamp, "sha256": checksum}
        return checksum


def key_of(checksum: str, options: Sequence[str], formats: Sequence[str], version: str, base: str) -> str:
    """The key of a mesh: what its bytes follow from. The base is what its files are called, as some name each other."""
    parts = json.dumps({"input": checksum, "options": list(options), "formats": list(formats), "version": version, "base": base},
                       sort_keys=True)
    return hashlib.sha256(parts.encode()).hexdigest()[:32]
