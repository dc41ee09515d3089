// A scan as a page holds it: its voxels, and the way between index and world.
"use strict";

function dot3(a, b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

function cross3(a, b) {
  return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
}

function bytes_of(base64) {
  const binary = atob(base64.trim());
  const bytes = new Uint8Array(binary.length);
  for (let i = 0; i < binary.length; ++i) bytes[i] = binary.charCodeAt(i);
  return bytes.buffer;
}

const kFieldParts = 4;  // of each side of a square between voxel centres

class SliceScan {
  // field: of a label map whose fields are smooth, for voxels where regions meet: voxel, region and value.
  constructor(about, base64, field = "") {
    Object.assign(this, about);
    this.values = new Uint16Array(bytes_of(base64));
    const bytes = bytes_of(field);
    [this.field_voxels, this.field_parts] = [new Uint32Array(bytes), new Uint16Array(bytes)];
    this.field_start = new Map();
    for (let n = this.field_voxels.length - 2; n >= 0; n -= 2) this.field_start.set(this.field_voxels[n], n);
    const [a, b, c] = this.columns_mm;
    const volume = dot3(a, cross3(b, c));
    this.rows = [cross3(b, c), cross3(c, a), cross3(a, b)].map((row) => row.map((x) => x / volume));
    this.grey_levels = this.levels.map((level) => 65535 * (level - this.low) / (this.high - this.low || 1));
  }

  // Of a label map.
  has_regions() {
    return this.regions.length > 0;
  }

  // The value of a region's field at a voxel.
  field_at(voxel, region) {
    for (let n = this.field_start.get(voxel); n < this.field_voxels.length && this.field_voxels[n] === voxel; n += 2) {
      if (this.field_parts[2 * n + 2] === region) return this.field_parts[2 * n + 3];
    }
    return this.values[voxel] === region ? 65535 : 0;
  }

  // Where the region of the largest field changes within a square between four voxels: lines from and to (u, v) in it.
  // The square is cut into parts with a region at each corner; a side between two regions is cut where their fields are
  // equal, two cuts of a part make a line, and more meet at its middle.
  outline_in(voxels) {
    const regions = [...new Set(voxels.map((voxel) => this.values[voxel]))];
    if (regions.length === 1) return [];
    const f = regions.map((region) => voxels.map((voxel) => this.field_at(voxel, region)));
    const at = (n, [u, v]) => (1 - v) * ((1 - u) * f[n][0] + u * f[n][1]) + v * ((1 - u) * f[n][2] + u * f[n][3]);
    const largest = (p) => f.reduce((best, _, n) => at(n, p) > at(best, p) ? n : best, 0);
    const lines = [];
    for (let n = 0; n < kFieldParts * kFieldParts; ++n) {
      const step = 1 / kFieldParts, u = step * (n % kFieldParts), v = step * Math.floor(n / kFieldParts);
      const corners = [[u, v], [u + step, v], [u + step, v + step], [u, v + step]];
      const owners = corners.map(largest);
      const cuts = [];
      for (let i = 0; i < 4; ++i) {
        const [a, b] = [owners[i], owners[(i + 1) % 4]];
        if (a === b) continue;
        const [p, q] = [corners[i], corners[(i + 1) % 4]];
        const [here, there] = [at(a, p) - at(b, p), at(b, q) - at(a, q)];
        const t = here + there > 0 ? here / (here + there) : 0.5;
        cuts.push([p[0] + t * (q[0] - p[0]), p[1] + t * (q[1] - p[1])]);
      }
      if (cuts.length === 2) lines.push(cuts);
      if (cuts.length < 3) continue;
      const middle = [0, 1].map((axis) => d3.mean(cuts, (cut) => cut[axis]));
      for (const cut of cuts) lines.push([cut, middle]);
    }
    return lines;
  }

  to_index(place_mm) {
    const d = place_mm.map((x, axis) => x - this.origin_mm[axis]);
    return this.rows.map((row) => dot3(row, d));
  }

  to_world(index) {
    return this.origin_mm.map((x, axis) => x + d3.sum([0, 1, 2], (n) => index[n] * this.columns_mm[n][axis]));
  }

  // Which way an index axis points: {axis: of the world, sign}.
  direction(n) {
    const column = this.columns_mm[n];
    const axis = d3.range(3).reduce((best, i) => Math.abs(column[i]) > Math.abs(column[best]) ? i : best, 0);
    return {axis, sign: Math.sign(column[axis])};
  }
}
