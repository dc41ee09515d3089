// What facets, or the fields themselves, leave to labels is counted (label_volume_count.h), and with it how much volume
// a small change of two labels' values moves between them: that gives a system of equations for the numbers to be
// added.
#include "scantet/labels/label_volumes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <utility>
#include <vector>

#include "scantet/base/parallel.h"
#include "scantet/labels/label_margins.h"
#include "scantet/labels/label_volume_count.h"

namespace scantet {
namespace {

// Of what is added to a label's values: so that nodes keep their labels where these win by a margin of 1, and more
// where nodes are held.
constexpr double kOfFields = 0.25;
constexpr double kOfFacets = 1;
constexpr double kOfMeshes = 1;

/// The numbers that take away the excess of volume, to first order, by Gauss-Seidel steps. added: what is there; what
/// comes is so that the sums stay within ±most. first: those of the ranks before it stay.
std::vector<double> numbers_to_add(const VolumeCount& count, const std::vector<double>& added, double most,
                                   std::size_t first = 0) {
  constexpr int kSweeps = 100;
  struct Neighbor {
    LabelRank rank;
    double movable;
  };
  std::vector<std::vector<Neighbor>> neighbors(added.size());
  for (const auto& [key, samples] : std::map<std::uint32_t, double>(count.movable.begin(), count.movable.end())) {
    const auto low = static_cast<LabelRank>(key >> 16);
    const auto high = static_cast<LabelRank>(key & 0xFFFF);
    neighbors[low].push_back({high, samples});
    neighbors[high].push_back({low, samples});
  }
  std::vector<double> more(added.size());
  for (int sweep = 0; sweep < kSweeps; ++sweep) {
    for (std::size_t n = first; n < added.size(); ++n) {
      double sum = -count.excess[n];
      double movable = 0;
      for (const Neighbor& neighbor : neighbors[n]) {
        sum += neighbor.movable * more[neighbor.rank];
        movable += neighbor.movable;
      }
      if (movable > 0) more[n] = std::clamp(added[n] + sum / movable, -most, most) - added[n];
    }
  }
  return more;
}

/// The values with these numbers added, but for those of nodes that would not keep their label: there it rises, until
/// it wins by the margin. held: by number of the node, those whose values stay; null: none.
std::vector<float> shifted(const LabelNodes& nodes, const LabelValues& values, const std::vector<double>& added,
                           float margin, const std::vector<bool>* held = nullptr) {
  const std::vector<std::size_t> positions = values.nodes.positions();
  constexpr std::size_t kPiece = 8192;  // nodes
  std::vector<float> out = values.values;
  parallel_for(positions.size(), kPiece, [&](std::size_t begin, std::size_t end) {
    for (std::size_t n = begin; n < end; ++n) {
      if (held != nullptr && (*held)[n]) continue;
      const std::array<int, 3> node = values.nodes.node_at(positions[n]);
      const LabelRank own = nodes.at(node[0], node[1], node[2]);
      float most = std::numeric_limits<float>::lowest();  // of others
      std::size_t at = values.first[n];
      for (std::size_t e = values.first[n]; e < values.first[n + 1]; ++e) {
        const LabelRank rank = values.ranks[e];
        out[e] = values.values[e] + static_cast<float>(added[rank]);
        if (rank == own) at = e;
        if (rank != own) most = std::max(most, out[e]);
      }
      out[at] = std::max(out[at], most + margin);
    }
  });
  return out;
}

/// Makes room in `added` for every rank that has values; false if none has.
bool number_ranks(LabelValues& values) {
  if (values.ranks.empty()) return false;
  values.added.resize(std::size_t{*std::max_element(values.ranks.begin(), values.ranks.end())} + 1);
  return true;
}

/// count: of the fields. most: of what is added to a label's values, with what was before.
void make_volumes_right(const LabelNodes& nodes, double most, LabelValues& values,
                        const std::function<VolumeCount(const CountedFields&)>& count) {
  constexpr int kRounds = 4;
  constexpr float kMargin = 0.3F;
  if (!number_ranks(values)) return;
  std::vector<double> added(values.added.size());
  std::vector<double> all = values.added;
  std::vector<float> now = values.values;
  for (int round = 0; round < kRounds; ++round) {
    const std::vector<double> more = numbers_to_add(count({nodes, values, now}), all, most);
    for (std::size_t n = 0; n < added.size(); ++n) {
      added[n] += more[n];
      all[n] += more[n];
    }
    now = shifted(nodes, values, added, kMargin);
  }
  values.added = std::move(all);
  values.values = std::move(now);
}

/// Whether three labels or more meet in a cell, or two in such a way that a small change of their values may join or
/// part their regions: they are as on a checkerboard on a face.
bool is_touchy(const std::array<LabelRank, 8>& ranks) {
  const LabelRank first = ranks[0];
  const auto other = std::find_if(ranks.begin(), ranks.end(), [&](LabelRank rank) { return rank != first; });
  if (std::any_of(other, ranks.end(), [&](LabelRank rank) { return rank != first && rank != *other; })) return true;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::size_t u = std::size_t{1} << (axis + 1) % 3;
    const std::size_t v = std::size_t{1} << (axis + 2) % 3;
    for (const std::size_t low : {std::size_t{0}, std::size_t{1} << axis}) {
      if (has_pass({ranks[low], ranks[low + u], ranks[low + v], ranks[low + u + v]})) return true;
    }
  }
  return false;
}

/// Whether the node's neighbours on both sides along two axes have other labels.
bool is_thin(const LabelNodes& nodes, int i, int j, int k) {
  const LabelRank own = nodes.at(i, j, k);
  const auto differs = [&](int x, int y, int z) { return nodes.at(x, y, z) != own; };
  const auto inside = [&](int at, std::size_t axis) { return at >= 0 && at < nodes.size()[axis]; };
  const bool along_x = inside(i, 0) && differs(i - 1, j, k) && differs(i + 1, j, k);
  const bool along_y = inside(j, 1) && differs(i, j - 1, k) && differs(i, j + 1, k);
  const bool along_z = inside(k, 2) && differs(i, j, k - 1) && differs(i, j, k + 1);
  return along_x + along_y + along_z >= 2;
}

/// By number of the node, those of cells where a small change of values may change what is joined: touchy ones, and
/// those of thin nodes.
std::vector<bool> touchy_nodes(const LabelNodes& nodes, const NodeSet& set) {
  const auto collect = [&](std::size_t begin, std::size_t end, std::vector<std::size_t>& found) {
    for (std::size_t layer = begin; layer < end; ++layer) {
      for_each_mixed_cell(nodes, static_cast<int>(layer) - 1, [&](int i, int j, int k) {
        const auto each_node = [&](const auto& act) {
          for (int c = 0; c < 8; ++c) act(i + (c & 1), j + (c >> 1 & 1), k + (c >> 2));
        };
        bool holds = is_touchy(nodes.corners({i, j, k}));
        each_node([&](int x, int y, int z) { holds = holds || is_thin(nodes, x, y, z); });
        if (holds) each_node([&](int x, int y, int z) { found.push_back(set.number_of(set.position(x, y, z))); });
      });
    }
  };
  const auto layers = static_cast<std::size_t>(nodes.size()[2]) + 1;
  std::vector<bool> at(set.count());
  for (const std::size_t number : parallel_collect<std::size_t>(layers, 1, collect)) at[number] = true;
  return at;
}

/// The nodes of the place's cell and of those around it.
void hold_around(const LabelNodes& nodes, const NodeSet& set, const Vec& place, std::vector<bool>& held) {
  const CellIndex cell = cell_of(place, nodes.size());
  const auto last = [&](std::size_t axis) { return std::min(cell[axis] + 2, nodes.size()[axis]); };
  for (int k = std::max(cell[2] - 1, -1); k <= last(2); ++k) {
    for (int j = std::max(cell[1] - 1, -1); j <= last(1); ++j) {
      for (int i = std::max(cell[0] - 1, -1); i <= last(0); ++i) {
        const std::size_t position = set.position(i, j, k);
        if (set.holds(position)) held[set.number_of(position)] = true;
      }
    }
  }
}

}  // namespace

