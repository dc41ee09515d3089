// Lists of places in the mesh: its worst tets, its components and cavities. A click on one goes there.
"use strict";

const kMostParts = 200;  // in a list

// These values in as many digits as tell them apart: four at least, eight at most.
function told_apart(values) {
  const different = new Set(values).size;
  let texts = values.map((value) => number(value));
  for (let digits = 5; digits <= 8 && new Set(texts).size < different; ++digits) {
    texts = values.map((value) => value === null ? number(value) : value.toPrecision(digits));
  }
  return texts;
}

function handles_text(count) {
  const words = ["no", "one", "two", "three", "four", "five", "six", "seven", "eight", "nine"];
  return `${words[count] || number(count)} ${count === 1 ? "handle" : "handles"}`;
}

// What the Euler numbers of these surfaces mean; nothing where the boundary is not manifold.
function genus_text(surfaces) {
  if (surfaces.length === 0 || surfaces.some((s) => s.handles === null)) return "";
  const sum = d3.sum(surfaces, (s) => s.handles);
  if (surfaces.length === 1) return `genus ${sum}: ${handles_text(sum)}`;
  if (surfaces.length > 4) return `${number(surfaces.length)} surfaces with ${handles_text(sum)} together`;
  return `surfaces of genus ${surfaces.map((s) => s.handles).join(", ")}: ${handles_text(sum)}`;
}

function box_center({min, max}) {
  const rounding = 1e-9 * Math.max(...min.map((low, axis) => max[axis] - low));
  return min.map((low, axis) => (low + max[axis]) / 2).map((x) => Math.abs(x) < rounding ? 0 : x);
}

// A button of a list. texts: what stands in its columns.
function place_button(texts, go) {
  const button = element("button", ...texts.map((text) => element("span", text)));
  button.type = "button";
  button.disabled = !go;
  button.setAttribute("aria-pressed", "false");
  if (go) button.addEventListener("click", () => go(button));
  return element("li", button);
}

// The worst tets by one measure. visit(tet, text, button), or null where there is no view.
function worst_buttons(list, tets, visit) {
  const values = told_apart(tets.map((tet) => tet.value));
  return tets.map((tet, i) => {
    const value = values[i] + list.unit;
    const text = `tet ${tet.tet}: ${list.title} ${value}, at ${place_text(tet.place_mm)}`;
    return place_button([value, `tet ${tet.tet}`, coordinates(tet.place_mm)], visit && ((button) => visit(tet, text, button)));
  });
}

// What is missing, components and cavities: {title, parts} each, the largest parts first.
function parts_of(topology) {
  const regions = new Set(topology.component_list.map((c) => c.region)).size;
  const missing = (topology.missing || []).map((m) => ({...m, name: `missing ${m.kind}`, about: ""}));
  const surfaces = topology.component_list.map(() => []);
  for (const surface of topology.surface_list) surfaces[surface.component].push(surface);
  const components = topology.component_list.map((c, i) => ({
    ...c,
    name: "component" + (regions > 1 ? ` of region ${c.region}` : ""),
    about: genus_text(surfaces[i]),
  }));
  const cavities = topology.cavity_list.map((c) => ({...c, name: "cavity", about: genus_text([c])}));
  const different = topology.handle_check ? topology.handle_check.different.map((d) => ({
    ...d,
    name: d.kind,
    about: d.expected_handles === null ? `Euler number ${d.euler}, in the input ${d.expected_euler}` :
                                         `${handles_text(d.handles)}, in the input ${number(d.expected_handles)}`,
  })) : [];
  return [
    {title: "Missing", parts: missing},
    {title: "Other handles than in the input", parts: different},
    {title: counted(components.length, "component", "components"), parts: components},
    {title: counted(cavities.length, "cavity", "cavities"), parts: cavities},
  ].map(({title, parts}) => ({title, parts: parts.sort((a, b) => b.volume_mm3 - a.volume_mm3)})).filter((g) => g.parts.length > 0);
}

// The lists of them, under their titles. visit(part, text, button), or null where there is no view.
function part_lists(topology, visit) {
  return parts_of(topology).map(({title, parts}) => {
    const items = parts.slice(0, kMostParts).map((part) => {
      const volume = part.volume_mm3 === null ? "" : `${number(part.volume_mm3)} mm³`;
      const place = box_center(part.box_mm);
      const text = [part.name, volume, part.about].filter((t) => t !== "").join(", ") + `, at ${place_text(place)}`;
      return place_button([part.name, volume, coordinates(place), part.about], visit && ((button) => visit(part, text, button)));
    });
    if (parts.length > kMostParts) items.push(element("li", `and ${number(parts.length - kMostParts)} smaller ones`));
    const list = element("ol", ...items);
    list.className = "places";
    return element("div", element("h3", title), list);
  });
}

// The places where the mesh and the surface are farthest from each other. visit(place, text, button), or null.
function far_lists(distance, visit) {
  return [["From the surface to the mesh", distance.to_mesh], ["From the mesh to the surface", distance.to_surface]]
      .filter(([, way]) => way.worst.length > 0)
      .map(([title, way]) => {
        const values = told_apart(way.worst.map((place) => place.distance_mm));
        const items = way.worst.map((place, i) => {
          const text = `${title.toLowerCase()}: ${values[i]} mm, at ${place_text(place.place_mm)}`;
          return place_button([`${values[i]} mm`, coordinates(place.place_mm)], visit && ((button) => visit(place, text, button)));
        });
        const list = element("ol", ...items);
        list.className = "places";
        return element("div", element("h3", title), list);
      });
}
