// The collar of one facet, and what follows from collars that are proved.
#include <algorithm>
#include <cmath>

#include "scantet/base/parallel.h"
#include "scantet/verify/box_tree.h"
#include "scantet/verify/collar.h"

namespace scantet::verify {

Triangle inward(const CollarInput& in, std::size_t facet) {
  Triangle t = in.shell.facets[facet];
  if (in.map.handedness() > 0) std::swap(t[1], t[2]);
  return t;
}

CollarInput collar_input(const TetMesh& mesh, const Shell& shell, const VoxelNodes& nodes, const IndexMap& map,
                         const NodeSides& sides) {
  CollarInput input{mesh, shell, nodes, map, {}, sides};
  for (const VertexId v : shell.vertices) input.places.push_back(map.to_index(mesh.vertices[v]));
  return input;
}

Prism prism_of(const CollarInput& in, const Collar& collar, std::size_t facet) {
  const Triangle t = inward(in, facet);
  Prism prism;
  for (std::size_t n = 0; n < 3; ++n) {
    prism.p[n] = in.places[t[n]];
    prism.e[n] = Interval(collar.heights[t[n]]) * IntervalVec(collar.directions[t[n]]);
  }
  return prism;
}

bool may_hold(const CollarInput& in, const Collar& collar, const std::vector<Point>& places) {
  if (places.empty()) return false;
  std::vector<Box> boxes(in.shell.facets.size());
  for (std::size_t f = 0; f < boxes.size(); ++f) boxes[f] = prism_of(in, collar, f).box(-1, 1);
  const BoxTree tree(boxes);
  const double margin = 2e-5 / in.nodes.frame().min_spacing_mm();
  for (const Point& place : places) {
    Box around;
    extend(around, in.map.to_index(place));
    for (int axis = 0; axis < 3; ++axis) around.min[axis] -= margin, around.max[axis] += margin;
    bool meets = false;
    tree.visit_meeting(around, [&](std::uint32_t) { meets = true; });
    if (meets) return true;
  }
  return false;
}

void bound_distances(const CollarInput& in, Collar& collar, Progress& progress) {
  double worst = 0;
  for (std::size_t f = 0; f < collar.faults.size(); ++f) {
    if (collar.faults[f] == 0) worst = std::max(worst, collar.sampled_mm[f]);
  }
  const double least = std::max(1.04 * worst, 1e-6 * in.nodes.frame().min_spacing_mm());
  parallel_for(collar.faults.size(), 128, [&](std::size_t begin, std::size_t end) {
    for (std::size_t f = begin; f < end && !progress.cancelled(); ++f) {
      if (collar.faults[f] != 0) continue;
      const Prism prism = prism_of(in, collar, f);
      double full = 0;  // the length of its longest fibre, mm: lengths are convex
      for (const IntervalVec& e : prism.e) full = std::max(full, length_bound(in.map.to_world(e)));
      collar.bound_mm[f] = full;
      for (double tried = least; tried < full; tried *= 1.15) {
        const double s = below(tried / full);
        if (!has_side(in.nodes, prism, s, 1, 3000) || !has_side(in.nodes, prism, -s, -1, 3000)) continue;
        collar.bound_mm[f] = tried;
        break;
      }
    }
  });
}

}  // namespace scantet::verify
