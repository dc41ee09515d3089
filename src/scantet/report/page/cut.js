// What a plane leaves of a mesh: every tet that reaches the kept side is shown whole. Of these only faces that can be
// seen become triangles: faces towards a tet that is gone, and faces of the boundary that the plane cuts.
// Regions that are hidden are as if they were not there.
"use strict";

const kNoTet = 0xffffffff;

// The arrays of a mesh from its <script> element; layout: page_mesh_impl.h.
function read_geometry(about, base64) {
  const binary = atob(base64);
  const bytes = new Uint8Array(binary.length);
  for (let i = 0; i < binary.length; ++i) bytes[i] = binary.charCodeAt(i);
  let at = 0;
  const take = (type, count) => {
    const array = new type(bytes.buffer, at, count);
    at += array.byteLength;
    return array;
  };
  const several = about.regions || [];
  const geometry = {
    ...about,
    coordinates: take(Float32Array, 3 * about.vertices),
    corners: take(Uint32Array, 4 * about.tets),
    facets: take(Uint32Array, 3 * about.facets),
    facet_tets: take(Uint32Array, about.facets),
    regions: several,
    facet_fronts: take(Uint32Array, several.length > 0 ? about.facets : 0),
    facet_sides: take(Uint16Array, several.length > 0 ? 2 * about.facets : 0),
    tet_regions: take(Uint16Array, several.length > 0 ? about.tets : 0),
    shown: new Uint8Array(several.length).fill(1),  // by region
    complete: about.numbers === undefined,
  };
  geometry.colorings = about.colorings.map((c) => ({...c, values: take(Uint8Array, about.tets)}));
  // Surfaces alone are coloured by these; of two meshes that are compared they come first.
  const of_facets = (about.facet_colorings || []).map((c) => ({...c, of_facets: true, values: take(Uint8Array, about.facets)}));
  geometry.colorings.unshift(...of_facets);
  geometry.kept = new Uint8Array(about.vertices);
  return geometry;
}

const kNoRegion = 0xffff;

// Whether a tet's region is shown.
function tet_is_shown(geometry, tet) {
  return geometry.regions.length === 0 || geometry.shown[geometry.tet_regions[tet]] === 1;
}

// Which side of a facet is shown alone, so that the facet is seen: 0 behind, 1 in front, -1 neither or both.
function open_side(geometry, facet) {
  if (geometry.regions.length === 0) return 0;
  const shows = (region) => region !== kNoRegion && geometry.shown[region] === 1;
  const behind = shows(geometry.facet_sides[2 * facet]);
  const front = shows(geometry.facet_sides[2 * facet + 1]);
  return behind === front ? -1 : behind ? 0 : 1;
}

// Finds the face of a tet (its corners but one, ascending) among those seen before.
class FacePairs {
  constructor(vertices) {
    this.vertices = vertices;
    this.faces = new Map();  // by the two smallest corners: third corners and places, one after the other
  }
  // The place given with the same face before, or -1.
  match(a, b, c, place) {
    const low = Math.min(a, b, c);
    const high = Math.max(a, b, c);
    const key = low * this.vertices + (a + b + c - low - high);
    const entry = this.faces.get(key);
    if (entry === undefined) {
      this.faces.set(key, [high, place]);
      return -1;
    }
    for (let i = 0; i < entry.length; i += 2) {
      if (entry[i] === high) return entry[i + 1];
    }
    entry.push(high, place);
    return -1;
  }
}

// side: 1 keeps what lies below `position` on the axis, -1 what lies above. Return: {faces, tets}: three vertices a
// visible triangle, and its tet.
function cut_faces(geometry, axis, position, side) {
  const {coordinates, corners, kept} = geometry;
  for (let v = 0; v < kept.length; ++v) kept[v] = side * (coordinates[3 * v + axis] - position) <= 0 ? 1 : 0;
  const faces = [];
  const tets = [];
  const hidden = [];
  const pairs = new FacePairs(geometry.vertices);
  // A face whose vertices are all gone is that of a tet with one vertex left. It is hidden if two such tets share it.
  for (let t = 0; t < geometry.tets && geometry.complete; ++t) {
    const a = corners[4 * t], b = corners[4 * t + 1], c = corners[4 * t + 2], d = corners[4 * t + 3];
    if (kept[a] + kept[b] + kept[c] + kept[d] !== 1 || !tet_is_shown(geometry, t)) continue;
    const face = kept[a] ? [b, c, d] : kept[b] ? [a, c, d] : kept[c] ? [a, b, d] : [a, b, c];
    const before = pairs.match(face[0], face[1], face[2], tets.length);
    if (before >= 0) {
      hidden[before] = true;
    } else {
      faces.push(face[0], face[1], face[2]);
      tets.push(t);
    }
  }
  for (let f = 0; f < geometry.facets.length / 3; ++f) {
    const open = open_side(geometry, f);
    const tet = open < 0 ? kNoTet : open === 0 ? geometry.facet_tets[f] : geometry.facet_fronts[f];
    if (tet === kNoTet) continue;
    const a = geometry.facets[3 * f], b = geometry.facets[3 * f + 1], c = geometry.facets[3 * f + 2];
    const count = kept[a] + kept[b] + kept[c];
    if (count === 0 || count === 3) continue;
    faces.push(a, b, c);
    tets.push(tet);
  }
  const seen = {faces: [], tets: []};
  for (let i = 0; i < tets.length; ++i) {
    if (hidden[i]) continue;
    seen.faces.push(faces[3 * i], faces[3 * i + 1], faces[3 * i + 2]);
    seen.tets.push(tets[i]);
  }
  return seen;
}
