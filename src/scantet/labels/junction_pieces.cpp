// In a tet with linear fields, where three of them are equal is a line; what of it is in the tet, and where no other
// field is larger, is convex: a piece with two ends, each on a face or where a fourth field is as large. In barycentric
// coordinates the line meets a face where two linear forms vanish, in the cross product of their coefficients, and the
// signs of that are all that decides: on an edge of the face they come from the same numbers in the same order,
// whichever face is asked, so the pieces join in spite of rounding.
//
// Fields that hold ones and zeros are equal at many nodes. A shift of each label's field, another one for each label
// but the same everywhere, parts what meets by chance and leaves parallel pieces, not a tangle, where four labels meet
// in a line.
#include "scantet/labels/junction_pieces.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <numeric>
#include <span>

#include "scantet/base/coordinate_hash.h"
#include "scantet/base/parallel.h"
#include "scantet/base/trilinear.h"

namespace scantet {
namespace {

constexpr double kShift = 1e-5;  // at the most, where fields go from 0 to 1
constexpr std::size_t kMostLabels = 8;
constexpr int kCuts = 8;  // subcells along each axis of a cell; a power of two

double shift_of(Region region) {
  const std::uint64_t hash = hash_of_words({static_cast<std::uint64_t>(region), 1, 2});
  return kShift * static_cast<double>(hash >> 11) * 0x1p-53;
}

/// One label's field at the nodes of subcells, or of one, or of a tet.
template <std::size_t Count>
using NodeValues = std::array<double, Count>;

/// Labels with their values, those left out that some other one exceeds at all nodes: they are largest nowhere between.
template <std::size_t Count>
struct Contenders {
  std::size_t count = 0;
  std::array<std::size_t, kMostLabels> labels{};  // of the cell
  std::array<NodeValues<Count>, kMostLabels> values{};

  void drop_beaten() {
    std::size_t kept = 0;
    std::array<bool, kMostLabels> beaten{};
    for (std::size_t i = 0; i < count; ++i) {
      for (std::size_t j = 0; j < count && !beaten[i]; ++j) beaten[i] = j != i && exceeds(values[j], values[i]);
    }
    for (std::size_t i = 0; i < count; ++i) {
      if (beaten[i]) continue;
      labels[kept] = labels[i];
      values[kept++] = values[i];
    }
    count = kept;
  }

 private:
  static bool exceeds(const NodeValues<Count>& a, const NodeValues<Count>& b) {
    for (std::size_t n = 0; n < Count; ++n) {
      if (!(a[n] > b[n])) return false;
    }
    return true;
  }
};

using TetContenders = Contenders<4>;
using Barycentric = std::array<double, 4>;

/// Makes coordinates of one sign sum up to 1. False if they are not of one sign: the point is not inside.
bool normalize(Barycentric& u, std::size_t used) {
  double sum = 0;
  for (std::size_t i = 0; i < used; ++i) {
    if (!(u[i] * u[0] > 0)) return false;
    sum += u[i];
  }
  for (std::size_t i = 0; i < used; ++i) u[i] /= sum;
  return true;
}

double at(const NodeValues<4>& values, const Barycentric& u) {
  return u[0] * values[0] + u[1] * values[1] + u[2] * values[2] + u[3] * values[3];
}

/// The coordinates that two linear forms on a triangle both vanish at, but for a factor.
std::array<double, 3> common_zero(const std::array<double, 3>& a, const std::array<double, 3>& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

/// A tet of a subcell: a walk along its edges from its lowest node to its highest.
struct Tet {
  std::array<unsigned, 2> steps;  ///< the corners of the subcell that are passed, bits as in trilinear.h
};
constexpr std::array<Tet, 6> kTets{{{{1, 3}}, {{1, 5}}, {{2, 3}}, {{2, 6}}, {{4, 5}}, {{4, 6}}}};

/// Traces the pieces of one cell after the other.
class CellTracer {
 public:
  CellTracer(const LabelField& field, std::vector<JunctionPiece>& out) : field_(field), out_(out) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      fine_[axis] = std::int64_t{kCuts} * (field.size()[axis] + 1) + 1;
    }
  }

  void trace(int i, int j, int k) {
    field_.cell(i, j, k, cell_);
    if (cell_.count < 3) return;
    cell_place_ = {i, j, k};
    std::array<std::size_t, kMostLabels> labels{};
    std::iota(labels.begin(), labels.end(), std::size_t{0});
    trace_block({0, 0, 0}, kCuts, std::span(labels).first(cell_.count));
  }
  std::size_t broken() const { return broken_; }

