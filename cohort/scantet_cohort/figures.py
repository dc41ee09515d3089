"""The figures of a scan that the group level shows, and how far each is from the others'."""
import dataclasses
import statistics
from typing import Any, Callable, Dict, List, Optional, Sequence, Tuple

Report = Dict[str, Any]


def _most(report: Report, side: str) -> Optional[float]:
    return ((report.get("distance") or {}).get(side) or {}).get("upper_mm")


@dataclasses.dataclass(frozen=True)
class Figure:
    name: str  # in tables; the unit is part of it
    title: str  # on the page
    read: Callable[[Report], Any]
    judged: bool = True  # whether outliers are looked for in it


# What follows from the input: the same in every run.
FIGURES = (
    Figure("tets", "Tets", lambda r: r["mesh"]["tets"]),
    Figure("vertices", "Vertices", lambda r: r["mesh"]["vertices"]),
    Figure("volume_mm3", "Volume, mm³", lambda r: r["mesh"]["volume_mm3"]),
    Figure("regions", "Regions", lambda r: len(r["mesh"]["regions"])),
    Figure("components", "Components", lambda r: r["topology"]["components"]),
    Figure("cavities", "Cavities", lambda r: r["topology"]["cavities"]),
    Figure("handles", "Handles", lambda r: r["topology"]["handles"]),
    Figure("min_dihedral_deg", "Least dihedral angle, °", lambda r: r["quality"]["min_dihedral_deg"]),
    Figure("max_dihedral_deg", "Largest dihedral angle, °", lambda r: r["quality"]["max_dihedral_deg"]),
    Figure("min_scaled_jacobian", "Least scaled Jacobian", lambda r: r["quality"]["min_scaled_jacobian"]),
    Figure("mean_inverse_aspect", "Mean inverse aspect ratio",
           lambda r: r["quality"]["statistics"]["inverse_aspect"]["mean"]),
    Figure("max_distance_to_mesh_mm", "Surface to mesh up to, mm", lambda r: _most(r, "to_mesh")),
    Figure("max_distance_to_surface_mm", "Mesh to surface up to, mm", lambda r: _most(r, "to_surface")),
    Figure("bounds_broken", "Bounds unmet", lambda r: sum(1 for bound in r["bounds"] if bound["broken"])),
    Figure("audit_faults", "Faults found", lambda r: len(r["audit"]["findings"])),
)
# What the machine took: other in every run, so never judged.
COSTS = ("seconds", "cpu_seconds", "memory_bytes", "threads")
FAR = 3.5  # robust z-scores beyond this are outliers (Iglewicz and Hoaglin, 1993)


def figures_of(report: Report) -> Dict[str, Any]:
    """By name; None for what the report does not have, or not as a number."""
    values: Dict[str, Any] = {}
    for figure in FIGURES:
        try:
            value = figure.read(report)
        except (AttributeError, KeyError, TypeError):
            value = None
        values[figure.name] = value if isinstance(value, (int, float)) and abs(value) < 1e300 else None
    return values


def robust_scores(values: Sequence[Optional[float]]) -> List[Optional[float]]:
    """0.6745 (x - median) / MAD, where MAD is the median of |x - median|. Where more than half of the values are the same
    MAD is 0, and (x - median) / (1.2533 mean of |x - median|) takes its place; 0 where all are the same."""
    known = [value for value in values if value is not None]
    if not known:
        return [None for _ in values]
    middle = statistics.median(known)
    away = [abs(value - middle) for value in known]
    scale = statistics.median(away) / 0.6745 or 1.2533 * statistics.fmean(away)
    return [None if value is None else (value - middle) / scale if scale else 0.0 for value in values]


def worst_scores(rows: Sequence[Dict[str, Any]]) -> List[Tuple[float, str]]:
    """Of each row its score farthest from 0, and the figure that has it."""
    worst: List[Tuple[float, str]] = [(0.0, "") for _ in rows]
    for figure in FIGURES:
        for index, score in enumerate(robust_scores([row[figure.name] for row in rows]) if figure.judged else []):
            if score is not None and abs(score) > abs(worst[index][0]):
                worst[index] = (score, figure.name)
    return worst
