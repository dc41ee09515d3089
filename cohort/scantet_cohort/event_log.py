"""The log: one JSON object a line, appended whole, so that many processes may write to one file."""
import datetime
import json
import os
import pathlib
import socket
from typing import Any


class EventLog:
    def __init__(self, path: pathlib.Path) -> None:
        path.parent.mkdir(parents=True, exist_ok=True)
        self.path = path

    def write(self, event: str, **fields: Any) -> None:
        """Appends {"time", "event", "host", "pid", ...fields}; one write, which the kernel does not part."""
        now = datetime.datetime.now(datetime.timezone.utc).isoformat(timespec="milliseconds")
        record = {"time": now, "event": event, "host": socket.gethostname(), "pid": os.getpid(), **fields}
        line = json.dumps(record) + "\n"
        handle = os.open(self.path, os.O_WRONLY | os.O_CREAT | os.O_APPEND, 0o644)
        try:
            os.write(handle, line.encode())
        finally:
            os.close(handle)
