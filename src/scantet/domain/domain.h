// The oracle: everything the mesher knows of an object. Two queries are enough (paper, section 3); the rest has
// defaults.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "scantet/base/geometry.h"
#include "scantet/base/tet_mesh.h"

namespace scantet {

/// A point where a segment passes from one region into another.
struct Crossing {
  Point point;  ///< on the boundary, world mm
  Region from;
  Region to;
};
using Crossings = std::vector<Crossing>;

/// Names a connected component of the domain's boundary; equal ids mean the same component.
using BoundaryId = std::uint64_t;

/// A connected component of a region, or a cavity in the inside: what must be found again in the mesh.
struct Component {
  Region region = kOutside;     ///< kOutside for a cavity
  Point witness;                ///< a point in it, world mm
  Box box_mm;                   ///< encloses it, up to one grid step
  double volume_mm3 = 0;        ///< approximate (a count of grid nodes); 0 if unknown
  bool touches_border = false;  ///< reaches the border of the image
};

/// Components that the user asked to leave out of a domain. Those of region n > 1 are islands in region n - 1, which
/// takes them in.
struct DroppedComponents {
  std::size_t found = 0;              ///< components before any was dropped, of all regions
  std::vector<Component> components;  ///< those dropped, largest first

  /// Of all that were dropped together.
  double volume_mm3() const {
    double sum = 0;
    for (const Component& component : components) sum += component.volume_mm3;
    return sum;
  }
};

/// A place where the boundary bends or narrows: near `point` its local feature size is about
/// `radius_mm` + the distance to `point`.
struct Feature {
  Point point;
  double radius_mm;
};

using PointSink = std::function<void(const Point&)>;
using FeatureSink = std::function<void(const Feature&)>;

/// A bounded open subset of space, known through queries. Const methods may be called from many threads at once, always
/// give the same answer to the same question, and agree with each other.
class Domain {
 public:
  virtual ~Domain() = default;

  /// A finite world box, mm, with every point outside of it in kOutside.
  virtual Box bounds() const = 0;

  /// The region that contains p; kOutside outside of the domain.
  virtual Region region_at(const Point& p) const = 0;

  /// Every point where the segment, whose ends are finite, crosses the boundary, ordered from its source. `out` is
  /// overwritten (its capacity is reused, so that a query need not allocate). Guarantees: out.front().from ==
  /// region_at(source), out.back().to == region_at(target), each crossing's `from` is the `to` of the one before and
  /// differs from its own `to`; an empty answer means both ends are in one region.
  virtual void crossings(const Segment& segment, Crossings& out) const = 0;

  /// Feeds boundary points to the sink, about `spacing_mm` apart, at least one on every component of the boundary that
  /// is not much smaller than that. Always in the same order.
  /// Default: casts lines parallel to the axes through bounds(), `spacing_mm` apart, with the two queries alone.
  virtual void surface_candidates(double spacing_mm, const PointSink& sink) const;

  /// The components of the regions and the cavities (the unbounded outside is not listed); empty if not known. A domain
  /// that lists more than one must tell their boundaries apart by boundary_at.
  virtual std::vector<Component> components() const { return {}; }

  /// Where the boundary must be sampled finer than elsewhere for its topology to survive. Default: nowhere.
  virtual void features(const FeatureSink&) const {}

  /// The component of the boundary that p, a point on it, belongs to. Default: cannot tell, one id for all.
  virtual BoundaryId boundary_at(const Point&) const { return 0; }

  /// How far p is off the boundary, relative to the domain's own scale (image: |f(p) - level| / range of the values).
  /// Default: not known.
  virtual std::optional<double> residual_at(const Point&) const { return std::nullopt; }
};

}  // namespace scantet
