// A synthetic scan in memory: what make_samples writes, checks and tabulates.
//
// This program owes nothing to the scantet library: its volumes are a second opinion on the library's.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace samples {

using Vec3 = std::array<double, 3>;

enum class Pixel { uint8, int8, uint16, int16, float32 };

/// An affine grid: voxel (i, j, k) is at origin + i·columns[0] + j·columns[1] + k·columns[2], mm, LPS.
struct Grid {
  std::array<int, 3> size{};
  std::array<Vec3, 3> columns{};
  Vec3 origin{};

  Vec3 to_world(double i, double j, double k) const;
  /// Signed volume of a voxel, mm³.
  double determinant() const;
  std::size_t voxel_count() const { return static_cast<std::size_t>(size[0]) * size[1] * size[2]; }
};

/// One scan and what is known of its level set.
struct Sample {
  std::vector<std::string> files;  ///< the same scan in one or more formats, told by the extension
  Pixel pixel = Pixel::float32;
  Grid grid;
  std::vector<double> voxels;  ///< x fastest, each exactly representable in `pixel`, none equal to `level`
  double level = 0;
  bool inside_above = true;
  int components = 1;
  int cavities = 0;
  int euler = 2;  ///< of the boundary: the sum of 2 - 2·genus over its surfaces
  std::string what;
};

/// All samples, in the order of the table.
std::vector<Sample> all_samples();

/// A segmentation and what is known of its labels.
struct LabelMap {
  struct Row {
    int label;
    int voxels;
    double volume_mm3;  ///< of what it stands for in truth
    std::string what;
  };
  Sample scan;  ///< its level and topology mean nothing
  std::vector<Row> rows;
};

/// All segmentations, in the order of their table.
std::vector<LabelMap> all_label_maps();

/// A volume by quadrature, and how much of it the last refinement of the quadrature changed.
struct Volume {
  double mm3 = 0;
  double relative_change = 0;
};

/// Volume of the inside of the sample's trilinear level set. The field goes on for one voxel beyond the outermost voxel
/// centres, to the scan's smallest value (its largest, if the inside is below the level).
Volume trilinear_volume(const Sample& sample);

}  // namespace samples
