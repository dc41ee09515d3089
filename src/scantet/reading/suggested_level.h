// A level to try first.
#pragma once

#include "scantet/base/api.h"
#include "scantet/field/scan.h"

namespace SCANTET_API scantet {

/// Otsu's threshold: the level that splits the voxel values into the two groups of least variance within.
/// Return: between min_value and max_value; for integer images with one histogram bin a value, halfway between two
/// values. Otherwise off by up to one bin (ScanStatistics::histogram). Source: Otsu, A threshold selection method from
/// gray-level histograms (1979), as itk::OtsuThresholdCalculator.
double suggested_level(const Scan& scan);

}  // namespace scantet
