// Private: the Delaunay triangulation of a lattice, which is known, within that of many points.
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "scantet/delaunay/seed_lattice.h"
#include "scantet/delaunay/triangulation_impl.h"

namespace scantet::engine {

/// The core of a lattice: the points that are where the lattice has them, as are all other points that could matter to
/// their tets. They need not be inserted, for their tets are known.
///
/// A body-centred cubic lattice of cube side a is the set of the corners and centres of cubes. Around each of its
/// points are 24 tets, on edges to 14 other points, with circumspheres of radius a·√5/4. If these 14 are there, and
/// nothing else within a·√5/2 of the point, then these tets are Delaunay, whatever else there is.
class LatticeCore {
 public:
  /// t: has all vertices, none of them inserted. Points may be off their places by 10⁻⁴ of the side.
  LatticeCore(const SeedLattice& lattice, const Triangulation& t);

  bool empty() const { return cells_ == 0; }
  bool has(PointId v) const { return !in_core_.empty() && in_core_[v] != 0; }

  /// Puts the tets around the core's points into the triangulation, which has all other points, in place of the tets
  /// that it has there.
  void join(Triangulation& t) const;

 private:
  using Place = std::array<std::uint32_t, 3>;  // in half sides, from a block beyond the corner; all even, or all odd
  static constexpr std::uint32_t kBlock = 16;  // half sides along the edge of a block
  static constexpr std::size_t kSites = std::size_t{2} * (kBlock / 2) * (kBlock / 2) * (kBlock / 2);

  struct Site {
    PointId vertex = kNone;   // the point there, if there is one
    std::uint16_t stars = 0;  // of an even place: which of the twelve tets on its edges upward have a point of the core
    std::uint32_t first = 0;  // the number of the first of them among all

    /// The cell's number for one of these twelve tets.
    CellId number_of(int tet) const { return first + static_cast<CellId>(std::popcount(stars & ((1U << tet) - 1))); }
  };
  struct Block {
    Place low{};
    std::array<Site, kSites> sites;
  };
  class Reader;

  static std::size_t index_in_block(const Place& place);
  static Place place_in_block(const Block& block, std::size_t index);
  static std::uint64_t key_of(const Place& place);
  bool find_place(const Point& p, Place& place) const;
  bool add_site(const Place& place, PointId v);
  void find_core(const Triangulation& t, const std::vector<Point>& others);
  void find_stars();
  struct OuterFacet;
  std::vector<OuterFacet> write_cells(Triangulation& t, const std::vector<CellId>& slots) const;
  std::vector<CellId> link_outer_facets(Triangulation& t, std::vector<OuterFacet> outer) const;
  static void remove_from(Triangulation& t, std::vector<CellId> cells);

  SeedLattice lattice_;
  std::vector<Block> blocks_;
  std::unordered_map<std::uint64_t, std::uint32_t> number_of_block_;
  std::vector<std::uint8_t> in_core_;  // by vertex
  std::size_t cells_ = 0;
};

}  // namespace scantet::engine
