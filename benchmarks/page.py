"""Makes docs/benchmarks.md and its plot from what `compare` wrote. Standard library only.

    page.py --page docs/benchmarks.md --plot docs/benchmarks.svg [--whole build/benchmarks/whole.json] build/benchmarks/call_1.json ...

--whole: what scripts/whole_command.py has measured. Each JSON file is one call of `compare`. Seconds are medians over all runs of all calls; a ratio is taken within one call
(the ratio of its medians), and the worst call is the one quoted.
"""
import argparse
import json
import re
from collections import Counter
from html import escape
from pathlib import Path
from statistics import median

WORST = {  # ratio: which of several calls is the worst
    "CGAL / scantet, threads": min,
    "CGAL / scantet, 1 thread": min,
    "scantet, threads / limit": max,
    "scantet, 1 thread / threads": min,
}
COLOURS = {"scantet_n": "#1f5fa8", "scantet_1": "#8fb8e4", "cgal_n": "#b8541a", "cgal_1": "#edb48a", "limit": "#808080"}


def names_of(threads):
    many = f"{threads} threads"
    return {"scantet_n": f"scantet, {many}", "scantet_1": "scantet, 1 thread", "cgal_n": f"CGAL Mesh_3, {many}",
            "cgal_1": "CGAL Mesh_3, 1 thread", "limit": "limit: Delaunay triangulation, 1 thread"}


class Case:
    """One case with its runs of all calls."""

    def __init__(self, first):
        self.name, self.scan, self.criteria, self.size_mm = (first[k] for k in ("name", "scan", "criteria", "size_mm"))
        self.runs, self.errors, self.ratios, self.same = {}, [], {}, []

    def add(self, case):
        for run in case["runs"]:
            if "error" in run:
                self.errors.append(f"{run['contestant']}: {run['error']}")
            else:
                self.runs.setdefault(run["contestant"], []).append(run["figures"])
        for ratio in case["ratios"]:
            self.ratios.setdefault(ratio["name"], []).append(ratio["of_medians"])
        if case["same_mesh"] is not None:
            self.same.append(case["same_mesh"])

    def values(self, contestant, figure):
        return [run[figure] for run in self.runs[contestant]]

    def median(self, contestant, figure):
        return median(self.values(contestant, figure))


def collect(calls):
    cases = {}
    for call in calls:
        for case in call["cases"]:
            cases.setdefault(case["name"], Case(case)).add(case)
    return list(cases.values())


def table(head, rows):
    return ["| " + " | ".join(head) + " |", "| --- |" + " ---: |" * (len(head) - 1)] + [
        "| " + " | ".join(row) + " |" for row in rows] + [""]


def ratio_text(case, name):
    values = case.ratios.get(name)
    if not values:
        return "–"
    worst = WORST[name](values)
    others = f" ({min(values):.2f} to {max(values):.2f})" if len(values) > 1 else ""
    return f"**{worst:.2f}**{others}"


def ratio_section(cases, threads):
    head = ["case"] + [name.replace("threads", f"{threads} threads") for name in WORST] + ["same mesh"]
    rows = [[case.name] + [ratio_text(case, name) for name in WORST]
            + ["–" if not case.same else "yes" if all(case.same) else "NO"] for case in cases if case.ratios]
    return ["## Ratios", "",
            "Of median times within a call; the worst call, in brackets the range over the calls. *Same mesh*: the "
            f"meshes of 1 and {threads} threads were the same bytes in every run.", ""] + table(head, rows)


def run_row(case, contestant, name):
    def middle(figure):
        return case.median(contestant, figure)
    seconds = case.values(contestant, "seconds")
    row = [name, f"{median(seconds):.3f}", f"{min(seconds):.3f} to {max(seconds):.3f}", f"{middle('cpu_s'):.2f}",
           f"{1e6 * median(seconds) / middle('tets'):.2f}", f"{middle('vertices'):,.0f}"]
    shape = ["", "", "", "", ""]
    if contestant != "limit":
        shape = [f"{middle('boundary_vertices'):,.0f}", f"{middle('components'):.0f}, {middle('cavities'):.0f}",
                 f"{min(case.values(contestant, 'min_dihedral_deg')):.2f}°", f"{middle('tets_under_10_deg'):,.0f}",
                 f"{max(case.values(contestant, 'max_radius_edge')):.2f}"]
    peak = middle("peak_bytes")
    return row + shape[:1] + [f"{middle('tets'):,.0f}"] + shape[1:] + [f"{peak / 2**20:,.0f}",
                                                                       f"{peak / middle('tets'):.0f}"]