void keep_volumes(const LabelNodes& nodes, LabelValues& values) {
  make_volumes_right(nodes, kOfFields, values, count_volumes);
}

void keep_volumes_of_facets(const LabelNodes& nodes, const Frame& frame, const FacetSizes& facets,
                            LabelValues& values) {
  make_volumes_right(nodes, kOfFacets, values,
                     [&](const CountedFields& counted) { return count_volumes_of_facets(counted, frame, facets); });
}

bool are_volumes_off(const LabelNodes& nodes, const Frame& frame, const FacetSizes& facets, const LabelValues& values,
                     std::span<const std::uint64_t> voxels) {
  constexpr std::uint64_t kLarge = 1000;
  constexpr double kMost = 0.05;  // of the volume: what finished meshes can be moved by, and more
  if (values.ranks.empty()) return false;
  const VolumeCount count = count_volumes_of_facets({nodes, values, values.values}, frame, facets);
  for (std::size_t rank = 1; rank < count.excess.size(); ++rank) {  // but for what is outside
    const double most = kMost * kVolumeSamples * static_cast<double>(voxels[rank]);
    if (voxels[rank] > kLarge && std::abs(count.excess[rank]) > most) return true;
  }
  return false;
}

void move_volumes(const LabelNodes& nodes, const std::vector<double>& excess_voxels, std::span<const Vec> held,
                  LabelValues& values) {
  constexpr float kMargin = 0.1F;
  if (!number_ranks(values)) return;
  values.moved.resize(values.added.size());
  std::vector<bool> stay = touchy_nodes(nodes, values.nodes);
  VolumeCount count = count_volumes({nodes, values, values.values, &stay});
  for (std::size_t n = 0; n < count.excess.size(); ++n) count.excess[n] = excess_voxels[n] * kVolumeSamples;
  const std::vector<double> more = numbers_to_add(count, values.moved, kOfMeshes, 1);
  // After the numbers are found: tries with other places held differ there only.
  for (const Vec& place : held) hold_around(nodes, values.nodes, place, stay);
  values.values = shifted(nodes, values, more, kMargin, &stay);
  for (std::size_t n = 0; n < more.size(); ++n) values.moved[n] += more[n];
}

}  // namespace scantet
