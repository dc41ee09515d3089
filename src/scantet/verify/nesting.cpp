// A ray from a point of one surface crosses each other surface an odd number of times if it starts within that. The
// point is on a facet to rounding, so none is taken that has another surface near it.
#include "scantet/verify/nesting.h"

#include <algorithm>
#include <array>

namespace scantet::verify {
namespace {

constexpr std::size_t kMostRays = 1000;  // from each surface

class Nesting {
 public:
  Nesting(const TetMesh& mesh, const Shell& shell, const BoundaryRays& rays) : mesh_(mesh), shell_(shell), rays_(rays) {
    const Box& all = rays.tree().around();
    margin_mm_ = 1e-12 * (length(all.min) + length(all.max));
  }

  /// What a ray from the component meets of others. Return: false if no ray was clear.
  bool cast_from(std::uint32_t component, std::vector<BoundaryRays::Hit>& hits) const {
    std::size_t rays = 0;
    for (std::size_t f = shell_.first[component]; f < shell_.facets.size() && rays < kMostRays; ++f) {
      if (shell_.component[f] != component) continue;
      ++rays;
      const Point p = point_on(shell_.facets[f]);
      if (is_alone(p, component) && rays_.cast(p, hits, component)) return true;
    }
    return false;
  }

 private:
  /// No grid has it on a line.
  Point point_on(const Triangle& facet) const {
    constexpr std::array kWeights{0.2113248654, 0.3416407865, 0.4470343481};
    Point sum;
    for (std::size_t n = 0; n < 3; ++n) sum = sum + kWeights[n] * mesh_.vertices[shell_.vertices[facet[n]]];
    return sum;
  }

  bool is_alone(const Point& p, std::uint32_t component) const {
    const Vec margin{margin_mm_, margin_mm_, margin_mm_};
    bool is_alone = true;
    rays_.tree().visit_meeting({p - margin, p + margin},
                               [&](std::uint32_t f) { is_alone = is_alone && shell_.component[f] == component; });
    return is_alone;
  }

  const TetMesh& mesh_;
  const Shell& shell_;
  const BoundaryRays& rays_;
  double margin_mm_;
};

}  // namespace

std::optional<std::vector<std::uint32_t>> nesting(const TetMesh& mesh, const Shell& shell, const BoundaryRays& rays) {
  std::vector<std::uint32_t> around(shell.first.size(), 0);
  const Nesting surfaces(mesh, shell, rays);
  std::vector<BoundaryRays::Hit> hits;
  for (std::uint32_t c = 0; c < around.size(); ++c) {
    if (!surfaces.cast_from(c, hits)) return std::nullopt;
    std::vector<std::uint32_t> crossed;
    crossed.reserve(hits.size());
    for (const BoundaryRays::Hit& hit : hits) crossed.push_back(shell.component[hit.facet]);
    std::sort(crossed.begin(), crossed.end());
    for (auto first = crossed.begin(); first != crossed.end();) {
      const auto last = std::upper_bound(first, crossed.end(), *first);
      around[c] += (last - first) % 2 == 1;
      first = last;
    }
  }
  return around;
}

}  // namespace scantet::verify
