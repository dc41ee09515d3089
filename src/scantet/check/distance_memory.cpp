#include <algorithm>
#include <iterator>

#include "scantet/base/parallel.h"
#include "scantet/check/distance_memory_impl.h"

namespace scantet::measuring {
namespace {

FacetCorners sorted(FacetCorners corners) {
  std::sort(corners.begin(), corners.end(), lexicographically_less);
  return corners;
}

bool before(const FacetCorners& a, const FacetCorners& b) {
  return std::lexicographical_compare(a.begin(), a.end(), b.begin(), b.end(), lexicographically_less);
}

/// Triangles as facets of a mesh without tets.
FacetTree tree_of(const std::vector<FacetCorners>& triangles) {
  TetMesh mesh;
  for (const FacetCorners& t : triangles) {
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    mesh.vertices.insert(mesh.vertices.end(), t.begin(), t.end());
    mesh.boundary_facets.push_back({first, first + 1, first + 2});
  }
  return {mesh, all_facets(mesh)};
}

}  // namespace

void SurfaceMemory::begin(const TetMesh& mesh, const std::vector<std::uint32_t>& facets,
                          std::optional<double> limit_mm) {
  next_.resize(facets.size());
  parallel_for(facets.size(), 4096, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      next_[i] = {sorted(corners_of(mesh, facets[i])), static_cast<std::uint32_t>(i)};
    }
  });
  parallel_sort(next_, [](const Known& a, const Known& b) {
    return before(a.corners, b.corners) || (!before(b.corners, a.corners) && a.place < b.place);
  });
  limit_mm_ = limit_mm;
  std::vector<FacetCorners> gone;
  auto there = next_.begin();
  for (const Known& known : known_) {
    while (there != next_.end() && before(there->corners, known.corners)) ++there;
    if (there == next_.end() || before(known.corners, there->corners)) gone.push_back(known.corners);
  }
  gone_ = tree_of(gone);
}

std::optional<double> SurfaceMemory::of_cell(std::size_t group, std::size_t place, const Point& center,
                                             double half_diagonal_mm) const {
  const std::vector<double>& cells_mm = cells_mm_[group];
  if (!limit_mm_ || cells_mm.empty() || cells_mm[place] > *limit_mm_) return std::nullopt;
  if (gone_.nearest(center).distance_mm <= half_diagonal_mm + *limit_mm_) return std::nullopt;
  return cells_mm[place];
}

const PartBounds* SurfaceMemory::of_facet(const FacetCorners& corners) const {
  const FacetCorners key = sorted(corners);
  const auto found = std::lower_bound(known_.begin(), known_.end(), key, [](const Known& known, const FacetCorners& k) {
    return before(known.corners, k);
  });
  return found != known_.end() && found->corners == key ? &bounds_[found->place] : nullptr;
}

void SurfaceMemory::keep_facets(std::vector<PartBounds> bounds) {
  known_ = std::move(next_);
  bounds_ = std::move(bounds);
}

}  // namespace scantet::measuring
