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
/// that order until none is broken. Between, it adds points where the topology of the boundary is not the domain's, and
/// at last lets small groups of tets change sides where points do not help (counts.repair_points, absorbed_tets).
///
/// domain, size (the paper's σ): asked from several threads at once (options.threads). progress: reported to as stages
/// "sample" and "refine", and polled. Return: with an empty mesh if cancelled, or out of budget before the rules began;
/// with the mesh by then at options.max_vertices, or out of budget later.
///
/// Throws Error: usage.option (size.min_size() or a bound is not above 0 and finite), input.empty (no line through the
/// domain's bounds crosses its boundary), usage.max_vertices (the sample of the boundary alone has more points than
/// allowed), usage.size (to look for it would take far more), input.flat (the points to start from do not span space).
///
/// Guarantees on Stop::converged: every restricted facet has its vertices on one component of the boundary, radius-edge
/// ratio ≤ facet_radius_edge (twice that with a vertex on a curve) and surface balls ≤ alpha·σ; every tet has
/// circumradius ≤ σ at its circumcentre, if size.bounds_tets(), and radius-edge ratio ≤ cell_radius_edge; of small
/// elements the ratios are ≤ small_slack times as much. With a vertex on a curve, circles and spheres are those
/// orthogonal to the balls that protect it. Exempt are facets on several components whose surface balls are under 0.001
/// alpha·σ (under 0.1 alpha·σ if the domain has curves, or once parting such components has taken more points than the
/// mesh started from), elements that no point can mend (counts.unmet), and tets that changed sides. The mesh is as
/// TetMesh promises. Same input, same mesh, bit for bit, for any number of threads. MeshResult::tangled has every
/// boundary vertex whose facets do not form a disk, a vertex of each piece that is one with another piece in the
/// domain, and a point of each component that the mesh has not; if it is empty, the boundary is a manifold and has the
/// components that the domain lists. Source: the paper, section 3; docs/algorithm.md.
MeshResult mesh_domain(const Domain& domain, const SizingField& size, const MesherOptions& options, Progress& progress);

/// Goes on from a mesh of the same domain where the size has become smaller: it starts from that mesh's points instead
/// of P_i, and these count as initial and lattice points; curves are sampled anew. options.seeding and seed are of no
/// meaning. before: only its sample, sample_dimensions and handles_left_out are used. Pre: it was not cancelled.
/// Otherwise as mesh_domain, but it throws usage.option and input.flat alone: points of `before` beyond
/// options.max_vertices are kept, and none are added to them.
MeshResult refine_further(const Domain& domain, const SizingField& size, const MesherOptions& options,
                          const MeshResult& before, Progress& progress);

}  // namespace scantet
