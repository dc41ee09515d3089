// The scan in three slices along its own axes, with the mesh's cut and the level set on them. A slice is the plane of a
// layer of voxel centres; there the level set is that of a bilinear function between each four of them. Of a label map
// voxels have their regions' colours; the fronts between these are drawn, and where in the field one region ends and the
// next begins.
"use strict";

const kMeshLine = "#0a84ff";
const kLevelLine = "#ffb000";
const kFrontLine = "rgba(255, 255, 255, .45)";
const kCrossLine = "rgba(255, 80, 160, .55)";
const kLevelParts = 4;  // of each side of a square between voxel centres
const kEnds = [["R", "L"], ["A", "P"], ["I", "S"]];
const kSliceNames = ["across i", "across j", "across k"];

// One slice: its canvas, its slider, and how places of the image lie on it.
class Slice {
  constructor(owner, normal, parent) {
    this.owner = owner;
    this.normal = normal;
    this.canvas = document.createElement("canvas");
    this.canvas.tabIndex = 0;
    this.slider = document.createElement("input");
    Object.assign(this.slider, {type: "range", min: 0, step: 1});
    this.slider.setAttribute("aria-label", `Slice ${kSliceNames[normal]}`);
    this.text = document.createElement("output");
    parent.append(element("figure", this.canvas, element("figcaption", this.text, this.slider)));
    this.slider.addEventListener("input", () => this.owner.scroll(this.normal, Number(this.slider.value)));
    this.canvas.addEventListener("wheel", (event) => {
      event.preventDefault();
      this.owner.scroll(this.normal, Math.round(this.owner.at[this.normal]) + Math.sign(event.deltaY));
    }, {passive: false});
    this.canvas.addEventListener("keydown", (event) => {
      const step = {ArrowUp: 1, ArrowDown: -1, PageUp: 10, PageDown: -10}[event.key];
      if (step === undefined) return;
      event.preventDefault();
      this.owner.scroll(this.normal, Math.round(this.owner.at[this.normal]) + step);
    });
    this.canvas.addEventListener("click", (event) => this.point(event));
  }

  // Lays the image's axes out: to the left of the patient, or else to the back, is to the right; to the head, or else to
  // the front, is up.
  lay_out(scan) {
    this.scan = scan;
    let [u, v] = [0, 1, 2].filter((n) => n !== this.normal);
    if (scan.direction(u).axis > scan.direction(v).axis) [u, v] = [v, u];
    this.across = u;
    this.down = v;
    const [cu, cv] = [scan.columns_mm[u], scan.columns_mm[v]];
    const [lu, lv] = [Math.hypot(...cu), Math.hypot(...cv)];
    const cosine = dot3(cu, cv) / (lu * lv);
    const right = scan.direction(u).sign;
    const down = scan.direction(v).sign * (scan.direction(v).axis === 2 ? -1 : 1);
    this.step_u = [right * lu, 0];  // on the screen, mm
    this.step_v = [right * lv * cosine, down * lv * Math.sqrt(Math.max(1 - cosine * cosine, 0))];
    this.slider.max = scan.size[this.normal] - 1;
    this.ends = [scan.direction(u), scan.direction(v)];
    this.right = right;
    this.turned = down;
  }

  place_on(u, v) {
    return [this.offset[0] + this.zoom * (u * this.step_u[0] + v * this.step_v[0]), this.offset[1] + this.zoom * v * this.step_v[1]];
  }

  point(event) {
    const ratio = this.canvas.width / this.canvas.clientWidth;
    const v = (event.offsetY * ratio - this.offset[1]) / (this.zoom * this.step_v[1]);
    const u = ((event.offsetX * ratio - this.offset[0]) / this.zoom - v * this.step_v[0]) / this.step_u[0];
    const index = [...this.owner.at];
    index[this.across] = u;
    index[this.down] = v;
    this.owner.move(index);
  }

  fit() {
    const ratio = window.devicePixelRatio || 1;
    const width = Math.max(Math.round(this.canvas.clientWidth * ratio), 1);
    const height = Math.max(Math.round(this.canvas.clientHeight * ratio), 1);
    if (this.canvas.width !== width) this.canvas.width = width;
    if (this.canvas.height !== height) this.canvas.height = height;
    const {size} = this.scan;
    const [nu, nv] = [size[this.across], size[this.down]];
    const wide = nu * Math.abs(this.step_u[0]) + nv * Math.abs(this.step_v[0]);
    const high = nv * Math.abs(this.step_v[1]);
    this.zoom = 0.94 * Math.min(width / wide, height / high) * this.owner.zoom;
    const middle = this.owner.zoom > 1 ? [this.owner.at[this.across], this.owner.at[this.down]] : [(nu - 1) / 2, (nv - 1) / 2];
    this.offset = [0, 0];
    const [x, y] = this.place_on(...middle);
    this.offset = [width / 2 - x, height / 2 - y];
  }