def case_section(case, names):
    head = ["", "s", "min to max", "CPU s", "µs/tet", "vertices", "on the boundary", "tets", "parts, cavities",
            "min dihedral", "under 10°", "radius-edge", "peak MiB", "bytes/tet"]
    rows = [run_row(case, contestant, name) for contestant, name in names.items() if contestant in case.runs]
    lines = [f"### {case.name}", "", f"`{Path(case.scan).name}`, {case.criteria}.", ""] + table(head, rows)
    ours = case.runs.get("scantet_n") or case.runs.get("scantet_1")
    if ours and ours[0]["object_components"]:
        lines += [f"Components of the object: {ours[0]['object_components']}; cavities: "
                  f"{ours[0]['object_cavities']}.", ""]
    unmet = max((run["unmet"] for run in ours or []), default=0)
    if unmet:
        lines += [f"Elements of scantet's mesh that break a rule: {unmet}.", ""]
    return lines + [f"Failed: {error}." for error in sorted(set(case.errors))] + ([""] if case.errors else [])


def scaling_section(cases, names):
    rows = []
    for contestant in ("scantet_n", "scantet_1"):
        skulls = [c for c in cases if c.name.startswith("skull") and contestant in c.runs]
        each = [c.median(contestant, "seconds") / c.median(contestant, "tets") for c in skulls]
        for case, one in zip(skulls, each):
            tets = case.median(contestant, "tets")
            rows.append([names[contestant], case.criteria, f"{tets:,.0f}", f"{1e6 * one:.2f}",
                         f"{100 * (one / each[0] - 1):+.0f} %", f"{case.median(contestant, 'peak_bytes') / tets:.0f}"])
    if len({row[1] for row in rows}) < 2:
        return []
    return ["## How it grows", "", "The skull at smaller sizes.", ""] + table(
        ["", "criteria", "tets", "µs/tet", "against the first", "bytes/tet"], rows)


def stage_section(case, names):
    columns = [c for c in ("scantet_1", "scantet_n") if c in case.runs and case.runs[c][0]["stages"]]
    if not columns:
        return []
    rows = []
    for i, stage in enumerate(case.runs[columns[0]][0]["stages"]):
        seconds = [median(run["stages"][i]["seconds"] for run in case.runs[c]) for c in columns]
        rows.append([stage["stage"]] + [f"{s:.3f}" for s in seconds] + [f"{stage['points']:,}"])
    return ["## Where the time goes", "", f"Stages of the {case.name}, median seconds; the report of every run has "
            "them too.", ""] + table(["stage"] + [names[c] for c in columns] + ["points added"], rows)


ROUGH = "## Rough scans"


def rough_section(cases):
    """Says where the rough scans are, or how they are measured."""
    rough = [case.name for case in cases if case.name.startswith("rough_")]
    if rough:
        return [ROUGH, "", "Scans that nobody smoothed, noise included: " + ", ".join(f"`{name}`" for name in rough) + ", in the tables above.", ""]
    return [ROUGH, "", "Scans that nobody smoothed (`rough_*`), label maps (`labels_*`) and sharp edges (`sharp_*`) have a page of their own: "
            "[benchmarks_scans.md](benchmarks_scans.md).", ""]


def whole_section(whole):
    """The whole command: what is not sampling, refining and improving."""
    if whole is None:
        return ["## The whole command", "", "`scripts/whole_command.py` measures the program from its start to its end, and which share is not sampling, refining and "
                "improving; `scripts/benchmark.sh` puts its table here.", ""]
    rows = [[row["job"], f"{row['tets']:,}", f"{row['whole_s']:.2f}", f"{row['rest_s']:.2f}", f"{100 * row['share']:.0f} %",
             f"{row['cpu_s']:.2f}", f"{row['rest_cpu_s']:.2f}", f"{100 * row['cpu_share']:.0f} %"] for row in whole["rows"]]
    return ["## The whole command", "", f"`{whole['command']}`: runs of the program with a `.vtu` and a JSON report, and with a page where `+html` stands. "
            "*Rest*: all that is not sampling, refining and improving, from the start of the process to its end; its share of the wall time, and the share of "
            "processor time of reading, checking and writing. The report lists them part by part (`phases`).", ""] + table(
        ["job", "tets", "whole s", "rest s", "share", "CPU s", "rest CPU s", "share"], rows)


