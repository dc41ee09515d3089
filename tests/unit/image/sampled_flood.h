// Components of a trilinear level set by flood fill of fine samples: slow, and blind to thin joins, but simple.
#pragma once

#include <algorithm>
#include <array>
#include <ostream>
#include <vector>

#include "scantet/field/padded_grid.h"
#include "scantet/field/trilinear_cell.h"

namespace scantet::test {

using Size = std::array<int, 3>;

struct Counts {
  int inside = 0;
  int cavities = 0;
  friend bool operator==(const Counts&, const Counts&) = default;
  friend std::ostream& operator<<(std::ostream& out, const Counts& c) {
    return out << c.inside << " inside, " << c.cavities << " cavities";
  }
};

/// The scan sampled n to a voxel, padding included, and the samples of one sign joined along axes.
class SampledFlood {
 public:
  SampledFlood(const Scan& scan, const LevelSetSettings& settings, int n) : n_(n) {
    const PaddedGrid<float> grid = padded_grid(scan, std::get<const float*>(scan.voxels), settings);
    for (int axis = 0; axis < 3; ++axis) m_[axis] = (scan.size[axis] + 1) * n + 1;
    heights_.resize(m_[0] * m_[1] * m_[2]);
    labels_.resize(heights_.size(), -1);
    for_each_sample([&](const Size& p) {
      Size cell;
      for (int axis = 0; axis < 3; ++axis) cell[axis] = std::min(p[axis] / n, scan.size[axis]);
      const Vec u{double(p[0]) / n - cell[0], double(p[1]) / n - cell[1], double(p[2]) / n - cell[2]};
      heights_[at(p)] = trilinear(grid.corners(cell[0] - 1, cell[1] - 1, cell[2] - 1), u);
    });
    for_each_sample([&](const Size& p) {
      if (labels_[at(p)] < 0) fill(p);
    });
    --counts_.cavities;  // the unbounded outside
  }

  const Counts& counts() const { return counts_; }

  /// Calls visit(point, inside label, outside label) wherever two neighbouring samples differ in sign; voxel units.
  template <class Visit>
  void crossings(Visit visit) const {
    for_each_sample([&](const Size& p) {
      for (int axis = 0; axis < 3; ++axis) {
        Size q = p;
        if (++q[axis] >= m_[axis]) continue;
        const double a = heights_[at(p)];
        const double b = heights_[at(q)];
        if ((a > 0) == (b > 0)) continue;
        Vec point{double(p[0]), double(p[1]), double(p[2])};
        point[axis] += a / (a - b);
        visit((1.0 / n_) * point - Vec{1, 1, 1}, labels_[at(a > 0 ? p : q)], labels_[at(a > 0 ? q : p)]);
      }
    });
  }

 private:
  int at(const Size& p) const { return (p[2] * m_[1] + p[1]) * m_[0] + p[0]; }
  template <class Visit>
  void for_each_sample(Visit visit) const {
    for (int z = 0; z < m_[2]; ++z) {
      for (int y = 0; y < m_[1]; ++y) {
        for (int x = 0; x < m_[0]; ++x) visit(Size{x, y, z});
      }
    }
  }
  void fill(const Size& seed) {
    const bool inside = heights_[at(seed)] > 0;
    const int label = counts_.inside + counts_.cavities;
    ++(inside ? counts_.inside : counts_.cavities);
    std::vector<Size> stack{seed};
    labels_[at(seed)] = label;
    while (!stack.empty()) {
      const Size p = stack.back();
      stack.pop_back();
      for (int side = 0; side < 6; ++side) {
        Size q = p;
        q[side / 2] += side % 2 == 0 ? -1 : 1;
        if (q[side / 2] < 0 || q[side / 2] >= m_[side / 2]) continue;
        if (labels_[at(q)] >= 0 || (heights_[at(q)] > 0) != inside) continue;
        labels_[at(q)] = label;
        stack.push_back(q);
      }
    }
  }

  int n_;
  Size m_;
  std::vector<double> heights_;
  std::vector<int> labels_;
  Counts counts_;
};

}  // namespace scantet::test
