// Each node carries the cone that is lowest there, as the place of its apex, and offers it to its neighbours. Sweeps go
// to and fro over the grid until no node takes an offer (after Danielsson's vector distance transform, with heights).
// The values are exact for the cones that are offered; the only cones missed are those that none of the neighbours has.
//
// No library does this: ITK's fast marching never lowers a node that starts with a value, and here all of them do;
// OpenVDB's fast sweeping keeps the values it starts from; the distance transforms of both know no heights.
#include <cmath>

#include "scantet/sizing/size_grid.h"

namespace scantet {
namespace {

class Sweeper {
 public:
  Sweeper(const GridShape& shape, std::vector<float>& sizes)
      : shape_(shape), sizes_(sizes), heights_(sizes), apexes_(sizes.size()) {
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
  /// one. Stops when cancelled.
  bool sweep(bool forth, const Progress& progress) {
    const auto [nx, ny, nz] = shape_.nodes;
    const auto place = [forth](int n, int count) { return forth ? n : count - 1 - n; };
    bool taken = false;
    for (int k = 0; k < nz && !progress.cancelled(); ++k) {
      for (int j = 0; j < ny; ++j) {
        for (int i = 0; i < nx; ++i) {
          taken = offer_earlier(place(i, nx), place(j, ny), place(k, nz), forth ? -1 : 1) || taken;
        }
      }
    }
    return taken;
  }

 private:
  struct Apex {
    std::int16_t i;
    std::int16_t j;
    std::int16_t k;
  };

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
