#include "scantet/verify/boundary_rays.h"

#include <algorithm>
#include <array>

#include "scantet/verify/exact_sign.h"
#include "scantet/verify/findings.h"

namespace scantet::verify {
namespace {

std::vector<Box> facet_boxes(const TetMesh& mesh, const Shell& shell) {
  std::vector<Box> boxes(shell.facets.size());
  for (std::size_t f = 0; f < boxes.size(); ++f) {
    for (const VertexId v : shell.facets[f]) boxes[f].extend(mesh.vertices[shell.vertices[v]]);
  }
  return boxes;
}

}  // namespace

BoundaryRays::BoundaryRays(const TetMesh& mesh, const Shell& shell)
    : mesh_(mesh), shell_(shell), tree_(facet_boxes(mesh, shell)) {}

bool BoundaryRays::cast(const Point& p, std::vector<Hit>& hits, std::uint32_t without) const {
  hits.clear();
  bool is_clear = true;
  const Box ray{p, {std::max(p.x, tree_.around().max.x), p.y, p.z}};
  tree_.visit_meeting(ray, [&](std::uint32_t f) {
    if (without != kNone && shell_.component[f] == without) return;
    const Point a = corner(f, 0);
    const Point b = corner(f, 1);
    const Point c = corner(f, 2);
    const int ab = orientation_yz(a, b, p);
    const int bc = orientation_yz(b, c, p);
    const int ca = orientation_yz(c, a, p);
    const bool outside = (ab < 0 || bc < 0 || ca < 0) && (ab > 0 || bc > 0 || ca > 0);
    if (outside) return;
    if (ab == 0 || bc == 0 || ca == 0) {
      is_clear = false;
      return;
    }
    // ab > 0: the facet's normal points along x; p is before it if it is on the other side.
    const int side = orientation(a, b, c, p);
    if (side == 0) is_clear = false;
    if (side * ab < 0) hits.push_back({f, ab});
  });
  return is_clear;
}

int BoundaryRays::coverage(const Point& p, std::vector<Hit>& hits, bool& has_moved) const {
  Point from = p;
  for (int attempt = 0; attempt < 10; ++attempt) {
    has_moved = attempt > 0;
    if (cast(from, hits)) {
      int sum = 0;
      for (const Hit& hit : hits) sum += hit.direction;
      return sum;
    }
    from = from + Vec{0, 1e-7 * (attempt + 1), 1.7e-7 * (attempt + 1)};
  }
  return -1;
}

bool check_coverage(const TetMesh& mesh, const Shell& shell, const BoundaryRays& rays,
                    std::vector<VerifyFinding>& found) {
  FindingList faults(found);
  std::vector<BoundaryRays::Hit> hits;
  bool is_sure = true;
  for (const std::uint32_t facet : shell.first) {
    const Tet& tet = mesh.tets[shell.tet_behind[facet]];
    bool is_done = false;
    std::uint32_t random = 12345;
    for (int attempt = 0; attempt < 50 && !is_done; ++attempt) {
      std::array<double, 4> weight{};
      double sum = 0;
      for (double& w : weight) {
        random = random * 1664525U + 1013904223U;
        sum += w = 0.1 + (random >> 8) * 0x1p-24;
      }
      Point p;
      for (std::size_t n = 0; n < 4; ++n) p = p + (weight[n] / sum) * mesh.vertices[tet[n]];
      bool is_inside = true;
      for (const auto& face : kFaces) {
        is_inside = is_inside && orientation(mesh.vertices[tet[static_cast<std::size_t>(face[0])]],
                                             mesh.vertices[tet[static_cast<std::size_t>(face[1])]],
                                             mesh.vertices[tet[static_cast<std::size_t>(face[2])]], p) < 0;
      }
      if (!is_inside || !rays.cast(p, hits)) continue;
      is_done = true;
      int covered = 0;
      for (const auto& hit : hits) covered += hit.direction;
      if (covered == 1) continue;
      is_sure = false;
      faults.add("tets.overlap", "space is covered by several tets", p);
    }
    if (is_done) continue;
    is_sure = false;
    faults.add_undecided("tets.coverage", "it could not be decided how often space is covered", mesh.vertices[tet[0]],
                         false);
  }
  return is_sure;
}

}  // namespace scantet::verify
