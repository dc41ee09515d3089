// Private to check/: the two ways of measuring distances.
#pragma once

#include <vector>

#include "scantet/check/distance.h"
#include "scantet/check/facet_tree_impl.h"
#include "scantet/domain/boundary_cells.h"

namespace scantet::measuring {

class SurfaceMemory;

/// What is asked of each part of a boundary: an upper bound that is no more than this.
class Aim {
 public:
  /// known_mm: a lower bound of the whole.
  Aim(const DistanceOptions& options, double known_mm) : options_(options), known_mm_(known_mm) {}
  /// For a part that has a point so far away.
  double of(double lower_mm) const {
    const double aim = (1 + options_.tolerance) * std::max(known_mm_, lower_mm);
    return options_.limit_mm && lower_mm <= *options_.limit_mm ? std::min(aim, *options_.limit_mm) : aim;
  }
  const std::optional<double>& limit_mm() const { return options_.limit_mm; }

 private:
  DistanceOptions options_;
  double known_mm_;
};

/// What was found out about a part of a boundary.
struct PartBounds {
  FarPlace farthest;
  bool measured = false;  ///< whether `farthest` was
  double upper_mm = 0;
  std::uint64_t points = 0;

  void take(const FarPlace& place) {
    ++points;
    if (!measured || place.distance_mm > farthest.distance_mm) farthest = place;
    measured = true;
  }
};

/// Sums up parts.
class Gathering {
 public:
  explicit Gathering(const DistanceOptions& options) : limit_mm_(options.limit_mm), size_(options.size) {}
  /// somewhere: a point of the part, if none was measured.
  void add(const PartBounds& part, const Point& somewhere);
  /// Whether a point so far away may be one of OneWayDistance::far.
  bool may_be_far(double distance_mm) const {
    return size_ != nullptr && distance_mm > kFarInSizes * size_->min_size();
  }
  /// Lists the place as far, if it is.
  void add_if_far(const FarPlace& place);
  /// A point beside the parts.
  void add_measured(const FarPlace& place) { keep(place); }
  void add(const Gathering& later);
  /// bounded: whether upper bounds are true.
  OneWayDistance result(bool bounded) const;

 private:
  void keep(const FarPlace& place);

  std::optional<double> limit_mm_;
  const SizingField* size_;
  OneWayDistance sum_;
  double upper_mm_ = 0;
};

/// Facets of a mesh that stand for a surface; all, if there are none.
std::vector<std::uint32_t> facets_of(const TetMesh& mesh, std::size_t surface);

/// From the domain's boundary to the mesh's. memory, here and below: for each surface, begun with the mesh.
OneWayDistance distance_to_mesh(const TetMesh& mesh, const BoundaryCells& cells, const DistanceOptions& options,
                                std::vector<SurfaceMemory>& memory);
/// From the mesh's boundary to the domain's.
OneWayDistance distance_to_domain(const TetMesh& mesh, const Domain& domain, const BoundaryCells& cells,
                                  const DistanceOptions& options, std::vector<SurfaceMemory>& memory);
/// From the boundary of one mesh to that of another. facets_off_mm: gets for each facet of `from` the distance of its
/// farthest corner.
OneWayDistance distance_between(const TetMesh& from, const FacetTree& to, const DistanceOptions& options,
                                std::vector<double>& facets_off_mm);
/// Points of the domain's boundary as far apart as the mesh's facets are wide; none of a mesh without area.
std::vector<Point> boundary_samples(const TetMesh& mesh, const Domain& domain);
/// Both, of points alone.
BoundaryDistance sampled_distance(const TetMesh& mesh, const Domain& domain, const DistanceOptions& options);

}  // namespace scantet::measuring
