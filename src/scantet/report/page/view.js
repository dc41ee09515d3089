// The 3D view: the boundary as a shaded surface, cut by a plane, and the tets along the cut in colour. The scene is the
// mesh moved to the origin and scaled to a ball of radius 1. It is drawn when something changes, not all the time.
"use strict";

const kSurfaceColor = 0xb9c4d0;
const kCutGrey = 0xe4;  // of tets, where facets alone have colours
const kHighlight = 0xc2187b;
// From bad to good; told apart by every kind of colour vision.
const kScaleColors = ["#a50026", "#d73027", "#f46d43", "#fdae61", "#fee090", "#e0f3f8", "#abd9e9", "#74add1", "#4575b4", "#313695"];
// Each axis is cut so that the cut faces the first view: from the left, the front and above.
const kFacingSide = [1, -1, 1];
const kFirstDirection = [0.75, -0.85, 0.5];

class View {
  // Throws if the browser has no WebGL.
  constructor(canvas) {
    this.canvas = canvas;
    this.renderer = new THREE.WebGLRenderer({canvas, antialias: true, alpha: true, preserveDrawingBuffer: true});
    this.renderer.localClippingEnabled = true;
    this.renderer.setPixelRatio(window.devicePixelRatio || 1);
    this.camera = new THREE.PerspectiveCamera(32, 1, 0.01, 10);
    this.camera.up.set(0, 0, 1);
    this.scene = new THREE.Scene();
    this.scene.add(new THREE.HemisphereLight(0xffffff, 0xc8ced6, 0.78));
    const lamp = new THREE.DirectionalLight(0xffffff, 0.3);
    lamp.position.set(-0.4, 0.7, 1);
    this.camera.add(lamp);
    this.scene.add(this.camera);
    this.orbit = new THREE.OrbitControls(this.camera, canvas);
    this.orbit.enableKeys = false;  // ours turn the mesh
    this.orbit.addEventListener("change", () => this.draw());
    canvas.addEventListener("keydown", (event) => this.turn_by_key(event));
    this.plane = new THREE.Plane(new THREE.Vector3(-1, 0, 0), 0);
    this.make_objects();
    this.marks = new Marks(document.getElementById("marks"));
    new ResizeObserver(() => this.resize()).observe(canvas);
  }

  make_objects() {
    const solid = {flatShading: true, side: THREE.DoubleSide, shininess: 0, specular: 0};
    const behind = {polygonOffset: true, polygonOffsetFactor: 1, polygonOffsetUnits: 1};
    this.surface = new THREE.Mesh(
        new THREE.BufferGeometry(),
        new THREE.MeshPhongMaterial({...solid, color: kSurfaceColor, clippingPlanes: [this.plane], ...behind, polygonOffsetFactor: 2}));
    this.cut = new THREE.Mesh(new THREE.BufferGeometry(),
                              new THREE.MeshPhongMaterial({...solid, vertexColors: THREE.VertexColors, ...behind}));
    const thin = {transparent: true, opacity: 0.32, color: 0x1c2733};
    this.cut_edges = new THREE.LineSegments(new THREE.BufferGeometry(), new THREE.LineBasicMaterial(thin));
    this.worst = new THREE.Mesh(
        new THREE.BufferGeometry(),
        new THREE.MeshBasicMaterial({color: kHighlight, transparent: true, opacity: 0.35, depthTest: false, side: THREE.DoubleSide}));
    this.worst_edges =
        new THREE.LineSegments(new THREE.BufferGeometry(), new THREE.LineBasicMaterial({color: kHighlight, depthTest: false}));
    this.worst.renderOrder = this.worst_edges.renderOrder = 1;
    for (const object of [this.surface, this.cut, this.cut_edges, this.worst, this.worst_edges]) {
      object.frustumCulled = false;
      this.scene.add(object);
    }
  }

  show(geometry) {
    this.geometry = geometry;
    this.coloring = geometry.colorings[0];
    this.update_surface();
    this.extent = [0, 1, 2].map((axis) => {
      let low = Infinity, high = -Infinity;
      for (let i = axis; i < geometry.coordinates.length; i += 3) {
        low = Math.min(low, geometry.coordinates[i]);
        high = Math.max(high, geometry.coordinates[i]);
      }
      return [low, high];
    });
    this.radius = 0;
    for (let i = 0; i < geometry.coordinates.length; i += 3) {
      this.radius = Math.max(this.radius, Math.hypot(...geometry.coordinates.subarray(i, i + 3)));
    }
    this.highlight(-1);
    this.reset();
  }

