// What is good of one attempt at a mesh is kept in the next one.
#pragma once

#include "scantet/app/meshing.h"

namespace scantet {

/// Improvement has other luck wherever it starts anew. So of another mesh of the same domain only what is nearer than
/// twice the size to other sizes than those of the best one (Meshing::finer), or to what is wrong with that, is put
/// into it (graft()). What MeshResult says of the boundary's topology stays that of the other mesh.
///
/// size: that was asked for. meshing: refinement ended by itself. Return: whether its mesh is such a one now; else it
/// is as before.
bool keep_best(const Meshing& best, const Domain& domain, const SizingField& size, Meshing& meshing);

}  // namespace scantet
