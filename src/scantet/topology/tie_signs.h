// The signs around a place at the level, and what pieces of either side they leave on a small sphere or circle there.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <functional>
#include <utility>

namespace scantet {

/// Up to eight pieces of a sphere or circle, joined to parts, with eight times their Euler numbers.
class Pieces {
 public:
  Pieces() {
    for (int n = 0; n < 8; ++n) part_[n] = n;
  }
  void add(int piece) {
    exists_ |= 1U << piece;
    eighths_[piece] += 8;
  }
  bool exists(int piece) const { return (exists_ >> piece & 1) != 0; }
  /// For what pieces have in common.
  void correct(int piece, int eighths) { eighths_[piece] += eighths; }
  void join(int a, int b) {
    const int from = part_[b];
    const int to = part_[a];
    std::replace(part_.begin(), part_.end(), from, to);
  }
  void join_all() {
    const int first = std::countr_zero(exists_);
    for (int n = 0; n < 8; ++n) {
      if (exists(n)) join(first, n);
    }
  }
  /// The parts there are.
  int count() const {
    int parts = 0;
    for_each([&](int, int) { ++parts; });
    return parts;
  }
  /// Calls visit(piece, eighths) for each part, with one of its pieces.
  template <class Visit>
  void for_each(const Visit& visit) const {
    std::array<int, 8> sum{};
    std::array<int, 8> piece{};
    unsigned parts = 0;
    for (int n = 0; n < 8; ++n) {
      if (!exists(n)) continue;
      sum[part_[n]] += eighths_[n];
      piece[part_[n]] = n;
      parts |= 1U << part_[n];
    }
    for (; parts != 0; parts &= parts - 1) visit(piece[std::countr_zero(parts)], sum[std::countr_zero(parts)]);
  }

 private:
  std::array<int, 8> part_{};
  std::array<int, 8> eighths_{};
  unsigned exists_ = 0;
};

/// Signs in the four directions across an edge at the level, in their order around it, and between each and the next.
struct Around {
  std::array<int, 4> beside;
  std::array<int, 4> between;

  /// What has the sign q there, by quadrants.
  Pieces pieces(int q) const;
};

/// The signs of the 26 neighbours of a node at the level. The sphere around it falls into eight octants, one a cell,
/// with twelve arcs and six poles between them.
class Signs {
 public:
  using Step = std::array<int, 3>;
  /// The height of the neighbour of an octant along the axes of a mask, as the octant's cell has it.
  using HeightAt = std::function<double(int octant, int axes)>;

  /// height_at: asked where signs do not suffice. across: the axis (as a bit) across which the plane through the node
  /// is at the level where the faces around it are, for a point of an edge along that axis; 0 for a node of the grid.
  explicit Signs(HeightAt height_at = {}, int across = 0) : height_at_(std::move(height_at)), across_(across) {}

  int& at(const Step& step) { return signs_[place(step)]; }
  int at(const Step& step) const { return signs_[place(step)]; }

  /// The neighbour of an octant (bit set: the high side) along the axes of a mask.
  static Step step(int octant, int axes);

  /// The axes of a neighbour of the octant that has the sign q, and whose sign the octant has in some part; 0 if none.
  int axes_of(int octant, int q) const;

  /// What has the sign q, by octants.
  Pieces pieces(int q) const;

 private:
  static int place(const Step& step) { return step[0] + 1 + 3 * (step[1] + 1) + 9 * (step[2] + 1); }
  void join_over_arc(int octant, int third, int q, Pieces& pieces) const;
  int reach(int octant, int u, int v, int q) const;
  int overlap_of(int octant, int u, int v, int q) const;
  void join_at_pole(int axis, int side, Pieces& pieces) const;

  HeightAt height_at_;
  int across_;
  std::array<int, 27> signs_{};
};

}  // namespace scantet
