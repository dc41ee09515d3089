// How large a mesh will be, and what it takes, before there is one.
#pragma once

#include <optional>

#include "scantet/base/api.h"
#include "scantet/base/progress.h"
#include "scantet/domain/domain.h"
#include "scantet/domain/sizing_field.h"

namespace SCANTET_PROGRAM_API scantet {

/// What the size of a mesh follows from, for a domain and a field of sizes.
struct MeshFeatures {
  double inside = 0;  ///< cubes of the size there that fill the inside: its integral of 1/σ³
  double cubes = 0;   ///< cubes of the size that the boundary passes
  /// Places where the domain announces features that are small beside the size: how often the spacing of the sample is
  /// halved there, of each the root.
  double narrow = 0;
  double bent = 0;  ///< small cubes in which the boundary is rough (boundary_look.h)
};

/// What a mesh with such features has and takes, by coefficients that were measured (prediction_coefficients.h).
struct MeshPrediction {
  double vertices = 0;
  double tets = 0;
  double bytes = 0;        ///< of memory at the peak, beyond what is held before
  double processor_s = 0;  ///< processor time, on the machine that was measured

  /// The time on so many threads, ≥ 1, there.
  double seconds(int threads) const;
};

MeshPrediction predict(const MeshFeatures& features);

/// size, alpha: as the mesher gets them. finest_mm: spacing of the voxels, if there are any. Takes a part of a second
/// to seconds for the boundary. None if cancelled.
std::optional<MeshFeatures> find_features(const Domain& domain, const SizingField& size, double alpha,
                                          std::optional<double> finest_mm, Progress& progress);

/// The inside alone; roughly, where sizes do not vary and the domain does not know its volume: then a twentieth of its
/// bounding box stands for it. 0 is not known: of an object of unknown volume that is thin beside its box.
MeshFeatures find_inside(const Domain& domain, const SizingField& size);

}  // namespace scantet
