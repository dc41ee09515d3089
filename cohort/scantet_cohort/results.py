"""The verdicts on scans, as jobs leave them."""
import dataclasses
from typing import Any, Dict, List, Optional

from scantet_cohort import files
from scantet_cohort.layout import Layout
from scantet_cohort.scans import Scan, scan_of_json


@dataclasses.dataclass(frozen=True)
class Entry:
    """A scan of the cohort with its key; without one it could not be read."""

    scan: Scan
    sha256: str
    key: str


def load_manifest(layout: Layout) -> List[Entry]:
    manifest = files.read_json(layout.manifest) or {"scans": []}
    return [Entry(scan_of_json(item["scan"]), item["sha256"], item["key"]) for item in manifest["scans"]]


def save_manifest(layout: Layout, entries: List[Entry]) -> None:
    files.write_json(layout.manifest, {"scans": [
        {"scan": entry.scan.as_json(), "sha256": entry.sha256, "key": entry.key} for entry in entries]})


def verdict_on(layout: Layout, key: str) -> Optional[Dict[str, Any]]:
    """None while there is none. A verdict whose files are not whole, as after a power cut, does not count."""
    result = files.read_json(layout.result(key))
    if not isinstance(result, dict) or "verdict" not in result:
        return None
    for name, file in result.get("files", {}).items():
        path = layout.store(key) / name
        if not path.is_file() or path.stat().st_size != file["bytes"]:
            return None
    return result


def publish(layout: Layout, entry: Entry, result: Dict[str, Any]) -> None:
    """Gives the files of a key the scan's name. A mesh of older options or of an older scan is replaced."""
    folder = layout.output / entry.scan.folder
    names = {"report.json": "_report.json", "report.html": "_report.html"}
    for name in result.get("files", {}):
        if name != "thumbnail.png":
            ending = names.get(name, "_mesh" + name[len("mesh"):])
            target = folder / (entry.scan.stem + ending)
            source = layout.store(entry.key) / name
            if not (target.exists() and target.samefile(source)):
                files.link_or_copy(source, target)
    if result["verdict"] == "quarantined":
        for stale in folder.glob(entry.scan.stem + "_*"):
            if stale.name[len(entry.scan.stem):].startswith(("_mesh.", "_report.")):
                stale.unlink()
