// Brings the parts together: data in, controls wired. One mesh is seen at a time, the histograms show all.
"use strict";

class Page {
  constructor(data) {
    this.data = data;
    this.by_id = (id) => document.getElementById(id);
    this.by_id("version").textContent = data.meshes[0].report.version;
    document.title = `Mesh report: ${data.meshes.map((mesh) => mesh.name).join(", ")}`;
    draw_charts(data);
    fill_summary(data);
    fill_difference(data);
    this.view = this.open_view();
    if (this.view) this.wire_controls();
    this.offer_meshes();
    const lists = data.worst_lists.map((list) => new Option(list.title, list.key));
    this.by_id("worst-by").replaceChildren(...lists);
    this.by_id("worst-by").addEventListener("change", () => this.list_worst());
    this.choose(0);
  }

  // null if the browser has no WebGL: charts and tables need none.
  open_view() {
    try {
      return new View(this.by_id("view"));
    } catch (error) {
      this.by_id("view").hidden = true;
      this.by_id("controls").hidden = true;
      this.notice(`No 3D view: this browser cannot draw with WebGL (${error.message}). Everything else is here.`);
      return null;
    }
  }

  notice(text) {
    this.by_id("view-notice").textContent = text;
    this.by_id("view-notice").hidden = text === "";
  }

  offer_meshes() {
    const select = this.by_id("mesh-select");
    this.data.meshes.forEach((mesh, i) => select.append(new Option(mesh.name, i)));
    this.by_id("mesh-choice").hidden = this.data.meshes.length < 2;
    select.addEventListener("change", () => this.choose(Number(select.value)));
  }

  choose(index) {
    this.mesh = this.data.meshes[index];
    fill_details(this.mesh);
    this.by_id("details-of").textContent = this.data.meshes.length > 1 ? ` of ${this.mesh.name}` : "";
    this.by_id("picked").textContent = "";
    this.list_worst();
    this.list_far();
    this.list_parts();
    this.list_regions();
    this.list_certificate();
    if (!this.view && !this.mesh.scan) return;
    this.geometry = read_geometry(this.mesh.geometry, this.by_id(`mesh-${index}`).textContent);
    this.show_slices(index);
    if (!this.view) return;
    this.notice(this.geometry.complete ? "" :
        `This mesh has ${number(this.mesh.report.mesh.tets)} tetrahedra, too many for a page: ` +
        `its boundary and its worst tetrahedra are shown, the others are left out.`);
    const regions = this.geometry.regions.map((number) => region_of(this.mesh.report, number));
    if (regions.length > 0) {
      const colors = regions.map(({color}) => [1, 3, 5].map((at) => parseInt(color.slice(at, at + 2), 16)));
      this.geometry.colorings.unshift({key: "region", title: "region", colors});
    }
    this.view.show(this.geometry);
    const colorings = this.geometry.colorings.map((c) => new Option(c.title, c.key));
    this.by_id("coloring").replaceChildren(...colorings);
    if (this.data.difference) this.by_id("position").value = this.by_id("position").max;  // the whole surface
    this.show_scale();
    this.move_plane();
  }

  wire_controls() {
    for (const radio of document.querySelectorAll("input[name=axis]")) {
      radio.addEventListener("change", () => this.move_plane());
    }
    this.by_id("position").addEventListener("input", () => this.move_plane());
    this.by_id("flip").addEventListener("change", () => this.move_plane());
    this.by_id("edges").addEventListener("change", (event) => this.view.set_edges(event.target.checked));
    this.by_id("coloring").addEventListener("change", (event) => {
      this.view.set_coloring(event.target.value);
      this.show_scale();
    });
    this.by_id("reset").addEventListener("click", () => {
      this.pick(null, "");
      this.view.highlight(-1);
      this.view.reset();
    });
    this.by_id("controls").addEventListener("submit", (event) => event.preventDefault());
  }

  axis() {
    return Number(document.querySelector("input[name=axis]:checked").value);
  }

  // Puts the plane where the slider is, or at a scene coordinate (and the slider beside it).
  move_plane(wanted) {
    const slider = this.by_id("position");
    const axis = this.axis();
    const [low, high] = this.view.extent[axis];
    const position = wanted === undefined ? low + (high - low) * slider.value / slider.max : wanted;
    if (wanted !== undefined) slider.value = Math.round(slider.max * (wanted - low) / (high - low));
    const {center_mm, scale_mm} = this.geometry;
    const decimals = Math.min(Math.max(4 - Math.ceil(Math.log10(scale_mm)), 0), 9);  // finer than the slider
    this.by_id("position-mm").textContent = `${(center_mm[axis] + scale_mm * position).toFixed(decimals)} mm`;
    slider.setAttribute("aria-valuetext", this.by_id("position-mm").textContent);
    this.view.set_plane(axis, position, this.by_id("flip").checked);
  }

  show_scale() {
    this.by_id("scale").hidden = this.view.coloring.colors !== undefined;
    if (this.view.coloring.colors) return;
    const {low, high, unit} = this.view.coloring;
    const palette = scale_palette(this.view.coloring);
    const stops = d3.range(0, 256, 15).map((i) => `rgb(${palette.slice(3 * i, 3 * i + 3).join(",")})`);
    this.by_id("scale-bar").style.background = `linear-gradient(90deg, ${stops.join(", ")})`;
    this.by_id("scale-low").textContent = number(low) + unit;
    this.by_id("scale-high").textContent = number(high) + unit;
  }

