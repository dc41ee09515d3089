// Meshes a domain, improves the mesh, and where that does not do, goes on at a finer size.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "scantet/base/api.h"
#include "scantet/check/conformance.h"
#include "scantet/check/distance.h"
#include "scantet/check/layers.h"
#include "scantet/check/loss_count.h"
#include "scantet/domain/sizing_field.h"
#include "scantet/optimize/optimizer.h"
#include "scantet/refine/mesher.h"

namespace SCANTET_API scantet {

/// Returns places, world mm, where a finished mesh should be finer; none: nothing is wrong with it.
using FaultSearch = std::function<std::vector<Point>(const TetMesh&, Progress&)>;

/// Returns where the boundary of a finished mesh is not like the domain's; nowhere: it is.
using LossSearch = std::function<RegionLosses(const TetMesh&)>;

/// A mesh and how it came about.
struct Meshing {
  MeshResult refined;             ///< with the improved mesh in it; seconds are of all attempts, counts of this one
  OptimizerResult optimized;      ///< no stages if nothing was improved
  std::vector<FinerPlace> finer;  ///< where the size was made finer
  Conformance conformance;  ///< the mesh against optimizer.bounds and the rules, at the size with its finer places
  double optimize_s = 0;    ///< seconds spent on improving, in all attempts
  std::vector<PhaseAccount> phases;          ///< what was spent on finding what breaks bounds, in all attempts
  std::optional<BoundaryDistance> distance;  ///< held against the limit, if one was asked for
  std::vector<Point> searched;               ///< what the search found in this mesh
  std::vector<FarPlace> lost_parts;          ///< find_lost_parts() of this mesh
  std::optional<RegionLosses> lost;          ///< what the search for losses found in it, if it was asked
  /// count_losses() of it, where it is improved and no search for losses was asked.
  std::optional<LossCount> loss_count;
  std::optional<LayerCheck> layers;      ///< across parts, where settle_volumes() counted them
  std::vector<std::uint32_t> crossings;  ///< facets that cross, before short edges go
  std::size_t first_points = 0;          ///< vertices of the first attempt
};

/// Meshes the domain and improves the mesh. With Optimize::full, the size is made finer where elements break bounds,
/// boundary facets cross, or the boundary is not like the domain's (MeshResult::tangled, wrong_handles), as long as
/// there are such spots and they are few (TroubleSpots); parts that the mesh has nothing of get points
/// (points_on_parts()). Meshing then goes on from the first mesh's points (with a search, from the last one's), up to
/// eight times (sixteen if the domain has curves), or until three attempts in a row were in vain, or one that left
/// hardly fewer of over a hundred spots, or more than twice the least; then once more, with what was best at each spot.
/// Where the first mesh leaves handles out (MeshResult::handles_left_out), they are given more points once before it is
/// improved, and those are kept if few handles stay wrong. Of each mesh and the best one before it, what is right in
/// one of them alone is taken together, if that leaves less wrong (best_of_both()). Where losses are searched for, what
/// is good of the best mesh is kept in the next one (keep_best()), which takes up the ways that they come with, and
/// with many losses the next ones are not improved as long as each leaves far fewer. The attempt counts that leaves the
/// fewest losses, and of those the one with the fewest spots. None follows one that a limit ended or whose refinement
/// was beyond mending.
///
/// size: not null. optimizer: bounds.rules are set from `mesher` and the size; bounds.min_edge is sought on the mesh
/// that counts. max_distance_mm: > 0; bounds mesher.bounds.facet_distance_mm, too, and where the boundaries of mesh and
/// domain are farther from each other, or not proved to be nearer, points of the domain's boundary are added, up to
/// eight times, before the mesh is improved. search: what it finds is a fault, too, however much it is; meshing then
/// goes on up to twelve times; empty: none. losses: with Optimize::full, what it finds stands for
/// MeshResult::tangled; empty: none. domain, size: asked from several threads at once. Refinement runs on
/// mesher.threads, the rest on the threads that with_threads() gives. Return: empty if cancelled. If out of budget:
/// what there is by then; empty if there is no mesh. A mesh without tets if none of that size fits into the domain.
/// Throws Error: as mesh_domain() and optimize_mesh() do; input.flat (the boundary's points do not span space).
std::optional<Meshing> mesh_and_optimize(const Domain& domain, const std::shared_ptr<const SizingField>& size,
                                         const MesherOptions& mesher, const OptimizerOptions& optimizer,
                                         Progress& progress, std::optional<double> max_distance_mm = std::nullopt,
                                         const FaultSearch& search = {}, const LossSearch& losses = {});

}  // namespace scantet
