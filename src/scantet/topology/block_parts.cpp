// Only the heights within the block depend on its middle, and none on its surface. So what is outside of the block
// hangs on the block by its 26 outer nodes, whose parts say all that components depend on; and the Euler number of all
// that is inside changes as the shares of the eight cells do.
#include "scantet/topology/block_parts.h"

#include <utility>

#include "scantet/base/neighbors.h"
#include "scantet/topology/trilinear_saddles.h"

namespace scantet {
namespace {

constexpr int kMiddle = 13;
constexpr std::array<int, 8> kLowCorners{0, 1, 3, 4, 9, 10, 12, 13};   // of the cells
constexpr std::array<int, 8> kCornerSteps{0, 1, 3, 4, 9, 10, 12, 13};  // from there

/// The edges between the 27 nodes.
constexpr std::array<std::pair<std::uint8_t, std::uint8_t>, 54> kEdges = [] {
  std::array<std::pair<std::uint8_t, std::uint8_t>, 54> edges{};
  std::size_t count = 0;
  constexpr std::array<int, 3> kSteps{1, 3, 9};
  for (int n = 0; n < 27; ++n) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (kNeighborhood[static_cast<std::size_t>(n)][axis] == 1) continue;
      edges[count++] = {static_cast<std::uint8_t>(n), static_cast<std::uint8_t>(n + kSteps[axis])};
    }
  }
  return edges;
}();

unsigned pattern_of(std::uint32_t inside, int cell) {
  unsigned pattern = 0;
  for (int c = 0; c < 8; ++c) pattern |= (inside >> (kLowCorners[cell] + kCornerSteps[c]) & 1) << c;
  return pattern;
}

bool is_open(std::uint32_t inside) {
  for (int cell = 0; cell < 8; ++cell) {
    if ((open_questions(pattern_of(inside, cell)) & kBodyOpen) != 0) return true;
  }
  return false;
}

class Joining {
 public:
  Joining() {
    for (std::uint8_t n = 0; n < 27; ++n) part_[n] = n;
  }
  std::uint8_t find(std::uint8_t n) {
    while (part_[n] != n) n = part_[n] = part_[part_[n]];
    return n;
  }
  void join(int a, int b) {
    const std::uint8_t first = find(static_cast<std::uint8_t>(a));
    const std::uint8_t second = find(static_cast<std::uint8_t>(b));
    part_[std::max(first, second)] = std::min(first, second);
  }

 private:
  std::array<std::uint8_t, 27> part_{};
};

/// heights: of the nodes; asked where a cell is open.
template <class HeightOf>
BlockParts parts_of(std::uint32_t inside, const HeightOf& height_of) {
  BlockParts parts;
  parts.inside = inside;
  Joining joining;
  for (const auto& [a, b] : kEdges) {
    if ((inside >> a & 1) == (inside >> b & 1)) joining.join(a, b);
  }
  for (int cell = 0; cell < 8; ++cell) {
    const unsigned pattern = pattern_of(inside, cell);
    const int low = kLowCorners[cell];
    CellHeights heights{};
    const bool open = (open_questions(pattern) & kBodyOpen) != 0;
    for (int c = 0; open && c < 8; ++c) heights[c] = height_of(low + kCornerSteps[c]);
    const CellParts in_cell = cell_parts(pattern, heights);
    parts.eighths += in_cell.eighths;
    for (int c = 0; open && c < 8; ++c) {
      for (int d = c + 1; d < 8; ++d) {
        if ((in_cell.corners[c] >> d & 1) != 0) joining.join(low + kCornerSteps[c], low + kCornerSteps[d]);
      }
    }
  }
  for (std::uint8_t n = 0; n < 27; ++n) parts.part[n] = joining.find(n);
  return parts;
}

bool has_neighbours(const BlockParts& parts) {
  for (int n = 0; n < 27; ++n) {
    if (n != kMiddle && parts.part[n] == parts.part[kMiddle]) return true;
  }
  return false;
}

}  // namespace

bool is_simple(const SideChange& change) {
  if (change.before.eighths != change.after.eighths) return false;
  if (!has_neighbours(change.before) || !has_neighbours(change.after)) return false;
  std::array<int, 27> renamed;
  std::array<int, 27> back;
  renamed.fill(-1);
  back.fill(-1);
  for (int n = 0; n < 27; ++n) {
    if (n == kMiddle) continue;
    const int before = change.before.part[n];
    const int after = change.after.part[n];
    if (renamed[before] < 0) renamed[before] = after;
    if (back[after] < 0) back[after] = before;
    if (renamed[before] != after || back[after] != before) return false;
  }
  return true;
}

SideChanges::SideChanges(const SidedNodes& nodes) : nodes_(nodes) {
  constexpr std::size_t kAnswers = std::size_t{1} << 16;
  answers_.resize(kAnswers);
  for (std::size_t n = 0; n < 27; ++n) {
    steps_[n] = nodes.nodes().step(kNeighborhood[n]);
  }
}

std::uint32_t SideChanges::inside_around(std::int64_t n) const {
  std::uint32_t inside = 0;
  for (unsigned m = 0; m < 27; ++m) inside |= std::uint32_t{nodes_.inside(n + steps_[m])} << m;
  return inside;
}

bool SideChanges::is_plainly_simple(std::int64_t n) {
  constexpr std::uint32_t kMix = 2654435761U;
  const std::uint32_t inside = inside_around(n);
  Answer& answer = answers_[inside * kMix >> 16];
  if (answer.known == Known::nothing || answer.inside != inside) {
    const std::uint32_t after = inside ^ (1U << kMiddle);
    answer.inside = inside;
    answer.known = Known::not_simple;
    if (!is_open(inside) && !is_open(after)) {
      const auto unasked = [](int) { return 0.0; };
      if (is_simple({parts_of(inside, unasked), parts_of(after, unasked)})) answer.known = Known::simple;
    }
  }
  return answer.known == Known::simple;
}

SideChange SideChanges::look_at(std::int64_t n) const {
  const std::uint32_t inside = inside_around(n);
  const std::array<int, 3> node = nodes_.nodes().node(n);
  std::array<double, 27> heights;
  for (std::size_t m = 0; m < 27; ++m) {
    const NeighborOffset& o = kNeighborhood[m];
    heights[m] = nodes_.height(n + steps_[m], {node[0] + o[0], node[1] + o[1], node[2] + o[2]});
  }
  const double turned = nodes_.turned_height(n, node);
  const auto before = [&](int m) { return heights[m]; };
  const auto after = [&](int m) { return m == kMiddle ? turned : heights[m]; };
  return {parts_of(inside, before), parts_of(inside ^ (1U << kMiddle), after)};
}

}  // namespace scantet
