// A segment is cut to the stretch that the planes leave of it; its ends there are put on the planes, exactly, before
// the inner domain is asked about what is between, so that the answer fits the regions at both ends.
//
// Why caps on the border of a grid do not change topology: between the outermost voxel centres and one voxel beyond,
// the field is linear along the grid's axis, from a value on the border to one that is outside. So what is inside there
// gets narrower outwards, and shrinks onto the border along straight lines, which is what cutting it off does, too. Of
// several regions inside each other that is not true: an inner one that comes to the border is wrapped up beyond.
#include "scantet/cuts/cut_domain.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

#include "scantet/base/error.h"
#include "scantet/base/parallel.h"
#include "scantet/cuts/cut_space.h"
#include "scantet/cuts/plane_axes.h"
#include "scantet/cuts/plane_contact.h"
#include "scantet/cuts/rims.h"
#include "scantet/domain/known_components.h"
#include "scantet/domain/patch_pieces.h"

namespace scantet {
namespace {

constexpr ComponentId kFirstCap = 0x80000000;      // numbers of caps, which are no components'
constexpr ComponentId kBehindCap = kFirstCap - 1;  // the component behind a cap, where it is not told which
constexpr double kOnPlane = 1e-11;                 // of the domain's scale: a point so near is on the plane
constexpr double kStandOff = 1e-10;                // of that scale: a plane moves so far off what lies in it
constexpr double kMargin = 1e-3;                   // of the box's diagonal, around what is left
constexpr std::size_t kCoarseLook = 100;           // points along the diagonal, to see whether something is left

class CutDomain final : public Domain, public KnownComponents, public PatchPieces {
 public:
  CutDomain(std::unique_ptr<Domain> inner, std::vector<CutPlane> planes, double step_mm, double spacing_mm)
      : inner_(std::move(inner)),
        planes_(std::move(planes)),
        space_{*inner_, planes_, inner_->bounds(), step_mm},
        spacing_mm_(spacing_mm) {
    double farthest = space_.box.diagonal();
    for (int axis = 0; axis < 3; ++axis) {
      farthest = std::max({farthest, std::abs(space_.box.min[axis]), std::abs(space_.box.max[axis])});
    }
    on_plane_mm_ = kOnPlane * farthest;
    for (std::size_t k = 0; k < planes_.size(); ++k) {
      if (!planes_[k].is_border() && touches_boundary(space_, k, 2 * on_plane_mm_)) {
        planes_[k].offset_mm -= kStandOff * farthest;
      }
    }
    find_box();
    find_components();
  }

  /// Finds the curves.
  CutReport trace() {
    CutReport report;
    report.uncounted = cut_components_;
    report.counted = known_.size();
    const std::vector<CutLine> lines = find_cut_lines(space_, cut_);
    const std::vector<CurveHit> hits = clip_curves(space_, cut_);
    for (std::size_t k = 0; k < planes_.size(); ++k) {
      const PlaneRims rims = find_rims(space_, k, lines, hits, cut_);
      report.meets.push_back(rims.meets_inside);
      report.unsettled += rims.unsettled;
    }
    return report;
  }

  /// Whether there is a part of the inner boundary that is not cut off.
  bool keeps_boundary() const {
    bool keeps = false;
    inner_->surface_candidates(space_.box.diagonal() / kCoarseLook,
                               [&](const Point& p) { keeps = keeps || space_.keeps(p); });
    return keeps;
  }

  Box bounds() const override { return box_; }

  Region region_at(const Point& p) const override { return space_.keeps(p) ? inner_->region_at(p) : kOutside; }

  void regions_at(std::span<const Point> points, std::span<Region> out) const override {
    inner_->regions_at(points, out);
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (!space_.keeps(points[i])) out[i] = kOutside;
    }
  }

  void crossings(const Segment& segment, Crossings& out) const override;
  void surface_candidates(double spacing_mm, const PointSink& sink) const override;

  std::vector<Component> components() const override {
    return cut_components_ == 0 ? known_ : std::vector<Component>();
  }
  std::vector<Component> known_components() const override { return known_; }
  void size_hints(const SizeHintSink& sink) const override {
    inner_->size_hints([&](const SizeHint& hint) {
      if (space_.keeps(hint.point)) sink(hint);
    });
  }
  void narrow_ways(LevelGround ground, const NarrowWaySink& sink) const override {
    inner_->narrow_ways(ground, [&](const NarrowWay& way) {
      if (space_.keeps(way.segment.source) && space_.keeps(way.segment.target)) sink(way);
    });
  }
  std::vector<Misplaced> misplaced(const MeshBoundary& boundary, const PlaceFilter& is_asked) const override;

  Patch patch_at(const Point& p) const override {
    const std::optional<std::size_t> plane = plane_at(p);
    const Region region = plane ? inner_->region_at(p) : kOutside;
    return region == kOutside ? inner_->patch_at(p) : Patch{{kOutside, region}, cap_components(*plane, p, region)};
  }

  std::vector<std::shared_ptr<const Curve>> curves() const override { return cut_.curves; }
  std::vector<Corner> corners() const override { return cut_.corners; }