 private:
  /// Traces a cube of subcells, in each half of it for itself, with those labels that may be largest somewhere in it.
  /// low: its lowest node among those of the cell; width: subcells along an axis; labels: of the cell, ascending.
  void trace_block(const std::array<int, 3>& low, int width, std::span<const std::size_t> labels) {
    Contenders<8> contenders;
    contenders.count = labels.size();
    for (std::size_t i = 0; i < labels.size(); ++i) contenders.labels[i] = labels[i];
    for (std::size_t corner = 0; corner < 8; ++corner) {
      std::array<int, 3> node = low;
      for (std::size_t axis = 0; axis < 3; ++axis) node[axis] += (corner >> axis & 1) != 0 ? width : 0;
      for (std::size_t i = 0; i < labels.size(); ++i) contenders.values[i][corner] = value_at(labels[i], node);
    }
    contenders.drop_beaten();
    if (contenders.count < 3) return;
    if (width > 1) {
      const int half = width / 2;
      for (unsigned part = 0; part < 8; ++part) {
        std::array<int, 3> at = low;
        for (unsigned axis = 0; axis < 3; ++axis) at[axis] += (part >> axis & 1) != 0 ? half : 0;
        trace_block(at, half, std::span(contenders.labels).first(contenders.count));
      }
      return;
    }
    for (std::size_t axis = 0; axis < 3; ++axis)
      base_[axis] = kCuts * (cell_place_[axis] + std::int64_t{1}) + low[axis];
    for (const Tet& tet : kTets) trace_tet(contenders, tet);
  }

  /// A label's field at a node of the subcells; on a face of the cell, the same for both cells at it.
  double value_at(std::size_t label, const std::array<int, 3>& node) const {
    const auto along = [&](std::size_t axis) { return static_cast<double>(node[axis]) / kCuts; };
    return trilinear(cell_.values[label], {along(0), along(1), along(2)}) + shift_of(cell_.regions[label]);
  }

  void trace_tet(const Contenders<8>& in_subcell, const Tet& tet) {
    corners_ = {0, tet.steps[0], tet.steps[1], 7};
    contenders_.count = in_subcell.count;
    contenders_.labels = in_subcell.labels;
    for (std::size_t label = 0; label < in_subcell.count; ++label) {
      for (std::size_t n = 0; n < 4; ++n) contenders_.values[label][n] = in_subcell.values[label][corners_[n]];
    }
    contenders_.drop_beaten();
    const std::size_t count = contenders_.count;
    if (count < 3) return;
    find_meetings_of_four();
    for (std::size_t a = 0; a < count; ++a) {
      for (std::size_t b = a + 1; b < count; ++b) {
        for (std::size_t c = b + 1; c < count; ++c) add_piece({a, b, c});
      }
    }
  }

  Region region_of(std::size_t contender) const { return cell_.regions[contenders_.labels[contender]]; }

  void find_meetings_of_four() {
    in_tet_.clear();
    const std::size_t count = contenders_.count;
    for (std::size_t a = 0; a < count; ++a) {
      for (std::size_t b = a + 1; b < count; ++b) {
        for (std::size_t c = b + 1; c < count; ++c) {
          for (std::size_t d = c + 1; d < count; ++d) add_meeting({a, b, c, d});
        }
      }
    }
  }

  void add_meeting(const std::array<std::size_t, 4>& labels) {
    const auto& v = contenders_.values;
    Barycentric u;
    for (std::size_t left_out = 0; left_out < 4; ++left_out) {
      std::array<std::array<double, 3>, 3> rows;
      for (std::size_t row = 0; row < 3; ++row) rows[row] = difference(v[labels[0]], v[labels[row + 1]], left_out);
      const std::array<double, 3> minors = common_zero(rows[1], rows[2]);
      const double det = rows[0][0] * minors[0] + rows[0][1] * minors[1] + rows[0][2] * minors[2];
      u[left_out] = left_out % 2 == 0 ? det : -det;
    }
    if (!normalize(u, 4) || !largest(u, labels[0], labels)) return;
    PieceEnd end;
    end.place = place_of(0, corners_[1], corners_[2]);
    for (std::size_t i = 0; i < 4; ++i) end.regions[i] = region_of(labels[i]);
    end.index = index_at(u);
    in_tet_.push_back(end);
  }

  void add_piece(const std::array<std::size_t, 3>& labels) {
    std::array<PieceEnd, 2> ends;
    std::size_t found = 0;
    const auto add = [&](const PieceEnd& end) {
      if (found < 2) ends[found] = end;
      ++found;
    };
    JunctionPiece piece;
    for (std::size_t i = 0; i < 3; ++i) piece.regions[i] = region_of(labels[i]);
    for (std::size_t face = 0; face < 4; ++face) {
      PieceEnd end;
      if (meets_face(labels, face, end)) add(end);
    }
    for (const PieceEnd& end : in_tet_) {
      if (std::includes(end.regions.begin(), end.regions.end(), piece.regions.begin(), piece.regions.end())) add(end);
    }
    if (found == 0) return;
    if (found != 2) {
      ++broken_;
      return;
    }
    piece.ends = ends;
    out_.push_back(piece);
  }

