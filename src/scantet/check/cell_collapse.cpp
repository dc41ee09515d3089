// J. H. C. Whitehead's elementary collapses, on a complex of cubes: with the only coface of a cell, which is part of no
// further one, the cell goes, too.
#include <algorithm>
#include <map>
#include <optional>

#include "scantet/base/union_find.h"
#include "scantet/check/cell_collapse_impl.h"

namespace scantet::auditing {
namespace {

class Collapse {
 public:
  /// cells: ascending.
  explicit Collapse(const std::vector<GridCell>& cells) : cells_(cells), cofaces_(cells.size()), gone_(cells.size()) {
    for (std::uint32_t n = 0; n < cells_.size(); ++n) {
      each_beside(n, false, [&](std::uint32_t) { ++cofaces_[n]; });
      if (cofaces_[n] == 1) free_.push_back(n);
    }
  }

  void run() {
    for (std::size_t n = 0; n < free_.size(); ++n) {
      const std::uint32_t cell = free_[n];
      if (gone_[cell] != 0 || cofaces_[cell] != 1) continue;
      each_beside(cell, false, [&](std::uint32_t coface) {
        if (gone_[coface] == 0) take(coface);
      });
      take(cell);
    }
  }

  std::vector<std::vector<GridCell>> groups() const {
    UnionFind sets(cells_.size());
    for (std::uint32_t n = 0; n < cells_.size(); ++n) {
      if (gone_[n] != 0) continue;
      each_beside(n, true, [&](std::uint32_t face) {
        if (gone_[face] == 0) sets.unite(n, face);
      });
    }
    std::map<std::uint32_t, std::vector<GridCell>> groups;
    for (std::uint32_t n = 0; n < cells_.size(); ++n) {
      if (gone_[n] == 0) groups[sets.find(n)].push_back(cells_[n]);
    }
    std::vector<std::vector<GridCell>> list;
    list.reserve(groups.size());
    for (auto& [first, group] : groups) list.push_back(std::move(group));
    return list;
  }

 private:
  /// The cells of a dimension less that it has, or those of a dimension more that it is part of.
  template <class Take>
  void each_beside(std::uint32_t cell, bool are_less, const Take& take) const {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (cells_[cell].is_wide(axis) != are_less) continue;
      for (const int step : {-1, 1}) {
        GridCell beside = cells_[cell];
        beside.center[axis] += step;
        const auto found = std::lower_bound(cells_.begin(), cells_.end(), beside);
        if (found != cells_.end() && *found == beside) take(static_cast<std::uint32_t>(found - cells_.begin()));
      }
    }
  }

  void take(std::uint32_t cell) {
    gone_[cell] = 1;
    each_beside(cell, true, [&](std::uint32_t face) {
      if (--cofaces_[face] == 1) free_.push_back(face);
    });
  }

  const std::vector<GridCell>& cells_;
  std::vector<std::uint8_t> cofaces_;  // that are left, one a cell
  std::vector<std::uint8_t> gone_;
  std::vector<std::uint32_t> free_;  // cells with one coface when they were put here
};

}  // namespace

std::vector<std::vector<GridCell>> collapsed(std::vector<GridCell> cells) {
  std::sort(cells.begin(), cells.end());
  Collapse collapse(cells);
  collapse.run();
  return collapse.groups();
}

}  // namespace scantet::auditing
