// Private: the boundary facets of the triangulation in connected surfaces.
#pragma once

#include <array>
#include <map>
#include <optional>
#include <set>
#include <unordered_map>
#include <vector>

#include "scantet/base/parallel_union_find.h"
#include "scantet/surface/boundary_facets_impl.h"

namespace scantet::engine {

/// The boundary facets, joined to surfaces at the vertices that are known to have a disk (check_disks), and what the
/// surfaces say of the components of ∂O: as they are when this is made, on several threads.
class BoundarySurfaces {
 public:
  /// What is known of a facet.
  struct Seen {
    std::uint32_t surface = kNone;
    std::optional<Patch> patch{};
    bool operator==(const Seen&) const = default;
  };
  struct Surface {
    std::uint32_t first = 0;   ///< of its facets, by place
    std::uint32_t facets = 0;  ///< how many it has
    bool takes_part = false;   ///< whether one of them approximates a patch that other surfaces approximate, too
  };

  /// facets: all of the boundary; must outlive this.
  BoundarySurfaces(const RestrictedTriangulation& t, const BoundaryFacets& facets);

  const std::vector<FacetCode>& facets() const { return facets_.codes; }
  /// Facet by facet, in the order of facets().
  const std::vector<Seen>& seen() const { return seen_; }
  /// Calls visit(begin, end) for stretches of facets of which the same is known, in their order; most are long.
  template <class Visit>
  void each_run(const Visit& visit) const {
    for (std::size_t n = 0; n < runs_.size(); ++n) {
      visit(std::size_t{runs_[n]}, n + 1 < runs_.size() ? std::size_t{runs_[n + 1]} : seen_.size());
    }
  }
  /// In the order of their first facets.
  const std::vector<Surface>& surfaces() const { return surfaces_; }
  /// The surface of a facet of the boundary, seen from either side; kNone if no facet that was given leads to it.
  std::uint32_t surface_of(FacetCode facet) const;

  /// Whether a patch is approximated by several surfaces.
  bool is_split(const Seen& seen) const { return seen.patch && split_.contains(*seen.patch); }
  bool has_split_patches() const { return !split_.empty(); }
  /// Whether a facet approximates the patch.
  bool has(const Patch& patch) const { return first_of_.contains(patch); }
  /// Whether there is a disk around every vertex, and one surface for each patch (and for all facets without one): then
  /// along each surface the cells of a side are joined through faces, and no piece is a side piece (Pieces).
  bool is_whole() const { return has_disks_ && is_one_each_; }
  /// The sum of those of the boundaries of the regions but kOutside, if the facets are closed surfaces of triangles:
  /// what parts two such regions counts for both.
  std::int64_t euler_number() const { return euler_number_; }

 private:
  void join();
  void number(ParallelUnionFind& joined, const std::vector<PointId>& disks);
  std::vector<std::uint32_t> first_facets(const std::vector<PointId>& disks) const;
  void find_split_patches();

  const RestrictedTriangulation& t_;
  const BoundaryFacets& facets_;
  std::vector<Seen> seen_;
  std::vector<std::uint32_t> runs_;  // where they begin
  std::vector<Surface> surfaces_;
  std::vector<std::uint32_t> surface_at_;                    // by vertex; kNone at those without a disk
  std::unordered_map<FacetCode, std::uint32_t> of_no_disk_;  // facets without a vertex with a disk, from both sides
  std::map<std::optional<Patch>, std::uint32_t> first_of_;   // surfaces, of each patch
  std::set<Patch> split_;
  std::int64_t euler_number_ = 0;
  bool has_disks_ = true;
  bool is_one_each_ = true;
};

}  // namespace scantet::engine