  std::string name_of_region(Region region) const override { return inner_->name_of_region(region); }
  std::string name_of_patch(const Patch& patch) const override {
    const ComponentId cap = patch.components[0];
    if (patch.regions[0] != kOutside || cap < kFirstCap) return inner_->name_of_patch(patch);
    return planes_[cap - kFirstCap].name;
  }

  std::optional<double> residual_at(const Point& p) const override;

  std::size_t piece_of(const std::array<Point, 3>& facet) const override {
    for (std::size_t k = 0; k < planes_.size(); ++k) {
      const auto is_on = [&](const Point& p) { return std::abs(planes_[k].beyond_mm(p)) <= on_plane_mm_; };
      if (std::all_of(facet.begin(), facet.end(), is_on)) return k + 1;
    }
    return 0;
  }
  std::string name_of_piece(std::size_t piece) const override { return planes_[piece - 1].name; }

 private:
  void find_box();
  /// What becomes of a component.
  enum class Fate {
    kept,    ///< whole, but for what the border's planes take away
    gone,    ///< beyond a plane
    unknown  ///< it may be cut
  };
  void find_components();
  Fate fate_of(const Component& component, bool is_one_region) const;
  Point inward(Point p, Region region) const;

  /// The plane that p, which no other one takes away, lies on.
  std::optional<std::size_t> plane_at(const Point& p) const {
    std::optional<std::size_t> on;
    for (std::size_t k = 0; k < planes_.size(); ++k) {
      const double beyond = planes_[k].beyond_mm(p);
      if (beyond > on_plane_mm_) return std::nullopt;
      if (beyond >= -on_plane_mm_ && !on) on = k;
    }
    return on;
  }

  /// What meets on a cap. Where components are told apart, the one that comes to the border there ends beyond it within
  /// a voxel.
  std::array<ComponentId, 2> cap_components(std::size_t plane, const Point& p, Region region) const {
    const ComponentId cap = kFirstCap + static_cast<ComponentId>(plane);
    if (known_.size() < 2 || !planes_[plane].is_border()) return {cap, kBehindCap};
    Crossings crossings;
    inner_->crossings({p, p + planes_[plane].closing_mm}, crossings);
    const bool is_seen = !crossings.empty() && crossings.front().from == region && crossings.front().to == kOutside;
    return {cap, is_seen ? crossings.front().components[1] : kBehindCap};
  }

