// Nodes that are neighbours along an axis and have one label are of one part, as fields are linear between them. In a
// cell of two labels their difference is trilinear, and what is joined in it is counted exactly. In a cell of more,
// straight lines between corners join where a label is surely the largest along them; where that is not shown, corners
// of a label may be joined.
#include "scantet/verify/label_parts.h"

#include <algorithm>
#include <array>
#include <bit>

#include "scantet/base/error.h"
#include "scantet/base/union_find.h"
#include "scantet/verify/cell_parts.h"
#include "scantet/verify/label_cells.h"

namespace scantet::verify {
namespace {

/// Two corners of a cell with one label.
struct Pair {
  std::uint32_t a;
  std::uint32_t b;
  bool is_sure;  // joined; else they may be
};

struct Seen {
  std::vector<Pair> pairs;
  std::vector<Cell> no_largest;  // cells with a corner whose label is not the largest there
  std::vector<Cell> faces;       // cells with a face on which another label than those of its corners may be largest
};

class CellLooker {
 public:
  explicit CellLooker(const LabelSource& labels) : labels_(labels) {
    for (std::size_t axis = 0; axis < 3; ++axis) count_[axis] = static_cast<std::uint32_t>(labels.size()[axis]) + 2;
  }

  std::uint32_t number(int i, int j, int k) const {
    return (static_cast<std::uint32_t>(k + 1) * count_[1] + static_cast<std::uint32_t>(j + 1)) * count_[0] +
           static_cast<std::uint32_t>(i + 1);
  }

  void look(const Cell& cell, Seen& seen) {
    cell_ = cell;
    labels_.cell(cell[0], cell[1], cell[2], fields_);
    for (int c = 0; c < 8; ++c) {
      const Region region = labels_.region_of(cell[0] + (c & 1), cell[1] + (c >> 1 & 1), cell[2] + (c >> 2));
      const auto* const at = std::find(fields_.regions.begin(), fields_.regions.begin() + fields_.count, region);
      field_of_[static_cast<std::size_t>(c)] = static_cast<std::size_t>(at - fields_.regions.begin());
    }
    if (!nodes_win()) {
      seen.no_largest.push_back(cell);
      for_pairs([&](int a, int b) { put(a, b, false, seen); });
      return;
    }
    if (fields_.count == 2) {
      two_labels(seen);
    } else {
      for_pairs([&](int a, int b) { put(a, b, is_joined(a, b), seen); });
    }
    if (!faces_agree()) seen.faces.push_back(cell);
  }

 private:
  bool nodes_win() const {
    for (std::size_t c = 0; c < 8; ++c) {
      if (field_of_[c] == fields_.count) return false;
      for (std::size_t n = 0; n < fields_.count; ++n) {
        if (n != field_of_[c] && fields_.values[n][c] >= fields_.values[field_of_[c]][c]) return false;
      }
    }
    return true;
  }

  template <class Act>
  void for_pairs(const Act& act) const {
    for (int a = 0; a < 8; ++a) {
      for (int b = a + 1; b < 8; ++b) {
        if (field_of_[static_cast<std::size_t>(a)] == field_of_[static_cast<std::size_t>(b)]) act(a, b);
      }
    }
  }

  void put(int a, int b, bool is_sure, Seen& seen) const {
    const auto node = [&](int c) { return number(cell_[0] + (c & 1), cell_[1] + (c >> 1 & 1), cell_[2] + (c >> 2)); };
    seen.pairs.push_back({node(a), node(b), is_sure});
  }

  void two_labels(Seen& seen) const {
    std::array<double, 8> difference{};
    bool is_exact = true;
    for (std::size_t c = 0; c < 8; ++c) {
      const double a = fields_.values[1][c];
      const double b = fields_.values[0][c];
      const double d = difference[c] = a - b;
      const double part = a - d;  // the error of a difference of two doubles is a double (Knuth)
      is_exact = is_exact && (part - b) + (a - (part + d)) == 0;
    }
    const CellPart sides[2] = {part_in_cell(difference, 0, -1), part_in_cell(difference, 0, 1)};
    for_pairs([&](int a, int b) {
      const CellPart& part = sides[field_of_[static_cast<std::size_t>(a)]];
      const bool is_known = is_exact && part.is_known;
      const bool is_one = part.piece[static_cast<std::size_t>(a)] == part.piece[static_cast<std::size_t>(b)];
      if (!is_known) {
        put(a, b, is_joined(a, b), seen);
      } else if (is_one) {
        put(a, b, true, seen);
      }
    });
  }

  /// Whether the label of both corners is surely the largest on the line between them.
  bool is_joined(int a, int b) const {
    constexpr int kSteps = 32;
    for (int step = 0; step < kSteps; ++step) {
      Box box;
      for (int axis = 0; axis < 3; ++axis) {
        const double from = a >> axis & 1;
        const double to = b >> axis & 1;
        const double base = cell_[static_cast<std::size_t>(axis)];
        const double low = base + from + (to - from) * step / kSteps;
        const double high = base + from + (to - from) * (step + 1) / kSteps;
        box.min[axis] = std::min(low, high);
        box.max[axis] = std::max(low, high);
      }
      if (!surely_wins(fields_, field_of_[static_cast<std::size_t>(a)], cell_, box)) return false;
    }
    return true;
  }

