// Two facets that share a vertex cross if the edge of one that is across from it meets the other; two that share none,
// if any edge does. The verifier asks the same in code of its own, on purpose: it shares none with what makes meshes.
#include "scantet/check/facet_crossings.h"

#include <algorithm>
#include <bit>

#include "scantet/base/parallel.h"
#include "scantet/check/facet_tree_impl.h"
#include "scantet/quality/orientation.h"

namespace scantet {
namespace {

/// Whether a segment meets a triangle that neither of its ends is a corner of, and whose plane it does not lie in.
bool meets(const Point& p, const Point& q, const FacetCorners& t) {
  const int side_of_p = orientation_sign(t[0], t[1], t[2], p);
  const int side_of_q = orientation_sign(t[0], t[1], t[2], q);
  if (side_of_p == side_of_q) return false;
  int least = 1;
  int most = -1;
  for (std::size_t n = 0; n < 3; ++n) {
    const int turn = orientation_sign(p, q, t[n], t[(n + 1) % 3]);
    least = std::min(least, turn);
    most = std::max(most, turn);
  }
  return least >= 0 || most <= 0;
}

/// Of the corners of f those that are at a corner of g: bit n for corner n.
unsigned shared_corners(const FacetCorners& f, const FacetCorners& g) {
  unsigned shared = 0;
  for (unsigned n = 0; n < 3; ++n) shared |= std::find(g.begin(), g.end(), f[n]) != g.end() ? 1U << n : 0;
  return shared;
}

bool any_edge_meets(const FacetCorners& f, const FacetCorners& g) {
  return meets(f[0], f[1], g) || meets(f[1], f[2], g) || meets(f[2], f[0], g);
}

bool edge_across_meets(const FacetCorners& f, std::size_t corner, const FacetCorners& g) {
  return meets(f[(corner + 1) % 3], f[(corner + 2) % 3], g);
}

/// Whether two facets lie in one plane, on one side of an edge that they share. apex, other: their corners across from
/// it.
bool folds(const FacetCorners& f, std::size_t apex, const Point& other) {
  const Point& a = f[(apex + 1) % 3];
  const Point& b = f[(apex + 2) % 3];
  if (orientation_sign(a, b, f[apex], other) != 0) return false;
  return dot(cross(b - a, f[apex] - a), cross(b - a, other - a)) > 0;
}

bool are_crossing(const FacetCorners& f, const FacetCorners& g) {
  constexpr unsigned kAll = 7;
  const unsigned of_f = shared_corners(f, g);
  const unsigned of_g = shared_corners(g, f);
  switch (std::popcount(of_f)) {
    case 0:
      return any_edge_meets(f, g) || any_edge_meets(g, f);
    case 1:
      return edge_across_meets(f, of_f / 2, g) || edge_across_meets(g, of_g / 2, f);
    case 2:
      return folds(f, (kAll - of_f) / 2, g[(kAll - of_g) / 2]);
    default:
      return false;  // one facet listed twice is another fault
  }
}

}  // namespace

std::vector<std::uint32_t> crossing_facets(const TetMesh& mesh) {
  const FacetTree tree(mesh, all_facets(mesh));
  constexpr std::size_t kGrain = 256;
  const auto find = [&](std::size_t begin, std::size_t end, std::vector<std::uint32_t>& found) {
    for (std::size_t leaf = begin; leaf < end; ++leaf) {
      tree.visit_pairs(leaf, [&](std::uint32_t f, std::uint32_t g) {
        if (!are_crossing(corners_of(mesh, f), corners_of(mesh, g))) return;
        found.push_back(f);
        found.push_back(g);
      });
    }
  };
  auto all = parallel_collect<std::uint32_t>(tree.leaves(), kGrain, find);
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
  return all;
}

}  // namespace scantet
