// The message gives the range of the values, as that is what a level is chosen from.
#include "scantet/field/level_settings.h"

#include <cmath>

#include "scantet/base/error.h"
#include "scantet/base/options.h"

namespace scantet {

std::string name_of(InsideSide side) {
  return side == InsideSide::above ? "above" : "below";
}

void check_level(double min_value, double max_value, const LevelSetSettings& settings) {
  const bool above = settings.inside == InsideSide::above;
  const double level = settings.level;
  const bool something_inside = above ? max_value > level : min_value < level;
  const bool something_outside = above ? min_value <= level : max_value >= level;
  if (std::isfinite(level) && something_inside && something_outside) return;
  const std::string low = number_text(min_value);
  const std::string high = number_text(max_value);
  if (min_value == max_value) {
    throw Error(Fault::input, "input.level", "level " + number_text(level) + ": every voxel has the value " + low,
                "without contrast there is no surface at any level; check that it is the right file");
  }
  const char* result = !std::isfinite(level) ? " is not a number"
                       : !something_inside   ? " leaves nothing inside"
                                             : " leaves nothing outside";
  throw Error(Fault::input, "input.level",
              "level " + number_text(level) + result + ": the values run from " + low + " to " + high +
                  " and inside is " + name_of(settings.inside) + " the level",
              "choose a level between " + low + " and " + high + "; `scantet info` suggests one");
}

}  // namespace scantet
