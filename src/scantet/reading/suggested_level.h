// A level to try first.
#pragma once

#include "scantet/base/api.h"
#include "scantet/field/scan.h"

namespace SCANTET_API scantet {

/// Otsu's threshold: the level that splits the voxel values into the two groups of least variance within. Looks at
/// every voxel once. scan: of more than one value. Return: between min_value and max_value; of integers that span less
/// than 65,536, halfway between two values that there are. Otherwise off by up to a 65,536th of the range. Source:
/// Otsu, A threshold selection method from gray-level histograms (1979), as itk::OtsuThresholdCalculator.
double suggested_level(const Scan& scan);

}  // namespace scantet
