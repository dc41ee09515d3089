"""The page of a cohort: one file that needs nothing else, in the style of a mesh's report."""
import base64
import collections
import hashlib
import html
import pathlib
import urllib.parse
from typing import Any, Dict, List, Sequence

from scantet_cohort.errors import CohortError
from scantet_cohort.figures import COSTS, FAR, FIGURES
from scantet_cohort.layout import Layout

PICTURES = 1000  # as many thumbnails, of the first rows; a page of more is slow to open
FOLDER = pathlib.Path(__file__).resolve().parent.parent
STYLES = (FOLDER / "page.css", FOLDER.parent / "src" / "scantet" / "report" / "page" / "page.css")
OWN_STYLE = """
td img { width: 60px; height: 60px; display: block; }
tr.quarantined td, tr.unfinished td { background: #fbeceb; }
tr.flagged td { background: #fff4d6; }
td small { white-space: nowrap; }
td.name small { white-space: normal; }
td.far { color: var(--bad); font-weight: 600; }
td.number { text-align: right; }
#scans th, #scans td { overflow-wrap: normal; vertical-align: middle; }
#scans td.name { min-width: 18em; overflow-wrap: anywhere; }
#summary { width: auto; }
th button { border: 0; padding: 0; background: none; font: inherit; font-weight: 600; text-align: inherit; white-space: normal; }
td { padding: 4px 12px 4px 0; }
"""
SCRIPT = """
const body = document.querySelector('#scans tbody');
document.querySelectorAll('#scans th button').forEach((button, column) => button.addEventListener('click', () => {
  const up = button.dataset.up !== 'yes';
  document.querySelectorAll('#scans th button').forEach(other => { other.dataset.up = ''; other.closest('th').removeAttribute('aria-sort'); });
  button.dataset.up = up ? 'yes' : '';
  button.closest('th').setAttribute('aria-sort', up ? 'ascending' : 'descending');
  const value = row => row.children[column]?.dataset.value ?? '';
  const compare = (a, b) => {
    const [x, y] = [value(a), value(b)];
    if (x === '' || y === '') return (x === '') - (y === '');
    const order = isNaN(x) || isNaN(y) ? x.localeCompare(y) : x - y;
    return up ? order : -order;
  };
  [...body.rows].sort(compare).forEach(row => body.append(row));
}));
document.querySelector('#find').addEventListener('input', event => {
  for (const row of body.rows) row.hidden = !row.textContent.toLowerCase().includes(event.target.value.toLowerCase());
});
"""
SCRIPT_SHA256 = base64.b64encode(hashlib.sha256(SCRIPT.encode()).digest()).decode()  # no other script runs
FIGURE_TITLES = {figure.name: figure.title for figure in FIGURES}
TITLES = {"seconds": "Time, s", "cpu_seconds": "Processor time, s", "memory_bytes": "Memory, MB", "threads": "Threads"}


def _style() -> str:
    for path in STYLES:
        if path.is_file():
            return path.read_text() + OWN_STYLE
    raise CohortError("page.css of scantet's report is missing", "install scantet again", 5)


def _number(value: Any) -> str:
    if value is None:
        return "–"
    return f"{value:,}" if isinstance(value, int) else f"{value:,.4g}" if abs(value) < 1e4 else f"{value:,.0f}"


def _cell(value: Any, shown: str, kind: str = "number") -> str:
    known = "" if value is None else html.escape(str(value), quote=True)
    return f'<td class="{kind}" data-value="{known}">{shown}</td>'


def _link(target: Any, text: str) -> str:
    return f'<a href="{html.escape(urllib.parse.quote(target, errors="surrogateescape"), quote=True)}">{text}</a>' if target else ""


def _picture(layout: Layout, row: Dict[str, Any]) -> str:
    path = layout.store(row["key"]) / "thumbnail.png"
    if not row["mesh"] or not path.is_file():
        return ""
    data = base64.b64encode(path.read_bytes()).decode()
    return f'<img alt="surface of {html.escape(row["scan"], quote=True)}" src="data:image/png;base64,{data}">'


