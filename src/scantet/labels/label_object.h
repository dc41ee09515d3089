// A segmentation in memory as a domain that can be meshed.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "scantet/base/api.h"
#include "scantet/base/progress.h"
#include "scantet/base/run_account.h"
#include "scantet/domain/domain.h"
#include "scantet/domain/region_grid.h"
#include "scantet/field/scan.h"
#include "scantet/labels/label_settings.h"

namespace SCANTET_API scantet {

/// A segmentation as a domain, and what else is known of it.
struct LabelObject {
  std::unique_ptr<Domain> domain;      ///< with its junction curves and corners; null if cancelled
  std::function<RegionGrid()> grid;    ///< its voxels, for AuditOptions::grid; lives without the domain
  std::vector<PhaseAccount> phases{};  ///< what smoothing and tracing took
  std::uint64_t changed_voxels = 0;    ///< that a Gaussian gave another label
  std::vector<Region> lost{};          ///< that it left no voxel of; tissues that are nowhere the most likely
};

/// The labels of a scan, whose voxels are whole numbers (make_scan() takes them from a buffer), as regions. The voxels
/// are not needed afterwards. Throws Error: input.labels (a value is no label, all is background, or the Gaussian
/// leaves nothing). Guarantee: the outcome does not depend on the number of threads.
LabelObject make_label_object(const Scan& scan, const LabelSettings& settings, Progress& progress);

/// Tissues that are given as probabilities, one map each, all on one grid: the n-th is region n + 1, and a point
/// belongs to the one whose trilinear map is largest there; the background's probability is what they leave of 1.
/// Values must be from 0 to 1; those of 8-bit integers are 255ths, or percents if as
/// 255ths they would leave no voxel to a tissue. Throws Error: input.grid (not one grid),
/// input.probabilities (values out of range, or no tissue anywhere).
LabelObject make_tissue_object(std::span<const Scan> maps, const std::map<Region, std::string>& names,
                               Progress& progress);

}  // namespace scantet
