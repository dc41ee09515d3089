// Summary and details. Text from the report is only ever set as text.
"use strict";

// An element with these children: nodes or texts.
function element(tag, ...children) {
  const node = document.createElement(tag);
  node.append(...children);
  return node;
}

function swatch(mesh) {
  const node = element("span");
  node.className = "swatch";
  node.style.background = mesh.color;
  return node;
}

// Four digits, or all before the decimal point. JSON has null for what is infinite or was not measured.
function number(value) {
  if (value === null || value === undefined) return "infinite";
  if (Math.abs(value) >= 1e15) return value.toExponential(3);
  if (Math.abs(value) >= 1000) return Math.round(value).toLocaleString("en-GB");
  return String(Number(value.toPrecision(4)));
}

function coordinates(place) {
  return `(${place.map(number).join(", ")})`;
}

function place_text(place) {
  return `${coordinates(place)} mm`;
}

function counted(count, one, many) {
  return `${number(count)} ${count === 1 ? one : many}`;
}

function percentage(part, whole) {
  return whole > 0 && part > 0 ? ` (${Number((100 * part / whole).toPrecision(2))} %)` : "";
}

function topology_text(t) {
  const expected = t.expected && (t.expected.components !== t.components || t.expected.cavities !== t.cavities) ?
      `; the input has ${number(t.expected.components)} and ${number(t.expected.cavities)}` :
    t.expected === null ? " (not checked, for the input does not know how many it has)" : "";
  const handles = t.handles === null ? "" : ` (${handles_text(t.handles)} in ${counted(t.boundary_components, "surface", "surfaces")})`;
  return `${counted(t.components, "component", "components")}, ${counted(t.cavities, "cavity", "cavities")}${expected}; ` +
      `Euler number ${t.euler}${handles}, ` +
      (t.manifold ? "manifold" :
                    `not manifold at ${counted(t.non_manifold_edges, "edge", "edges")} and ` +
           `${counted(t.non_manifold_vertices, "vertex", "vertices")}`);
}

// check: undefined where there was no input to compare with, null where that does not know its handles.
function handle_check_text(check) {
  if (check === undefined) return "";
  if (check === null) return "not checked, for the input does not know how many it has";
  const cavities = check.compared_cavities > 0 ? ` and ${counted(check.compared_cavities, "cavity", "cavities")}` : "";
  const components = counted(check.compared, "component", "components") + cavities;
  const same = check.different.length === 0;
  const counts = same || check.expected_handles === null ? "" : `: ${number(check.handles)} of ${number(check.expected_handles)}`;
  const unknown = check.unknown > 0 ? `; not known of ${counted(check.unknown, "component", "components")} of the input` : "";
  return (same ? `the input's, in ${check.compared + check.compared_cavities === 1 ? "" : "each of "}${components}` :
                 `not the input's in ${number(check.different.length)} of ${components}`) +
      `${counts}; Euler number of the boundary ${check.euler}, in the input ${check.expected_euler}${unknown}`;
}

// One way: between the boundary of the mesh and the surface that it stands for.
function distance_text(way) {
  if (way.points === 0) return "not measured";
  if (way.upper_mm === null) return `${number(way.lower_mm)} mm at the worst of ${number(way.points)} points, without a bound`;
  return `${number(way.lower_mm)} to ${number(way.upper_mm)} mm`;
}

function dropped_text({found, dropped}) {
  const largest = dropped.largest.length > 0 ? `, the largest of them ${number(dropped.largest[0].volume_mm3)} mm³, together ${number(dropped.volume_mm3)} mm³` : "";
  return `${dropped.count === 0 ? "none" : number(dropped.count)} of ${counted(found, "component", "components")}${largest}`;
}

// A size is a number of mm, a formula or a file.
function size_option_text({size}) {
  return size === null || size === undefined ? "" : Number.isFinite(Number(size)) ? `${size} mm` : String(size);
}

function level_text({level}) {
  return level === null || level === undefined ? "" : option_text(level);
}

// ratio: its statistics, where there was a sizing field.
function size_text(ratio) {
  return ratio ? `up to ${number(ratio.max)}, median ${number(ratio.p50)}` : "";
}

function rules_text(r) {
  return `${number(r.initial_points)} initial points, ${number(r.lattice_points)} of a lattice; inserted by R1 ${number(r.r1)}, ` +
      `R2 ${number(r.r2)}, R3.1 ${number(r.r3_1)}, R3.2 ${number(r.r3_2)}`;
}