def _row(layout: Layout, row: Dict[str, Any], with_picture: bool) -> str:
    score, verdict = row["robust_z"], html.escape(row["verdict"], quote=True)
    far = score is not None and abs(score) > FAR
    said = "" if not row["robust_z_figure"] else f"<br><small>{FIGURE_TITLES[row['robust_z_figure']]}</small>"
    links = " ".join(filter(None, [_link(row["report"], "report"), _link(row["mesh"], "mesh")]))
    message = f'exit status {html.escape(str(row["exit_status"]))}: {html.escape(row["message"])}' if row["message"] else ""
    if not row["mesh"]:  # the reason takes the place of the figures
        place = f'colspan="{1 + len(FIGURES) + len(COSTS)}"'
        return (f'<tr class="{verdict}"><td></td>{_cell(row["scan"], html.escape(row["scan"]), "name")}'
                f'{_cell(row["verdict"], verdict, "verdict bad")}<td {place}>{message}</td></tr>')
    message = message and f"<br><small>{message}</small>"
    cells = [f"<td>{_picture(layout, row) if with_picture else ''}</td>",
             _cell(row["scan"], f"{html.escape(row['scan'])}<br>{links}{message}", "name"),
             _cell(row["verdict"], verdict, "verdict " + ("good" if row["verdict"] == "meshed" else "bad")),
             _cell(None if score is None else abs(score), _number(score) + said if score is not None else "–",
                   "number far" if far else "number")]
    cells += [_cell(row[figure.name], _number(row[figure.name])) for figure in FIGURES]
    costs = {**{name: row[name] for name in COSTS},
             "memory_bytes": None if row["memory_bytes"] is None else round(row["memory_bytes"] / 1e6)}
    cells += [_cell(costs[name], _number(costs[name])) for name in COSTS]
    return f'<tr class="{verdict}">{"".join(cells)}</tr>'


def _summary(rows: Sequence[Dict[str, Any]], settings: Dict[str, Any]) -> str:
    counts, options = collections.Counter(row["verdict"] for row in rows), settings.get("options")
    lines: List[Sequence[str]] = [("Scans", _number(len(rows)))]
    lines += [(html.escape(verdict).capitalize(), _number(count)) for verdict, count in sorted(counts.items())]
    lines.append((f"Outliers (beyond {FAR})", _number(sum(abs(row["robust_z"] or 0) > FAR for row in rows))))
    lines.append(("Options", html.escape(" ".join(map(str, options)) if isinstance(options, list) and options else "none")))
    return "".join(f"<tr><th>{name}</th><td>{value}</td></tr>" for name, value in lines)


def make_page(layout: Layout, rows: Sequence[Dict[str, Any]], settings: Dict[str, Any]) -> str:
    titles = ["", "Scan", "Verdict", "Robust z", *(figure.title for figure in FIGURES), *(TITLES[name] for name in COSTS)]
    head = "".join(f'<th><button type="button">{title}</button></th>' for title in titles)
    body = "\n".join(_row(layout, row, index < PICTURES) for index, row in enumerate(rows))
    bad = sum(row["verdict"] != "meshed" for row in rows)
    looks = "1 scan needs a look" if bad == 1 else f"{bad or 'no'} scans need a look"
    verdict = f'<span class="verdict {"bad" if bad else "good"}">{looks}</span>'
    return f"""<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<meta http-equiv="Content-Security-Policy" content="default-src 'none'; script-src 'sha256-{SCRIPT_SHA256}'; style-src 'unsafe-inline'; img-src data:">
<title>Cohort of {len(rows)} scans</title>
<style>
{_style()}
</style>
</head>
<body>
<header><h1>Cohort</h1>{verdict}</header>
<main>
<section aria-label="Summary"><h2>Summary</h2><table id="summary">{_summary(rows, settings)}</table></section>
<section aria-label="Scans"><h2>Scans</h2>
<p class="hint">Scans without a mesh first, then meshes that miss a bound, then by the robust z-score that is farthest from 0:
0.6745 (x − median) / median of |x − median| over all meshes, of the figure named; where more than half of the values are the same,
(x − median) / (1.2533 mean of |x − median|). Beyond {FAR} a mesh counts as an outlier. Time and memory are not judged. A click on a title sorts.</p>
<p><label>Show scans with <input id="find" type="search"></label></p>
<div class="scroll"><table id="scans"><thead><tr>{head}</tr></thead><tbody>
{body}
</tbody></table></div>
</section>
</main>
<footer>Made by {html.escape(str(settings.get("version") or "scantet"))}.</footer>
<script>{SCRIPT}</script>
</body>
</html>
"""
