// In index space, where voxel centres are whole numbers: each tet looks at those in its box.
#include "scantet/materials/sample_means.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "scantet/base/parallel.h"

namespace scantet {
namespace {

constexpr std::size_t kGrain = 512;
constexpr double kTouch = 1e-12;  // of a tet's volume: a centre this far outside is on a face

/// A box of voxels, its ends included.
struct VoxelBox {
  std::array<std::int64_t, 3> low{};
  std::array<std::int64_t, 3> high{};
};

/// The sum over some voxels.
struct Sum {
  double value = 0;
  std::int64_t count = 0;
};

class TetInVoxels {
 public:
  TetInVoxels(const ScanValues& values, const TetMesh& mesh, std::size_t tet) : scan_(values.scan()) {
    for (std::size_t i = 0; i < 4; ++i) {
      const Vec index = scan_.frame.to_index(mesh.vertices[mesh.tets[tet][i]]);
      corners_[i] = {index.x, index.y, index.z};
    }
    volume_ = signed_volume(corners_);
  }

  /// Of the voxels whose centres are in the tet.
  Sum inside(const std::function<double(double)>& of_value) const {
    VoxelBox box;
    for (int axis = 0; axis < 3; ++axis) {
      const auto a = static_cast<std::size_t>(axis);
      const auto [low, high] =
          std::minmax({corners_[0][axis], corners_[1][axis], corners_[2][axis], corners_[3][axis]});
      box.low[a] = static_cast<std::int64_t>(std::ceil(std::max(low, 0.0)));
      box.high[a] = static_cast<std::int64_t>(std::floor(std::min(high, scan_.size[a] - 1.0)));
    }
    return sum(box, of_value, true);
  }

  /// Of the eight voxels around the centroid.
  Sum around_centroid(const std::function<double(double)>& of_value) const {
    VoxelBox box;
    for (int axis = 0; axis < 3; ++axis) {
      const auto a = static_cast<std::size_t>(axis);
      const double centre = (corners_[0][axis] + corners_[1][axis] + corners_[2][axis] + corners_[3][axis]) / 4;
      box.low[a] = static_cast<std::int64_t>(std::floor(std::clamp(centre, 0.0, scan_.size[a] - 2.0)));
      box.high[a] = box.low[a] + 1;
    }
    return sum(box, of_value, false);
  }

 private:
  static double signed_volume(const std::array<Point, 4>& c) {
    return dot(c[1] - c[0], cross(c[2] - c[0], c[3] - c[0]));
  }

  bool holds(const Point& p) const {
    for (std::size_t i = 0; i < 4; ++i) {
      std::array<Point, 4> other = corners_;
      other[i] = p;
      if (signed_volume(other) / volume_ < -kTouch) return false;
    }
    return true;
  }

  Sum sum(const VoxelBox& box, const std::function<double(double)>& of_value, bool only_inside) const {
    Sum result;
    for (std::int64_t k = box.low[2]; k <= box.high[2]; ++k) {
      for (std::int64_t j = box.low[1]; j <= box.high[1]; ++j) {
        for (std::int64_t i = box.low[0]; i <= box.high[0]; ++i) {
          const Point centre{static_cast<double>(i), static_cast<double>(j), static_cast<double>(k)};
          if (only_inside && !holds(centre)) continue;
          const std::int64_t place = i + scan_.size[0] * (j + scan_.size[1] * k);
          result.value +=
              of_value(std::visit([place](const auto* v) { return static_cast<double>(v[place]); }, scan_.voxels));
          ++result.count;
        }
      }
    }
    return result;
  }

  const Scan& scan_;
  std::array<Point, 4> corners_;
  double volume_ = 0;
};

}  // namespace

std::vector<double> voxel_means(const TetMesh& mesh, const ScanValues& scan,
                                const std::function<double(double)>& of_value) {
  std::vector<double> means(mesh.tets.size());
  parallel_for(means.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t t = begin; t < end; ++t) {
      const TetInVoxels tet(scan, mesh, t);
      Sum sum = tet.inside(of_value);
      if (sum.count == 0) sum = tet.around_centroid(of_value);
      means[t] = sum.value / static_cast<double>(sum.count);
    }
  });
  return means;
}

std::vector<double> corner_means(const TetMesh& mesh, const ScanValues& scan,
                                 const std::function<double(double)>& of_value) {
  std::vector<double> means(mesh.tets.size());
  parallel_for(means.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t t = begin; t < end; ++t) {
      double sum = 0;
      for (const auto corner : mesh.tets[t]) sum += of_value(scan.at(mesh.vertices[corner]));
      means[t] = sum / 4;
    }
  });
  return means;
}

}  // namespace scantet
