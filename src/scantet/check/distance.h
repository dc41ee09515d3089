// How far the boundary of a mesh and that of its domain are from each other.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "scantet/base/api.h"
#include "scantet/base/tet_mesh.h"
#include "scantet/domain/domain.h"
#include "scantet/domain/sizing_field.h"

namespace SCANTET_API scantet {

/// A point of one boundary, and how far it is from the other.
struct FarPlace {
  Point point;             ///< world mm
  Point nearest;           ///< of the other boundary, as near as was found; `point` itself if nothing was measured
  double distance_mm = 0;  ///< of `point` from the other boundary, at least; proved where OneWayDistance::upper_mm is

  friend bool operator==(const FarPlace&, const FarPlace&) = default;
};

/// How far the points of one boundary are from the other one.
struct OneWayDistance {
  double lower_mm = 0;             ///< worst.front() is that far from the other boundary; 0 if there is no point
  std::optional<double> upper_mm;  ///< no point is farther; none: only points were measured
  std::uint64_t points = 0;        ///< that were measured
  std::uint64_t parts = 0;         ///< cells or facets that were bounded, or points
  std::vector<FarPlace> worst;     ///< the farthest points that were found, ten at most and apart; farthest first
  std::vector<FarPlace> beyond;    ///< a point for each cell, facet or point that is not proved to keep the limit
  std::uint64_t undecided = 0;     ///< of those in `beyond`: not proved to break it either
  /// With DistanceOptions::size, of the way to the mesh: the points that are found to be farther than kFarInSizes times
  /// the size there, apart from each other, at most a thousand; farthest first.
  std::vector<FarPlace> far;

  friend bool operator==(const OneWayDistance&, const OneWayDistance&) = default;
};

/// Both ways; the greater one is the Hausdorff distance of the two boundaries.
struct BoundaryDistance {
  OneWayDistance to_mesh;          ///< from the domain's boundary to the mesh's
  OneWayDistance to_domain;        ///< from the mesh's boundary to the domain's
  std::optional<double> limit_mm;  ///< that was asked for; none of a mesh without facets

  /// Whether both ways are bounded, not only measured at points.
  bool proved() const { return to_mesh.upper_mm && to_domain.upper_mm; }
  friend bool operator==(const BoundaryDistance&, const BoundaryDistance&) = default;
};

/// Whether one of the two boundaries has more beyond the limit than before.
inline bool is_farther(const BoundaryDistance& now, const BoundaryDistance& before) {
  return now.to_mesh.beyond.size() > before.to_mesh.beyond.size() ||
         now.to_domain.beyond.size() > before.to_domain.beyond.size();
}

/// What is farther from the mesh than so many times the size is not in it; a sphere's facets are at a small share.
constexpr double kFarInSizes = 2;

/// How exact a measure is to be.
struct DistanceOptions {
  std::optional<double> limit_mm;  ///< > 0; every cell and facet is held against it, as close as need be; or none
  double tolerance = 0.25;  ///< > 0; upper bounds are at most this share more than the lower ones, where they can
  const SizingField* size = nullptr;  ///< that the mesh was made with; not kept; null: no places are far
};

/// Measures the distance between the boundaries of a mesh and its domain.
///
/// With Domain::boundary_cells() both ways are bounded, surface by surface, each from the facets that stand for it:
/// boxes that may hold the domain's boundary are divided until they are proved near enough or are 1/16 of a cell (1/256
/// where that leaves the limit open), facets until their parts are 1/25 of the bound aimed at; lower bounds are true of
/// a point that was found. Proofs are up to rounding (some ulps of a coordinate). Else points are measured: the lower
/// bound of to_mesh is true, that of to_domain comes from crossings along the facets' normals and may be too great. Of
/// a mesh without facets nothing is measured.
///
/// domain, options.size: asked from several threads at once. Pre: as TetMesh promises. Guarantees: does not depend on
/// the number of threads.
BoundaryDistance measure_distance(const TetMesh& mesh, const Domain& domain, const DistanceOptions& options = {});

/// Measures the meshes of one domain, one after the other, against a limit. What one of them has in common with the one
/// before is not bounded anew: the answers are as true as those of measure_distance(), but other points may be
/// measured.
class DistanceMeter {
 public:
  /// domain: outlives it. limit_mm: > 0.
  DistanceMeter(const Domain& domain, double limit_mm);
  ~DistanceMeter();
  DistanceMeter(const DistanceMeter&) = delete;
  DistanceMeter& operator=(const DistanceMeter&) = delete;

  /// As measure_distance(). size: as DistanceOptions::size.
  BoundaryDistance measure(const TetMesh& mesh, const SizingField* size = nullptr);

 private:
  friend BoundaryDistance measure_distance(const TetMesh& mesh, const Domain& domain, const DistanceOptions& options);
  class Impl;
  std::unique_ptr<Impl> impl_;
  double limit_mm_;
};

}  // namespace scantet
