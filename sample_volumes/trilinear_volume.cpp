// Along a line parallel to one axis of a cell the trilinear field is linear, so the length of the line on the inside is
// exact. A cell is integrated over the other two axes with the midpoint rule, ever finer until it settles; the lines
// run along the axis on which the field changes most, where their length varies most smoothly. Cells with all corners
// on one side are exact.
#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "sample.h"

namespace samples {
namespace {

using Corners = std::array<double, 8>;  // heights above the level; bit 0 of the position is x, bit 1 y, bit 2 z

int steepest_axis(const Corners& h) {
  Vec3 change{};
  for (int c = 0; c < 8; ++c) {
    for (int axis = 0; axis < 3; ++axis) change[axis] += (c >> axis & 1) ? h[c] : -h[c];
  }
  for (double& value : change) value = std::abs(value);
  return static_cast<int>(std::max_element(change.begin(), change.end()) - change.begin());
}

// The part of [0, 1] on which the line from height a to height b is above zero.
double inside_length(double a, double b) {
  if (a > 0 && b > 0) return 1;
  if (a <= 0 && b <= 0) return 0;
  return std::max(a, b) / std::abs(a - b);
}

// Fraction of a cell on the inside, by lines^2 lines.
double inside_fraction(const Corners& h, int lines) {
  const auto above = std::count_if(h.begin(), h.end(), [](double value) { return value > 0; });
  if (above == 0 || above == 8) return above == 8 ? 1 : 0;
  const int along = 1 << steepest_axis(h);
  const int across_u = along == 1 ? 2 : 1;
  const int across_v = along == 4 ? 2 : 4;
  const auto height = [&](int end, double u, double v) {
    const double low = (1 - u) * h[end] + u * h[end | across_u];
    const double high = (1 - u) * h[end | across_v] + u * h[end | across_u | across_v];
    return (1 - v) * low + v * high;
  };
  double sum = 0;
  for (int iv = 0; iv < lines; ++iv) {
    for (int iu = 0; iu < lines; ++iu) {
      const double u = (iu + 0.5) / lines;
      const double v = (iv + 0.5) / lines;
      sum += inside_length(height(0, u, v), height(along, u, v));
    }
  }
  return sum / (static_cast<double>(lines) * lines);
}

// Doubles the lines until the fraction settles. Returns it and its last change.
std::array<double, 2> converged_fraction(const Corners& h) {
  constexpr double kSmallChange = 2e-5;  // of the cell
  constexpr int kMaxLines = 256;
  int lines = 16;
  double fraction = inside_fraction(h, lines);
  double change = 1;
  while (change > kSmallChange && lines < kMaxLines) {
    lines *= 2;
    const double finer = inside_fraction(h, lines);
    change = std::abs(finer - fraction);
    fraction = finer;
  }
  return {fraction, change};
}

}  // namespace

Volume trilinear_volume(const Sample& sample) {
  const auto [low, high] = std::minmax_element(sample.voxels.begin(), sample.voxels.end());
  const double sign = sample.inside_above ? 1 : -1;
  const double beyond = sign * ((sample.inside_above ? *low : *high) - sample.level);
  const auto& size = sample.grid.size;
  const auto height = [&](int i, int j, int k) {
    if (i < 0 || j < 0 || k < 0 || i >= size[0] || j >= size[1] || k >= size[2]) return beyond;
    return sign * (sample.voxels[(static_cast<std::size_t>(k) * size[1] + j) * size[0] + i] - sample.level);
  };
  double cells = 0;
  double error = 0;
  for (int k = -1; k < size[2]; ++k) {
    for (int j = -1; j < size[1]; ++j) {
      for (int i = -1; i < size[0]; ++i) {
        Corners h;
        for (int c = 0; c < 8; ++c) h[c] = height(i + (c & 1), j + (c >> 1 & 1), k + (c >> 2));
        const auto [fraction, change] = converged_fraction(h);
        cells += fraction;
        error += change;
      }
    }
  }
  return {cells * std::abs(sample.grid.determinant()), error / cells};
}

}  // namespace samples