  draw() {
    this.fit();
    const layer = Math.round(this.owner.at[this.normal]);
    this.slider.value = layer;
    const place = [...this.owner.at];
    place[this.normal] = layer;
    this.text.textContent = `${kSliceNames[this.normal]}: ${layer + 1} of ${this.scan.size[this.normal]}`;
    const context = this.canvas.getContext("2d");
    context.setTransform(1, 0, 0, 1, 0, 0);
    context.fillStyle = "#101317";
    context.fillRect(0, 0, this.canvas.width, this.canvas.height);
    this.draw_voxels(context, layer);
    if (this.owner.shows("fill")) this.draw_tets(context, layer);
    if (this.owner.shows("level")) this.draw_level(context, layer);
    if (this.owner.shows("mesh")) this.draw_outline(context, layer);
    this.draw_cross(context);
    this.draw_ends(context);
  }

  index_of(u, v, layer) {
    const {size} = this.scan;
    const index = [0, 0, 0];
    index[this.across] = u;
    index[this.down] = v;
    index[this.normal] = layer;
    return (index[2] * size[1] + index[1]) * size[0] + index[0];
  }

  draw_voxels(context, layer) {
    const {size, values} = this.scan;
    const [nu, nv] = [size[this.across], size[this.down]];
    const image = new ImageData(nu, nv);
    const [low, high] = this.owner.window();
    const colors = this.scan.has_regions() ? this.owner.voxel_colors : null;
    const du = this.index_of(1, 0, 0) - this.index_of(0, 0, 0);
    for (let v = 0; v < nv; ++v) {
      let from = this.index_of(0, v, layer);
      for (let u = 0; u < nu; ++u, from += du) {
        const to = 4 * (v * nu + u);
        image.data[to + 3] = 255;
        if (colors) {
          image.data.set(colors[values[from]], to);
          continue;
        }
        const grey = 255 * (values[from] - low) / (high - low);  // is clamped
        image.data[to] = image.data[to + 1] = image.data[to + 2] = grey;
      }
    }
    const flat = document.createElement("canvas");
    flat.width = nu;
    flat.height = nv;
    flat.getContext("2d").putImageData(image, 0, 0);
    const z = this.zoom;
    context.imageSmoothingEnabled = false;
    context.setTransform(z * this.step_u[0], 0, z * this.step_v[0], z * this.step_v[1], ...this.offset);
    context.drawImage(flat, -0.5, -0.5);  // voxels are around their centres
    context.setTransform(1, 0, 0, 1, 0, 0);
  }

  // Where edge (a, b) of the mesh meets the layer, on the screen. Vertices on the layer count as above it.
  meet(a, b, layer) {
    const {index} = this.owner;
    const da = index[3 * a + this.normal] - layer;
    const t = da / (index[3 * a + this.normal] - index[3 * b + this.normal]);
    const at = (axis) => index[3 * a + axis] + t * (index[3 * b + axis] - index[3 * a + axis]);
    return this.place_on(at(this.across), at(this.down));
  }

  draw_outline(context, layer) {
    const {facets} = this.owner.geometry;
    const above = (v) => this.owner.index[3 * v + this.normal] >= layer;
    context.beginPath();
    this.segments = 0;
    for (let f = 0; f < facets.length; f += 3) {
      const [a, b, c] = [facets[f], facets[f + 1], facets[f + 2]];
      const count = above(a) + above(b) + above(c);
      if (count === 0 || count === 3) continue;
      const alone = count === 1 ? true : false;
      const [p, q, r] = above(a) === alone ? [a, b, c] : above(b) === alone ? [b, c, a] : [c, a, b];
      context.moveTo(...this.meet(p, q, layer));
      context.lineTo(...this.meet(p, r, layer));
      ++this.segments;
    }
    context.strokeStyle = kMeshLine;
    context.lineWidth = 1.5 * (window.devicePixelRatio || 1);
    context.stroke();
  }

