"""What a scan will take, from `scantet mesh --plan`, and what is asked for because of it."""
import math
import pathlib
from typing import Any, Dict, Optional

from scantet_cohort import files
from scantet_cohort.layout import Layout

WITHOUT_PLAN = {"memory_bytes": 4e9, "processor_s": 600.0}
SECONDS_A_THREAD = 1800  # what takes longer than this gets a further thread


def _figures(layout: Layout, key: str) -> Dict[str, Any]:
    plan = files.read_json(layout.plan(key)) or {}
    figures = {**WITHOUT_PLAN, **plan.get("features", {}), **plan.get("plan", {})}
    return {name: figures[name] for name in WITHOUT_PLAN}


def threads(output: str, key: str, most: int) -> int:
    """One thread for each half hour of work: many scans side by side are quicker than one scan on many threads."""
    return max(1, min(most, math.ceil(_figures(Layout(pathlib.Path(output)), key)["processor_s"] / SECONDS_A_THREAD)))


def memory_mb(output: str, key: str, attempt: int, limit: Optional[int]) -> int:
    """A quarter more than the plan says and what Python takes; half as much again for each further attempt."""
    planned = _figures(Layout(pathlib.Path(output)), key)["memory_bytes"]
    wanted = math.ceil((1.25 * planned / 1e6 + 200) * 1.5 ** (attempt - 1))
    return min(wanted, limit) if limit else wanted


def minutes(output: str, key: str, attempt: int) -> int:
    """Three times what the plan says on one thread, and five minutes; as much again for each further attempt."""
    return (5 + math.ceil(_figures(Layout(pathlib.Path(output)), key)["processor_s"] / 20)) * attempt


def seconds(layout: Layout, key: str) -> float:
    """Processor time expected."""
    return float(_figures(layout, key)["processor_s"])