function improvement_text(o) {
  const stages = o.stages.map((s) => `${s.stage}: ${counted(s.changes, "change", "changes")}, from ${number(s.min_dihedral_before_deg)}° to ${number(s.min_dihedral_after_deg)}°`);
  if (o.finer.places > 0) stages.push(`meshed finer at ${counted(o.finer.places, "place", "places")}`);
  return stages.length > 0 ? stages.join("; ") : "nothing to do";
}

function edge_share_text(share) {
  return share === undefined ? "" : `, and from ${number(share)} of the size asked for there`;
}

function short_edges_text(e) {
  if (e.count === 0) return `none shorter than ${e.than}`;
  const worst = e.places[0];
  return `${number(e.count)} of ${number(e.of)} shorter than ${e.than}, at ${counted(e.place_count, "place", "places")}, the shortest ${number(worst.length_mm)} mm at ${place_text(worst.place_mm)}`;
}

function bounds_text(bounds) {
  const broken = bounds.filter((b) => b.broken > 0);
  if (broken.length === 0) return "all met";
  return broken.map((b) => `unmet: ${b.name} ${number(b.asked)} by ${number(b.broken)} of ${number(b.of)}, the worst with ${number(b.worst)} at ${place_text(b.place_mm)}`).join("; ");
}

// Label, the part of a report that it is about, and what it says; reports without that part have no such row.
const kSummary = [
  ["input", "input", (r) => r.input.path],
  ["vertices", "mesh", (r) => number(r.mesh.vertices)],
  ["tetrahedra", "mesh", (r) => number(r.mesh.tets)],
  ["boundary", "mesh", (r) => `${counted(r.mesh.boundary_facets, "triangle", "triangles")}, ${counted(r.mesh.boundary_vertices, "vertex", "vertices")}`],
  ["volume", "mesh", (r) => `${number(r.mesh.volume_mm3)} mm³`],
  ["level", "options", (r) => level_text(r.options)],
  ["size asked for", "options", (r) => size_option_text(r.options)],
  ["dihedral angles", "quality", (r) => `${number(r.quality.min_dihedral_deg)}° to ${number(r.quality.max_dihedral_deg)}°`],
  ["tets under 5° / 10°", "quality", (r) => [5, 10].map((d) => number(r.quality.tets_under_deg[d])).join(" / ") + percentage(r.quality.tets_under_deg[10], r.mesh.tets)],
  ["tets under 15° / 20°", "quality", (r) => [15, 20].map((d) => number(r.quality.tets_under_deg[d])).join(" / ") + percentage(r.quality.tets_under_deg[20], r.mesh.tets)],
  ["radius-edge ratio", "quality", (r) => `up to ${number(r.quality.max_radius_edge)}`],
  ["scaled Jacobian", "quality", (r) => `from ${number(r.quality.min_scaled_jacobian)}`],
  ["boundary angles", "quality", (r) => `from ${number(r.quality.min_facet_angle_deg)}°`],
  ["shortest edge", "quality", (r) => `${number(r.quality.min_edge_length_mm)} mm` + edge_share_text(r.quality.min_edge_size_ratio)],
  ["least height", "quality", (r) => `${number(r.quality.min_height_mm)} mm: stable time step up to ${number(r.quality.min_stable_time_step_us)} µs at ${number(r.quality.wave_speed_m_per_s)} m/s`],
  ["least volume", "quality", (r) => `${number(r.quality.min_volume_mm3)} mm³, median ${number(r.quality.median_volume_mm3)} mm³`],
  ["condition number", "quality", (r) => `up to ${number(r.quality.condition_factor)} times that of regular tetrahedra of the median volume, by shape alone ${number(r.quality.max_stiffness_ratio)} times`],
  ["circumradius", "quality", (r) => `up to ${number(r.quality.max_circumradius_mm)} mm`],
  ["circumradius / size", "quality", (r) => size_text(r.quality.statistics.size_ratio)],
  ["topology", "topology", (r) => topology_text(r.topology)],
  ["handles", "topology", (r) => handle_check_text(r.topology.handle_check)],
  ["surface to mesh", "distance", (r) => distance_text(r.distance.to_mesh)],
  ["mesh to surface", "distance", (r) => distance_text(r.distance.to_surface)],
  ["dropped", "components", (r) => dropped_text(r.components)],
  ["rules", "rules", (r) => rules_text(r.rules)],
  ["improvement", "optimization", (r) => improvement_text(r.optimization)],
  ["bounds", "bounds", (r) => bounds_text(r.bounds)],
  ["short edges", "short_edges", (r) => short_edges_text(r.short_edges)],
  ["proofs", "theory", (r) => r.theory.meaning],
  ["audit", "audit", (r) => r.audit.passed ? "passed" : counted(r.audit.findings.length, "fault", "faults") + ", see below"],
  ["time", "timing_s", (r) => `${r.timing_s.total.toFixed(2)} s`],
];

