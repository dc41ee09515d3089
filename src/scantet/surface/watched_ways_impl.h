// Private: ways through the triangulation, and which tets are on them.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "scantet/base/large_pages.h"
#include "scantet/delaunay/triangulation_impl.h"
#include "scantet/domain/domain.h"

namespace scantet::engine {

/// A tet of another region than the domain has at a place in it.
struct WrongTet {
  CellId cell;
  Point place;
  std::uint32_t group = 0;  ///< of misplaced places
};

/// The domain's narrow ways on which its own regions, as rounding has them, agree. Along a space-filling curve.
LargeVector<NarrowWay> agreed_ways(const Domain& domain, LevelGround ground);

/// Ways that must be in tets of their regions. A look costs what has changed since the one before.
class WatchedWays {
 public:
  explicit WatchedWays(Triangulation& t) : t_(t) {}

  /// ways: must outlive this, and be the same in each call.
  /// Return: the tets of other regions on them, each once with its first place, ascending.
  std::vector<WrongTet> wrong(std::span<const NarrowWay> ways);

 private:
  /// A tet that is there as long as its slot has the generation.
  struct SeenCell {
    CellId cell;
    std::uint32_t generation;
  };
  /// The tets that ways pass, way after way.
  struct Trace {
    std::vector<SeenCell> cells;
    std::vector<std::uint32_t> ends;  ///< of each way's tets
  };
  bool is_right(const SeenCell& seen, Region region) const {
    return t_.info(seen.cell).generation == seen.generation && t_.info(seen.cell).region == region;
  }
  void follow(std::span<const NarrowWay> ways, CellId start, Trace& trace, std::vector<WrongTet>& wrong) const;

  Triangulation& t_;
  std::vector<Trace> traces_;  // a trace for a grain of the ways
};

/// One of the triangulation.
CellId any_cell(const Triangulation& t);

}  // namespace scantet::engine
