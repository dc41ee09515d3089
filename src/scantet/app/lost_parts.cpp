#include "scantet/app/lost_parts.h"

#include <algorithm>
#include <atomic>

#include "scantet/app/nearer_points.h"
#include "scantet/base/parallel.h"
#include "scantet/base/point_grid_impl.h"
#include "scantet/check/boundary_points.h"
#include "scantet/domain/boundary_cells.h"

namespace scantet {
namespace {

/// Half of the longest way through a cell.
double half_diagonal_mm(const BoundaryCell& cell) {
  double most_mm = 0;
  for (const Vec& third : {cell.edges[2], -1.0 * cell.edges[2]}) {
    for (const Vec& second : {cell.edges[1], -1.0 * cell.edges[1]}) {
      most_mm = std::max(most_mm, 0.5 * length(cell.edges[0] + second + third));
    }
  }
  return most_mm;
}

/// Whether a point of the boundary may be that far: facets that are nearer have a vertex that is not much farther.
bool may_be_lost(const TetMesh& mesh, const BoundaryCells& cells, const SizingField& size) {
  std::vector<Point> vertices;
  for (VertexId v = 0; v < mesh.vertices.size(); ++v) {
    if (mesh.on_boundary(v)) vertices.push_back(mesh.vertices[v]);
  }
  const PointGrid grid(vertices, kFarInSizes * size.usual_size());
  const auto has_vertex = [&](const BoundaryCell& cell) {
    const Point center = cell.corner + 0.5 * (cell.edges[0] + cell.edges[1] + cell.edges[2]);
    const double reach_mm = kFarInSizes * size.size_at(center) - half_diagonal_mm(cell);
    return grid.any_near(center, reach_mm, [](std::uint32_t, const Point&, double) { return true; });
  };
  std::atomic<bool> found = false;
  for (std::size_t surface = 0; surface < cells.surfaces(); ++surface) {
    parallel_for(cells.groups(surface), 1, [&](std::size_t begin, std::size_t end) {
      std::vector<BoundaryCell> list;
      for (std::size_t group = begin; group < end && !found.load(); ++group) {
        list.clear();
        cells.cells_of(surface, group, list);
        if (!std::ranges::all_of(list, has_vertex)) found.store(true);
      }
    });
  }
  return found.load();
}

}  // namespace

std::vector<FarPlace> find_lost_parts(const TetMesh& mesh, const Domain& domain, const SizingField& size) {
  const BoundaryCells* const cells = domain.boundary_cells();
  if (cells == nullptr || mesh.tets.empty() || !may_be_lost(mesh, *cells, size)) return {};
  return measure_distance(mesh, domain, {.limit_mm = {}, .size = &size}).to_mesh.far;
}

std::vector<Point> points_on_parts(const Domain& domain, const std::vector<FarPlace>& parts,
                                   const std::vector<Point>& sample, double share) {
  std::vector<Box> boxes;
  for (const FarPlace& part : parts) {
    const Vec reach = part.distance_mm * Vec{1, 1, 1};
    boxes.push_back({part.point - reach, part.point + reach});
  }
  return close_points(domain, boundary_points_in(domain, boxes, 1), share, sample);
}

}  // namespace scantet
