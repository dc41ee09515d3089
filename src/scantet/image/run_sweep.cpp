// A run takes the label of the first run it touches in the row before it or in the layer below, else a new one. That
// choice does not look at the unions, which is why a later sweep repeats it.
#include "scantet/image/run_sweep.h"

#include <algorithm>
#include <bit>
#include <limits>

namespace scantet {
namespace {

constexpr std::uint32_t kNoLabel = std::numeric_limits<std::uint32_t>::max();

}  // namespace

std::uint32_t RunLayer::label_at(int i, int j) const {
  const auto begin = start.begin() + row_begin[j + 1];
  const auto end = start.begin() + row_begin[j + 2];
  return label[std::upper_bound(begin, end, i + 1) - start.begin() - 1];
}

RunSweep::RunSweep(const HeightGrid& grid, int first, int last)
    : grid_(grid), layers_{RunLayer(grid), RunLayer(grid), RunLayer(grid)}, first_(first), last_(last), k_(first - 1) {}

bool RunSweep::advance(UnionFind* sets) {
  if (k_ == last_) return false;
  ++k_;
  RunLayer& layer = layers_[(k_ + 4) % 3];
  layer.row_begin.assign(1, 0);
  layer.start.clear();
  layer.label.clear();
  for (int row = 0; row < layer.rows; ++row) {
    add_row(layer, row);
    if (row > 0) link(layer, row, layer, row - 1, sets);
    if (k_ > first_) link(layer, row, this->layer(1), row, sets);
    for (std::uint32_t run = layer.row_begin[row]; run < layer.row_begin[row + 1]; ++run) {
      if (layer.label[run] != kNoLabel) continue;
      layer.label[run] = next_label_++;
      if (sets != nullptr) sets->add();
    }
  }
  return true;
}

void RunSweep::add_row(RunLayer& layer, int row) const {
  layer.read_row(grid_, row, k_);
  const std::uint64_t* words = layer.row_signs(row);
  layer.start.push_back(0);
  std::uint64_t carry = 0;
  for (int w = 0; layer.some[row] && w < layer.words; ++w) {
    std::uint64_t changes = words[w] ^ (words[w] << 1 | carry);
    for (; changes != 0; changes &= changes - 1) layer.start.push_back(64 * w + std::countr_zero(changes));
    carry = words[w] >> 63;
  }
  layer.row_begin.push_back(static_cast<std::uint32_t>(layer.start.size()));
  layer.label.resize(layer.start.size(), kNoLabel);
  layer.label[layer.row_begin[row]] = kUnboundedLabel;  // these two hold the padding's nodes
  layer.label.back() = kUnboundedLabel;
}

void RunSweep::link(RunLayer& layer, int row, const RunLayer& other, int other_row, UnionFind* sets) const {
  std::uint32_t first = other.row_begin[other_row];
  const std::uint32_t last = other.row_begin[other_row + 1];
  for (std::uint32_t run = layer.row_begin[row]; run < layer.row_begin[row + 1]; ++run) {
    const std::int32_t end = layer.end_of(row, run);
    while (other.end_of(other_row, first) <= layer.start[run]) ++first;
    const bool inside = layer.is_inside(row, run);
    for (std::uint32_t touched = first; touched < last && other.start[touched] < end; ++touched) {
      if (other.is_inside(other_row, touched) != inside) continue;
      if (layer.label[run] == kNoLabel) {
        layer.label[run] = other.label[touched];
      } else if (sets != nullptr && layer.label[run] != other.label[touched]) {
        sets->unite(layer.label[run], other.label[touched]);
      }
    }
  }
}

}  // namespace scantet
