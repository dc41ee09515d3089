// Private: Poisson-disk samples by throwing darts.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "scantet/base/geometry.h"
#include "scantet/base/large_pages.h"

namespace scantet::engine {

/// A point, its turn to be thrown, and how far it must be from the points thrown before it.
struct Dart {
  Point point;
  double radius_mm;
  std::uint64_t turn;  ///< smaller ones first; among equals the lexicographically smaller point
  bool fixed = false;  ///< not to be moved afterwards
};

/// The points of the darts, in their order.
std::vector<Point> points_of(std::span<const Dart> darts);

/// Throws the darts in turn: one is kept if no dart kept before it is nearer than `share` of its radius. Several
/// threads; the result is that of throwing one dart after the other.
/// Return: the kept darts by turn.
LargeVector<Dart> throw_darts(std::span<const Dart> darts, double share);

}  // namespace scantet::engine
