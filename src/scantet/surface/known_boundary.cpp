// While tets change sides, and around that, several questions are asked of one and the same boundary.
#include "scantet/base/parallel.h"
#include "scantet/surface/known_boundary_impl.h"

namespace scantet::engine {
namespace {

/// The same facets as boundary_facets() gives, in another order, as long as no tet has changed sides: each facet
/// between two regions has a ball.
std::vector<FacetCode> facets_with_balls(const RestrictedTriangulation& restricted) {
  constexpr std::size_t kGrain = 8192;
  const Triangulation& t = restricted.triangulation();
  return parallel_collect<FacetCode>(restricted.balls().slots(), kGrain,
                                     [&](std::size_t begin, std::size_t end, std::vector<FacetCode>& facets) {
                                       for (std::size_t b = begin; b < end; ++b) {
                                         const SurfaceBall& ball = restricted.balls()[static_cast<std::uint32_t>(b)];
                                         if (ball.generation % 2 == 0) continue;
                                         const CellId c = ball.facet / 4;
                                         if (t.info(c).balls[ball.facet % 4] != b)
                                           continue;  // not the first of its chain
                                         const FacetCode across = t.cell(c).neighbor[ball.facet % 4];
                                         const Region here = t.info(c).region;
                                         const Region beyond = t.info(across / 4).region;
                                         if (here == beyond) continue;
                                         facets.push_back(is_seen_from(here, beyond) ? ball.facet : across);
                                       }
                                     });
}

}  // namespace

void KnownBoundary::update_disks() {
  disks_.update([&]() -> const BoundaryFacets& { return facets(); });
  if (!disks_.asked().empty()) surfaces_.reset();
}

const BoundaryFacets& KnownBoundary::facets() {
  constexpr std::size_t kMany = 16;  // one in so many vertices: then to look at all facets is faster
  const State now{triangulation_.vertex_count(), triangulation_.changes_of_sides()};
  if (seen_ == now) return facets_;
  seen_ = now;
  surfaces_.reset();
  const std::vector<PointId> changed = triangulation_.take_changed();
  if (facets_.codes.empty() || changed.size() * kMany > triangulation_.triangulation().vertex_slots()) {
    facets_.set(triangulation_, now.changes_of_sides == 0 ? facets_with_balls(triangulation_)
                                                          : boundary_facets(triangulation_.triangulation()));
  } else {
    facets_.update(triangulation_, changed);
  }
  return facets_;
}

const BoundarySurfaces& KnownBoundary::surfaces() {
  const BoundaryFacets& all = facets();
  if (!surfaces_) surfaces_ = std::make_unique<BoundarySurfaces>(triangulation_, all);
  return *surfaces_;
}

}  // namespace scantet::engine
