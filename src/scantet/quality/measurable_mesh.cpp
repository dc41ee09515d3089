#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "scantet/base/error.h"
#include "scantet/base/options.h"
#include "scantet/base/parallel.h"
#include "scantet/quality/measurable_mesh_impl.h"
#include "scantet/quality/measures.h"

namespace scantet {
namespace {

constexpr std::size_t kStretch = 8192;  // tets, facets or vertices that one thread takes at once

// The least i < count for which is_it(i), if there is one.
template <class IsIt>
std::optional<std::size_t> first_of(std::size_t count, const IsIt& is_it) {
  std::vector<std::optional<std::size_t>> pieces((count + kStretch - 1) / kStretch);
  parallel_for(count, kStretch, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      if (!is_it(i)) continue;
      pieces[begin / kStretch] = i;
      return;
    }
  });
  const auto found = std::find_if(pieces.begin(), pieces.end(), [](const auto& piece) { return piece.has_value(); });
  return found == pieces.end() ? std::nullopt : *found;
}

}  // namespace

void check_measurable(const TetMesh& mesh) {
  const auto refuse = [](const std::string& what) {
    throw Error(Fault::internal, "mesh.inconsistent", "cannot measure the mesh: " + what, "audit the mesh first");
  };
  const auto is_usable = [](double x) { return std::abs(x) <= kLargestCoordinateMm; };
  const auto is_bad_vertex = [&](std::size_t i) {
    const Point& p = mesh.vertices[i];
    return !(is_usable(p.x) && is_usable(p.y) && is_usable(p.z));
  };
  if (const auto bad = first_of(mesh.vertices.size(), is_bad_vertex)) {
    const Point& p = mesh.vertices[*bad];
    const double x = !is_usable(p.x) ? p.x : !is_usable(p.y) ? p.y : p.z;
    refuse("vertex " + std::to_string(*bad) + " has the coordinate " + number_text(x));
  }
  const auto too_large = [&](VertexId v) { return v >= mesh.vertices.size(); };
  const auto is_bad_tet = [&](std::size_t i) {
    return std::any_of(mesh.tets[i].begin(), mesh.tets[i].end(), too_large);
  };
  if (const auto bad = first_of(mesh.tets.size(), is_bad_tet)) {
    refuse("tet " + std::to_string(*bad) + " names a vertex that does not exist");
  }
  const auto is_bad_facet = [&](std::size_t i) {
    return std::any_of(mesh.boundary_facets[i].begin(), mesh.boundary_facets[i].end(), too_large);
  };
  if (const auto bad = first_of(mesh.boundary_facets.size(), is_bad_facet)) {
    refuse("boundary facet " + std::to_string(*bad) + " names a vertex that does not exist");
  }
  if (!mesh.tet_regions.empty() && mesh.tet_regions.size() != mesh.tets.size()) {
    refuse(std::to_string(mesh.tet_regions.size()) + " regions for " + std::to_string(mesh.tets.size()) + " tets");
  }
}

}  // namespace scantet
