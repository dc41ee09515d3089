// Which level set of a field is meant.
#pragma once

#include <optional>
#include <string>

#include "scantet/base/api.h"

namespace SCANTET_API scantet {

/// On which side of the level the inside is.
enum class InsideSide { above, below };

/// "above" or "below".
std::string name_of(InsideSide side);

/// Which level set, and how it closes at the border of the image.
struct LevelSetSettings {
  double level = 0;                       ///< in the units of the voxel values
  InsideSide inside = InsideSide::above;  ///< inside is value > level, or value < level
  /// Value of the field one voxel beyond the outermost voxel centres; must be on the outside of the level or at it, and
  /// at most 1000 times the range of the values off it. None: the smallest value of the scan (the largest with
  /// InsideSide::below).
  std::optional<double> outside{};
};

/// Checks that the level parts values that run from min_value to max_value; settings.outside is not looked at. Throws
/// Error: input.level (nothing or everything is inside, or the level is not finite: the message gives the range).
void check_level(double min_value, double max_value, const LevelSetSettings& settings);

}  // namespace scantet
