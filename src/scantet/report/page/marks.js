// A cross in a corner of the view that says which way the axes of the world point: x to the left, y to the back, z to
// the head. It turns with the camera.
"use strict";

const kMarks = [["R", "L"], ["A", "P"], ["I", "S"]];  // of each axis: where it comes from, where it points
const kMarkColors = ["#b3261e", "#00694b", "#0072b2"];

class Marks {
  constructor(svg) {
    this.ends = [];
    const add = (tag) => svg.appendChild(document.createElementNS("http://www.w3.org/2000/svg", tag));
    for (let axis = 0; axis < 3; ++axis) {
      for (const sign of [-1, 1]) {
        const line = add("line");
        const text = add("text");
        line.setAttribute("stroke", kMarkColors[axis]);
        text.setAttribute("fill", kMarkColors[axis]);
        text.textContent = kMarks[axis][(sign + 1) / 2];
        const direction = new THREE.Vector3();
        direction.setComponent(axis, sign);
        this.ends.push({direction, line, text});
      }
    }
  }

  turn(camera) {
    const inverse = camera.quaternion.clone();
    inverse.set(-inverse.x, -inverse.y, -inverse.z, inverse.w);
    for (const {direction, line, text} of this.ends) {
      const seen = direction.clone().applyQuaternion(inverse);
      line.setAttribute("x2", 30 * seen.x);
      line.setAttribute("y2", -30 * seen.y);
      text.setAttribute("x", 40 * seen.x);
      text.setAttribute("y", -40 * seen.y);
      // What points away is paler.
      const opacity = 0.7 + 0.3 * seen.z;
      for (const part of [line, text]) part.setAttribute("opacity", opacity);
    }
  }
}