  bool meets_face(const std::array<std::size_t, 3>& labels, std::size_t face, PieceEnd& end) const {
    const auto& v = contenders_.values;
    const std::array<double, 3> zero =
        common_zero(difference(v[labels[0]], v[labels[1]], face), difference(v[labels[0]], v[labels[2]], face));
    Barycentric in_face{zero[0], zero[1], zero[2], 0};
    if (!normalize(in_face, 3)) return false;
    Barycentric u{};
    for (std::size_t n = 0, next = 0; n < 4; ++n) {
      if (n != face) u[n] = in_face[next++];
    }
    if (!largest(u, labels[0], labels)) return false;
    const unsigned low = corners_[face == 0 ? 1 : 0];
    const unsigned middle = corners_[face <= 1 ? 2 : 1];
    const unsigned high = corners_[face <= 2 ? 3 : 2];
    end.place = place_of(low, middle - low, high - low);
    for (std::size_t i = 0; i < 3; ++i) end.regions[i] = region_of(labels[i]);
    end.regions[3] = PieceEnd::kNone;
    end.index = index_at(u);
    return true;
  }

  /// a - b at the nodes but one.
  static std::array<double, 3> difference(const NodeValues<4>& a, const NodeValues<4>& b, std::size_t left_out) {
    std::array<double, 3> result;
    for (std::size_t n = 0, next = 0; n < 4; ++n) {
      if (n != left_out) result[next++] = a[n] - b[n];
    }
    return result;
  }

  /// Whether no label exceeds those that meet.
  template <std::size_t Count>
  bool largest(const Barycentric& u, std::size_t one_of_them, const std::array<std::size_t, Count>& meeting) const {
    const double value = at(contenders_.values[one_of_them], u);
    for (std::size_t label = 0; label < contenders_.count; ++label) {
      if (std::find(meeting.begin(), meeting.end(), label) != meeting.end()) continue;
      if (at(contenders_.values[label], u) > value) return false;
    }
    return true;
  }

  /// Names the face, or the tet, whose lowest node is the subcell's corner `low`; steps: from there to its next ones.
  std::int64_t place_of(unsigned low, unsigned first_step, unsigned second_step) const {
    const std::int64_t x = base_[0] + static_cast<int>(low & 1);
    const std::int64_t y = base_[1] + static_cast<int>(low >> 1 & 1);
    const std::int64_t z = base_[2] + static_cast<int>(low >> 2);
    return 64 * ((z * fine_[1] + y) * fine_[0] + x) + std::int64_t{8} * first_step + second_step;
  }

  Vec index_at(const Barycentric& u) const {
    Vec index;
    for (int axis = 0; axis < 3; ++axis) {
      double steps = 0;
      double all = 0;
      for (std::size_t n = 0; n < 4; ++n) {
        if ((corners_[n] >> axis & 1) != 0) steps += u[n];
        if ((corners_[n] >> axis & 1) == 0) all += u[n];
      }
      if (all == 0) steps = 1;  // in a face of the subcell, exactly
      index[axis] = (static_cast<double>(base_[static_cast<std::size_t>(axis)]) + steps) / kCuts - 1;
    }
    return index;
  }

  const LabelField& field_;
  std::vector<JunctionPiece>& out_;
  std::array<std::int64_t, 3> fine_{};  // nodes of all subcells
  LabelCell cell_;
  std::array<int, 3> cell_place_{};
  std::array<std::int64_t, 3> base_{};  // lowest node of the subcell, among all of them
  std::array<unsigned, 4> corners_{};   // of the tet, as corners of the subcell
  TetContenders contenders_;
  std::vector<PieceEnd> in_tet_;  // where four labels meet
  std::size_t broken_ = 0;
};

}  // namespace

JunctionPieces trace_junctions(const LabelField& field, const Progress& progress) {
  constexpr std::size_t kRows = 32;
  const auto [nx, ny, nz] = field.size();
  const auto rows_y = static_cast<std::size_t>(ny) + 1;
  std::atomic<std::size_t> broken{0};
  JunctionPieces all;
  all.pieces = parallel_collect<JunctionPiece>(
      rows_y * (static_cast<std::size_t>(nz) + 1), kRows,
      [&, cells = nx](std::size_t begin, std::size_t end, std::vector<JunctionPiece>& out) {
        if (progress.cancelled()) return;
        CellTracer tracer(field, out);
        for (std::size_t row = begin; row < end; ++row) {
          const int j = static_cast<int>(row % rows_y) - 1;
          const int k = static_cast<int>(row / rows_y) - 1;
          for (int i = -1; i < cells; ++i) {
            if (field.is_mixed(i, j, k)) tracer.trace(i, j, k);
          }
        }
        broken += tracer.broken();
      });
  all.broken = broken;
  return all;
}

}  // namespace scantet