  // Each region in its colour.
  draw_tets(context, layer) {
    const {geometry, index} = this.owner;
    const paths = new Map();
    const above = (v) => index[3 * v + this.normal] >= layer;
    for (let t = 0; t < geometry.tets && geometry.complete; ++t) {
      const corners = geometry.corners.subarray(4 * t, 4 * t + 4);
      const count = above(corners[0]) + above(corners[1]) + above(corners[2]) + above(corners[3]);
      if (count === 0 || count === 4) continue;
      const up = [], down = [];
      for (const v of corners) (above(v) ? up : down).push(v);
      const region = geometry.regions.length > 0 ? geometry.tet_regions[t] : 0;
      if (!paths.has(region)) paths.set(region, new Path2D());
      const path = paths.get(region);
      const around = up.length === 2 ? [[up[0], down[0]], [up[0], down[1]], [up[1], down[1]], [up[1], down[0]]]
                                     : up.flatMap((a) => down.map((b) => [a, b]));
      around.forEach(([a, b], n) => {
        const [x, y] = this.meet(a, b, layer);
        n === 0 ? path.moveTo(x, y) : path.lineTo(x, y);
      });
      path.closePath();
    }
    for (const [region, path] of paths) {
      context.globalAlpha = 0.32;
      context.fillStyle = this.owner.color_of(region);
      context.fill(path);
    }
    context.globalAlpha = 1;
  }

  draw_level(context, layer) {
    if (this.scan.has_regions()) {
      this.draw_squares(context, layer, kFrontLine, 0.8, (u, v, voxels) => this.draw_fronts(context, u, v, voxels));
      this.draw_squares(context, layer, kLevelLine, 1.2, (u, v, voxels) => this.draw_outline_of_field(context, u, v, voxels));
      return;
    }
    const {values, grey_levels} = this.scan;
    this.draw_squares(context, layer, kLevelLine, 1.2, (u, v, voxels) => {
      const f = voxels.map((voxel) => values[voxel]);
      for (const level of grey_levels) {
        if (Math.min(...f) < level && Math.max(...f) >= level) this.trace(context, u, v, f, level);
      }
    });
  }

  // What `trace` adds to the path for each square between four voxels of a layer.
  draw_squares(context, layer, color, width, trace) {
    const [nu, nv] = [this.scan.size[this.across], this.scan.size[this.down]];
    context.beginPath();
    for (let v = 0; v + 1 < nv; ++v) {
      for (let u = 0; u + 1 < nu; ++u) {
        trace(u, v, [this.index_of(u, v, layer), this.index_of(u + 1, v, layer), this.index_of(u, v + 1, layer), this.index_of(u + 1, v + 1, layer)]);
      }
    }
    context.strokeStyle = color;
    context.lineWidth = width * (window.devicePixelRatio || 1);
    context.stroke();
  }

  draw_outline_of_field(context, u, v, voxels) {
    for (const [from, to] of this.scan.outline_in(voxels)) {
      context.moveTo(...this.place_on(u + from[0], v + from[1]));
      context.lineTo(...this.place_on(u + to[0], v + to[1]));
    }
  }

  // Where neighbours are of different regions: between voxel (u, v) and those after it.
  draw_fronts(context, u, v, voxels) {
    const [here, beside, below] = voxels.map((voxel) => this.scan.values[voxel]);
    if (here !== beside) {
      context.moveTo(...this.place_on(u + 0.5, v - 0.5));
      context.lineTo(...this.place_on(u + 0.5, v + 0.5));
    }
    if (here !== below) {
      context.moveTo(...this.place_on(u - 0.5, v + 0.5));
      context.lineTo(...this.place_on(u + 0.5, v + 0.5));
    }
  }

  // The level set in a square between four voxel centres, in parts whose sides it crosses once at most.
  trace(context, u0, v0, f, level) {
    const at = (u, v) => (1 - v) * ((1 - u) * f[0] + u * f[1]) + v * ((1 - u) * f[2] + u * f[3]) - level;
    for (let n = 0; n < kLevelParts * kLevelParts; ++n) {
      const u = n % kLevelParts / kLevelParts, v = Math.floor(n / kLevelParts) / kLevelParts, step = 1 / kLevelParts;
      const corners = [[u, v], [u + step, v], [u + step, v + step], [u, v + step]];
      const heights = corners.map((c) => at(...c));
      const points = [];
      for (let i = 0; i < 4; ++i) {
        const [a, b] = [heights[i], heights[(i + 1) % 4]];
        if (a < 0 === b < 0) continue;
        const t = a / (a - b);
        points.push([0, 1].map((k) => corners[i][k] + t * (corners[(i + 1) % 4][k] - corners[i][k])));
      }
      // Of four points at a saddle the middle says which belong together.
      const turn = points.length === 4 && at(u + step / 2, v + step / 2) < 0 === heights[0] < 0 ? 0 : points.length === 4 ? 1 : 0;
      for (let i = 0; i + 1 < points.length; i += 2) {
        const [p, q] = [points[(i + turn) % points.length], points[(i + 1 + turn) % points.length]];
        context.moveTo(...this.place_on(u0 + p[0], v0 + p[1]));
        context.lineTo(...this.place_on(u0 + q[0], v0 + q[1]));
      }
    }
  }

