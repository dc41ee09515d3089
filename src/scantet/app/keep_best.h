// What is good of one attempt at a mesh is kept in the next one.
#pragma once

#include "scantet/app/meshing.h"

namespace scantet {

/// Improvement has other luck wherever it starts anew. So of another mesh of the same domain only what is near other
/// sizes than those of the best one (Meshing::finer), or near what is wrong with that, is put into it (graft()): what
/// is nearer than twice the size, or five times if with that handles are missing. Where they always are, nothing is.
///
/// size: that was asked for. meshing: refinement ended by itself; gets the mesh, and what is known of its handles.
/// Return: whether it has; else it is as before.
bool keep_best(const Meshing& best, const Domain& domain, const SizingField& size, Meshing& meshing);

}  // namespace scantet
