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
inline constexpr double kMinDihedralDeg = 10;       ///< least dihedral angle of a tet
inline constexpr double kMaxDihedralDeg = 165;      ///< greatest dihedral angle of a tet
inline constexpr double kMinScaledJacobian = 0.05;  ///< least scaled Jacobian of a tet; 1 is the regular tet
inline constexpr double kMinEdgeShare =
    0.05;  ///< least edge / size; sought, and told where it is not reached, but not a bound

/// Tets with a node at each corner (four), or with one on each edge, too (ten).
enum class ElementOrder { first, second };

/// Sizes and bounds of the elements, and how far the mesh is improved for them.
struct MeshRequest {
  SizeOptions sizes;                          ///< σ
  CutOptions cut;                             ///< where the object ends flat
  MesherOptions mesher;                       ///< bounds of the refinement, and when it gives up
  Optimize optimize = Optimize::full;         ///< how the mesh is improved after refinement
  ElementOrder order = ElementOrder::first;   ///< of the mesh that comes out; measured and audited is that of order 1
  std::optional<double> min_dihedral_deg;     ///< 0 … 60; none: kMinDihedralDeg, unless nothing is optimised
  std::optional<double> max_dihedral_deg;     ///< 90 … 180; none: kMaxDihedralDeg, unless nothing is optimised
  std::optional<double> max_distance_mm;      ///< > 0, between the boundaries of mesh and object; none: no bound
  std::optional<double> min_scaled_jacobian;  ///< 0 … 0.9; none: kMinScaledJacobian, unless nothing is optimised

  /// The least length of edges: "0.2" is mm, "5%" a share of the size, up to 50%; "0": any length will do. Empty:
  /// kMinEdgeShare, unless nothing is optimised.
  std::string min_edge;

  /// What is asked of edges. size: must outlive what is returned. Return: none if nothing is asked of them. Throws
  /// Error: usage.value (min_edge cannot be read, or is too large a share).
  std::optional<EdgeTarget> edge_target(const SizingField& size) const;

  /// Sets the bounds on angles and on the scaled Jacobian that the request does not give, to the values above, unless
  /// nothing is optimised.
  void resolve_bounds();
};

}  // namespace scantet
