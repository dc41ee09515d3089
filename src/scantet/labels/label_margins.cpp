// Fields know nothing of how narrow a bridge or a gap becomes. On an edge of the grid the two labels of its ends are
// equal at one point, and a third one is smaller there by something; on a face with a pass, as at the middle of a
// checkerboard, the labels across one diagonal meet, and part those across the other one, by something; a region of one
// node ends at some distance from it. Where that is next to nothing, no element fits between surfaces, or curves:
// docs/algorithm.md has what atlases gain.
#include "scantet/labels/label_margins.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "scantet/base/neighbors.h"
#include "scantet/base/parallel.h"
#include "scantet/base/trilinear.h"
#include "scantet/labels/label_agreement.h"

namespace scantet {
namespace {

constexpr std::size_t kPiece = 8192;   // nodes
constexpr float kBelow = 0.6F;         // of labels on faces that they are at no corner of
constexpr double kMargin = 0.3;        // on edges, and at passes
constexpr double kMarginOfFour = 0.7;  // at those of four labels, where curves run side by side
constexpr double kThinnest = 0.8;      // voxels
constexpr double kTie = 0.02;          // where four labels are as near to meeting in one point, they do in a mesh
constexpr double kNearly = 0.99;       // of a margin, or a thickness: is enough
constexpr double kNowhere = -std::numeric_limits<double>::infinity();

/// A field on a face, at its corners (0, 0), (1, 0), (0, 1), (1, 1).
using FaceValues = std::array<double, 4>;

double value_at(const FaceValues& f, double x, double y) {
  return mix(mix(f[0], f[1], x), mix(f[2], f[3], x), y);
}

/// The fields of the labels at the corners of a face.
struct Face {
  std::array<LabelRank, 4> ranks;
  std::array<FaceValues, 4> fields;
};

/// By how much the labels of one diagonal's ends, which differ, exceed both others, where they do so most along the
/// line where they are equal. first: corner that the diagonal begins at, 0 or 1.
double excess_along(const Face& face, std::size_t first) {
  constexpr int kLines = 9;
  constexpr int kHalvings = 20;
  const FaceValues& a = face.fields[first];
  const FaceValues& b = face.fields[3 - first];
  const FaceValues& c = face.fields[1 - first];
  const FaceValues& d = face.fields[2 + first];
  const double to_right = first == 0 ? 1 : -1;  // of the diagonal
  double most = kNowhere;
  for (int line = 1; line <= kLines; ++line) {  // parallel to the diagonal
    const double at = static_cast<double>(line) / (kLines + 1);
    const auto x = [&](double along) { return (first == 0 ? 1 - at : at) + to_right * along; };
    const auto y = [&](double along) { return at + along; };
    double low = -std::min(at, 1 - at);
    double high = -low;
    const auto ahead = [&](double along) { return value_at(a, x(along), y(along)) - value_at(b, x(along), y(along)); };
    if (!(ahead(low) > 0 && ahead(high) < 0)) continue;
    for (int halving = 0; halving < kHalvings; ++halving) {
      const double middle = (low + high) / 2;
      (ahead(middle) > 0 ? low : high) = middle;
    }
    const double others = std::max(value_at(c, x(low), y(low)), value_at(d, x(low), y(low)));
    most = std::max(most, value_at(b, x(low), y(low)) - others);
  }
  return most;
}

/// By how much the labels at the corners 0 and 3 meet, and part those at 1 and 2; less than 0 if they are parted.
/// Nothing if that cannot be told. Pre: has_pass().
std::optional<double> pass_of(const Face& face) {
  const auto& [a, c, d, b] = face.ranks;
  if (a == b && c == d) {
    FaceValues ahead;
    for (std::size_t corner = 0; corner < 4; ++corner) ahead[corner] = face.fields[0][corner] - face.fields[1][corner];
    const auto& [low, beside, across, high] = ahead;
    return (low * high - beside * across) / (low + high - beside - across);
  }
  const double meets = a == b ? kNowhere : excess_along(face, 0);
  const double parts = c == d ? kNowhere : excess_along(face, 1);
  const double pass = a == b || (c != d && parts > meets) ? -parts : meets;
  if (!std::isfinite(pass)) return std::nullopt;
  return pass;
}

class Margins {
 public:
  Margins(const LabelNodes& nodes, LabelValues& values)
      : nodes_(nodes), values_(values), positions_(values.nodes.positions()) {}