function fill_summary(data) {
  const table = document.getElementById("summary");
  if (data.meshes.length > 1) {
    const names = data.meshes.map((mesh) => element("th", swatch(mesh), mesh.name));
    table.append(element("thead", element("tr", element("th"), ...names)));
  }
  for (const [label, part, say] of kSummary) {
    const values = data.meshes.map((mesh) => mesh.report[part] ? say(mesh.report) : "");
    if (values.some((value) => value !== "")) {
      table.append(element("tr", element("th", label), ...values.map((value) => element("td", value))));
    }
  }
}

// What two meshes that are compared have of everything, side by side.
function fill_difference(data) {
  if (!data.difference) return;
  const {verdict, same, reasons, rows} = data.difference;
  const names = data.meshes.map((mesh) => element("th", swatch(mesh), mesh.name));
  const lines = rows.map((row) => element("tr", element("th", row.what), ...row.values.map((value) => element("td", value)), element("td", row.change)));
  document.getElementById("difference").append(element("thead", element("tr", element("th"), ...names, element("th", "change"))), ...lines);
  document.getElementById("difference-verdict").textContent = same ? verdict : `different: ${reasons.join("; ")}`;
  document.getElementById("difference-panel").hidden = false;
}

function details_table(title, rows) {
  const table = element("table", ...rows.map(([label, value]) => element("tr", element("th", label), element("td", value))));
  return element("div", element("h3", title), table);
}

function findings_list(findings) {
  const items = findings.map((f) => element("li", `${f.message}, at ${place_text(f.where_mm)}. Remedy: ${f.remedy}. `, element("code", f.code)));
  const box = element("div", element("h3", "Faults"), element("ul", ...items));
  box.className = "findings";
  return box;
}

function notes_list(notes) {
  const box = element("div", element("h3", "Notes"), element("ul", ...notes.map((note) => element("li", note))));
  box.className = "notes";
  return box;
}

function option_text(value) {
  if (value === null) return "none";
  return Array.isArray(value) ? value.join(", ") : String(value);
}

function fill_details(mesh) {
  const r = mesh.report;
  const parts = [];
  if (r.audit && r.audit.findings.length > 0) parts.push(findings_list(r.audit.findings));
  if (r.notes) parts.push(notes_list(r.notes));
  if (r.limit) {
    const where = `${r.limit.rule} kept inserting points, the last at ${place_text(r.limit.place_mm)}, ` +
        `${number(r.limit.insertion_radius_mm)} mm from its nearest vertex`;
    parts.push(details_table("Stopped at the largest number of vertices", [["where", where]]));
  }
  if (r.input) parts.push(details_table("Input", [["path", r.input.path], ["sha256", r.input.sha256 || "unknown"]]));
  const regions = (r.regions || []).filter((g) => g.region !== 0);
  if (regions.length > 1) {
    parts.push(details_table("Regions", regions.map((g) => [region_name(g), region_text(g)])));
  }
  if (r.components && r.components.dropped.largest.length > 0) {
    const rows = r.components.dropped.largest.map((c) => [`${number(c.volume_mm3)} mm³`, `at ${place_text(c.witness_mm)}`]);
    parts.push(details_table("Largest components dropped", rows));
  }
  if (r.timing_s) parts.push(details_table("Time", Object.entries(r.timing_s).map(([stage, s]) => [stage, `${s.toFixed(2)} s`])));
  if (r.stages) {
    const rows = r.stages.map((s) => [s.stage, `${s.seconds.toFixed(2)} s` + (s.points > 0 ? `, ${counted(s.points, "point", "points")}` : "")]);
    parts.push(details_table("Stages", rows));
  }
  if (r.phases) parts.push(details_table("Phases", r.phases.map((p) => [`${p.stage}: ${p.part}`, `${p.seconds.toFixed(2)} s`])));
  if (r.options) parts.push(details_table("Options", Object.entries(r.options).map(([name, value]) => [name, option_text(value)])));
  document.getElementById("details").replaceChildren(...parts);
  const verdict = document.getElementById("verdict");
  verdict.className = r.audit && r.audit.passed ? "verdict good" : "verdict bad";
  verdict.textContent = !r.audit ? "" : r.audit.passed ? "audit passed" : `audit: ${counted(r.audit.findings.length, "fault", "faults")}`;
}
