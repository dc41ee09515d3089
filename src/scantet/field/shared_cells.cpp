// The object is exactly {f > level} without the components left out, f the field as it was read. In a cell whose inside
// nodes are all kept, the heights say that by themselves; in one whose inside nodes are all left out, nothing is
// inside. In a shared cell a point with f > level belongs to the component of the node that one reaches by climbing
// along z, y and x: f is linear along each, so one never falls below f(p), and stays inside. That is the order in which
// trilinear() goes back to its corners, and mix() has no sign that neither end has, so the corner reached is inside
// whatever rounding does.
//
// Cells agree on their common faces. A point inside on a face climbs, within the face, to a node of the face, which is
// of the point's component. So the face has inside nodes of that kind, and so have both cells: where points of either
// kind lie on the face, both cells are shared or have the kind alone.
//
// What is filled is the same turned upside down: a point that is not inside belongs to the part of the node that one
// reaches by going down.
//
// Nodes of a kept component are joined to none of the others, so cells that are not shared hold heights as they were
// read wherever a kept component reaches into them: every boundary point is asked in the field as it was read.
#include "scantet/field/shared_cells.h"

#include <algorithm>

#include "scantet/base/parallel.h"
#include "scantet/field/sign_patterns.h"

namespace scantet {
namespace {

bool comes_before(const CellIndex& a, const CellIndex& b) {
  return std::lexicographical_compare(a.rbegin(), a.rend(), b.rbegin(), b.rend());
}

/// The shared cells between the layers k and k + 1 of nodes, begin ≤ k < end.
std::vector<SharedCell> shared_between(const HeightGrid& as_read, const HeightGrid& kept, int begin, int end) {
  std::vector<SharedCell> cells;
  std::array<SignLayer, 2> layers{SignLayer(kept), SignLayer(kept)};
  const auto layer = [&](int k) -> SignLayer& { return layers[k & 1]; };
  const auto read = [&](int k) {
    for (int row = 0; row < layer(k).rows; ++row) layer(k).read_row(kept, row, k);
  };
  read(begin);
  for (int k = begin; k < end; ++k) {
    read(k + 1);
    visit_mixed_cells(layer(k), layer(k + 1), [&](int i, int j, unsigned inside) {
      SharedCell cell{{i, j, k}, as_read.corners(i, j, k)};
      for (unsigned c = 0; c < 8; ++c) {
        const bool was_inside = cell.heights[c] > 0;
        if (was_inside == ((inside >> c & 1) != 0)) continue;
        (was_inside ? cell.dropped : cell.filled) |= static_cast<std::uint8_t>(1U << c);
      }
      if (cell.dropped != 0 || cell.filled != 0) cells.push_back(cell);
    });
  }
  return cells;
}

}  // namespace

const SharedCell* SharedCells::find(const CellIndex& cell) const {
  const auto found = std::lower_bound(cells_.begin(), cells_.end(), cell,
                                      [](const SharedCell& a, const CellIndex& b) { return comes_before(a.cell, b); });
  return found != cells_.end() && found->cell == cell ? &*found : nullptr;
}

std::shared_ptr<const SharedCells> find_shared_cells(const HeightGrid& as_read, const HeightGrid& kept,
                                                     const Progress& progress) {
  constexpr std::size_t kSlab = 16;  // layers
  const auto layers = static_cast<std::size_t>(kept.size()[2]) + 1;
  std::vector<std::vector<SharedCell>> found((layers + kSlab - 1) / kSlab);
  parallel_for(layers, kSlab, [&](std::size_t begin, std::size_t end) {
    if (progress.cancelled()) return;
    found[begin / kSlab] = shared_between(as_read, kept, static_cast<int>(begin) - 1, static_cast<int>(end) - 1);
  });
  std::vector<SharedCell> all;
  for (const std::vector<SharedCell>& part : found) all.insert(all.end(), part.begin(), part.end());
  return all.empty() ? nullptr : std::make_shared<const SharedCells>(std::move(all));
}

}  // namespace scantet
