// Voxels are counted in their own type. Mean and deviation are summed about the smallest value, row by row, so that
// large offsets and large images lose no digits.
#include "scantet/field/scan_statistics.h"

#include <algorithm>
#include <cmath>
#include <type_traits>

namespace scantet {
namespace {

constexpr std::size_t kBins = 65536;

template <class T>
void count_values(const T* values, std::int64_t count, ValueHistogram& histogram) {
  const std::size_t last = histogram.counts.size() - 1;
  const double per_bin = 1 / histogram.bin_width;
  for (std::int64_t i = 0; i < count; ++i) {
    const double bin = (static_cast<double>(values[i]) - histogram.lower) * per_bin;
    ++histogram.counts[std::min(static_cast<std::size_t>(std::max(bin, 0.0)), last)];
  }
}

struct Sums {
  double first = 0;
  double second = 0;
};

template <class T>
Sums sums_about(const T* values, const Scan& scan, double centre) {
  Sums total;
  const std::int64_t rows = scan.voxel_count() / scan.size[0];
  for (std::int64_t row = 0; row < rows; ++row) {
    Sums sums;
    for (int i = 0; i < scan.size[0]; ++i) {
      const double v = static_cast<double>(values[row * scan.size[0] + i]) - centre;
      sums.first += v;
      sums.second += v * v;
    }
    total.first += sums.first;
    total.second += sums.second;
  }
  return total;
}

double percentile(const ValueHistogram& histogram, const ScanStatistics& all, std::int64_t voxels, int percent) {
  const double wanted = std::ceil(static_cast<double>(voxels) * percent / 100);
  std::uint64_t seen = 0;
  std::size_t bin = 0;
  while (bin + 1 < histogram.counts.size() && static_cast<double>(seen += histogram.counts[bin]) < wanted) ++bin;
  const double middle = histogram.lower + (static_cast<double>(bin) + 0.5) * histogram.bin_width;
  return std::clamp(middle, all.min, all.max);
}

char letter(int world_axis, bool towards_positive) {
  constexpr char kLetters[3][2] = {{'R', 'L'}, {'A', 'P'}, {'I', 'S'}};
  return kLetters[world_axis][towards_positive ? 1 : 0];
}

constexpr int kPermutations[6][3] = {{0, 1, 2}, {0, 2, 1}, {1, 0, 2}, {1, 2, 0}, {2, 0, 1}, {2, 1, 0}};

}  // namespace

ValueHistogram histogram_of(const Scan& scan) {
  ValueHistogram histogram;
  const double range = scan.max_value - scan.min_value;
  const bool integer = std::visit(
      [](const auto* values) { return std::is_integral_v<std::remove_cvref_t<decltype(*values)>>; }, scan.voxels);
  histogram.exact = integer && range < static_cast<double>(kBins);
  if (histogram.exact) {
    histogram.lower = scan.min_value - 0.5;
    histogram.counts.resize(static_cast<std::size_t>(range) + 1);
  } else {
    histogram.lower = scan.min_value;
    histogram.bin_width = range > 0 ? range / static_cast<double>(kBins) : 1;
    histogram.counts.resize(kBins);
  }
  std::visit([&](const auto* values) { count_values(values, scan.voxel_count(), histogram); }, scan.voxels);
  return histogram;
}

ScanStatistics statistics_of(const Scan& scan) {
  ScanStatistics all;
  all.min = scan.min_value;
  all.max = scan.max_value;
  all.histogram = histogram_of(scan);
  const double centre = scan.min_value;
  const Sums sums = std::visit([&](const auto* values) { return sums_about(values, scan, centre); }, scan.voxels);
  const auto count = static_cast<double>(scan.voxel_count());
  const double offset = sums.first / count;
  all.mean = centre + offset;
  all.standard_deviation = std::sqrt(std::max(0.0, sums.second / count - offset * offset));
  for (std::size_t k = 0; k < kPercents.size(); ++k) {
    all.percentiles[k] = percentile(all.histogram, all, scan.voxel_count(), kPercents[k]);
  }
  return all;
}

std::array<FaceTouch, 6> border_touch(const Scan& scan, double level, InsideSide side) {
  const std::string code = orientation_of(scan.frame).code;
  const auto opposite = [](char c) {
    const std::string pairs = "LRAPSI";
    return pairs[pairs.find(c) ^ 1U];
  };
  std::array<FaceTouch, 6> faces;
  std::visit(
      [&](const auto* values) {
        const std::array<std::int64_t, 3> step{1, scan.size[0], std::int64_t{scan.size[0]} * scan.size[1]};
        for (int face = 0; face < 6; ++face) {
          const int axis = face / 2;
          const bool high = face % 2 == 1;
          const int u = (axis + 1) % 3;
          const int v = (axis + 2) % 3;
          const auto* layer = values + (high ? (scan.size[axis] - 1) * step[axis] : 0);
          std::int64_t inside = 0;
          for (int a = 0; a < scan.size[u]; ++a) {
            for (int b = 0; b < scan.size[v]; ++b) {
              const auto value = static_cast<double>(layer[a * step[u] + b * step[v]]);
              inside += side == InsideSide::above ? value > level : value < level;
            }
          }
          const double voxels = static_cast<double>(scan.size[u]) * scan.size[v];
          const std::string name{high ? '+' : '-', "ijk"[axis]};
          faces[face] = {name, high ? code[axis] : opposite(code[axis]), static_cast<double>(inside) / voxels};
        }
      },
      scan.voxels);
  return faces;
}

Orientation orientation_of(const Frame& frame) {
  constexpr double kStraight = 1e-4;  // rad: headers keep six to seven digits
  std::array<Vec, 3> unit;
  for (int axis = 0; axis < 3; ++axis) unit[axis] = (1 / frame.spacing_mm(axis)) * frame.column(axis);
  const auto fit = [&](const int* world) {
    return std::abs(unit[0][world[0]]) + std::abs(unit[1][world[1]]) + std::abs(unit[2][world[2]]);
  };
  const int* best = kPermutations[0];
  for (const auto& candidate : kPermutations) {
    if (fit(candidate) > fit(best) + 1e-9) best = candidate;
  }
  Orientation orientation;
  for (int axis = 0; axis < 3; ++axis) {
    Vec along;
    along[best[axis]] = unit[axis][best[axis]] > 0 ? 1 : -1;
    orientation.code += letter(best[axis], along[best[axis]] > 0);
    orientation.oblique |= length(unit[axis] - along) > kStraight;
    orientation.sheared |= std::abs(dot(unit[axis], unit[(axis + 1) % 3])) > kStraight;
  }
  orientation.left_handed = frame.determinant_mm3() < 0;
  return orientation;
}

}  // namespace scantet
