// The histograms: step curves with d3, all meshes in one panel, values read off under the pointer.
"use strict";

const kChart = {width: 420, height: 230, left: 60, right: 12, top: 10, bottom: 42};

function chart_scales(panel) {
  return {
    x: d3.scale.linear().domain([panel.low, panel.high]).range([kChart.left, kChart.width - kChart.right]),
    y: d3.scale.linear().domain([0, 1.06 * panel.highest]).range([kChart.height - kChart.bottom, kChart.top]),
  };
}

function step_path(curve, x, y) {
  let path = `M${x(curve.edges[0])},${y(0)}`;
  curve.density.forEach((density, i) => {
    path += `L${x(curve.edges[i])},${y(density)}L${x(curve.edges[i + 1])},${y(density)}`;
  });
  return path + `L${x(curve.edges[curve.edges.length - 1])},${y(0)}`;
}

function draw_axes(svg, panel, {x, y}) {
  const number = (value) => String(Number(value.toPrecision(4)));
  const bottom = kChart.height - kChart.bottom;
  const lines = d3.svg.axis().scale(y).orient("left").ticks(4).tickFormat("").tickSize(-(kChart.width - kChart.left - kChart.right));
  svg.append("g").attr("class", "grid").attr("transform", `translate(${kChart.left},0)`).call(lines);
  svg.append("g").attr("class", "axis").attr("transform", `translate(0,${bottom})`)
      .call(d3.svg.axis().scale(x).orient("bottom").tickValues(panel.ticks).tickFormat(number).outerTickSize(0));
  svg.append("g").attr("class", "axis").attr("transform", `translate(${kChart.left},0)`)
      .call(d3.svg.axis().scale(y).orient("left").ticks(4).tickFormat(number).outerTickSize(0));
  const middle = (kChart.left + kChart.width - kChart.right) / 2;
  svg.append("text").attr("class", "axis-label").attr("text-anchor", "middle").attr("x", middle).attr("y", kChart.height - 6)
      .text(panel.label + (panel.open_ended ? " (last bin: all above)" : ""));
  svg.append("text").attr("class", "axis-label").attr("text-anchor", "middle")
      .attr("transform", `translate(10,${(kChart.top + bottom) / 2}) rotate(-90)`).text(panel.density_label);
}

function draw_curves(svg, panel, meshes, {x, y}) {
  const bottom = kChart.height - kChart.bottom;
  for (const curve of panel.curves) {
    const color = meshes[curve.mesh].color;
    svg.append("path").attr("d", step_path(curve, x, y)).attr("class", "curve").attr("fill", color)
        .attr("fill-opacity", panel.curves.length === 1 ? 0.3 : 0.12).attr("stroke", color).attr("stroke-width", 1.6);
    for (const value of [curve.min, curve.max]) {
      const at = x(Math.min(value === null ? Infinity : value, panel.high));
      svg.append("path").attr("d", `M${at},${bottom}l-4,7h8z`).attr("fill", color);
    }
  }
}

// What the curves say at a place of the axis.
function reading(panel, meshes, value) {
  const parts = panel.curves.map((curve) => {
    const bin = Math.min(Math.max(d3.bisectRight(curve.edges, value) - 1, 0), curve.density.length - 1);
    const low = curve.edges[bin], high = curve.edges[bin + 1];
    const share = 100 * curve.density[bin] * (high - low);
    const above = panel.open_ended && bin === curve.density.length - 1;
    const range = above ? `above ${number(low)}` : `${number(low)} to ${number(high)}${panel.unit}`;
    return `${range}: ${share.toPrecision(3)} %` + (meshes.length > 1 ? ` (${meshes[curve.mesh].name})` : "");
  });
  return parts.join("; ");
}

function draw_chart(parent, panel, meshes) {
  const figure = d3.select(parent).append("figure");
  figure.append("figcaption").text(panel.title);
  const svg = figure.append("svg").attr("viewBox", `0 0 ${kChart.width} ${kChart.height}`).attr("role", "img")
                  .attr("aria-label", `Histogram: ${panel.title}`);
  const scales = chart_scales(panel);
  draw_axes(svg, panel, scales);
  draw_curves(svg, panel, meshes, scales);
  const ranges = panel.curves.map((c) => `${meshes.length > 1 ? meshes[c.mesh].name + ": " : ""}min ${number(c.min)}${panel.unit}, ` +
                                         `max ${number(c.max)}${panel.unit}`).join("; ");
  const note = figure.append("p").text(ranges);
  svg.on("mousemove", function() {
    note.text(reading(panel, meshes, scales.x.invert(d3.mouse(this)[0])));
  }).on("mouseleave", () => note.text(ranges));
}

function draw_charts(data) {
  const legend = document.getElementById("legend");
  for (const mesh of data.meshes) legend.append(element("span", swatch(mesh), mesh.name));
  for (const panel of data.panels) draw_chart(document.getElementById("charts"), panel, data.meshes);
}
