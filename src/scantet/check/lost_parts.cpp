// A part that is far from the mesh has no vertex of it near: cells with one are passed over, and distances are measured
// in the others alone.
#include "scantet/check/lost_parts.h"

#include "scantet/base/parallel.h"
#include "scantet/base/point_grid_impl.h"
#include "scantet/check/boundary_box_impl.h"
#include "scantet/check/distance_impl.h"
#include "scantet/check/facet_tree_impl.h"

namespace scantet {
namespace {

/// The boundary's vertices, to be asked whether a cell is near them.
class NearVertices {
 public:
  NearVertices(const TetMesh& mesh, const SizingField& size)
      : size_(size), grid_(on_boundary(mesh), kFarInSizes * size.usual_size()) {}

  /// Whether one is so near that no point of the cell is farther than kFarInSizes times the size from it.
  bool has_one(const BoundaryBox& cell) const {
    const Point center = cell.center();
    const double reach_mm = kFarInSizes * size_.size_at(center) - cell.half_diagonal_mm();
    return grid_.any_near(center, reach_mm, [](std::uint32_t, const Point&, double) { return true; });
  }

 private:
  static std::vector<Point> on_boundary(const TetMesh& mesh) {
    std::vector<Point> vertices;
    for (VertexId v = 0; v < mesh.vertices.size(); ++v) {
      if (mesh.on_boundary(v)) vertices.push_back(mesh.vertices[v]);
    }
    return vertices;
  }

  const SizingField& size_;
  PointGrid grid_;
};

}  // namespace

std::vector<FarPlace> find_lost_parts(const TetMesh& mesh, const Domain& domain, const SizingField& size) {
  const BoundaryCells* const cells = domain.boundary_cells();
  if (cells == nullptr || mesh.boundary_facets.empty()) return {};
  const NearVertices vertices(mesh, size);
  measuring::Gathering far({.limit_mm = {}, .size = &size});
  for (std::size_t surface = 0; surface < cells->surfaces(); ++surface) {
    const auto collect = [&](std::size_t begin, std::size_t end, std::vector<Point>& out) {
      std::vector<BoundaryCell> list;
      for (std::size_t group = begin; group < end; ++group) {
        list.clear();
        cells->cells_of(surface, group, list);
        for (const BoundaryCell& cell : list) {
          const BoundaryBox box(cell);
          if (vertices.has_one(box) || !box.may_hold(*cells, surface)) continue;
          if (const std::optional<Point> witness = box.witness(*cells, surface)) out.push_back(*witness);
        }
      }
    };
    const std::vector<Point> points = parallel_collect<Point>(cells->groups(surface), 1, collect);
    if (points.empty()) continue;
    const FacetTree tree(mesh, measuring::facets_of(mesh, surface));
    for (const Point& p : points) {
      const FacetTree::Nearest nearest = tree.nearest(p);
      far.add_if_far({p, tree.nearest_point(nearest.facet, p), nearest.distance_mm});
    }
  }
  return far.result(false).far;
}

}  // namespace scantet
