// The oracle: everything the mesher knows of an object. Two queries are enough (paper, section 3); the rest has
// defaults.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "scantet/base/api.h"
#include "scantet/base/geometry.h"
#include "scantet/base/stratum.h"
#include "scantet/base/triangle_surface.h"
#include "scantet/domain/component.h"
#include "scantet/domain/curve.h"

namespace SCANTET_API scantet {

class BoundaryCells;

/// A point where a segment passes from one region into another.
struct Crossing {
  Point point;                              ///< on the boundary, world mm
  Region from;                              ///< before it, along the segment
  Region to;                                ///< after it; another one
  std::array<ComponentId, 2> components{};  ///< as Patch::components

  /// The patch that the point lies on.
  Patch patch() const { return {{std::min(from, to), std::max(from, to)}, components}; }
};
using Crossings = std::vector<Crossing>;

/// The crossings of several segments, one list after the other.
class CrossingLists {
 public:
  /// Leaves no list; keeps the memory.
  void clear() {
    all_.clear();
    ends_.clear();
  }
  /// Adds a list behind the others.
  void append(const Crossings& list) {
    all_.insert(all_.end(), list.begin(), list.end());
    ends_.push_back(all_.size());
  }
  /// How many lists there are.
  std::size_t size() const { return ends_.size(); }
  /// Those of segment i, from 0 to size() - 1; valid until the next change.
  std::span<const Crossing> operator[](std::size_t i) const {
    const std::size_t begin = i == 0 ? 0 : ends_[i - 1];
    return {all_.data() + begin, ends_[i] - begin};
  }

 private:
  Crossings all_;
  std::vector<std::size_t> ends_;
};

/// A hint of how finely the boundary must be sampled, where it bends or narrows: near `point` its local feature size is
/// about `radius_mm` + the distance to `point`.
struct SizeHint {
  Point point;       ///< world mm
  double radius_mm;  ///< > 0
};

/// A segment that lies in one region wholly, where that is narrow.
struct NarrowWay {
  Region region;    ///< kOutside: the segment leads through a tunnel or a slit
  Segment segment;  ///< world mm
};

/// Whether narrow ways lead on where a domain is level, so that nothing tells which way it widens.
enum class LevelGround { ends_ways, is_crossed };

/// A place that is in one region in the domain and in another one in a mesh, where that seems to change the topology.
struct Misplaced {
  Point point;          ///< world mm
  Region region;        ///< the domain's
  std::uint32_t group;  ///< places with the same number change the topology together
};

/// Sinks are called once for each thing, never from two threads at once, but maybe from another one than the caller's.
/// What they throw comes out of the query that calls them.
using PointSink = std::function<void(const Point&)>;
using SizeHintSink = std::function<void(const SizeHint&)>;
using NarrowWaySink = std::function<void(const NarrowWay&)>;
/// Whether something is asked for at a point. Called from several threads; null: everywhere.
using PlaceFilter = std::function<bool(const Point&)>;
/// The facets of a mesh's boundary between the regions from `first` ≥ 1 on and those before, kOutside among these.
using MeshBoundary = std::function<TriangleSurface(Region first)>;

/// A bounded open subset of space, known through queries. Points and lengths are world mm. Const methods may be called
/// from many threads at once, always give the same answer to the same question, and agree with each other.
class Domain {
 public:
  virtual ~Domain() = default;

  /// A finite world box, mm, with every point outside of it, and on its faces, in kOutside.
  virtual Box bounds() const = 0;

  /// The region that contains p; kOutside outside of the domain.
  virtual Region region_at(const Point& p) const = 0;

  /// Every point where the segment, whose ends are finite, crosses the boundary, ordered from its source. `out` is
  /// overwritten (its capacity is reused, so that a query need not allocate). Guarantees: out.front().from ==
  /// region_at(source), out.back().to == region_at(target), each crossing's `from` is the `to` of the one before and
  /// differs from its own `to`; an empty answer means both ends are in one region.
  virtual void crossings(const Segment& segment, Crossings& out) const = 0;

  /// Feeds boundary points to the sink, about `spacing_mm` apart, at least one on every component of the boundary that
  /// is not much smaller than that. Always in the same order. Pre: spacing_mm > 0. Throws Error: usage.spacing (of a
  /// domain on a grid: more than 1000 points a voxel), and what the sink throws.
  /// Default: casts lines parallel to the axes through bounds(), `spacing_mm` apart, by crossings_of(), on several
  /// threads.
  virtual void surface_candidates(double spacing_mm, const PointSink& sink) const;

  /// As region_at() for many points in one call, for whoever pays dearly for each: out[i] is region_at(points[i]), both
  /// spans being equally long. Default: one by one.
  virtual void regions_at(std::span<const Point> points, std::span<Region> out) const;
  /// As crossings() for many segments in one call: out[i] are the crossings of segments[i], `out` is overwritten.
  /// Default: one by one.
  virtual void crossings_of(std::span<const Segment> segments, CrossingLists& out) const;

  /// The components of the regions and the cavities (the unbounded outside is not listed); empty if not known. A domain
  /// that lists more than one must tell their boundaries apart by the patches of its crossings.
  virtual std::vector<Component> components() const { return {}; }

  /// Where the boundary must be sampled finer than elsewhere for its topology to survive. Always in the same order.
  /// Default: nowhere.
  virtual void size_hints(const SizeHintSink&) const {}

  /// Ways along which the narrow parts of regions hang together: where a mesh has them in tets of their regions it has
  /// the handles that these parts make. Always in the same order. ground: ways across it take more points to keep, and
  /// hold more together. Default: none known.
  virtual void narrow_ways(LevelGround, const NarrowWaySink&) const {}

  /// Where a mesh seems to have another topology, group by group, always in the same order. boundary: of the mesh; may
  /// be called as often as there are regions. is_asked: whether a place may be told. Default: not known.
  virtual std::vector<Misplaced> misplaced(const MeshBoundary& /*boundary*/, const PlaceFilter& /*is_asked*/) const {
    return {};
  }

  /// The patch that p, a point on the boundary, lies on, for points that come without the crossing that they were found
  /// by; equal to that crossing's patch(). Default: the patch of a crossing of a short segment through p; not known
  /// (Patch::is_known()) if there is none.
  virtual Patch patch_at(const Point& p) const;

  /// The curves that a mesh must follow, where three or more regions meet, or edges and rims. Always in the same order;
  /// none is null; to be asked as long as the domain lives. Default: none.
  virtual std::vector<std::shared_ptr<const Curve>> curves() const { return {}; }
  /// The corners where curves end or meet. Always in the same order. Default: none.
  virtual std::vector<Corner> corners() const { return {}; }

  /// What people call a region: a segment's name, a level. Written to mesh files. Default: no name, so that files
  /// number it.
  virtual std::string name_of_region(Region) const { return {}; }
  /// What people call a patch: a face of the image, say. Its components may be left at 0. As name_of_region().
  virtual std::string name_of_patch(const Patch&) const { return {}; }

  /// How far p is off the boundary, ≥ 0, relative to the domain's own scale (image: |f(p) - level| / range of the
  /// values; labels: the difference of the two largest fields). Default: not known.
  virtual std::optional<double> residual_at(const Point&) const { return std::nullopt; }

  /// Where the boundary may be, cell by cell, so that distances to it can be bounded (domain/boundary_cells.h); it
  /// lives as long as the domain. Default: null, not known.
  virtual const BoundaryCells* boundary_cells() const { return nullptr; }
};

}  // namespace scantet
