// A function sampled on a grid, and the domain where it is negative.
#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <vector>

#include "scantet/base/frame.h"
#include "scantet/domain/domain.h"

namespace points {

/// Values at the nodes of a cubic grid, x fastest.
struct LevelGrid {
  std::array<int, 3> size{};
  scantet::Point origin;  ///< of node (0, 0, 0), mm
  double step_mm = 0;
  std::shared_ptr<std::vector<float>> values = std::make_shared<std::vector<float>>();

  std::size_t index(int i, int j, int k) const {
    return static_cast<std::size_t>(i) +
           static_cast<std::size_t>(size[0]) * (j + static_cast<std::size_t>(size[1]) * k);
  }
  std::size_t nodes() const { return index(0, 0, size[2]); }
  scantet::Frame frame() const {
    return {{scantet::Vec{step_mm, 0, 0}, scantet::Vec{0, step_mm, 0}, scantet::Vec{0, 0, step_mm}}, origin};
  }
};

/// Whether the outermost layer of nodes has a value below zero.
bool reaches_border(const LevelGrid& grid);

/// Where the trilinear interpolant of the values is negative. Shares the values.
/// Throws scantet::Error: input.level (all values have one sign).
std::unique_ptr<scantet::Domain> make_domain(const LevelGrid& grid);

/// Gives the nodes of each component and cavity smaller than volume_mm3, but the largest component, the sign of what is
/// around them; the domain is that of the grid, and to be made anew if any was there. Return: how many there were.
std::size_t drop_specks(const scantet::Domain& domain, double volume_mm3, LevelGrid& grid);

}  // namespace points