  /// On each face the largest field is one of its corners'.
  bool faces_agree() const {
    constexpr int kDepth = 12;
    for (int face = 0; face < 6; ++face) {
      std::uint8_t there = 0;
      for (int n = 0; n < 4; ++n) {
        there = static_cast<std::uint8_t>(there |
                                          1 << field_of_[static_cast<std::size_t>(face_corner(face / 2, face % 2, n))]);
      }
      Box box{{double(cell_[0]), double(cell_[1]), double(cell_[2])}, {cell_[0] + 1.0, cell_[1] + 1.0, cell_[2] + 1.0}};
      (face % 2 == 0 ? box.max : box.min)[face / 2] = cell_[static_cast<std::size_t>(face / 2)] + face % 2;
      for (std::size_t n = 0; n < fields_.count; ++n) {
        if ((there >> n & 1) == 0 && !surely_not_above(fields_, n, cell_, box, kDepth)) return false;
      }
    }
    return true;
  }

  const LabelSource& labels_;
  std::array<std::uint32_t, 3> count_{};
  Cell cell_{};
  LabelCellValues fields_;
  std::array<std::size_t, 8> field_of_{};  // of each corner
};

void add_faults(const std::vector<Seen>& seen, const Frame& frame, std::vector<VerifyFinding>& list) {
  FindingList faults(list);
  const auto place = [&](const Cell& c) { return frame.to_world({c[0] + 0.5, c[1] + 0.5, c[2] + 0.5}); };
  for (const Seen& layer : seen) {
    for (const Cell& cell : layer.no_largest) {
      faults.add_undecided("label.tie", "the field of a voxel's label is not the largest at its centre", place(cell),
                           false);
    }
    for (const Cell& cell : layer.faces) {
      faults.add_undecided("label.face", "whether two cells agree on the face between them could not be decided",
                           place(cell), false);
    }
  }
}

/// Numbers the sets of nodes as parts; parts that may be one have one group.
LabelParts number_parts(const LabelSource& labels, UnionFind& sets, const std::vector<Seen>& seen) {
  LabelParts all;
  all.parts.resize(sets.number_sets(all.part_of));
  const std::array<int, 3>& size = labels.size();
  std::size_t at = 0;
  for (int k = -1; k <= size[2]; ++k) {
    for (int j = -1; j <= size[1]; ++j) {
      for (int i = -1; i <= size[0]; ++i, ++at) {
        LabelParts::Part& part = all.parts[all.part_of[at]];
        const bool is_voxel = i >= 0 && j >= 0 && k >= 0 && i < size[0] && j < size[1] && k < size[2];
        if (part.voxels == 0) part.node = {i, j, k};
        part.region = labels.region_of(i, j, k);
        part.voxels += is_voxel ? 1 : 0;
      }
    }
  }
  UnionFind groups(all.parts.size());
  for (const Seen& layer : seen) {
    for (const Pair& pair : layer.pairs) groups.unite(all.part_of[pair.a], all.part_of[pair.b]);
  }
  for (std::uint32_t n = 0; n < all.parts.size(); ++n) all.parts[n].group = groups.find(n);
  return all;
}

}  // namespace

LabelParts label_parts(const LabelSource& labels, std::vector<VerifyFinding>& faults, const Progress& progress) {
  const std::array<int, 3>& size = labels.size();
  const double nodes = (size[0] + 2.0) * (size[1] + 2.0) * (size[2] + 2.0);
  if (nodes >= 4294967295.0) {
    throw Error(Fault::input, "input.too_large", "the label map has 2^32 voxels or more, which cannot be verified",
                "crop it");
  }
  std::vector<Seen> seen(static_cast<std::size_t>(size[2]) + 1);
  for_cells(labels, progress, [&](std::size_t layer, const Cell& cell) {
    if (!only_region(labels, cell)) CellLooker(labels).look(cell, seen[layer]);
  });
  add_faults(seen, labels.frame(), faults);
  const CellLooker looker(labels);
  UnionFind sets(static_cast<std::size_t>(nodes));
  for (int k = -1; k <= size[2]; ++k) {
    for (int j = -1; j <= size[1]; ++j) {
      for (int i = -1; i <= size[0]; ++i) {
        const Region region = labels.region_of(i, j, k);
        const std::uint32_t here = looker.number(i, j, k);
        if (i >= 0 && labels.region_of(i - 1, j, k) == region) sets.unite(here, looker.number(i - 1, j, k));
        if (j >= 0 && labels.region_of(i, j - 1, k) == region) sets.unite(here, looker.number(i, j - 1, k));
        if (k >= 0 && labels.region_of(i, j, k - 1) == region) sets.unite(here, looker.number(i, j, k - 1));
      }
    }
  }
  for (const Seen& layer : seen) {
    for (const Pair& pair : layer.pairs) {
      if (pair.is_sure) sets.unite(pair.a, pair.b);
    }
  }
  return number_parts(labels, sets, seen);
}

}  // namespace scantet::verify
