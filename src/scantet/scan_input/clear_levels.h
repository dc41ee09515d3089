// Levels at which a grid has saddles are moved off them.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "scantet/base/api.h"
#include "scantet/field/scan.h"
#include "scantet/field/values_at_level.h"
#include "scantet/image/nested_level_sets.h"

namespace SCANTET_API scantet {

/// As values_at_level() of some grid.
using LevelLook = std::function<ValuesAtLevel(double level, InsideSide side)>;
/// Moves levels at which there is no voxel, but saddles, to the clear ones. Return: what there is at each that was
/// asked for.
std::vector<ValuesAtLevel> clear_levels(const LevelLook& look, NestedLevelSettings& settings);
std::vector<ValuesAtLevel> clear_levels(const Scan& scan, NestedLevelSettings& settings);
/// What users should know of that. asked: the levels that were asked for.
std::vector<std::string> notes_on_levels(const std::vector<ValuesAtLevel>& at, const std::vector<double>& asked);

}  // namespace scantet
