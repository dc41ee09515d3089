// From a file of points to a domain.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "normals.h"
#include "scantet/base/frame.h"
#include "scantet/domain/domain.h"

namespace points {

struct Settings {
  NormalSource normals = NormalSource::given;
  std::optional<double> grid_step_mm;  ///< default: half the average spacing of the points
};

/// How far the points are from the surface, along their normals.
struct Fit {
  std::size_t missed = 0;  ///< points without surface within two average spacings
  double median_mm = 0;    ///< of the others
  double most_mm = 0;      ///< 95 % of them are nearer
};

struct Reconstruction {
  std::unique_ptr<scantet::Domain> domain;  ///< null if cancelled
  std::size_t points = 0;                   ///< different ones
  bool estimated = false;                   ///< the normals are not from the file
  double spacing_mm = 0;                    ///< average_spacing_mm()
  std::array<int, 3> grid{};                ///< nodes along each axis
  double grid_step_mm = 0;
  std::size_t specks = 0;  ///< components and cavities dropped for being smaller than the points can tell
  Fit fit;

  /// The least size that makes sense: what is between the points is not known.
  double least_size_mm() const { return std::max(spacing_mm, 2 * grid_step_mm); }
};

/// Reads the points, settles their normals, and takes for the object where the trilinear interpolant of their Poisson
/// function, sampled on a grid, is negative.
/// Throws scantet::Error: input.points (the file, points that lie in a plane, a surface that does not close near the
/// points or passes by a quarter of them), usage.grid_step (more than kMostNodes nodes).
Reconstruction reconstruct(const std::string& file, const Settings& settings, scantet::Progress& progress);

inline constexpr double kMostNodes = 1 << 28;  // 1 GiB of values

}  // namespace points
