// What is done to a mesh after refinement: its worst tets are made better, its boundary stays on the domain's.
#pragma once

#include <vector>

#include "scantet/base/api.h"
#include "scantet/base/progress.h"
#include "scantet/base/run_account.h"
#include "scantet/base/tet_mesh.h"
#include "scantet/domain/domain.h"
#include "scantet/optimize/element_bounds.h"

namespace SCANTET_API scantet {

/// How far the mesh is improved after refinement.
enum class Optimize {
  none,   ///< not at all
  exude,  ///< slivers are exuded by weights (paper, section 7.2, reference [8]); no vertex moves
  full    ///< reconnected, smoothed, vertices taken away or added, until all elements are within the bounds
};

/// How much is done about elements that a first pass of improvement leaves out of bounds.
enum class Persistence {
  once,    ///< nothing
  deep,    ///< remedies are searched for at length; what very few are left then, in a mesh with curves few, are shaken
  shaking  ///< a few in any mesh; takes seconds
};

/// How far a mesh is improved, and when that is enough.
struct OptimizerOptions {
  Optimize optimize = Optimize::full;
  ElementBounds bounds;            ///< work stops where all elements keep them
  bool facets_keep_rules = false;  ///< known: no boundary facet breaks R1 or R2, so none is looked for
  std::vector<Box> held{};         ///< world mm; vertices in these are not taken away for the sake of short edges
  Persistence persistence = Persistence::deep;
};

/// What the improvement did.
struct OptimizerResult {
  std::vector<OptimizerStage> stages;  ///< in order; none where there was nothing to do
  double min_dihedral_deg = 0;         ///< of the mesh in the end; 0 if it has no tets
  bool cancelled = false;              ///< whether progress.cancelled() had become true in the end
};

/// Improves the mesh in place until every element keeps options.bounds, or no operation helps. What breaks a bound is
/// changed only for what breaks the bounds by less (of several elements the worst counts), so bounds that all elements
/// keep are kept. Exudation leaves boundary facets as they are. What is asked of edges comes last and gives way to the
/// rest.
///
/// domain: what the mesh was made from; asked from several threads at once. On the threads of base/parallel.h.
/// Pre: the mesh is as TetMesh promises, of first order, and has no sets, fields and materials yet, which are not
/// carried on; vertices of boundary facets lie on the domain's boundary.
/// Throws Error: usage.option (a bound out of its range).
/// Guarantees: every tet stays positively oriented; the boundary keeps its Euler number, its components and whether it
/// is manifold; a boundary vertex that moves is put on the domain's boundary again, on the same component of it; the
/// share that the worst element has of what is asked of it never falls; the result does not depend on the number of
/// threads. Cancelled: the mesh is valid, as far as it got.
OptimizerResult optimize_mesh(TetMesh& mesh, const Domain& domain, const OptimizerOptions& options, Progress& progress);

/// The last part of optimize_mesh() by itself: with Optimize::full, vertices are taken away where edges are shorter
/// than options.bounds.min_edge, as far as all elements around them keep the other bounds; else nothing is done. Mesh,
/// domain, errors, guarantees and what becomes of the mesh when cancelled: as of optimize_mesh().
/// result: if there are such edges, a stage is added and min_dihedral_deg set; else, and in `cancelled`, it stays as it
/// is.
void contract_short_edges(TetMesh& mesh, const Domain& domain, const OptimizerOptions& options, Progress& progress,
                          OptimizerResult& result);

}  // namespace scantet
