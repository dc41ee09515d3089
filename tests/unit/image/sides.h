// Short names for the sides of a level.
#pragma once

#include "scantet/field/level_settings.h"

namespace scantet::test {

inline constexpr InsideSide kAbove = InsideSide::above;
inline constexpr InsideSide kBelow = InsideSide::below;

}  // namespace scantet::test
