// Each node carries the cone that is lowest there, as the place of its apex, and offers it to its neighbours. Sweeps go
// to and fro over the grid until no node takes an offer (after Danielsson's vector distance transform, with heights).
// The values are exact for the cones that are offered; the only cones missed are those that none of the neighbours has.
//
// No library does this: ITK's fast marching never lowers a node that starts with a value, and here all of them do;
// OpenVDB's fast sweeping keeps the values it starts from; the distance transforms of both know no heights.
#include <algorithm>
#include <cmath>

#include "scantet/base/parallel.h"
#include "scantet/sizing/size_grid.h"

namespace scantet {
namespace {

class Sweeper {
 public:
  Sweeper(const GridShape& shape, std::vector<float>& sizes)
      : shape_(shape),
        sizes_(sizes),
        heights_(sizes),
        apexes_(sizes.size()),
        taken_(static_cast<std::size_t>(shape.nodes[1]) * static_cast<std::size_t>(shape.nodes[2]), 1) {
    for (int k = 0; k < shape.nodes[2]; ++k) {
      for (int j = 0; j < shape.nodes[1]; ++j) {
        for (int i = 0; i < shape.nodes[0]; ++i) {
          apexes_[shape_.index(i, j, k)] = {static_cast<std::int16_t>(i), static_cast<std::int16_t>(j),
                                            static_cast<std::int16_t>(k)};
        }
      }
    }
  }

  /// Offers each node the cones of the thirteen neighbours that come earlier in the order; returns whether any took
  /// one. Stops when cancelled. Rows of one front have no such neighbours in each other, so that they go side by side.
  bool sweep(bool forth, const Progress& progress) {
    const auto [nx, ny, nz] = shape_.nodes;
    ++sweep_;
    for (int front = 0; front < ny + 2 * (nz - 1) && !progress.cancelled(); ++front) {
      const int first = std::max(0, (front - ny + 2) / 2);  // layers k with a row j = front - 2k
      const int last = std::min(nz - 1, front / 2);
      const int rows = last - first + 1;
      parallel_for(static_cast<std::size_t>(rows), kRows, [&, front](std::size_t begin, std::size_t end) {
        for (std::size_t n = begin; n < end; ++n) {
          const int k = first + static_cast<int>(n);
          const int j = front - 2 * k;
          sweep_row(forth ? j : shape_.nodes[1] - 1 - j, forth ? k : shape_.nodes[2] - 1 - k, forth ? -1 : 1);
        }
      });
    }
    return std::find(taken_.begin(), taken_.end(), sweep_) != taken_.end();
  }

 private:
  static constexpr std::size_t kRows = 4;  // at a time

  struct Apex {
    std::int16_t i;
    std::int16_t j;
    std::int16_t k;
  };

  std::size_t row(int j, int k) const {
    return static_cast<std::size_t>(k) * static_cast<std::size_t>(shape_.nodes[1]) + static_cast<std::size_t>(j);
  }

  /// What has not changed since the last sweep this way was offered then.
  bool has_news(int j, int k, int back) const {
    const auto is_news = [&](int y, int z) {
      const bool there = y >= 0 && z >= 0 && y < shape_.nodes[1] && z < shape_.nodes[2];
      return there && taken_[row(y, z)] + 1 >= sweep_;
    };
    return is_news(j, k) || is_news(j + back, k) || is_news(j - 1, k + back) || is_news(j, k + back) ||
           is_news(j + 1, k + back);
  }

  void sweep_row(int j, int k, int back) {
    if (!has_news(j, k, back)) return;
    const int nx = shape_.nodes[0];
    bool taken = false;
    for (int i = 0; i < nx; ++i) taken = offer_earlier(back < 0 ? i : nx - 1 - i, j, k, back) || taken;
    if (taken) taken_[row(j, k)] = sweep_;
  }

  bool offer_earlier(int i, int j, int k, int back) {
    bool taken = false;
    for (int n = 0; n < 13; ++n) {
      const int x = i + back * (1 - n % 3);
      const int y = j + back * (1 - n / 3 % 3);
      const int z = k + back * (1 - n / 9);
      const bool there =
          x >= 0 && y >= 0 && z >= 0 && x < shape_.nodes[0] && y < shape_.nodes[1] && z < shape_.nodes[2];
      if (there) taken = offer(i, j, k, apexes_[shape_.index(x, y, z)]) || taken;
    }
    return taken;
  }

  bool offer(int i, int j, int k, const Apex& apex) {
    constexpr double kGain = 1 - 1e-6;  // a smaller gain is rounding
    float& size = sizes_[shape_.index(i, j, k)];
    const double height = static_cast<double>(heights_[shape_.index(apex.i, apex.j, apex.k)]);
    const double room = kGain * static_cast<double>(size) - height;
    if (!(room > 0)) return false;
    const Vec steps{double(i - apex.i), double(j - apex.j), double(k - apex.k)};
    const double squared = squared_length(steps) * shape_.step_mm * shape_.step_mm;
    if (squared >= room * room) return false;
    size = static_cast<float>(height + std::sqrt(squared));
    apexes_[shape_.index(i, j, k)] = apex;
    return true;
  }

  const GridShape& shape_;
  std::vector<float>& sizes_;
  std::vector<float> heights_;  // of the cones: the sizes at the start
  std::vector<Apex> apexes_;    // of the lowest cone so far at each node
  std::vector<int> taken_;      // one a row along x: the last sweep in which one of its nodes took a cone
  int sweep_ = 0;
};

}  // namespace

void make_lipschitz(const GridShape& shape, std::vector<float>& sizes, const Progress& progress) {
  Sweeper sweeper(shape, sizes);
  bool taken = true;
  while (taken && !progress.cancelled()) {
    taken = sweeper.sweep(true, progress);
    taken = sweeper.sweep(false, progress) || taken;
  }
}

}  // namespace scantet
