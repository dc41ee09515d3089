"""Files that appear whole or not at all, and locks that the kernel releases when their holder dies."""
import contextlib
import fcntl
import json
import os
import pathlib
import socket
from typing import Any, Iterator, Optional


def temporary_name(path: pathlib.Path) -> pathlib.Path:
    """A name beside `path` that no other process of any machine uses."""
    return path.with_name(f".{path.name}.{socket.gethostname()}.{os.getpid()}.tmp")


def write_whole(path: pathlib.Path, content: "str | bytes") -> None:
    """Writes a file such that no reader, and no kill, ever finds a part of it. A byte in a file's name that is no text is
    written as "\\udce9"."""
    path.parent.mkdir(parents=True, exist_ok=True)
    temporary = temporary_name(path)
    data = content.encode(errors="backslashreplace") if isinstance(content, str) else content
    try:
        with open(temporary, "wb") as file:
            file.write(data)
            file.flush()
            os.fsync(file.fileno())
        os.replace(temporary, path)
    finally:
        temporary.unlink(missing_ok=True)


def json_text(value: Any) -> str:
    return json.dumps(value, indent=2) + "\n"


def write_json(path: pathlib.Path, value: Any) -> None:
    write_whole(path, json_text(value))


def read_json(path: pathlib.Path) -> Optional[Any]:
    """What the file holds; None if it is missing, no regular file, or no JSON, as after a machine lost its power."""
    try:
        return json.loads(path.read_text(encoding="utf-8")) if path.is_file() else None  # reading a pipe could wait for ever
    except (OSError, ValueError, RecursionError):
        return None


@contextlib.contextmanager
def locked(path: pathlib.Path, wait: bool = True) -> Iterator[bool]:
    """Holds an exclusive lock on the file, which stays. Yields whether it is held: without `wait` another may have it."""
    path.parent.mkdir(parents=True, exist_ok=True)
    with open(path, "a") as file:
        try:
            fcntl.flock(file, fcntl.LOCK_EX | (0 if wait else fcntl.LOCK_NB))
        except BlockingIOError:
            yield False
            return
        yield True  # closing the file releases the lock


def link_or_copy(source: pathlib.Path, target: pathlib.Path) -> None:
    """Makes `target` the same file as `source`: a hard link, or a copy where the file system has none."""
    target.parent.mkdir(parents=True, exist_ok=True)
    temporary = temporary_name(target)
    temporary.unlink(missing_ok=True)
    try:
        os.link(source, temporary)
    except OSError:
        temporary.write_bytes(source.read_bytes())
    os.replace(temporary, target)
    temporary.unlink(missing_ok=True)  # a rename between two links of one file does nothing
