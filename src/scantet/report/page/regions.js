// The list of regions: each can be hidden, shown, and looked at alone.
"use strict";

// What the report says of a region; a number and a colour where it says nothing.
function region_of(report, number) {
  const known = (report.regions || []).find((r) => r.region === number);
  return known || {region: number, name: `region_${number}`, color: "#b9c4d0"};
}

function region_name(region) {
  return region.name === `region_${region.region}` ? region.name : `${region.region} ${region.name}`;
}

function off_text(percent) {
  return percent === null ? "" : ` (${percent < 0 ? "\u2212" : "+"}${Math.abs(percent).toFixed(2)} %)`;
}

// Volume, quality, neighbours, and what became of the voxels.
function region_text(r) {
  if (r.tets === undefined) return "";
  const parts = [`${number(r.volume_mm3)} mm³`];
  if (r.voxels !== undefined) {
    const field = r.field_mm3 === null ? "cut" : `field ${number(r.field_mm3)}${off_text(r.off_field_percent)}`;
    parts[0] += `, voxels ${number(r.voxels_mm3)}${off_text(r.off_voxels_percent)}, ${field}`;
  }
  parts.push(`${counted(r.tets, "tet", "tets")}, dihedral angles ${number(r.min_dihedral_deg)}° to ${number(r.max_dihedral_deg)}°`);
  const expected = r.field_components === undefined || r.field_components === r.components ? "" : ` (the input has ${number(r.field_components)})`;
  parts.push(counted(r.components, "component", "components") + expected);
  if (r.voxels !== undefined) {
    parts.push(r.voxels_kept === r.voxels ? `all ${number(r.voxels)} voxel centres in it` :
                                            `${number(r.voxels - r.voxels_kept)} of ${number(r.voxels)} voxel centres not in it`);
  }
  const neighbors = r.neighbors.slice(0, 8).map((n) => `${n.region} (${number(n.area_mm2)} mm²)`);
  if (r.neighbors.length > 8) neighbors.push(`${r.neighbors.length - 8} more`);
  parts.push(`beside ${neighbors.join(", ")}`);
  return parts.join("; ");
}

// One box a region, and buttons for all. show(shown): told of every change; null where there is no view.
function region_items(regions, show) {
  if (regions.length === 0) return [];
  const boxes = [];
  const buttons = [];
  const changed = () => {
    const alone = boxes.filter((box) => box.checked).length === 1;
    buttons.forEach((button, i) => button.setAttribute("aria-pressed", alone && boxes[i].checked));
    show(boxes.map((box) => box.checked ? 1 : 0));
  };
  const set = (wanted) => {
    boxes.forEach((box, i) => { box.checked = wanted(i); });
    changed();
  };
  const button_that = (text, act) => {
    const button = element("button", text);
    button.type = "button";
    button.disabled = !show;
    button.addEventListener("click", act);
    return button;
  };
  const items = regions.map((region, i) => {
    const box = element("input");
    box.type = "checkbox";
    box.checked = true;
    box.disabled = !show;
    box.addEventListener("change", changed);
    boxes.push(box);
    const button = button_that("alone", () => {
      const is_alone = button.getAttribute("aria-pressed") === "true";
      set((k) => is_alone || k === i);
    });
    button.setAttribute("aria-pressed", "false");
    buttons.push(button);
    const label = element("label", box, swatch(region), region_name(region));
    label.title = region_name(region);
    return element("li", label, button, element("small", region_text(region)));
  });
  const list = element("ul", ...items);
  list.className = "regions";
  return [list, button_that("Show all", () => set(() => true)), button_that("Hide all", () => set(() => false))];
}
