// The mesher: samples the inside and the boundary of a domain at the same time by Delaunay refinement.
#pragma once

#include "scantet/base/api.h"
#include "scantet/base/progress.h"
#include "scantet/domain/domain.h"
#include "scantet/domain/sizing_field.h"
#include "scantet/refine/mesh_result.h"
#include "scantet/refine/mesher_options.h"

namespace SCANTET_API scantet {

/// Meshes the domain: takes the points to start from (options.seeding), then applies the rules R1, R2, R3.1, R3.2 in
/// that order until none is broken.
///
/// size: the paper's σ. Domain and size are asked from several threads at once (options.threads). Throws Error:
/// usage.option (a bound is not positive and finite), input.empty (the domain has no boundary), usage.max_vertices,
/// usage.size (the boundary alone takes more vertices than allowed, or far more). Guarantees on Stop::converged: every
/// restricted facet has its vertices on one component of the boundary (unless components touch and its surface balls
/// are under 0.001 alpha·σ), radius-edge ratio ≤ facet_radius_edge (twice that with a vertex on a curve) and surface
/// balls ≤ alpha·σ; every tet has circumradius ≤ σ at its circumcentre, if size.bounds_tets(), and radius-edge ratio
/// ≤ cell_radius_edge. The mesh is as TetMesh promises. Same input, same mesh, bit for bit. MeshResult::tangled has
/// every boundary vertex whose facets do not form a disk, a vertex of each piece that is one with another piece in the
/// domain, and a point of each component that the mesh has not; if it is empty, the boundary is a manifold and has the
/// components that the domain lists. A cancelled run returns an empty mesh; one that has reached a limit, or is out of
/// budget, returns the mesh by then.
MeshResult mesh_domain(const Domain& domain, const SizingField& size, const MesherOptions& options, Progress& progress);

/// Goes on from a mesh of the same domain where the size has become smaller: it starts from that mesh's points instead
/// of P_i, and these count as initial and lattice points. Otherwise as mesh_domain.
MeshResult refine_further(const Domain& domain, const SizingField& size, const MesherOptions& options,
                          const MeshResult& before, Progress& progress);

}  // namespace scantet
