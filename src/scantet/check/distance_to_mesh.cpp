// From the domain's boundary to the mesh's. First a point of the boundary in each of its cells is measured: the
// greatest of these distances is a lower bound. Then each cell is bounded. The distance to one facet is a convex
// function, so its greatest value on a box's hull is at one of the hull's points; and no point of the hull is farther
// than a measured one plus its distance from that. Where neither is good enough the box is divided. A bound from the
// mesh before is kept where no facet is gone.
#include <algorithm>

#include "scantet/base/parallel.h"
#include "scantet/check/boundary_box_impl.h"
#include "scantet/check/distance_memory_impl.h"

namespace scantet::measuring {
namespace {

constexpr double kLeastBox = 1.0 / 16;    // of a cell
constexpr double kLeastOpen = 1.0 / 256;  // of one that neither keeps the limit nor breaks it

class ToMesh {
 public:
  ToMesh(const BoundaryCells& cells, std::size_t surface, const FacetTree& tree, const DistanceOptions& options,
         SurfaceMemory& memory)
      : cells_(cells),
        surface_(surface),
        tree_(tree),
        options_(options),
        memory_(memory),
        first_(cells.groups(surface)) {
    memory_.make_room(first_.size());
  }

  Gathering run() {
    parallel_for(first_.size(), 1, [&](std::size_t begin, std::size_t end) {
      for (std::size_t group = begin; group < end; ++group) measure(group);
    });
    double known_mm = 0;
    for (const auto& group : first_) {
      for (const Measured& m : group) known_mm = std::max(known_mm, m.distance_mm);
    }
    const Aim aim(options_, known_mm);
    std::vector<Gathering> groups(first_.size(), Gathering(options_));
    parallel_for(first_.size(), 1, [&](std::size_t begin, std::size_t end) {
      for (std::size_t group = begin; group < end; ++group) bound(group, aim, known_mm, groups[group]);
    });
    Gathering all(options_);
    for (const Gathering& group : groups) all.add(group);
    return all;
  }

 private:
  struct Measured {
    double distance_mm = -1;  // of a cell's witness; -1: it has none
    std::uint32_t facet = FacetTree::kNone;
  };

  void measure(std::size_t group) {
    std::vector<BoundaryCell> cells;
    cells_.cells_of(surface_, group, cells);
    std::uint32_t hint = FacetTree::kNone;
    for (const BoundaryCell& cell : cells) {
      const BoundaryBox box(cell);
      const std::optional<Point> witness = box.witness(cells_, surface_);
      const FacetTree::Nearest nearest = tree_.nearest(witness.value_or(box.center()), hint);
      hint = nearest.facet;
      first_[group].push_back({witness ? nearest.distance_mm : -1, hint});
    }
  }

  void bound(std::size_t group, const Aim& aim, double known_mm, Gathering& out) {
    constexpr double kWorthListing = 0.5;  // of the greatest distance
    if (first_[group].empty()) return;
    std::vector<BoundaryCell> cells;
    cells_.cells_of(surface_, group, cells);
    std::vector<double> upper_mm(cells.size());
    for (std::size_t i = 0; i < cells.size(); ++i) {
      const BoundaryBox box(cells[i]);
      const Measured& m = first_[group][i];
      PartBounds part;
      part.points = m.distance_mm >= 0 ? 1 : 0;
      if (out.may_be_far(m.distance_mm) || m.distance_mm >= kWorthListing * known_mm) {
        if (const auto witness = box.witness(cells_, surface_))
          part.take({*witness, tree_.nearest_point(m.facet, *witness), m.distance_mm});
      }
      part.upper_mm = m.distance_mm + 2 * box.half_diagonal_mm();
      if (m.distance_mm < 0 || part.upper_mm > aim.of(0)) {
        const std::optional<double> before_mm = memory_.of_cell(group, i, box.center(), box.half_diagonal_mm());
        part.upper_mm = before_mm && *before_mm <= aim.of(0) ? *before_mm : 0;
        if (part.upper_mm == 0) settle(box, m.facet, aim, part);
      }
      upper_mm[i] = part.upper_mm;
      out.add(part, box.center());
      if (part.measured) out.add_if_far(part.farthest);
    }
    memory_.keep_cells(group, std::move(upper_mm));
  }

  /// facet: one that may be near.
  void settle(const BoundaryBox& box, std::uint32_t facet, const Aim& aim, PartBounds& part) const {
    if (!box.may_hold(cells_, surface_)) return;
    const BoundaryBox::Hull hull = box.hull();
    double upper_mm = farthest_mm(hull, facet);
    if (upper_mm > aim.of(part.farthest.distance_mm)) {
      const Point middle = hull.middle();
      const FacetTree::Nearest nearest = tree_.nearest(middle, facet);
      if (nearest.facet != facet) upper_mm = std::min(upper_mm, farthest_mm(hull, nearest.facet));
      upper_mm = std::min(upper_mm, nearest.distance_mm + hull.farthest_mm(middle));
      facet = nearest.facet;
    }
    if (upper_mm > aim.of(part.farthest.distance_mm)) {
      const std::optional<Point> witness = box.witness(cells_, surface_);
      if (witness) {
        const FacetTree::Nearest nearest = tree_.nearest(*witness, facet);
        part.take({*witness, tree_.nearest_point(nearest.facet, *witness), nearest.distance_mm});
      }
      if (box.size() > least_box(upper_mm, part) && upper_mm > aim.of(part.farthest.distance_mm)) {
        for (int corner = 0; corner < 8; ++corner) settle(box.part(corner), facet, aim, part);
        return;
      }
    }
    part.upper_mm = std::max(part.upper_mm, upper_mm);
  }

  /// How small boxes of a part may be; upper_mm: of one. Where a box has stayed open nothing is gained by the others.
  double least_box(double upper_mm, const PartBounds& part) const {
    const std::optional<double>& limit_mm = options_.limit_mm;
    const bool is_open = limit_mm && upper_mm > *limit_mm && part.farthest.distance_mm <= *limit_mm;
    return is_open && part.upper_mm <= *limit_mm ? kLeastOpen : kLeastBox;
  }

  double farthest_mm(const BoundaryBox::Hull& hull, std::uint32_t facet) const {
    double farthest_mm = 0;
    for (std::size_t i = 0; i < hull.count; ++i) {
      farthest_mm = std::max(farthest_mm, tree_.distance_to(facet, hull.points[i]));
    }
    return farthest_mm;
  }

  const BoundaryCells& cells_;
  std::size_t surface_;
  const FacetTree& tree_;
  DistanceOptions options_;
  SurfaceMemory& memory_;
  std::vector<std::vector<Measured>> first_;  // by group and cell
};

}  // namespace

OneWayDistance distance_to_mesh(const TetMesh& mesh, const BoundaryCells& cells, const DistanceOptions& options,
                                std::vector<SurfaceMemory>& memory) {
  Gathering all(options);
  for (std::size_t surface = 0; surface < cells.surfaces(); ++surface) {
    const FacetTree tree(mesh, facets_of(mesh, surface));
    all.add(ToMesh(cells, surface, tree, options, memory[surface]).run());
  }
  return all.result(true);
}

}  // namespace scantet::measuring
