// A part that is far from the mesh has no vertex of it near: what has one is passed over, and distances are measured of
// the rest alone.
#include "scantet/check/lost_parts.h"

#include <algorithm>
#include <optional>

#include "scantet/base/parallel.h"
#include "scantet/base/point_grid_impl.h"
#include "scantet/check/boundary_box_impl.h"
#include "scantet/check/boundary_points.h"
#include "scantet/check/distance_impl.h"
#include "scantet/check/facet_corners_impl.h"
#include "scantet/check/facet_tree_impl.h"

namespace scantet {
namespace {

/// The boundary's vertices, to be asked what is near them.
class NearVertices {
 public:
  NearVertices(const TetMesh& mesh, const SizingField& size)
      : size_(size), grid_(on_boundary(mesh), kFarInSizes * size.usual_size()) {}

  /// Whether one is so near that no point up to some distance from p is farther from it than kFarInSizes times its own
  /// size, which is 1-Lipschitz.
  bool has_one(const Point& p, double around_mm) const {
    const double reach_mm = kFarInSizes * size_.size_at(p) - (1 + kFarInSizes) * around_mm;
    return reach_mm > 0 && grid_.any_near(p, reach_mm, [](std::uint32_t, const Point&, double) { return true; });
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

/// The point with width of a surface in a box that is farthest from the mesh, if any there is farther than kFarInSizes
/// times the size: to an eighth of a cell, as points nearby are not much farther.
class FarPoint {
 public:
  FarPoint(const Domain& domain, std::size_t surface, const FacetTree& tree, const SizingField& size,
           const NearVertices& vertices)
      : domain_(domain),
        cells_(*domain.boundary_cells()),
        surface_(surface),
        tree_(tree),
        size_(size),
        vertices_(vertices) {}

  void look_in(const BoundaryBox& box, std::optional<FarPlace>& farthest) const {
    constexpr double kLeastBox = 0.125;  // of a cell
    if (vertices_.has_one(box.center(), box.half_diagonal_mm()) || !box.may_hold(cells_, surface_)) return;
    const std::optional<Point> witness = box.witness(cells_, surface_);
    if (witness && !vertices_.has_one(*witness, 0)) {
      const FacetTree::Nearest nearest = tree_.nearest(*witness);
      const double size_mm = size_.size_at(*witness);
      const double far_mm = std::max(kFarInSizes * size_mm, farthest ? farthest->distance_mm : 0);
      if (nearest.distance_mm > far_mm && has_width(domain_, *witness, size_mm)) {
        farthest = {*witness, tree_.nearest_point(nearest.facet, *witness), nearest.distance_mm};
      }
      if (nearest.distance_mm + 2 * (1 + kFarInSizes) * box.half_diagonal_mm() <= far_mm) return;  // sizes: 1-Lipschitz
    }
    if (box.size() <= kLeastBox) return;
    for (int corner = 0; corner < 8; ++corner) look_in(box.part(corner), farthest);
  }

 private:
  const Domain& domain_;
  const BoundaryCells& cells_;
  std::size_t surface_;
  const FacetTree& tree_;
  const SizingField& size_;
  const NearVertices& vertices_;
};

void find_in_cells(const TetMesh& mesh, const Domain& domain, const SizingField& size, const NearVertices& vertices,
                   measuring::Gathering& far) {
  constexpr std::size_t kGrain = 16;
  const BoundaryCells& cells = *domain.boundary_cells();
  for (std::size_t surface = 0; surface < cells.surfaces(); ++surface) {
    const auto collect = [&](std::size_t begin, std::size_t end, std::vector<BoundaryCell>& out) {
      std::vector<BoundaryCell> list;
      for (std::size_t group = begin; group < end; ++group) {
        list.clear();
        cells.cells_of(surface, group, list);
        for (const BoundaryCell& cell : list) {
          const BoundaryBox box(cell);
          if (vertices.has_one(box.center(), box.half_diagonal_mm())) continue;
          if (box.may_hold(cells, surface)) out.push_back(cell);
        }
      }
    };
    const std::vector<BoundaryCell> lonely = parallel_collect<BoundaryCell>(cells.groups(surface), 1, collect);
    if (lonely.empty()) continue;
    const FacetTree tree(mesh, measuring::facets_of(mesh, surface));
    const FarPoint far_point(domain, surface, tree, size, vertices);
    const auto look = [&](std::size_t begin, std::size_t end, std::vector<FarPlace>& found) {
      for (std::size_t n = begin; n < end; ++n) {
        std::optional<FarPlace> farthest;
        far_point.look_in(BoundaryBox(lonely[n]), farthest);
        if (farthest) found.push_back(*farthest);
      }
    };
    for (const FarPlace& place : parallel_collect<FarPlace>(lonely.size(), kGrain, look)) far.add_if_far(place);
  }
}

void find_in_samples(const TetMesh& mesh, const Domain& domain, const NearVertices& vertices,
                     measuring::Gathering& far) {
  std::vector<Point> lonely = measuring::boundary_samples(mesh, domain);
  std::erase_if(lonely, [&](const Point& p) { return vertices.has_one(p, 0); });
  if (lonely.empty()) return;
  const FacetTree tree(mesh, all_facets(mesh));
  for (const Point& p : lonely) {
    const FacetTree::Nearest nearest = tree.nearest(p);
    far.add_if_far({p, tree.nearest_point(nearest.facet, p), nearest.distance_mm});
  }
}

}  // namespace

std::vector<FarPlace> find_lost_parts(const TetMesh& mesh, const Domain& domain, const SizingField& size) {
  if (mesh.boundary_facets.empty()) return {};
  const NearVertices vertices(mesh, size);
  measuring::Gathering far({.limit_mm = {}, .size = &size});
  if (domain.boundary_cells() != nullptr) {
    find_in_cells(mesh, domain, size, vertices, far);
  } else {
    find_in_samples(mesh, domain, vertices, far);
  }
  return far.result(false).far;
}

}  // namespace scantet