  // The boundary of what is shown. Of several regions each triangle has the colour of its own.
  update_surface() {
    const {coordinates, facets, regions, facet_sides} = this.geometry;
    const by_facet = this.coloring.of_facets === true;
    const several = regions.length > 0 || by_facet;
    const palette = by_facet ? scale_palette(this.coloring) : null;
    const shape = new THREE.BufferGeometry();
    if (!several) {
      shape.setAttribute("position", new THREE.BufferAttribute(coordinates, 3));
      shape.setIndex(new THREE.BufferAttribute(facets, 1));
    } else {
      const points = [];
      const colors = [];
      const grey = [kSurfaceColor >> 16, kSurfaceColor >> 8 & 255, kSurfaceColor & 255];
      for (let f = 0; f < facets.length / 3; ++f) {
        const open = open_side(this.geometry, f);
        if (open < 0) continue;
        const value = by_facet ? 3 * this.coloring.values[f] : 0;
        const color = by_facet ? palette.subarray(value, value + 3) : this.coloring.colors ? this.coloring.colors[facet_sides[2 * f + open]] : grey;
        for (let i = 3 * f; i < 3 * f + 3; ++i) {
          const v = 3 * facets[i];
          points.push(coordinates[v], coordinates[v + 1], coordinates[v + 2]);
          colors.push(color[0], color[1], color[2]);
        }
      }
      shape.setAttribute("position", new THREE.BufferAttribute(new Float32Array(points), 3));
      shape.setAttribute("color", new THREE.BufferAttribute(new Uint8Array(colors), 3, true));
    }
    const material = this.surface.material;
    material.color.set(several ? 0xffffff : kSurfaceColor);
    material.vertexColors = several ? THREE.VertexColors : THREE.NoColors;
    material.needsUpdate = true;
    this.surface.geometry.dispose();
    this.surface.geometry = shape;
  }

  // shown: of each region of the geometry, whether it is.
  show_regions(shown) {
    this.geometry.shown.set(shown);
    this.update_surface();
    this.update_cut();
  }

  // axis: 0, 1 or 2. position: scene coordinate. flip: show the other side.
  set_plane(axis, position, flip) {
    const side = kFacingSide[axis] * (flip ? -1 : 1);
    this.cut_at = {axis, position, side};
    const normal = [0, 0, 0];
    normal[axis] = -side;
    this.plane.set(new THREE.Vector3(...normal), side * position);
    this.update_cut();
  }

  set_coloring(key) {
    this.coloring = this.geometry.colorings.find((c) => c.key === key);
    this.update_surface();
    this.update_cut();
  }

  set_edges(visible) {
    this.cut_edges.visible = visible;
    this.draw();
  }

  update_cut() {
    const {axis, position, side} = this.cut_at;
    const seen = cut_faces(this.geometry, axis, position, side);
    const points = new Float32Array(3 * seen.faces.length);
    const colors = new Uint8Array(3 * seen.faces.length);
    const lines = new Float32Array(6 * seen.faces.length);
    const by_region = this.coloring.colors;
    const of_facets = this.coloring.of_facets === true;
    const palette = by_region ? new Uint8Array(by_region.flat()) : scale_palette(this.coloring);
    const values = by_region ? this.geometry.tet_regions : this.coloring.values;
    for (let i = 0; i < seen.faces.length; ++i) {
      const next = i % 3 === 2 ? i - 2 : i + 1;
      const color = 3 * values[seen.tets[(i - i % 3) / 3]];
      for (let k = 0; k < 3; ++k) {
        points[3 * i + k] = this.geometry.coordinates[3 * seen.faces[i] + k];
        colors[3 * i + k] = of_facets ? kCutGrey : palette[color + k];
        lines[6 * i + k] = points[3 * i + k];
        lines[6 * i + 3 + k] = this.geometry.coordinates[3 * seen.faces[next] + k];
      }
    }
    set_points(this.cut, points);
    this.cut.geometry.setAttribute("color", new THREE.BufferAttribute(colors, 3, true));
    set_points(this.cut_edges, lines);
    this.draw();
  }

  // The tet at this index of the geometry; -1: none.
  highlight(tet) {
    const corners = tet < 0 ? [] : Array.from(this.geometry.corners.subarray(4 * tet, 4 * tet + 4));
    const points = (order) => {
      const array = [];
      for (const i of corners.length ? order : []) {
        array.push(...this.geometry.coordinates.subarray(3 * corners[i], 3 * corners[i] + 3));
      }
      return new Float32Array(array);
    };
    set_points(this.worst, points([0, 1, 2, 0, 1, 3, 0, 2, 3, 1, 2, 3]));
    set_points(this.worst_edges, points([0, 1, 0, 2, 0, 3, 1, 2, 1, 3, 2, 3]));
    this.draw();
  }

