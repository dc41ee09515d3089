// A run takes the label of the first run it touches in the row before it or in the layer below; if it touches none, it
// gets a new label. That choice does not look at the unions, which is why a later sweep repeats it.
#include "scantet/field/run_sweep.h"

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
    : grid_(grid), layers_{RunLayer(grid), RunLayer(grid), RunLayer(grid)}, first_(first), last_(last), k_(first - 1) {
  for (auto& words : zeros_) words.resize(grid.row_words());
}

bool RunSweep::advance(UnionFind* sets) {
  if (k_ == last_) return false;
  ++k_;
  RunLayer& layer = layers_[(k_ + 4) % 3];
  layer.row_begin.assign(1, 0);
  layer.start.clear();
  layer.side.clear();
  layer.label.clear();
  layer.has_zeros = false;
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

/// Finds, in zeros_[0], the nodes of a row of the layer that are at the level, but for the corners of cells that lie in
/// the level wholly. Returns whether there is any.
bool RunSweep::find_zeros(int j) {
  if (!grid_.row_zeros(j, k_, zeros_[0].data())) return false;
  const int words = grid_.row_words();
  zeros_[4].assign(words, 0);  // of cells
  for (int quadrant = 0; quadrant < 4; ++quadrant) {
    const int beside = quadrant & 1 ? j + 1 : j - 1;
    const int beyond = quadrant & 2 ? k_ + 1 : k_ - 1;
    if (!grid_.row_zeros(beside, k_, zeros_[1].data()) || !grid_.row_zeros(j, beyond, zeros_[2].data()) ||
        !grid_.row_zeros(beside, beyond, zeros_[3].data())) {
      continue;
    }
    for (int w = 0; w < words; ++w) zeros_[1][w] &= zeros_[0][w] & zeros_[2][w] & zeros_[3][w];
    for (int w = 0; w < words; ++w) {
      const std::uint64_t next = w + 1 < words ? zeros_[1][w + 1] << 63 : 0;
      const std::uint64_t pairs = zeros_[1][w] & (zeros_[1][w] >> 1 | next);
      zeros_[4][w] |= pairs | pairs << 1;
      if (pairs >> 63) zeros_[4][w + 1] |= 1;
    }
  }
  std::uint64_t any = 0;
  for (int w = 0; w < words; ++w) any |= zeros_[0][w] &= ~zeros_[4][w];
  return any != 0;
}

void RunSweep::add_row(RunLayer& layer, int row) {
  layer.read_row(grid_, row, k_);
  const bool has_zeros = find_zeros(row - 1);
  layer.has_zeros = layer.has_zeros || has_zeros;
  const std::uint64_t* above = layer.row_signs(row);
  std::uint64_t* reached = layer.reached.signs.data() + static_cast<std::size_t>(row) * layer.words;
  layer.reached.some[row] = layer.some[row] || has_zeros;
  for (int w = 0; w < layer.words; ++w) reached[w] = has_zeros ? above[w] | zeros_[0][w] : above[w];

  layer.start.push_back(0);
  layer.side.push_back(-1);
  std::uint64_t carry_above = 0;
  std::uint64_t carry_reached = 0;
  for (int w = 0; layer.reached.some[row] && w < layer.words; ++w) {
    std::uint64_t changes =
        (above[w] ^ (above[w] << 1 | carry_above)) | (reached[w] ^ (reached[w] << 1 | carry_reached));
    for (; changes != 0; changes &= changes - 1) {
      const int bit = std::countr_zero(changes);
      layer.start.push_back(64 * w + bit);
      layer.side.push_back(above[w] >> bit & 1 ? 1 : reached[w] >> bit & 1 ? 0 : -1);
    }
    carry_above = above[w] >> 63;
    carry_reached = reached[w] >> 63;
  }
  layer.row_begin.push_back(static_cast<std::uint32_t>(layer.start.size()));
  layer.label.resize(layer.start.size(), kNoLabel);
  for (std::uint32_t run = layer.row_begin[row]; has_zeros && run < layer.start.size(); ++run) {
    if (layer.side[run] == 0) layer.label[run] = kUnboundedLabel;  // it need not be true: nobody asks
  }
  layer.label[layer.row_begin[row]] = kUnboundedLabel;  // these two hold the padding's nodes
  layer.label.back() = kUnboundedLabel;
}

void RunSweep::link(RunLayer& layer, int row, const RunLayer& other, int other_row, UnionFind* sets) const {
  std::uint32_t first = other.row_begin[other_row];
  const std::uint32_t last = other.row_begin[other_row + 1];
  for (std::uint32_t run = layer.row_begin[row]; run < layer.row_begin[row + 1]; ++run) {
    const std::int32_t end = layer.end_of(row, run);
    while (other.end_of(other_row, first) <= layer.start[run]) ++first;
    const std::int8_t side = layer.side[run];
    if (side == 0) continue;
    for (std::uint32_t touched = first; touched < last && other.start[touched] < end; ++touched) {
      if (other.side[touched] != side) continue;
      if (layer.label[run] == kNoLabel) {
        layer.label[run] = other.label[touched];
      } else if (sets != nullptr && layer.label[run] != other.label[touched]) {
        sets->unite(layer.label[run], other.label[touched]);
      }
    }
  }
}

}  // namespace scantet
