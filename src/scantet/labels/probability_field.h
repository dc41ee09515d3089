// The fields of tissues that are given as probabilities.
#pragma once

#include <memory>
#include <span>

#include "scantet/base/progress.h"
#include "scantet/field/scan.h"
#include "scantet/labels/label_field.h"

namespace scantet {

/// Whether maps of 8-bit integers are percents and no 255ths: nowhere do they come to more than 127 together, so that
/// as 255ths they would leave no voxel to a tissue.
bool are_percents(std::span<const Scan> maps);

/// One map a tissue, on one grid: the n-th is region n + 1, and a point belongs to the one whose map is largest there;
/// the background's probability is what they leave of 1. Values must be from 0 to 1; those of 8-bit integers are taken
/// for 255ths, or for percents (are_percents()). Throws Error: input.grid (the maps are not on one grid: says which),
/// input.probabilities (a value is out of that range, or no voxel has a tissue). Null if progress.cancelled() became
/// true.
std::shared_ptr<const LabelField> make_probability_field(std::span<const Scan> maps, const Progress& progress);

}  // namespace scantet
