// A scan as a page holds it: its voxels, and the way between index and world.
"use strict";

function dot3(a, b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

function cross3(a, b) {
  return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
}

class SliceScan {
  constructor(about, base64) {
    const binary = atob(base64);
    const bytes = new Uint8Array(binary.length);
    for (let i = 0; i < binary.length; ++i) bytes[i] = binary.charCodeAt(i);
    Object.assign(this, about);
    this.values = new Uint16Array(bytes.buffer);
    const [a, b, c] = this.columns_mm;
    const volume = dot3(a, cross3(b, c));
    this.rows = [cross3(b, c), cross3(c, a), cross3(a, b)].map((row) => row.map((x) => x / volume));
    this.grey_levels = this.levels.map((level) => 65535 * (level - this.low) / (this.high - this.low));
  }

  // Of a label map.
  has_regions() {
    return this.regions.length > 0;
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
