"""Which scans a folder holds: a BIDS dataset, or any folder of scans."""
import dataclasses
import pathlib
import re
from typing import Dict, Iterator, List, Optional, Sequence

from scantet_cohort.errors import CohortError

ENDINGS = (".nii.gz", ".nii", ".nrrd", ".nhdr", ".mha", ".mhd", ".tif", ".tiff", ".vdb")
DATATYPES = ("anat", "dwi", "func", "fmap", "perf", "pet", "ct", "micr")


@dataclasses.dataclass(frozen=True)
class Scan:
    name: str  # unique in the cohort: the file's name without its ending, or its place in a plain folder
    path: pathlib.Path
    subject: str  # without "sub-"
    session: str  # without "ses-"; empty if there are none
    suffix: str  # "T1w"
    folder: str  # of its outputs, relative to the output folder
    stem: str  # of its outputs: "sub-01_desc-T1w"

    def as_json(self) -> Dict[str, str]:
        return {**dataclasses.asdict(self), "path": str(self.path)}


def scan_of_json(value: Dict[str, str]) -> Scan:
    return Scan(**{**value, "path": pathlib.Path(value["path"])})  # type: ignore[arg-type]


@dataclasses.dataclass(frozen=True)
class Choice:
    """Which scans are wanted; an empty list means all."""

    participants: Sequence[str] = ()
    sessions: Sequence[str] = ()
    suffixes: Sequence[str] = ()
    entities: Optional[Dict[str, str]] = None  # "acq": "mprage"


def _ending(path: pathlib.Path) -> Optional[str]:
    return next((ending for ending in ENDINGS if path.name.lower().endswith(ending)), None)


def _entities(stem: str) -> Dict[str, str]:
    """{"sub": "01", "ses": "2", ..., "suffix": "T1w"} of "sub-01_ses-2_T1w"."""
    parts = stem.split("_")
    found = dict(part.split("-", 1) for part in parts if "-" in part)
    if "-" not in parts[-1]:
        found["suffix"] = parts[-1]
    return found


def _output_stem(stem: str) -> str:
    """"sub-01_ses-2_T1w" gives "sub-01_ses-2_desc-T1w", as BIDS names what is derived."""
    parts = stem.split("_")
    suffix = parts.pop() if "-" not in parts[-1] else ""
    description = "".join(part[5:] for part in parts if part.startswith("desc-")) + suffix
    parts = [part for part in parts if not part.startswith("desc-")]
    return "_".join(parts + ([f"desc-{description}"] if description else []))


def _bids_files(root: pathlib.Path) -> Iterator[pathlib.Path]:
    for subject in sorted(root.glob("sub-*")):
        for path in sorted(subject.rglob("*")):
            if path.is_file() and path.parent.name in DATATYPES:
                yield path


def _bids_scans(root: pathlib.Path, choice: Choice) -> Iterator[Scan]:
    for path in _bids_files(root):
        ending = _ending(path)
        if ending is None:
            continue
        stem = path.name[: -len(ending)]
        entities = _entities(stem)
        wanted = {**(choice.entities or {})}
        if choice.suffixes and entities.get("suffix") not in choice.suffixes:
            continue
        if any(entities.get(name) != value for name, value in wanted.items()):
            continue
        yield Scan(stem, path.resolve(), entities.get("sub", ""), entities.get("ses", ""), entities.get("suffix", ""),
                   str(path.parent.relative_to(root)), _output_stem(stem))


def _is_dicom_folder(folder: pathlib.Path) -> bool:
    for path in sorted(folder.iterdir())[:3]:
        if path.is_file():
            with open(path, "rb") as file:
                file.seek(128)
                if file.read(4) == b"DICM":
                    return True
    return False


def _plain_scans(root: pathlib.Path, choice: Choice, skip: pathlib.Path) -> Iterator[Scan]:
    """Every scan below the folder; one in a folder of its own counts by its path."""
    for path in sorted(root.rglob("*")):
        if skip in path.parents or path == skip or any(part.startswith(".") for part in path.relative_to(root).parts):
            continue
        ending = _ending(path) if path.is_file() else ""
        if ending is None or (path.is_dir() and not _is_dicom_folder(path)):
            continue
        relative = str(path.relative_to(root))
        name = re.sub(r"[^A-Za-z0-9.+-]+", "_", relative[: len(relative) - len(ending)])
        yield Scan(name, path.resolve(), name, "", "", f"sub-{name}", name)


def is_bids(root: pathlib.Path) -> bool:
    return (root / "dataset_description.json").is_file() or any(path.is_dir() for path in root.glob("sub-*"))


def find_scans(root: pathlib.Path, output: pathlib.Path, choice: Choice) -> List[Scan]:
    """The scans wanted, sorted by name. Raises CohortError if there is none, or if two share a name."""
    if not root.is_dir():
        raise CohortError(f"{root} is no folder", "give a BIDS dataset or a folder of scans", 3)
    bids = is_bids(root)
    if not bids and (choice.sessions or choice.suffixes or choice.entities):
        raise CohortError(f"{root} is no BIDS dataset, so its scans have no sessions, suffixes or entities",
                          "give --participant-label alone, or a folder with sub-*/")
    scans = list(_bids_scans(root, choice) if bids else _plain_scans(root, choice, output.resolve()))
    scans = [scan for scan in scans if (not choice.participants or scan.subject in choice.participants)
             and (not choice.sessions or scan.session in choice.sessions)]
    if not scans:
        raise CohortError(f"no scan in {root} is wanted", f"scans end in {', '.join(ENDINGS)}; look at the filters", 3)
    missing = sorted(set(choice.participants) - {scan.subject for scan in scans})
    if missing:
        raise CohortError(f"no scan of participant {', '.join(missing)} in {root}", "look at --participant-label", 3)
    scans.sort(key=lambda scan: scan.name)
    for one, next_one in zip(scans, scans[1:]):
        if (one.folder, one.stem) == (next_one.folder, next_one.stem):
            raise CohortError(f"{one.path} and {next_one.path} would have outputs of the same name", "rename one", 3)
    return scans
