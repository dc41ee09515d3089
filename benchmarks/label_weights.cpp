// Each label is smoothed in the box of its voxels and what the Gaussian reaches around them. Beyond the image there are
// as many of each label as at its border.
#include "label_weights.h"

#include <algorithm>
#include <cmath>

namespace scantet::bench {
namespace {

constexpr double kReach = 4;  // in sigmas

struct IndexBox {
  std::array<int, 3> low;
  std::array<int, 3> high;  // beyond the last

  std::array<std::size_t, 3> extent() const {
    return {static_cast<std::size_t>(high[0] - low[0]), static_cast<std::size_t>(high[1] - low[1]),
            static_cast<std::size_t>(high[2] - low[2])};
  }
};

std::vector<float> gaussian(double sigma_steps) {
  const int reach = static_cast<int>(std::ceil(kReach * sigma_steps));
  std::vector<float> kernel;
  double sum = 0;
  for (int n = -reach; n <= reach; ++n) sum += std::exp(-0.5 * n * n / (sigma_steps * sigma_steps));
  for (int n = -reach; n <= reach; ++n) {
    kernel.push_back(static_cast<float>(std::exp(-0.5 * n * n / (sigma_steps * sigma_steps)) / sum));
  }
  return kernel;
}

/// Values repeat beyond the ends.
void smooth(std::vector<float>& values, const std::array<std::size_t, 3>& extent, std::size_t axis,
            const std::vector<float>& kernel) {
  const std::size_t stride = axis == 0 ? 1 : axis == 1 ? extent[0] : extent[0] * extent[1];
  const auto count = static_cast<int>(extent[axis]);
  const int reach = static_cast<int>(kernel.size() / 2);
  std::vector<float> line(extent[axis]);
  for (std::size_t first = 0; first < values.size(); ++first) {
    if (first / stride % extent[axis] != 0) continue;
    for (int i = 0; i < count; ++i)
      line[static_cast<std::size_t>(i)] = values[first + static_cast<std::size_t>(i) * stride];
    for (int i = 0; i < count; ++i) {
      float sum = 0;
      for (int n = -reach; n <= reach; ++n) {
        const int weight = n + reach;
        const int at = std::clamp(i + n, 0, count - 1);
        sum += kernel[static_cast<std::size_t>(weight)] * line[static_cast<std::size_t>(at)];
      }
      values[first + static_cast<std::size_t>(i) * stride] = sum;
    }
  }
}

}  // namespace

std::vector<std::uint8_t> label_weights(const std::vector<std::uint8_t>& labels, const std::array<int, 3>& size,
                                        const std::array<double, 3>& spacing, double sigma) {
  std::array<std::vector<float>, 3> kernels;
  for (std::size_t axis = 0; axis < 3; ++axis) kernels[axis] = gaussian(sigma / spacing[axis]);
  const auto position = [&](int i, int j, int k) {
    return (static_cast<std::size_t>(k) * static_cast<std::size_t>(size[1]) + static_cast<std::size_t>(j)) *
               static_cast<std::size_t>(size[0]) +
           static_cast<std::size_t>(i);
  };
  std::vector<IndexBox> boxes(256, IndexBox{size, {0, 0, 0}});
  for (int k = 0; k < size[2]; ++k) {
    for (int j = 0; j < size[1]; ++j) {
      for (int i = 0; i < size[0]; ++i) {
        IndexBox& box = boxes[labels[position(i, j, k)]];
        const std::array<int, 3> at{i, j, k};
        for (std::size_t axis = 0; axis < 3; ++axis) {
          const int reach = static_cast<int>(kernels[axis].size() / 2);
          box.low[axis] = std::min(box.low[axis], std::max(at[axis] - reach, 0));
          box.high[axis] = std::max(box.high[axis], std::min(at[axis] + reach + 1, size[axis]));
        }
      }
    }
  }
  std::vector<std::uint8_t> weights(labels.size(), 0);
  std::vector<float> values;
  for (std::size_t label = 0; label < boxes.size(); ++label) {
    const IndexBox& box = boxes[label];
    if (box.high[0] == 0) continue;
    values.clear();
    const auto each = [&](const auto& visit) {
      for (int k = box.low[2]; k < box.high[2]; ++k) {
        for (int j = box.low[1]; j < box.high[1]; ++j) {
          for (int i = box.low[0]; i < box.high[0]; ++i) visit(position(i, j, k));
        }
      }
    };
    each([&](std::size_t at) { values.push_back(labels[at] == label ? 255.0F : 0.0F); });
    for (std::size_t axis = 0; axis < 3; ++axis) smooth(values, box.extent(), axis, kernels[axis]);
    std::size_t next = 0;
    each([&](std::size_t at) {
      const auto value = static_cast<std::uint8_t>(std::lround(std::min(values[next++], 255.0F)));
      weights[at] = std::max(weights[at], value);
    });
  }
  return weights;
}

}  // namespace scantet::bench
