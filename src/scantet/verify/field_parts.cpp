// The Euler number of a part is that of its pieces in cells, less that in their faces, plus that in their edges, less
// its nodes. Each cell brings its low faces, the edges and the node at its low corner; in a cell that is wholly in the
// part these cancel out. Parts that do not reach the layer around the image are counted in full that way.
#include "scantet/verify/field_parts.h"

#include <limits>
#include <optional>

#include "scantet/base/error.h"
#include "scantet/base/parallel.h"
#include "scantet/base/union_find.h"
#include "scantet/verify/cell_parts.h"

namespace scantet::verify {
namespace {

class PartCounter {
 public:
  PartCounter(const VoxelNodes& nodes, const Progress& progress) : nodes_(nodes), progress_(progress) {
    std::size_t count = 1;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      width_[axis] = nodes.size()[axis] + 2;
      count *= static_cast<std::size_t>(width_[axis]);
    }
    if (count >= std::numeric_limits<std::uint32_t>::max()) {
      throw Error(Fault::input, "input.too_large", "the scan has 2^32 voxels or more", "crop it");
    }
    sign_.resize(count);
    const auto layer = static_cast<std::size_t>(width_[0]) * static_cast<std::size_t>(width_[1]);
    parallel_for(static_cast<std::size_t>(width_[2]), 1, [&](std::size_t begin, std::size_t end) {
      for (std::size_t k = begin; k < end; ++k) {
        for (std::size_t n = 0; n < layer; ++n) {
          const auto i = static_cast<int>(n) % width_[0];
          const auto j = static_cast<int>(n) / width_[0];
          sign_[k * layer + n] = static_cast<std::int8_t>(nodes.sign(i - 1, j - 1, static_cast<int>(k) - 1));
        }
      }
    });
  }

  FieldParts run() {
    UnionFind sets(sign_.size());
    join_edges(sets);
    for_mixed_cells([&](const Cell& cell, const std::array<double, 8>& values) { join_cell(cell, values, sets); });
    if (progress_.cancelled()) return found_;
    find_parts(sets);
    for_mixed_cells([&](const Cell& cell, const std::array<double, 8>& values) { add_euler(cell, values); });
    find_loose_nodes();
    return found_;
  }

 private:
  /// Node of a cell's corner; cells and nodes are counted from the layer around the image.
  std::size_t node(const Cell& cell, int corner) const {
    const auto i = static_cast<std::size_t>(cell[0]) + static_cast<std::size_t>(corner & 1);
    const auto j = static_cast<std::size_t>(cell[1]) + static_cast<std::size_t>(corner >> 1 & 1);
    const auto k = static_cast<std::size_t>(cell[2]) + static_cast<std::size_t>(corner >> 2);
    return (k * static_cast<std::size_t>(width_[1]) + j) * static_cast<std::size_t>(width_[0]) + i;
  }

  void join_edges(UnionFind& sets) {
    for (int k = 0; k < width_[2]; ++k) {
      for (int j = 0; j < width_[1]; ++j) {
        for (int i = 0; i < width_[0]; ++i) {
          const std::size_t here = node({i, j, k}, 0);
          for (int axis = 0; axis < 3; ++axis) {
            const Cell at{i, j, k};
            if (at[static_cast<std::size_t>(axis)] + 1 == width_[static_cast<std::size_t>(axis)]) continue;
            const std::size_t next = node(at, 1 << axis);
            if (sign_[here] != 0 && sign_[here] == sign_[next]) {
              sets.unite(static_cast<std::uint32_t>(here), static_cast<std::uint32_t>(next));
            }
          }
        }
      }
    }
  }

  template <class Visit>
  void for_mixed_cells(const Visit& visit) {
    for (int k = 0; k + 1 < width_[2] && !progress_.cancelled(); ++k) {
      for (int j = 0; j + 1 < width_[1]; ++j) {
        for (int i = 0; i + 1 < width_[0]; ++i) {
          const Cell cell{i, j, k};
          const std::int8_t first = sign_[node(cell, 0)];
          bool is_mixed = first == 0;
          for (int c = 1; c < 8; ++c) is_mixed = is_mixed || sign_[node(cell, c)] != first;
          if (!is_mixed) continue;
          std::array<double, 8> values;
          for (int c = 0; c < 8; ++c) {
            values[static_cast<std::size_t>(c)] = nodes_.value(i - 1 + (c & 1), j - 1 + (c >> 1 & 1), k - 1 + (c >> 2));
          }
          visit(cell, values);
        }
      }
    }
  }

  int raw_side(int side) const { return nodes_.side() > 0 ? side : -side; }