  // Paints the edges of a box in place of a tet.
  outline(low, high) {
    this.highlight(-1);
    const array = [];
    for (let corner = 0; corner < 8; ++corner) {
      for (let axis = 0; axis < 3; ++axis) {
        if (corner >> axis & 1) continue;
        for (const end of [corner, corner | 1 << axis]) {
          for (let i = 0; i < 3; ++i) array.push((end >> i & 1 ? high : low).getComponent(i));
        }
      }
    }
    set_points(this.worst_edges, new Float32Array(array));
    this.draw();
  }

  // The distance of a tet's farthest corner from its centre, in the scene.
  radius_of(tet) {
    const center = new THREE.Vector3();
    const points = [];
    for (let i = 0; i < 4; ++i) {
      const v = 3 * this.geometry.corners[4 * tet + i];
      points.push(new THREE.Vector3().fromArray(this.geometry.coordinates, v));
      center.addScaledVector(points[i], 0.25);
    }
    return Math.max(...points.map((p) => p.distanceTo(center)));
  }

  // Moves the camera in front of the cut, `distance` from a place.
  fly_to(place, distance) {
    const direction = new THREE.Vector3(...kFirstDirection).multiplyScalar(0.6);
    direction.setComponent(this.cut_at.axis, this.cut_at.side);
    this.fly(place, direction.normalize().multiplyScalar(distance).add(place));
  }

  fly(target, eye) {
    const start = {target: this.orbit.target.clone(), eye: this.camera.position.clone()};
    const began = performance.now();
    const still = window.matchMedia("(prefers-reduced-motion: reduce)").matches;
    const flight = this.flight = {};
    const step = (now) => {
      if (this.flight !== flight) return;  // another one has begun
      const share = still ? 1 : Math.min((now - began) / 500, 1);
      const eased = share * share * (3 - 2 * share);
      this.orbit.target.lerpVectors(start.target, target, eased);
      this.camera.position.lerpVectors(start.eye, eye, eased);
      this.orbit.update();
      this.draw();
      if (share < 1) requestAnimationFrame(step);
    };
    requestAnimationFrame(step);
  }

  reset() {
    const distance = 1.02 * this.radius / Math.sin(this.camera.fov * Math.PI / 360);
    this.fly(new THREE.Vector3(), new THREE.Vector3(...kFirstDirection).normalize().multiplyScalar(distance));
  }

  turn_by_key(event) {
    const turns = {ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1]};
    const zooms = {"+": 1 / 1.15, "=": 1 / 1.15, "-": 1.15};
    const turn = turns[event.key] || [0, 0];
    const zoom = zooms[event.key] || 1;
    if (!turns[event.key] && zoom === 1) return;
    event.preventDefault();
    const step = Math.PI / 36;
    const offset = this.camera.position.clone().sub(this.orbit.target).multiplyScalar(zoom);
    offset.applyAxisAngle(this.camera.up, turn[0] * step);
    const tilt = Math.acos(offset.z / offset.length()) + turn[1] * step;
    if (tilt > step && tilt < Math.PI - step) {
      const right = new THREE.Vector3().crossVectors(this.camera.up, offset).normalize();
      offset.applyAxisAngle(right, turn[1] * step);
    }
    this.camera.position.copy(this.orbit.target).add(offset);
    this.orbit.update();
    this.draw();
  }

  resize() {
    const {clientWidth, clientHeight} = this.canvas;
    if (clientWidth === 0 || clientHeight === 0) return;
    this.renderer.setSize(clientWidth, clientHeight, false);
    this.camera.aspect = clientWidth / clientHeight;
    this.draw();
  }

  draw() {
    if (this.waiting) return;
    this.waiting = true;
    requestAnimationFrame(() => {
      this.waiting = false;
      const distance = this.camera.position.distanceTo(this.orbit.target);
      this.camera.near = 0.02 * distance;
      this.camera.far = distance + 3;
      // Upright windows must see the whole ball as well.
      this.camera.zoom = Math.min(1, this.camera.aspect);
      this.camera.updateProjectionMatrix();
      this.renderer.render(this.scene, this.camera);
      this.marks.turn(this.camera);
    });
  }
}

function set_points(object, points) {
  object.geometry.dispose();
  object.geometry = new THREE.BufferGeometry();
  object.geometry.setAttribute("position", new THREE.BufferAttribute(points, 3));
}

// The colours of the 256 values of a measure, as bytes.
function scale_palette(coloring) {
  const colors = coloring.low_is_bad ? kScaleColors : [...kScaleColors].reverse();
  const color_at = d3.scale.linear().domain(colors.map((_, i) => 255 * i / (colors.length - 1))).range(colors);
  const bytes = new Uint8Array(3 * 256);
  for (let i = 0; i < 256; ++i) {
    const {r, g, b} = d3.rgb(color_at(i));
    bytes.set([r, g, b], 3 * i);
  }
  return bytes;
}
