// What is asked of a mesh, whatever it is of.
#pragma once

#include <optional>
#include <string>

#include "scantet/app/cut_options.h"
#include "scantet/base/api.h"
#include "scantet/optimize/optimizer.h"
#include "scantet/refine/mesher_options.h"
#include "scantet/size_options/size_options.h"

namespace SCANTET_API scantet {

// Asked for when the request does not say, unless nothing is optimised:
inline constexpr double kMinDihedralDeg = 10;
inline constexpr double kMaxDihedralDeg = 165;
inline constexpr double kMinScaledJacobian = 0.05;
inline constexpr double kMinEdgeShare =
    0.05;  ///< of the size; sought, and told where it is not reached, but not a bound

/// Elements with a node at each corner, or with one on each edge, too.
enum class ElementOrder { first, second };

/// Sizes and bounds of the elements, and how far the mesh is improved for them.
struct MeshRequest {
  SizeOptions sizes;                          ///< σ
  CutOptions cut;                             ///< where the object ends flat
  MesherOptions mesher;                       ///< bounds of the refinement, and when it gives up
  Optimize optimize = Optimize::full;         ///< how the mesh is improved after refinement
  ElementOrder order = ElementOrder::first;   ///< of the mesh that comes out; measured and audited is that of order 1
  std::optional<double> min_dihedral_deg;     ///< none: kMinDihedralDeg, unless nothing is optimised
  std::optional<double> max_dihedral_deg;     ///< none: kMaxDihedralDeg, unless nothing is optimised
  std::optional<double> max_distance_mm;      ///< between the boundaries of the mesh and the object; none: no bound
  std::optional<double> min_scaled_jacobian;  ///< none: kMinScaledJacobian, unless nothing is optimised

  /// The least length of edges: "0.2" is mm, "5%" a share of the size; "0": any length will do. Empty: kMinEdgeShare,
  /// unless nothing is optimised.
  std::string min_edge;

  /// What is asked of edges, of a size that outlives the target; none: nothing.
  std::optional<EdgeTarget> edge_target(const SizingField& size) const;

  /// Gives the bounds on elements that the request does not say their values, unless nothing is optimised.
  void resolve_bounds();
};

}  // namespace scantet
