// What is done once in each attempt at a mesh.
#pragma once

#include <memory>
#include <optional>

#include "scantet/app/meshing.h"

namespace scantet {

/// mesh_domain(), or refine_further() if there is a mesh before. Return: empty if cancelled.
std::optional<MeshResult> mesh_or_cancel(const Domain& domain, const SizingField& size, const MesherOptions& options,
                                         const MeshResult* before, Progress& progress);

/// Of a mesh, what another one goes on from.
MeshResult points_of(const MeshResult& mesh);

/// The options with more points for handles; where these are too few, a few wrong handles are mended without ways.
MesherOptions with_handles(const MesherOptions& options);
/// Whether that was worth it.
bool keeps_most_handles(const MeshResult& mesh);

/// The options with the rules' bounds for that size.
OptimizerOptions with_rules(const OptimizerOptions& options, const Domain& domain, const MesherOptions& mesher,
                            const SizingField& size);

/// optimize_mesh() at the size asked for, finer where Meshing::finer says; edges may stay short. is_mixed: of two
/// meshes. Return: whether it was not cancelled.
bool improve(const Domain& domain, const std::shared_ptr<const SizingField>& size_asked, const MesherOptions& mesher,
             const OptimizerOptions& optimizer, bool is_mixed, Progress& progress, Meshing& meshing);

/// lengthen_short_edges(), but edges stay short if the search finds more without them. meter: null if there is no
/// limit.
void contract_unless_found(const Domain& domain, const SizingField& size, const MesherOptions& mesher,
                           const OptimizerOptions& optimizer, const FaultSearch& search, const LossSearch& losses,
                           DistanceMeter* meter, Progress& progress, Meshing& meshing);

}  // namespace scantet
