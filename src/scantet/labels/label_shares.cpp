// The background's share is what the others leave. Shares are asked for twice, as the second time it is known where
// they are wanted.
#include "scantet/labels/label_shares.h"

#include <algorithm>

#include "scantet/base/neighbors.h"
#include "scantet/labels/label_agreement.h"
#include "scantet/labels/rank_set.h"

namespace scantet {
namespace {

/// By how much shares are below those of a face's labels if they are of labels that are at none of its corners. With a
/// hundredth of that the curves around where the face's labels touch are some hundredths of a voxel apart.
constexpr float kBelow = 0.1F;

/// The label of the largest share at each node, and the background's share.
LabelNodes largest_shares(const std::array<int, 3>& size, std::size_t ranks, const ShareSource& source,
                          std::vector<float>& background, const Progress& progress) {
  const NodeSet place(size);
  const std::size_t count = place.position(size[0], size[1], size[2]) + 1;
  std::vector<float> largest(count, 0);
  std::vector<LabelRank> who(count, 0);
  background.assign(count, 1);
  for (std::size_t rank = 1; rank < ranks && !progress.cancelled(); ++rank) {
    source(static_cast<LabelRank>(rank), [&](int i, int j, int k, std::span<const float> row) {
      std::size_t at = place.position(i, j, k);
      for (const float share : row) {
        background[at] -= share;
        if (share > largest[at]) {
          largest[at] = share;
          who[at] = static_cast<LabelRank>(rank);
        }
        ++at;
      }
    });
  }
  LabelNodes nodes(size, ranks);
  std::vector<LabelRank> row(static_cast<std::size_t>(size[0]));
  for (int k = 0; k < size[2]; ++k) {
    for (int j = 0; j < size[1]; ++j) {
      for (int i = 0; i < size[0]; ++i) {
        const std::size_t at = place.position(i, j, k);
        row[static_cast<std::size_t>(i)] = background[at] >= largest[at] ? LabelRank{0} : who[at];
      }
      nodes.set_row(j, k, row.data());
    }
  }
  nodes.find_blocks();
  return nodes;
}

/// The nodes of cells where labels meet, with the labels of the cells around each; values are the background's share
/// or 0.
LabelValues entries_of(const LabelNodes& nodes, const std::vector<float>& background) {
  LabelValues values;
  values.nodes = NodeSet(nodes.size());
  for (int layer = -1; layer < nodes.size()[2]; ++layer) {
    for_each_mixed_cell(nodes, layer, [&](int i, int j, int k) {
      for (int c = 0; c < 8; ++c) values.nodes.insert(values.nodes.position(i + c % 2, j + c / 2 % 2, k + c / 4));
    });
  }
  values.nodes.number();
  values.first = {0};
  for (const std::size_t position : values.nodes.positions()) {
    const std::array<int, 3> node = values.nodes.node_at(position);
    RankSet ranks;
    for (const NeighborOffset& offset : kNeighborhood) {
      std::array<int, 3> there{};
      bool inside = true;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        there[axis] = node[axis] + offset[axis];
        inside = inside && there[axis] >= -1 && there[axis] <= nodes.size()[axis];
      }
      ranks.insert(inside ? nodes.at(there[0], there[1], there[2]) : LabelRank{0});
    }
    for (const LabelRank rank : ranks) {
      values.ranks.push_back(rank);
      values.values.push_back(rank == 0 ? background[position] : 0);
    }
    values.first.push_back(static_cast<std::uint32_t>(values.ranks.size()));
  }
  return values;
}

}  // namespace

SharedLabels share_labels(const std::array<int, 3>& size, std::size_t ranks, const ShareSource& source,
                          const Progress& progress) {
  std::vector<float> background;
  SharedLabels out;
  out.nodes = largest_shares(size, ranks, source, background, progress);
  if (progress.cancelled()) return {};
  out.values = entries_of(out.nodes, background);
  LabelValues& values = out.values;
  for (std::size_t rank = 1; rank < ranks && !progress.cancelled(); ++rank) {
    source(static_cast<LabelRank>(rank), [&](int i, int j, int k, std::span<const float> row) {
      std::size_t position = values.nodes.position(i, j, k);
      for (const float share : row) {
        if (values.nodes.holds(position)) {
          const std::size_t node = values.nodes.number_of(position);
          for (std::size_t e = values.first[node]; e < values.first[node + 1]; ++e) {
            if (values.ranks[e] == rank) values.values[e] = share;
          }
        }
        ++position;
      }
    });
  }
  if (progress.cancelled()) return {};
  agree_on_faces(out.nodes, kBelow, out.values);
  return out;
}

}  // namespace scantet
