"""The files that a mesh comes to in each format, and their names. Some formats are several files, or a folder of them."""
import contextlib
import pathlib
import re
from typing import Collection, List, Sequence

BESIDE = {".xdmf": ".h5", ".vtm": ".blocks"}  # what the file of a format names
# Files of the program's in folders, as src/scantet/io knows them. What else is there is somebody's own.
IN_FOLDERS = {
    ".elmer": r"mesh\.(header|nodes|elements|boundary|names)|materials\.sif",
    ".blocks": r"(regions|boundaries|curves|sets)/[^/]+\.vtu",
    ".mesh-complete": r"mesh-complete\.(mesh\.vtu|exterior\.vtp)|walls_combined\.vtp|mesh-surfaces/[^/]+\.vtp",
    ".stls": r"[^/]+\.stl",
}
PUBLIC = re.compile(r"(mesh|report)\.|mesh_(static|modal|heat|electro)\.")


def base_name(stem: str, formats: Sequence[str], options: Sequence[str]) -> str:
    """What the files of a mesh are called before their endings. Those that name each other, as decks name meshes, have the
    scan's name from the beginning; others get it when they are published, so that equal scans share them."""
    return f"{stem}_mesh" if "--deck" in options or any(ending.lower() in BESIDE for ending in formats) else "mesh"


def public_name(stem: str, name: str) -> str:
    """What a file of the store is called in the output folder."""
    return name if name.startswith(f"{stem}_") else f"{stem}_{name}"


def is_public(stem: str, name: str) -> bool:
    """Whether a file or folder of the output folder has such a name."""
    return name.startswith(f"{stem}_") and bool(PUBLIC.match(name[len(stem) + 1:]))


def files_of(mesh: str, names: Collection[str]) -> List[str]:
    """Those of one format, by name: itself, what is in it and what it names."""
    path = pathlib.PurePath(mesh)
    beside = str(path.with_suffix(BESIDE.get(path.suffix.lower(), path.suffix)))
    return sorted(name for name in names if name in (mesh, beside) or name.startswith((f"{mesh}/", f"{beside}/")))


def clear_folder(folder: pathlib.Path, keep: Collection[pathlib.Path] = ()) -> None:
    """Removes the program's files but those to be kept, and folders that are then empty. A link is left alone."""
    if folder.is_symlink():
        return
    ours = re.compile(IN_FOLDERS.get(folder.suffix.lower(), "(?!)"))
    for path in sorted(folder.rglob("*"), reverse=True):
        if path.is_dir():
            with contextlib.suppress(OSError):
                path.rmdir()
        elif path not in keep and ours.fullmatch(path.relative_to(folder).as_posix()):
            path.unlink()
    with contextlib.suppress(OSError):
        folder.rmdir()