  list_worst() {
    const list = this.data.worst_lists.find((l) => l.key === this.by_id("worst-by").value);
    const visit = this.view && ((tet, text, button) => this.visit_tet(tet, text, button));
    this.by_id("worst").replaceChildren(...worst_buttons(list, this.mesh.report.quality.worst[list.key] || [], visit));
  }

  list_far() {
    const {distance} = this.mesh.report;
    const visit = this.view && ((place, text, button) => this.visit_far(place, text, button));
    const lists = distance ? far_lists(distance, visit) : [];
    this.by_id("far").replaceChildren(...lists);
    this.by_id("far-panel").hidden = lists.length === 0;
  }

  list_parts() {
    const {topology} = this.mesh.report;
    const visit = this.view && ((part, text, button) => this.visit_part(part, text, button));
    const lists = topology ? part_lists(topology, visit) : [];
    this.by_id("parts").replaceChildren(...lists);
    this.by_id("parts-panel").hidden = lists.length === 0;
  }

  list_regions() {
    const {report, geometry} = this.mesh;
    const entries = (geometry.regions || []).map((number) => region_of(report, number));
    const items = region_items(entries, this.view && ((shown) => this.view.show_regions(shown)));
    this.by_id("regions").replaceChildren(...items);
    this.by_id("regions-panel").hidden = items.length === 0;
  }

  // The slices are beside the 3D view, and need no WebGL.
  show_slices(index) {
    this.by_id("slices-panel").hidden = !this.mesh.scan;
    if (!this.mesh.scan) return;
    this.slices = this.slices || new Slices(this.by_id("slices"));
    const colors = this.geometry.regions.map((number) => region_of(this.mesh.report, number).color);
    const dim = (color) => [1, 3, 5].map((at) => 0.55 * parseInt(color.slice(at, at + 2), 16));
    const voxel_colors = this.mesh.scan.regions.map((number) => number === 0 ? [0, 0, 0] : dim(region_of(this.mesh.report, number).color));
    const [voxels, field] = [`scan-${index}`, `scan-field-${index}`].map((id) => this.by_id(id).textContent);
    this.slices.show(new SliceScan(this.mesh.scan, voxels, field), this.geometry, colors, voxel_colors);
    this.by_id("slices-note").textContent = this.mesh.scan.note === "" ? "" : `Of the scan ${this.mesh.scan.note}.`;
  }

  list_certificate() {
    const {certificate} = this.mesh.report;
    this.by_id("certificate-panel").hidden = !certificate;
    if (!certificate) return;
    const visit = (box_mm, text, button) => {
      if (this.view) {
        this.visit_part({box_mm}, text, button);
      } else {
        this.pick(button, text);
        this.go_slices(box_center(box_mm));
      }
    };
    const levels = certificate.levels || [certificate];
    this.by_id("certificate-grade").textContent = certificate.grade;
    this.by_id("certificate-text").textContent = levels.map(certificate_text).join("; ");
    this.by_id("certificate-places").replaceChildren(...certificate_lists(certificate, visit));
  }

  go_slices(place_mm) {
    if (this.slices && this.mesh.scan) this.slices.go(place_mm);
  }

  // Shows which button was clicked, and what it stands for.
  pick(button, text) {
    for (const other of document.querySelectorAll(".places button")) other.setAttribute("aria-pressed", other === button);
    this.by_id("picked").textContent = text;
    const stage = this.by_id("stage");
    if (stage.getBoundingClientRect().bottom < 100) stage.scrollIntoView();  // in a narrow window it is above the lists
  }

  in_scene(place_mm) {
    const {center_mm, scale_mm} = this.geometry;
    return new THREE.Vector3(...place_mm.map((x, axis) => (x - center_mm[axis]) / scale_mm));
  }

  visit_tet(worst, text, button) {
    this.pick(button, text);
    this.go_slices(worst.place_mm);
    const tet = this.geometry.complete ? worst.tet : this.geometry.numbers.indexOf(worst.tet);
    const place = this.in_scene(worst.place_mm);  // its centre, or the middle of one of its edges
    this.move_plane(place.getComponent(this.axis()));
    this.view.highlight(tet);
    this.view.fly_to(place, 14 * this.view.radius_of(tet));
  }

  // Outlines a cube as wide as the distance each way.
  visit_far({place_mm, distance_mm}, text, button) {
    const box_mm = {min: place_mm.map((x) => x - distance_mm), max: place_mm.map((x) => x + distance_mm)};
    this.visit_part({box_mm}, text, button);
  }

  visit_part(part, text, button) {
    this.pick(button, text);
    this.go_slices(box_center(part.box_mm));
    const low = this.in_scene(part.box_mm.min);
    const high = this.in_scene(part.box_mm.max);
    const center = low.clone().add(high).multiplyScalar(0.5);
    this.move_plane(center.getComponent(this.axis()));
    this.view.outline(low, high);
    this.view.fly_to(center, Math.max(2.4 * low.distanceTo(high), 0.01));
  }
}

const page = new Page(JSON.parse(document.getElementById("data").textContent));