  /// After the first sweep, nodes around which nothing has changed are not looked at again.
  void keep() {
    constexpr int kMostSweeps = 8;
    std::vector<std::uint8_t> asked(positions_.size(), 1);
    for (int sweep = 0; sweep < kMostSweeps; ++sweep) {
      const std::vector<Changes> pieces = find_changes(asked);
      if (std::all_of(pieces.begin(), pieces.end(), [](const Changes& piece) { return piece.empty(); })) return;
      std::fill(asked.begin(), asked.end(), std::uint8_t{0});
      for (const Changes& piece : pieces) {
        for (const Change& change : piece) make(change, asked);
      }
    }
  }

 private:
  struct Change {
    std::size_t entry;
    float bound;
    bool rises;  ///< bound is the least that the value may be, else the most
  };
  using Changes = std::vector<Change>;
  using Node = std::array<int, 3>;

  std::vector<Changes> find_changes(const std::vector<std::uint8_t>& asked) const {
    std::vector<Changes> pieces((positions_.size() + kPiece - 1) / kPiece);
    parallel_for(positions_.size(), kPiece, [&](std::size_t begin, std::size_t end) {
      Changes& changes = pieces[begin / kPiece];
      for (std::size_t n = begin; n < end; ++n) {
        if (asked[n] == 0 || values_.first[n + 1] - values_.first[n] < 2) continue;
        const Node node = values_.nodes.node_at(positions_[n]);
        for (std::size_t axis = 0; axis < 3; ++axis) {
          part_edge(node, n, axis, changes);
          widen_pass(node, (axis + 1) % 3, (axis + 2) % 3, changes);
          thicken_node(node, axis, changes);
          thicken_edge(node, axis, changes);
        }
      }
    });
    return pieces;
  }

  /// asked: gets the nodes that look at the value.
  void make(const Change& change, std::vector<std::uint8_t>& asked) {
    float& value = values_.values[change.entry];
    value = change.rises ? std::max(value, change.bound) : std::min(value, change.bound);
    const auto after = std::upper_bound(values_.first.begin(), values_.first.end(), change.entry);
    const auto n = static_cast<std::size_t>(after - values_.first.begin()) - 1;
    const Node node = values_.nodes.node_at(positions_[n]);
    for (const NeighborOffset& offset : kNeighborhood) {
      const Node other{node[0] + offset[0], node[1] + offset[1], node[2] + offset[2]};
      if (*std::min_element(other.begin(), other.end()) < -1 || !holds(other)) continue;
      asked[values_.nodes.number_of(position(other))] = 1;
    }
  }

  bool holds(const Node& node) const {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (node[axis] > nodes_.size()[axis]) return false;
    }
    return values_.nodes.holds(position(node));
  }
  std::size_t position(const Node& node) const { return values_.nodes.position(node[0], node[1], node[2]); }
  LabelRank rank(const Node& node) const { return nodes_.at(node[0], node[1], node[2]); }
  double value(const Node& node, LabelRank rank) const {
    return static_cast<double>(values_.values[values_.entry_of(position(node), rank)]);
  }

  /// Third labels at the point of an edge where those of its ends are equal.
  void part_edge(const Node& node, std::size_t n, std::size_t axis, Changes& out) const {
    Node other = node;
    ++other[axis];
    if (!holds(other) || rank(other) == rank(node)) return;
    const std::size_t m = values_.nodes.number_of(position(other));
    const double ahead = value(node, rank(node)) - value(node, rank(other));
    const double behind = value(other, rank(other)) - value(other, rank(node));
    const double at = ahead / (ahead + behind);
    const double equal = (1 - at) * value(node, rank(node)) + at * value(other, rank(node));
    std::size_t there = values_.first[m];
    for (std::size_t e = values_.first[n]; e < values_.first[n + 1]; ++e) {
      const LabelRank third = values_.ranks[e];
      while (there < values_.first[m + 1] && values_.ranks[there] < third) ++there;
      if (there == values_.first[m + 1]) return;
      if (values_.ranks[there] != third || third == rank(node) || third == rank(other)) continue;
      const double above =
          (1 - at) * static_cast<double>(values_.values[e]) + at * static_cast<double>(values_.values[there]) - equal;
      if (above <= -kNearly * kMargin) continue;
      const auto lower = static_cast<float>(above + kMargin);
      out.push_back({e, values_.values[e] - lower, false});
      out.push_back({there, values_.values[there] - lower, false});
    }
  }

  /// A region of one node along an axis, at that node.
  void thicken_node(const Node& node, std::size_t across, Changes& out) const {
    const std::array<Node, 1> ends{node};
    if (const double rise = missing_rise(ends, across); rise > 0) raise_own(node, rise, out);
  }

