"""The verdicts on scans, as jobs leave them."""
import dataclasses
import pathlib
import re
from typing import Any, Dict, List, Optional

from scantet_cohort import files, mesh_files
from scantet_cohort.errors import CohortError
from scantet_cohort.figures import COSTS
from scantet_cohort.layout import Layout
from scantet_cohort.scans import Scan, scan_of_json

KEY = re.compile("[0-9a-f]{32}")
VERDICTS = ("meshed", "flagged", "quarantined")


@dataclasses.dataclass(frozen=True)
class Entry:
    """A scan of the cohort with its key; without one it could not be read."""

    scan: Scan
    sha256: str
    key: str


def load_manifest(layout: Layout) -> List[Entry]:
    """Empty if there is none. Raises CohortError if it is not as `save_manifest` leaves it: its keys are names of folders."""
    manifest = files.read_json(layout.manifest) or {"scans": []}
    try:
        entries = [Entry(scan_of_json(item["scan"]), item["sha256"], item["key"]) for item in manifest["scans"]]
        sound = all(KEY.fullmatch(entry.key) and entry.scan.folder.startswith("sub-") for entry in entries) and all(
            isinstance(text, str) for entry in entries for text in (entry.sha256, *entry.scan.as_json().values()))
    except (AttributeError, KeyError, TypeError):
        sound = False
    if not sound:
        raise CohortError(f"{layout.manifest} is damaged", "run the participant level again", 3)
    return entries


def save_manifest(layout: Layout, entries: List[Entry]) -> None:
    files.write_json(layout.manifest, {"scans": [
        {"scan": entry.scan.as_json(), "sha256": entry.sha256, "key": entry.key} for entry in entries]})


def is_sound(result: Any, store: pathlib.Path) -> bool:
    """Whether this is a verdict as jobs leave it, with its files whole: not so after a power cut, or if somebody else made it. The
    names of files become paths in the store and beside the scan's other outputs."""
    if not isinstance(result, dict) or result.get("verdict") not in VERDICTS:
        return False
    made = result.get("files", {})
    numbers = [result.get("exit_status"), *(result.get(name, 0) for name in COSTS)]
    if not all(isinstance(number, (int, float)) and abs(number) < 1e300 for number in numbers) or not isinstance(made, dict):
        return False
    if not isinstance(result.get("message"), str) or not isinstance(result.get("mesh", ""), str):
        return False
    return all(_is_whole(store, pathlib.PurePath(name), file) for name, file in made.items())


def _is_whole(store: pathlib.Path, name: pathlib.PurePath, file: Any) -> bool:
    inside = not name.is_absolute() and ".." not in name.parts
    return inside and (store / name).is_file() and isinstance(file, dict) and (store / name).stat().st_size == file.get("bytes")


def verdict_on(layout: Layout, key: str) -> Optional[Dict[str, Any]]:
    """None while there is none. One that is not sound does not count."""
    result: Optional[Dict[str, Any]] = files.read_json(layout.result(key))
    return result if is_sound(result, layout.store(key)) else None


def publish(layout: Layout, entry: Entry, result: Dict[str, Any]) -> None:
    """Gives the files of a key the scan's name. A mesh of older options or of an older scan is replaced."""
    folder, stem = layout.output / entry.scan.folder, entry.scan.stem
    made = {folder / mesh_files.public_name(stem, name): layout.store(entry.key) / name
            for name in result.get("files", {}) if name != "thumbnail.png"}
    for target, source in made.items():
        if not (target.exists() and target.samefile(source)):
            files.link_or_copy(source, target)
    for whole in {target.parent for target in made} - {folder}:
        mesh_files.clear_folder(folder / whole.relative_to(folder).parts[0], made)
    if result["verdict"] == "quarantined" and folder.is_dir():
        for stale in [path for path in folder.iterdir() if mesh_files.is_public(stem, path.name)]:
            if stale.is_dir():
                mesh_files.clear_folder(stale)
            else:
                stale.unlink()
