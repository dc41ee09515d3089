"""The group level: one page, one table and one JSON file about all scans that the participant level saw."""
import math
from typing import Any, Dict, List

from scantet_cohort import files, mesh_files, results
from scantet_cohort.errors import CohortError, one_line
from scantet_cohort.figures import COSTS, FAR, FIGURES, figures_of, worst_scores
from scantet_cohort.layout import Layout
from scantet_cohort.page import make_page
from scantet_cohort.results import Entry

Row = Dict[str, Any]
COLUMNS = ("scan", "subject", "session", "suffix", "verdict", "exit_status", "message", "robust_z", "robust_z_figure",
           *(figure.name for figure in FIGURES), "key", "input_sha256", "mesh_sha256", "mesh", "report", *COSTS)


def _row(layout: Layout, entry: Entry) -> Row:
    result = results.verdict_on(layout, entry.key) or {"verdict": "unfinished", "exit_status": None,
                                                       "message": "no verdict yet"}
    mesh = result.get("mesh")
    report = files.read_json(layout.store(entry.key) / "report.json") if mesh else None
    place = f"{entry.scan.folder}/{entry.scan.stem}"
    row: Row = {"scan": entry.scan.name, "subject": entry.scan.subject, "session": entry.scan.session,
                "suffix": entry.scan.suffix, "verdict": result["verdict"], "exit_status": result["exit_status"],
                "message": result["message"], **figures_of(report or {}), "key": entry.key, "input_sha256": entry.sha256,
                "mesh_sha256": result.get("mesh_sha256"),
                "mesh": f"{entry.scan.folder}/{mesh_files.public_name(entry.scan.stem, mesh)}" if mesh else None,
                "report": place + "_report.html" if "report.html" in result.get("files", {}) else None}
    row.update({name: result.get(name) for name in COSTS})
    return row


def _sorted_rows(rows: List[Row]) -> List[Row]:
    """Bad scans first, then meshes with faults, then outliers by their score; equal ones by name."""
    meshed = [row for row in rows if row["mesh"]]
    for row, (score, name) in zip(meshed, worst_scores(meshed)):
        row["robust_z"], row["robust_z_figure"] = round(score, 4), name or None
    for row in rows:
        row.setdefault("robust_z", None)
        row.setdefault("robust_z_figure", None)
    order = {"unfinished": 0, "quarantined": 1, "flagged": 2, "meshed": 3}
    return sorted(rows, key=lambda row: (order[row["verdict"]], -abs(row["robust_z"] or 0), row["scan"]))


def _cell(value: Any) -> str:
    if value is None or (isinstance(value, float) and not math.isfinite(value)):
        return "n/a"  # as BIDS has it
    return one_line(str(value))


def run(layout: Layout) -> int:
    """Writes group.html, group.tsv and group.json into the output folder. Returns 0."""
    entries = results.load_manifest(layout)
    if not entries:
        raise CohortError(f"{layout.output} holds no cohort", "run the participant level first", 3)
    rows = _sorted_rows([_row(layout, entry) for entry in entries])
    settings = files.read_json(layout.settings)
    settings = settings if isinstance(settings, dict) else {}
    lines = ["\t".join(COLUMNS)] + ["\t".join(_cell(row[name]) for name in COLUMNS) for row in rows]
    files.write_whole(layout.output / "group.tsv", "\n".join(lines) + "\n")
    about = {"version": settings.get("version"), "options": settings.get("options"),
             "outliers": {"score": "0.6745 (x - median) / median of |x - median|", "beyond": FAR}}
    files.write_json(layout.output / "group.json", {**about, "scans": [{name: row[name] for name in COLUMNS} for row in rows]})
    files.write_whole(layout.output / "group.html", make_page(layout, rows, settings))
    far = sum(1 for row in rows if abs(row["robust_z"] or 0) > FAR)
    print(f"{len(rows)} scans, {far} of them outliers; wrote {layout.output / 'group.html'}, group.tsv and group.json")
    return 0