def intro(calls, title):
    first = calls[0]
    m = first["machine"]
    cores = f"{m['cores']} core" + ("" if m["cores"] == 1 else "s")
    return [
        f"# {title}", "",
        "<!-- Made by benchmarks/page.py; do not edit. -->",
        "Made by `scripts/benchmark.sh`, which builds `benchmarks/compare`, runs it and writes its page, or by `benchmarks/page.py` from calls of `compare --json`.", "",
        f"- Machine: {m['cpu']}, {cores}, {int(m['memory'].split()[0]) / 2**20:.0f} GiB; {m['compiler']}, release build; "
        f"CGAL {m['cgal']}; {first['date']}.",
        "- Calls: " + "; ".join(f"{n} × `{command}`" for command, n in Counter(re.sub(r" --json \S+", "", c["command"]) for c in calls).items()) + ".",
        "- Each run is a process of its own, which first writes 1 GiB and gives it back: a virtual machine's host hands memory "
        "over slowly, and no run is timed with that. The contestants take turns, one run each a round.",
        "- scantet: sample + refine, with its topology checks. CGAL: `make_mesh_3` without optimisers, on its own domain "
        "of the same object, with facet size α·σ, cell size σ, facet angle 30° (ϱ_f = 1), radius-edge ratio 2; scantet lets "
        "elements smaller than half of the size have 1.5 times these ratios (`--small-slack`): CGAL given 1.5 times both for all "
        "elements was as fast beside scantet within a tenth. *Graded*: the σ of [benchmarks/tanglecube.h](../benchmarks/tanglecube.h), given to both.",
        "- *implicit_*: scantet's plugin parses the formula; CGAL's `Labeled_mesh_domain_3` is given it as a compiled function, "
        "crossings bisected to 1e-6 of the radius of a ball around the object. *polyhedron_*: surfaces of CGAL's data "
        "(Debian's `libcgal-demo`); CGAL's `Polyhedral_mesh_domain_3`, without features. *sharp_*: with sharp edges; CGAL's "
        "`Polyhedral_mesh_domain_with_features_3`, with edges up to α·σ along them.",
        "- Where the criteria name a dihedral angle, both go on until no tet has a smaller one: scantet improves, CGAL "
        "perturbs and exudes (`sliver_bound`). *Exudation alone*: the seconds of exudation without what is before it, "
        "scantet's to 10°, CGAL's with its defaults.",
        "- Limit: CGAL's plain Delaunay triangulation of scantet's final points, one thread.",
        "- Peak memory: resident, over what was resident before the call (the scan and its domain).",
        "- *Parts, cavities*: CGAL may lose small components, and so be done sooner; what the object has is said below "
        "each table. *Under 10°*: tets with such a dihedral angle.", ""]


def plot(cases, names):
    """Bars of seconds, each group scaled to scantet's on several threads."""
    bar, gap, left, width, right = 16, 14, 230, 430, 150
    cases = [c for c in cases if "scantet_n" in c.runs and len(c.runs) > 2]
    def share(case, contestant):
        return case.median(contestant, "seconds") / case.median("scantet_n", "seconds")
    most = max((share(c, k) for c in cases for k in c.runs), default=1)
    body, y = [], 34
    for case in cases:
        body.append(f'<text x="8" y="{y + 12}" font-weight="bold">{escape(case.name)}: {escape(case.criteria)}</text>')
        y += 20
        for contestant in (k for k in names if k in case.runs):
            length = max(1, width * share(case, contestant) / most)
            body += [f'<text x="{left - 6}" y="{y + 12}" text-anchor="end">{escape(names[contestant].split(":")[0])}</text>',
                     f'<rect x="{left}" y="{y}" width="{length:.1f}" height="{bar - 3}" fill="{COLOURS[contestant]}"/>',
                     f'<text x="{left + length + 5:.1f}" y="{y + 12}">{case.median(contestant, "seconds"):.2f} s '
                     f'(× {share(case, contestant):.2f})</text>']
            y += bar
        y += gap
    total = left + width + right
    return "\n".join([
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {total} {y}" width="{total}" height="{y}" '
        'font-family="sans-serif" font-size="12">',
        f'<rect width="{total}" height="{y}" fill="white"/>',
        f'<text x="8" y="20" font-size="14">Median seconds (× those of {escape(names["scantet_n"])})</text>'] + body
        + ["</svg>", ""])


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--page", type=Path, required=True)
    parser.add_argument("--plot", type=Path, required=True)
    parser.add_argument("--whole", type=Path)
    parser.add_argument("--title", default="Benchmarks")
    parser.add_argument("calls", nargs="+", type=Path)
    arguments = parser.parse_args()
    calls = [json.loads(path.read_text(encoding="utf-8")) for path in arguments.calls]
    names = names_of(calls[0]["threads"])
    cases = collect(calls)
    lines = intro(calls, arguments.title) + [f"![Median seconds of each contestant on each case]({arguments.plot.name})", ""]
    lines += ratio_section(cases, calls[0]["threads"])
    lines += ["## Cases", ""] + [line for case in cases for line in case_section(case, names)]
    lines += rough_section(cases)
    lines += scaling_section(cases, names)
    if cases:
        lines += stage_section(cases[0], names)
    lines += whole_section(json.loads(arguments.whole.read_text(encoding="utf-8")) if arguments.whole else None)
    arguments.page.write_text("\n".join(lines).rstrip() + "\n", encoding="utf-8")
    arguments.plot.write_text(plot(cases, names), encoding="utf-8")


if __name__ == "__main__":
    main()