  draw_cross(context) {
    const [x, y] = this.place_on(this.owner.at[this.across], this.owner.at[this.down]);
    context.strokeStyle = kCrossLine;
    context.lineWidth = window.devicePixelRatio || 1;
    context.beginPath();
    context.moveTo(x, 0);
    context.lineTo(x, this.canvas.height);
    context.moveTo(0, y);
    context.lineTo(this.canvas.width, y);
    context.stroke();
  }

  // Which way the patient's sides are.
  draw_ends(context) {
    const ratio = window.devicePixelRatio || 1;
    const [u, v] = this.ends;
    const name = ({axis, sign}, to) => kEnds[axis][sign * to > 0 ? 1 : 0];
    context.fillStyle = "#e8edf2";
    context.font = `${13 * ratio}px sans-serif`;
    context.textAlign = "center";
    context.textBaseline = "middle";
    const {width, height} = this.canvas;
    context.fillText(name(u, this.right), width - 10 * ratio, height / 2);
    context.fillText(name(u, -this.right), 10 * ratio, height / 2);
    context.fillText(name(v, this.turned), width / 2, height - 10 * ratio);
    context.fillText(name(v, -this.turned), width / 2, 10 * ratio);
  }
}

// All three, and what they have in common.
class Slices {
  constructor(panel) {
    this.by_id = (id) => document.getElementById(id);
    this.parts = [2, 1, 0].map((normal) => new Slice(this, normal, panel));
    this.zoom = 1;
    for (const id of ["fill", "level", "mesh"]) this.by_id(`slices-${id}`).addEventListener("change", () => this.draw());
    for (const id of ["low", "high"]) this.by_id(`slices-${id}`).addEventListener("input", () => this.draw());
    this.by_id("slices-zoom").addEventListener("input", (event) => {
      this.zoom = 2 ** Number(event.target.value);
      this.draw();
    });
    this.by_id("slices-form").addEventListener("submit", (event) => event.preventDefault());
    new ResizeObserver(() => this.draw()).observe(panel);
  }

  // colors: of regions of the mesh, as texts; voxel_colors: of those of a label map, as numbers.
  show(scan, geometry, colors, voxel_colors) {
    this.scan = scan;
    this.geometry = geometry;
    this.colors = colors;
    this.voxel_colors = voxel_colors;
    this.by_id("slices-level-name").textContent = scan.has_regions() ? "field's outline, voxels' fronts" : "level set";
    for (const part of document.querySelectorAll(".slices-grey")) part.hidden = scan.has_regions();
    this.index = new Float32Array(geometry.coordinates.length);
    for (let v = 0; v < geometry.coordinates.length; v += 3) {
      const place = [0, 1, 2].map((axis) => geometry.center_mm[axis] + geometry.scale_mm * geometry.coordinates[v + axis]);
      this.index.set(scan.to_index(place), v);
    }
    for (const part of this.parts) part.lay_out(scan);
    this.set_window();
    this.move(scan.to_index(geometry.center_mm));
  }

  // The window is around the levels as far as values go, on sliders of a thousand steps.
  set_window() {
    this.by_id("slices-low").value = 0;
    this.by_id("slices-high").value = 1000;
  }

  window() {
    const [low, high] = ["low", "high"].map((id) => 65.535 * Number(this.by_id(`slices-${id}`).value));
    const {low: least, high: most} = this.scan;
    const value = (grey) => number(least + (most - least) * grey / 65535);
    this.by_id("slices-window").textContent = `${value(Math.min(low, high))} to ${value(Math.max(low, high))}`;
    return low < high ? [low, high] : [high, Math.max(low, high + 1)];
  }

  shows(id) {
    return this.by_id(`slices-${id}`).checked;
  }

  color_of(region) {
    return this.colors[region] || "#3fa7ff";
  }

  scroll(axis, to) {
    const at = [...this.at];
    at[axis] = to;
    this.move(at);
  }

  // To a place, index; it stays in the image.
  move(index) {
    this.at = index.map((x, axis) => Math.min(Math.max(x, 0), this.scan.size[axis] - 1));
    this.by_id("slices-at").textContent = `at ${place_text(this.scan.to_world(this.at))}`;
    this.draw();
  }

  go(place_mm) {
    if (this.scan) this.move(this.scan.to_index(place_mm));
  }

  draw() {
    if (this.waiting || !this.scan) return;
    this.waiting = true;
    requestAnimationFrame(() => {
      this.waiting = false;
      for (const part of this.parts) part.draw();
    });
  }
}
