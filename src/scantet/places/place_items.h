// The nodes, facets and elements of a mesh that are in a place.
#pragma once

#include "scantet/base/tet_mesh.h"
#include "scantet/places/place.h"
#include "scantet/places/scan_values.h"

namespace scantet {

/// The set of what is in a place. A node is where it is; a facet or an element is where its centre is. Regions,
/// patches, curves and normals are of facets; nodes and elements that such a facet has, too, are in them.
///
/// scans: all of scans_of(named.place). mesh: its sets may be asked for by name.
/// Throws Error (usage.place): there is no region, patch, curve or set of a name; (usage.empty_set): nothing of what is
/// asked for is in the place (of all: no node is), with the item that is nearest to it and how far it is.
MeshSet items_in_place(const TetMesh& mesh, const NamedPlace& named, const ScanTable& scans);

}  // namespace scantet
