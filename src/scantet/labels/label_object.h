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
#include "scantet/domain/facet_sizes.h"
#include "scantet/domain/region_grid.h"
#include "scantet/field/scan.h"
#include "scantet/labels/label_settings.h"

namespace SCANTET_API scantet {

/// A segmentation as a domain, and what else is known of it.
struct LabelObject {
  std::unique_ptr<Domain> domain;    ///< with its junction curves and corners; null if cancelled
  std::function<RegionGrid()> grid;  ///< finds its voxels' regions and parts at each call, for AuditOptions::grid;
                                     ///< lives without the domain; empty if cancelled
  /// Makes the object anew, its interfaces where facets of these sizes leave each region the volume of its voxels;
  /// lives without the domain; empty if nothing can be done for that (LabelField::fitted_to()), or cancelled.
  std::function<LabelObject(const FacetSizes&, Progress&)> fit{};
  /// Of what fit() has made: moves its interfaces by a little, away from junctions and from the places held, so that a
  /// mesh that follows gets the volumes of the voxels. Given: the volumes that its regions have, mm³, without those of
  /// regions that have none, and places, world mm. Lives without the domain; junctions, grid and phases are as before.
  /// An empty object if the volumes are right, or cancelled.
  std::function<LabelObject(const std::map<Region, double>&, std::span<const Point>, Progress&)> settle{};
  std::vector<PhaseAccount> phases{};  ///< what smoothing and tracing took, of the stage "read"
  std::uint64_t changed_voxels = 0;    ///< that a Gaussian gave another label
  std::vector<Region> lost{};          ///< that it left no voxel of; tissues nowhere the most likely; ascending
};

/// The labels of a scan, whose voxels are whole numbers (make_scan() takes them from a buffer), as regions. The voxels
/// are not needed afterwards.
/// scan: with its range of values; at most 65,535 labels, from 0 to 2^31 - 1, of any type of voxels. progress: is asked
/// whether to stop, and shown the tracing of junctions. Return: an empty object if progress.cancelled() became true.
/// Throws Error: input.labels (a value is no label, there are too many, label 0 finds no region, all is background, or
/// the Gaussian leaves nothing), usage.labels (a label is to become a region below 0), usage.smooth (the Gaussian is
/// as wide as the image). Guarantee: the outcome does not depend on the number of threads.
LabelObject make_label_object(const Scan& scan, const LabelSettings& settings, Progress& progress);

/// Tissues that are given as probabilities, one map each, all on one grid: the n-th, counted from 0, is region n + 1,
/// and a point belongs to the one whose trilinear map is largest there; the background's probability is what they leave
/// of 1. The voxels are not needed afterwards.
/// maps: at least one, each with its range of values. Values must be from 0 to 1; those of unsigned 8-bit integers are
/// 255ths, or if all maps are of these percents or masks, as find_map_units() has it. names: of the
/// regions; may lack any. progress, return: as of make_label_object().
/// Throws Error: input.grid (voxels are not where those of the first map are, to a thousandth of the shortest step),
/// input.probabilities (no maps, values out of range, or no tissue anywhere). Guarantee: as make_label_object().
LabelObject make_tissue_object(std::span<const Scan> maps, const std::map<Region, std::string>& names,
                               Progress& progress);

}  // namespace scantet