  /// The same between two nodes of a label.
  void thicken_edge(const Node& node, std::size_t axis, Changes& out) const {
    Node other = node;
    ++other[axis];
    if (!holds(other) || rank(other) != rank(node)) return;
    const std::array<Node, 2> ends{node, other};
    for (const std::size_t across : {(axis + 1) % 3, (axis + 2) % 3}) {
      const double rise = missing_rise(ends, across);
      if (!(rise > 0)) continue;
      raise_own(node, rise, out);
      raise_own(other, rise, out);
    }
  }

  void raise_own(const Node& node, double rise, Changes& out) const {
    const std::size_t entry = values_.entry_of(position(node), rank(node));
    out.push_back({entry, values_.values[entry] + static_cast<float>(rise), true});
  }

  /// By how much the label of these nodes has to rise there to be as thick as it must, midway between them. 0: it is,
  /// or is at a node beside them, too.
  template <std::size_t count>
  double missing_rise(const std::array<Node, count>& ends, std::size_t across) const {
    constexpr double kLeastRise = 0.01;
    constexpr double kMoreRise = 1.1;
    const LabelRank own = rank(ends[0]);
    struct Side {
      double ahead;   // by how much the label exceeds that of the nodes beside
      double behind;  // and by how much it is exceeded there
    };
    std::array<Side, 2> sides{};
    for (std::size_t n = 0; n < 2; ++n) {
      Side& side = sides[n];
      side = {std::numeric_limits<double>::infinity(), kNowhere};
      std::array<Node, count> beside = ends;
      for (Node& node : beside) {
        node[across] += n == 0 ? -1 : 1;
        if (node[across] < -1 || !holds(node) || rank(node) == own) return 0;
      }
      for (const Node& node : beside) {
        Side by{0, 0};
        for (std::size_t end = 0; end < count; ++end) {
          by.ahead += (value(ends[end], own) - value(ends[end], rank(node))) / count;
          by.behind += (value(beside[end], rank(node)) - value(beside[end], own)) / count;
        }
        side = {std::min(side.ahead, by.ahead), std::max(side.behind, by.behind)};
      }
    }
    const auto thickness = [&](double rise) {
      double sum = 0;
      for (const Side& side : sides) sum += (side.ahead + rise) / (side.ahead + rise + std::max(side.behind, 0.0));
      return sum;
    };
    if (thickness(0) >= kNearly * kThinnest) return 0;
    double rise = kLeastRise;
    while (thickness(rise) < kThinnest) rise *= kMoreRise;
    return rise;
  }

  void widen_pass(const Node& node, std::size_t u, std::size_t v, Changes& out) const {
    std::array<Node, 4> corners{node, node, node, node};
    Face face;
    for (std::size_t c = 0; c < 4; ++c) {
      if (c % 2 == 1) ++corners[c][u];
      if (c / 2 == 1) ++corners[c][v];
      if (!holds(corners[c])) return;
      face.ranks[c] = rank(corners[c]);
    }
    if (!has_pass(face.ranks)) return;
    for (std::size_t label = 0; label < 4; ++label) {
      for (std::size_t at = 0; at < 4; ++at) face.fields[label][at] = value(corners[at], face.ranks[label]);
    }
    const std::optional<double> pass = pass_of(face);
    const auto& [a, c, d, b] = face.ranks;
    const double margin = a != b && c != d ? kMarginOfFour : kMargin;
    if (!pass || std::abs(*pass) >= kNearly * margin) return;
    if (a != b && c != d && std::abs(*pass) < kTie) return;
    const bool meet = *pass > 0 || (*pass == 0 && std::min(a, b) < std::min(c, d));
    const auto rise = static_cast<float>(2 * (margin - std::abs(*pass)));  // at a pass each has about half a say
    for (const std::size_t at : meet ? std::array<std::size_t, 2>{0, 3} : std::array<std::size_t, 2>{1, 2}) {
      const std::size_t entry = values_.entry_of(position(corners[at]), face.ranks[at]);
      out.push_back({entry, values_.values[entry] + rise, true});
    }
  }

  const LabelNodes& nodes_;
  LabelValues& values_;
  std::vector<std::size_t> positions_;
};

}  // namespace

void keep_margins(const LabelNodes& nodes, LabelValues& values) {
  agree_on_faces(nodes, kBelow, values);
  Margins(nodes, values).keep();
}

}  // namespace scantet