  std::unique_ptr<Domain> inner_;
  std::vector<CutPlane> planes_;
  CutSpace space_;
  double spacing_mm_;
  double on_plane_mm_ = 0;
  Box box_;
  std::vector<Component> known_;    // those that are whole
  std::size_t cut_components_ = 0;  // those that may be cut
  CutCurves cut_;
};

/// Around the corners of the box that no plane takes away, and those of the caps.
void CutDomain::find_box() {
  const Box& whole = space_.box;
  Box left;
  for (int n = 0; n < 8; ++n) {
    const Point p = whole.corner(n);
    if (space_.keeps(p)) left.extend(p);
  }
  for (std::size_t k = 0; k < planes_.size(); ++k) {
    for (const Point& p : space_.polygon(k)) left.extend(p);
  }
  if (left.empty()) return;
  box_ = left.grown(kMargin * left.diagonal());
}

void CutDomain::find_components() {
  const std::vector<Component> whole = inner_->components();
  const bool is_one_region =
      std::all_of(whole.begin(), whole.end(), [](const Component& component) { return component.region <= 1; });
  for (const Component& component : whole) {
    const Fate fate = fate_of(component, is_one_region);
    if (fate == Fate::unknown) ++cut_components_;
    if (fate != Fate::kept) continue;
    known_.push_back(component);
    known_.back().witness = inward(component.witness, component.region);
  }
}

/// The border's planes leave a component as it is if the domain is one region.
CutDomain::Fate CutDomain::fate_of(const Component& component, bool is_one_region) const {
  bool is_met = false;
  bool is_at_border = false;
  for (const CutPlane& plane : planes_) {
    Vec nearest;
    Vec farthest;
    for (int axis = 0; axis < 3; ++axis) {
      const bool is_up = plane.normal[axis] > 0;
      nearest[axis] = (is_up ? component.box_mm.min : component.box_mm.max)[axis];
      farthest[axis] = (is_up ? component.box_mm.max : component.box_mm.min)[axis];
    }
    if (plane.beyond_mm(farthest) + spacing_mm_ < 0) continue;  // as it is
    is_at_border = is_at_border || plane.is_border();
    if (plane.is_border()) continue;
    if (plane.beyond_mm(nearest) >= spacing_mm_) return Fate::gone;
    is_met = true;
  }
  return is_met || (is_at_border && !is_one_region) ? Fate::unknown : Fate::kept;
}

/// A point beside p, in the region and within all planes, if p, a node of the grid, is on one.
Point CutDomain::inward(Point p, Region region) const {
  constexpr int kHalvings = 30;
  double step_mm = 0.25 * spacing_mm_;
  for (int n = 0; n < kHalvings && !space_.keeps(p); ++n, step_mm *= 0.5) {
    Point inner = p;
    for (const CutPlane& plane : planes_) {
      if (plane.beyond_mm(inner) >= -on_plane_mm_) inner = plane.nearest(inner) - step_mm * plane.normal;
    }
    if (space_.keeps(inner) && inner_->region_at(inner) == region) return inner;
  }
  return p;
}

void CutDomain::crossings(const Segment& segment, Crossings& out) const {
  const auto stretch = space_.kept(segment);
  if (!stretch) return out.clear();
  if (stretch->enter_plane == kNoPlane && stretch->leave_plane == kNoPlane) return inner_->crossings(segment, out);
  Segment kept = segment;
  if (stretch->enter_plane != kNoPlane) {
    kept.source = planes_[stretch->enter_plane].nearest(lerp(segment.source, segment.target, stretch->enter));
  }
  if (stretch->leave_plane != kNoPlane) {
    kept.target = planes_[stretch->leave_plane].nearest(lerp(segment.source, segment.target, stretch->leave));
  }
  inner_->crossings(kept, out);
  const Region first = out.empty() ? inner_->region_at(kept.source) : out.front().from;
  const Region last = out.empty() ? first : out.back().to;
  if (stretch->enter_plane != kNoPlane && first != kOutside) {
    out.insert(out.begin(), {kept.source, kOutside, first, cap_components(stretch->enter_plane, kept.source, first)});
  }
  if (stretch->leave_plane != kNoPlane && last != kOutside) {
    out.push_back({kept.target, last, kOutside, cap_components(stretch->leave_plane, kept.target, last)});
  }
  assert(std::adjacent_find(out.begin(), out.end(),
                            [](const Crossing& a, const Crossing& b) { return a.to != b.from; }) == out.end());
}

void CutDomain::surface_candidates(double spacing_mm, const PointSink& sink) const {
  inner_->surface_candidates(spacing_mm, [&](const Point& p) {
    if (space_.keeps(p)) sink(p);
  });
  for (std::size_t k = 0; k < planes_.size(); ++k) {
    const std::vector<Point> polygon = space_.polygon(k);
    if (polygon.empty()) continue;
    const PlaneAxes axes(planes_[k], space_.box.center());
    Box box;
    for (const Point& p : polygon) box.extend({axes.u_of(p), axes.v_of(p), 0});
    const auto count = [&](double length) { return static_cast<std::size_t>(length / spacing_mm) + 1; };
    const std::size_t columns = count(box.extent().x);
    const auto collect = [&](std::size_t begin, std::size_t end, std::vector<Point>& found) {
      for (std::size_t row = begin; row < end; ++row) {
        for (std::size_t column = 0; column < columns; ++column) {
          const Point p = axes.at(box.min.x + (0.5 + static_cast<double>(column)) * spacing_mm,
                                  box.min.y + (0.5 + static_cast<double>(row)) * spacing_mm);
          if (space_.keeps(p, {k, kNoPlane}) && inner_->region_at(p) != kOutside) found.push_back(p);
        }
      }
    };
    for (const Point& p : parallel_collect<Point>(count(box.extent().y), 8, collect)) sink(p);
  }
}

/// Beyond the planes nothing is asked for.
std::vector<Misplaced> CutDomain::misplaced(const MeshBoundary& boundary, const PlaceFilter& is_asked) const {
  return inner_->misplaced(boundary, [&](const Point& p) { return space_.keeps(p) && (!is_asked || is_asked(p)); });
}

std::optional<double> CutDomain::residual_at(const Point& p) const {
  double beyond = 0;
  double to_plane = space_.box.diagonal();
  for (const CutPlane& plane : planes_) {
    const double over = plane.beyond_mm(p);
    beyond = std::max(beyond, over);
    to_plane = std::min(to_plane, std::abs(over));
  }
  const std::optional<double> own = inner_->residual_at(p);
  if (!own) return std::nullopt;
  const double diagonal = space_.box.diagonal();
  const double on_cap = inner_->region_at(p) == kOutside ? 1 : to_plane / diagonal;
  return std::max(beyond / diagonal, std::min(*own, on_cap));
}

}  // namespace

void refuse_cuts() {
  throw Error(Fault::input, "input.cut", "the cuts leave nothing of the object", "look at which side each keeps");
}

std::unique_ptr<Domain> make_cut_domain(std::unique_ptr<Domain> domain, std::vector<CutPlane> planes, double step_mm,
                                        double spacing_mm, CutReport* report) {
  auto cut = std::make_unique<CutDomain>(std::move(domain), std::move(planes), step_mm, spacing_mm);
  CutReport found;
  if (!cut->bounds().empty()) found = cut->trace();
  const bool is_met = std::find(found.meets.begin(), found.meets.end(), true) != found.meets.end();
  if (!is_met && (cut->bounds().empty() || !cut->keeps_boundary())) {
    refuse_cuts();
  }
  if (report != nullptr) *report = std::move(found);
  return cut;
}

}  // namespace scantet
