// Where a certificate has something to look at: what is wrong, the farthest places, what is undecided.
"use strict";

const kReasons = {
  value: "the level is not shown to lie on the fibres", slope: "the field is not shown to grow along the fibres",
  fold: "fibres may cross", crowded: "fibres may meet those of other facets", vertex: "the surface may fold at a vertex",
};

// Of level sets, of label maps, of surfaces.
const kDistances = ["mesh_to_level", "level_to_mesh", "mesh_to_field", "field_to_mesh", "mesh_to_surface", "surface_to_mesh"];

function certificate_distances(c) {
  return kDistances.filter((key) => c[key]).map((key) => [key.replaceAll("_", " "), c[key]]);
}

function certificate_text(c) {
  const distances = certificate_distances(c).map(([name, d]) =>
    `${name} ${d.upper_mm === null ? "not bounded" : `at most ${number(d.upper_mm)} mm`}`);
  const parts = c.facets.certified === undefined ? [] : [`${number(c.facets.certified)} of ${number(c.facets.count)} facets have a collar`];
  return (c.level === undefined ? "" : `level ${c.level}: `) + [...parts, distances.join(", ")].join("; ");
}

function certificate_lists(certificate, visit) {
  const levels = certificate.levels || [certificate];
  const groups = [["Wrong, not proved, or found", []], ["Farthest", []], ["Left out", []], ["Without a collar, the largest first", []]];
  for (const c of levels) {
    for (const f of c.findings) groups[0][1].push({place: f.place, about: `${f.message} [${f.code}]`, size: 1});
    for (const [name, d] of certificate_distances(c)) {
      if (d.lower_mm > 0) groups[1][1].push({place: d.lower_place, about: `${name}: at least ${number(d.lower_mm)} mm`, size: 2 * d.lower_mm});
      if (d.upper_mm !== null) groups[1][1].push({place: d.upper_place, about: `${name}: at most ${number(d.upper_mm)} mm, near here`, size: 2 * d.upper_mm});
    }
    for (const p of c.left_out ? c.left_out.parts : []) groups[2][1].push({place: p.place, about: `${p.kind} of ${number(p.volume_mm3)} mm³`, size: Math.cbrt(p.volume_mm3)});
    for (const u of c.undecided || []) {
      const place = u.min.map((x, axis) => (x + u.max[axis]) / 2);
      groups[3][1].push({place, about: kReasons[u.reason] || u.reason, size: Math.max(...u.min.map((x, axis) => u.max[axis] - x))});
    }
  }
  return groups.filter(([, places]) => places.length > 0).map(([title, places]) => {
    const items = places.slice(0, kMostParts).map(({place, about, size}) => {
      const box_mm = {min: place.map((x) => x - size / 2), max: place.map((x) => x + size / 2)};
      return place_button([about, coordinates(place)], visit && ((button) => visit(box_mm, `${about}, at ${place_text(place)}`, button)));
    });
    if (places.length > kMostParts) items.push(element("li", `and ${number(places.length - kMostParts)} more`));
    const list = element("ol", ...items);
    list.className = "places";
    return element("div", element("h3", title), list);
  });
}
