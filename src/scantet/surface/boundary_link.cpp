// The link of a vertex has, of each of its boundary facets, the edge that lies across from the vertex. The facets form
// a disk with the vertex inside if and only if the link is one closed path.
#include <algorithm>
#include <cassert>
#include <iterator>
#include <optional>

#include "scantet/base/large_pages.h"
#include "scantet/base/parallel.h"
#include "scantet/base/parallel_buckets.h"
#include "scantet/surface/boundary_link_impl.h"
#include "scantet/surface/region_star_impl.h"

namespace scantet::engine {
namespace {

using Link = std::vector<LinkEdge>;

/// Finds the link of v from the cells around it.
void find_link(const Triangulation& t, PointId v, std::vector<CellId>& star, Link& link) {
  t.star_of(v, star);
  link.clear();
  for (const CellId c : star) {
    const Cell& cell = t.cell(c);
    for (FacetCode i = 0; i < 4; ++i) {
      const FacetCode across = cell.neighbor[i];
      if (cell.vertex[i] == v || across < 4 * c + i || t.info(c).region == t.info(across / 4).region) continue;
      const auto corners = facet_vertices(cell, static_cast<int>(i));
      assert(corners[0] == v || corners[1] == v || corners[2] == v);
      const std::size_t own = corners[0] == v ? 0 : corners[1] == v ? 1 : 2;
      link.push_back({corners[(own + 1) % 3], corners[(own + 2) % 3]});
    }
  }
}

/// Whether v is joined to a point that stands for several curves, and regions meet well at v, too: one of these curves
/// may pass through it.
bool is_beside_merged(const Triangulation& t, const Junctions& junctions, PointId v, std::vector<CellId>& star) {
  if (junctions.empty()) return false;
  t.star_of(v, star);
  const bool has_merged = std::any_of(star.begin(), star.end(), [&](CellId c) {
    const auto& vertices = t.cell(c).vertex;
    return std::any_of(vertices.begin(), vertices.end(), [&](PointId w) { return junctions.is_merged(w); });
  });
  return has_merged && regions_meet_well(t, v, star);
}

/// The links of all vertices on ∂O without a known disk, found from the facets. Where there are many such vertices,
/// that takes less time than their stars.
class Links {
 public:
  Links(const Triangulation& t, const DiskNotes& notes, const BoundaryFacets& facets) : of_vertex_(t.vertex_slots()) {
    each_edge(t, notes, facets, [&](PointId v, const LinkEdge&) { of_vertex_.count(v); });
    edges_.resize(of_vertex_.close());
    each_edge(t, notes, facets, [&](PointId v, const LinkEdge& edge) { edges_[of_vertex_.place(v)] = edge; });
  }
  /// Finds the link's edges, in any order.
  void find(PointId v, Link& link) const {
    link.assign(edges_.data() + of_vertex_.begin(v), edges_.data() + of_vertex_.end(v));
  }

 private:
  /// Calls visit(vertex, link edge) for each of the vertices and each of its facets, on several threads.
  template <class Visit>
  static void each_edge(const Triangulation& t, const DiskNotes& notes, const BoundaryFacets& facets, Visit visit) {
    constexpr std::size_t kFacets = 2048;
    parallel_for(facets.corners.size(), kFacets, [&](std::size_t begin, std::size_t end) {
      for (std::size_t f = begin; f < end; ++f) {
        const auto& v = facets.corners[f];
        for (std::size_t i = 0; i < 3; ++i) {
          if (!t.vertex_info(v[i]).on_boundary() || notes.has_disk(v[i])) continue;
          visit(v[i], LinkEdge{v[(i + 1) % 3], v[(i + 2) % 3]});
        }
      }
    });
  }

  ParallelBuckets of_vertex_;
  LargeVector<LinkEdge> edges_;
};

}  // namespace

std::vector<PointId> check_disks(const Triangulation& t, DiskNotes& notes, const Junctions& junctions,
                                 const std::vector<PointId>& vertices,
                                 const std::function<const BoundaryFacets&()>& facets) {
  constexpr std::size_t kMany = 16;  // one in so many vertices
  constexpr std::size_t kVertices = 256;
  const std::optional<Links> links =
      vertices.size() * kMany > t.vertex_slots() ? std::optional<Links>({t, notes, facets()}) : std::nullopt;
  return parallel_collect<PointId>(
      vertices.size(), kVertices, [&](std::size_t begin, std::size_t end, std::vector<PointId>& broken) {
        std::vector<CellId> star;
        Link link;
        for (std::size_t i = begin; i < end; ++i) {
          const PointId v = vertices[i];
          if (t.vertex_info(v).dimension < 2) {
            t.star_of(v, star);
            notes.set_disk(v, regions_meet_well(t, v, star));
          } else {
            links ? links->find(v, link) : find_link(t, v, star, link);
            notes.set_disk(v, is_one_cycle(link) || is_beside_merged(t, junctions, v, star));
          }
          if (!notes.has_disk(v)) broken.push_back(v);
        }
      });
}

std::vector<PointId> BrokenDisks::on_facets() const {
  constexpr std::size_t kVertices = 64;
  const Triangulation& t = triangulation_.triangulation();
  return parallel_collect<PointId>(
      all_.size(), kVertices, [&](std::size_t begin, std::size_t end, std::vector<PointId>& on_facets) {
        std::vector<CellId> star;
        for (std::size_t i = begin; i < end; ++i) {
          t.star_of(all_[i], star);
          const Region region = t.info(star.front()).region;
          const bool is_on =
              std::any_of(star.begin(), star.end(), [&](CellId c) { return t.info(c).region != region; });
          if (is_on) on_facets.push_back(all_[i]);
        }
      });
}

void BrokenDisks::update(const std::function<const BoundaryFacets&()>& facets) {
  asked_ = triangulation_.take_questions();
  found_ =
      check_disks(triangulation_.triangulation(), triangulation_.disks(), triangulation_.junctions(), asked_, facets);
  std::vector<PointId> others;
  std::set_difference(all_.begin(), all_.end(), asked_.begin(), asked_.end(), std::back_inserter(others));
  all_.clear();
  std::merge(others.begin(), others.end(), found_.begin(), found_.end(), std::back_inserter(all_));
}

}  // namespace scantet::engine
