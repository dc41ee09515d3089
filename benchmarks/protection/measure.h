// What came of a refinement: whether the curves are in the mesh, and how good its elements are.
#pragma once

#include "refined.h"

namespace scantet::bench {

struct Figures {
  int segments = 0;       ///< of the curves
  int held = 0;           ///< of them, edges of the mesh where just the patches of the curve meet, one facet each
  int stray_edges = 0;    ///< edges where patches meet, or other than two facets do, that are no segment
  double to_curve = 0;    ///< farthest point of the mesh's curve edges from the curves, mm
  double from_curve = 0;  ///< farthest point of the curves from the mesh's curve edges, mm
  double least_dihedral = 180, largest_dihedral = 0;  ///< of tets, degrees
  int sharp = 0;                                      ///< tets with a dihedral angle under 10 degrees
  int sharp_away = 0;                                 ///< of them, those without a vertex on a curve
  double least_facet_angle = 180;
  double shortest = 0;  ///< shortest edge over the size
};

Figures measure(const Arrangement& domain, const Refined& mesh, double size_mm);

}  // namespace scantet::bench