  void join_cell(const Cell& cell, const std::array<double, 8>& values, UnionFind& sets) {
    for (const int side : {1, -1}) {
      const CellPart part = part_in_cell(values, nodes_.level(), raw_side(side));
      found_.is_known = found_.is_known && part.is_known;
      found_.has_tied_saddles = found_.has_tied_saddles || part.has_tied_saddle;
      for (int c = 0; c < 8; ++c) {
        const int to = part.piece[static_cast<std::size_t>(c)];
        if ((part.members >> c & 1) == 0 || to == c) continue;
        sets.unite(static_cast<std::uint32_t>(node(cell, c)), static_cast<std::uint32_t>(node(cell, to)));
      }
    }
  }

  /// The part that the one whose first node is n lies in. The node before that one along x is of another part, which
  /// has earlier nodes: of those beside a part only the one around it has.
  std::uint32_t part_around(std::size_t n) const {
    const auto row = static_cast<std::size_t>(width_[0]);
    return n % row == 0 ? FieldPart::kNoPart : found_.part_of[n - 1];
  }

  void find_parts(UnionFind& sets) {
    found_.part_of.assign(sign_.size(), FieldPart::kNoPart);
    std::vector<double> depth;
    std::size_t n = 0;
    for (int k = 0; k < width_[2]; ++k) {
      for (int j = 0; j < width_[1]; ++j) {
        for (int i = 0; i < width_[0]; ++i, ++n) {
          if (sign_[n] == 0) {
            ++found_.nodes_at_level;
            continue;
          }
          const std::uint32_t root = sets.find(static_cast<std::uint32_t>(n));  // never above n
          if (root == n) {
            found_.part_of[n] = static_cast<std::uint32_t>(found_.parts.size());
            found_.parts.emplace_back().side = sign_[n] > 0 ? 1 : -1;
            found_.parts.back().around = part_around(n);
            depth.push_back(-1);
            ++(sign_[n] > 0 ? found_.inside : found_.outside);
          }
          found_.part_of[n] = found_.part_of[root];
          FieldPart& part = found_.parts[found_.part_of[n]];
          const bool is_around =
              i == 0 || j == 0 || k == 0 || i + 1 == width_[0] || j + 1 == width_[1] || k + 1 == width_[2];
          part.is_unbounded = part.is_unbounded || is_around;
          if (is_around) continue;
          ++part.nodes;
          const double height = std::abs(nodes_.value(i - 1, j - 1, k - 1) - nodes_.level());
          if (height <= depth[found_.part_of[n]]) continue;
          depth[found_.part_of[n]] = height;
          part.deepest = {i - 1, j - 1, k - 1};
        }
      }
    }
  }

  void add_euler(const Cell& cell, const std::array<double, 8>& values) {
    for (const int side : {1, -1}) {
      const CellPart part = part_in_cell(values, nodes_.level(), raw_side(side));
      if (part.members == 0) continue;
      const auto add = [&](int corner, int euler) { found_.parts[found_.part_of[node(cell, corner)]].euler += euler; };
      for (int c = 0; c < 8; ++c) {
        if ((part.members >> c & 1) != 0 && part.piece[static_cast<std::size_t>(c)] == c) {
          add(c, part.euler[static_cast<std::size_t>(c)]);
        }
      }
      for (int axis = 0; axis < 3; ++axis) {
        std::array<int, 2> corners{};
        const int pieces = pieces_in_low_face(values, nodes_.level(), raw_side(side), axis, corners);
        for (int n = 0; n < pieces; ++n) add(corners[static_cast<std::size_t>(n)], -1);
        const int end = 1 << axis;
        if ((part.members & 1) != 0) {
          add(0, 1);
        } else if ((part.members >> end & 1) != 0) {
          add(end, 1);
        }
      }
      if ((part.members & 1) != 0) add(0, -1);
    }
  }

  void find_loose_nodes() {
    if (found_.nodes_at_level == 0) return;
    for (int k = 0; k < width_[2]; ++k) {
      for (int j = 0; j < width_[1]; ++j) {
        for (int i = 0; i < width_[0]; ++i) {
          const Cell at{i, j, k};
          if (sign_[node(at, 0)] != 0) continue;
          unsigned seen = 0;
          for (std::size_t axis = 0; axis < 3; ++axis) {
            for (const int step : {-1, 1}) {
              Cell next = at;
              next[axis] += step;
              if (next[axis] < 0 || next[axis] >= width_[axis]) continue;
              seen |= 1U << (sign_[node(next, 0)] + 1);
            }
          }
          if ((seen & 5) == 5) continue;
          ++found_.loose_nodes;
          found_.loose_node = {i - 1, j - 1, k - 1};
        }
      }
    }
  }

  const VoxelNodes& nodes_;
  const Progress& progress_;
  Cell width_{};
  std::vector<std::int8_t> sign_;
  FieldParts found_;
};

}  // namespace

FieldParts field_parts(const VoxelNodes& nodes, const Progress& progress) {
  return PartCounter(nodes, progress).run();
}

}  // namespace scantet::verify
