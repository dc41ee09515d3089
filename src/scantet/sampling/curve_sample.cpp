// The radius of a ball is bounded by the size, by half of the gap to other curves, and by what leaves room for the
// curves that come from the same corner; along a curve it grows by half of the way at most. Balls are placed so that
// each reaches over half a radius of the next: what fills a stretch of a curve is one number, the integral of 1 over
// the radius, so the radii are shrunk a little to make it come out even. Long curves are halved into stretches that
// begin with a ball: where the size changes on one of them, the others keep their points.
#include "scantet/sampling/curve_sample.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <numeric>
#include <utility>

#include "scantet/base/parallel.h"
#include "scantet/base/point_grid_impl.h"
#include "scantet/base/union_find.h"
#include "scantet/domain/curve_regions.h"
#include "scantet/sampling/curve_stretch_impl.h"
#include "scantet/sampling/hinted_spacing_impl.h"

namespace scantet {
namespace {

constexpr double kLargestBall = 2.0 / 3;  // of alpha·σ: centres are alpha·σ apart
constexpr double kHintShare = 1.0 / 3;    // of the local feature size near a hint: what is narrow there has no room in
                                          // larger balls
constexpr double kClear = 0.475;          // of a gap between curves, the share of each side's balls
constexpr double kGrading = 0.5;
// Times the distance of two places: a curve longer than that between them comes back. Balls are 1.5 radii apart along
// a curve: where it bends more than that, the next but one would be in the ball.
constexpr double kComesBack = 1.3;
constexpr double kJunctionComesBack = 2;
constexpr double kStretch = 12;           // alpha·σ: longer ones are halved
constexpr double kFromCorners = 4;        // alpha·σ: stretches that begin nearer to the end of a curve do not
constexpr std::size_t kFewestInLoop = 5;  // balls around a closed curve
constexpr std::size_t kGrain = 256;
constexpr std::uint32_t kNoCorner = 0xffffffff;

/// A place on a curve that is looked at.
struct Place {
  std::uint32_t curve;
  double along_mm;
};

class CurveSampler {
 public:
  CurveSampler(const Domain& domain, const SizingField& size, double alpha)
      : size_(size),
        alpha_(alpha),
        curves_(domain.curves()),
        corners_(domain.corners()),
        has_junctions_(have_junctions(curves_)),
        smallest_(has_junctions_ ? kSmallestAtJunctions : kSmallestBall),
        comes_back_(has_junctions_ ? kJunctionComesBack : kComesBack) {
    if (has_junctions_ || (curves_.empty() && corners_.empty())) return;
    std::vector<SizeHint> hints;
    domain.size_hints([&](const SizeHint& hint) { hints.push_back(hint); });
    hinted_ = HintedSpacing(std::move(hints), kHintShare, kLargestBall * alpha * size.min_size());
  }

  CurveSample run() {
    if (curves_.empty() && corners_.empty()) return {};
    merge_corners();
    choose_places();
    choose_corner_radii();
    choose_radii();
    std::vector<CurveVertex> proposed;
    for (std::size_t c = 0; c < corners_.size(); ++c) {
      if (stays_[c] != c) continue;
      proposed.push_back({corners_[c].point, corner_mm_[c], 0, regions_of_corner_[c], merges_[c]});
    }
    std::vector<std::vector<CurveVertex>> of_curve(curves_.size());
    parallel_for(curves_.size(), 1, [&](std::size_t i, std::size_t) { of_curve[i] = balls_of(i); });
    std::vector<std::uint32_t> place_of_corner(corners_.size());
    for (std::size_t c = 0, place = 0; c < corners_.size(); ++c) {
      place_of_corner[c] = stays_[c] == c ? static_cast<std::uint32_t>(place++) : place_of_corner[stays_[c]];
    }
    std::vector<std::vector<std::uint32_t>> chains;  // of each curve: its balls, from end to end
    for (std::size_t i = 0; i < curves_.size(); ++i) {
      std::vector<std::uint32_t> chain(of_curve[i].size());
      std::iota(chain.begin(), chain.end(), static_cast<std::uint32_t>(proposed.size()));
      if (ends_[i][0] != kNoCorner) {
        chain.insert(chain.begin(), place_of_corner[ends_[i][0]]);
        chain.push_back(place_of_corner[ends_[i][1]]);
      } else {
        chain.push_back(chain.front());
      }
      chains.push_back(std::move(chain));
      std::move(of_curve[i].begin(), of_curve[i].end(), std::back_inserter(proposed));
    }
    const std::vector<std::uint32_t> kept = settle(std::move(proposed));
    for (std::uint32_t i = 0; i < chains.size(); ++i) {
      for (std::size_t k = 0; k + 1 < chains[i].size(); ++k) {
        const std::array<std::uint32_t, 2> ends{kept[chains[i][k]], kept[chains[i][k + 1]]};
        if (ends[0] != ends[1]) sample_.pieces.push_back({ends, i});
      }
    }
    return std::move(sample_);
  }

 private:
  double largest_at(const Point& p) const {
    return std::max(hinted_.at(p, kLargestBall * alpha_ * size_.size_at(p)), smallest_at(p));
  }
  double smallest_at(const Point& p) const { return smallest_ * alpha_ * size_.size_at(p); }

  /// Corners at the ends of curves shorter than two smallest balls become one, shortest curves first, if the corner
  /// that stays is as near.
  void merge_corners() {
    UnionFind sets(corners_.size());
    std::vector<std::pair<double, std::size_t>> by_length;
    for (std::size_t i = 0; i < curves_.size(); ++i) by_length.emplace_back(curves_[i]->length_mm(), i);
    std::sort(by_length.begin(), by_length.end());
    for (const auto& [length_mm, i] : by_length) {
      const auto ends = curves_[i]->corners();
      if (!ends) continue;
      auto a = sets.find(static_cast<std::uint32_t>((*ends)[0]));  // the one that stays
      auto b = sets.find(static_cast<std::uint32_t>((*ends)[1]));
      if (b < a) std::swap(a, b);
      const Point& at = corners_[a].point;
      if (a == b || std::max(length_mm, distance(at, corners_[b].point)) > 2 * smallest_at(at)) continue;
      sample_.merged.push_back(corners_[b].point);
      sets.unite(a, b);
    }
    regions_of_corner_.resize(corners_.size());
    merges_.assign(corners_.size(), false);
    for (std::uint32_t c = 0; c < corners_.size(); ++c) {
      stays_.push_back(sets.find(c));
      unite_regions(regions_of_corner_[stays_[c]], corners_[c].regions);
      if (stays_[c] != c) merges_[stays_[c]] = true;
    }
    ends_.assign(curves_.size(), {kNoCorner, kNoCorner});
    for (std::size_t i = 0; i < curves_.size(); ++i) {
      if (const auto ends = curves_[i]->corners()) ends_[i] = {stays_[(*ends)[0]], stays_[(*ends)[1]]};
    }
  }

  bool ends_at(std::size_t curve, std::size_t corner) const {
    return ends_[curve][0] == corner || ends_[curve][1] == corner;
  }

  /// Notes places along all curves, as far from each other as the smallest balls are wide.
  void choose_places() {
    std::vector<std::vector<double>> along(curves_.size());
    anchors_.resize(curves_.size());
    parallel_for(curves_.size(), 1, [&](std::size_t i, std::size_t) {
      const Curve& curve = *curves_[i];
      add_anchors(curve, 0, curve.length_mm(), anchors_[i]);
      std::vector<double> ends = anchors_[i];
      ends.push_back(curve.length_mm());
      along[i].push_back(0);
      for (const double end_mm : ends) {
        while (along[i].back() < end_mm) {
          const double step_mm = smallest_at(curve.at(along[i].back()));
          along[i].push_back(std::min(along[i].back() + step_mm, end_mm));
        }
      }
    });
    first_place_.push_back(0);
    for (std::uint32_t i = 0; i < curves_.size(); ++i) {
      for (const double along_mm : along[i]) places_.push_back({i, along_mm});
      first_place_.push_back(places_.size());
    }
    points_.resize(places_.size());
    largest_mm_.resize(places_.size());
    parallel_for(places_.size(), kGrain, [&](std::size_t begin, std::size_t end) {
      for (std::size_t n = begin; n < end; ++n) {
        points_[n] = curves_[places_[n].curve]->at(places_[n].along_mm);
        largest_mm_[n] = largest_at(points_[n]);
      }
    });
    grid_ = PointGrid(points_, middle_of(largest_mm_));
  }

  /// The places, mm along a curve and ascending, where stretches between two others begin.
  void add_anchors(const Curve& curve, double from, double to, std::vector<double>& anchors) const {
    const double middle = 0.5 * (from + to);
    const double unit_mm = alpha_ * size_.size_at(curve.at(middle));
    if (to - from <= kStretch * unit_mm) return;
    add_anchors(curve, from, middle, anchors);
    const double to_end = std::min(middle, curve.length_mm() - middle);
    if (!curve.corners() || to_end > kFromCorners * unit_mm) anchors.push_back(middle);
    add_anchors(curve, middle, to, anchors);
  }

  /// Of sizes that differ, rows as wide as the smallest would be far too many to look through.
  static double middle_of(std::vector<double> values) {
    if (values.empty()) return 1;
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
  }

  void choose_radii() {
    radius_mm_.resize(places_.size());
    parallel_for(places_.size(), kGrain, [&](std::size_t begin, std::size_t end) {
      for (std::size_t n = begin; n < end; ++n) radius_mm_[n] = room_at(n);
    });
    for (std::size_t i = 0; i < curves_.size(); ++i) grade(i);
  }

  /// The radius that a ball at a place may have.
  double room_at(std::size_t n) const {
    const Point& p = points_[n];
    const double most = largest_mm_[n];
    double room = most;
    if (in_corner_ball(places_[n])) return most;
    const double least = smallest_at(p);
    grid_.any_near(p, most / kClear, [&](std::uint32_t m, const Point& q, double squared) {
      room = std::min(room, room_beside(n, m, q, std::sqrt(squared)));
      return room <= least;
    });
    return std::max(room, least);
  }

  /// The radius that another place, at a distance, leaves for a ball at place n.
  double room_beside(std::size_t n, std::size_t m, const Point& q, double distance_mm) const {
    constexpr double kNone = std::numeric_limits<double>::infinity();
    const std::uint32_t own = places_[n].curve;
    const std::uint32_t other = places_[m].curve;
    if (own == other) {  // a curve that comes back to itself; what is next along it is no other curve
      double along = std::abs(places_[n].along_mm - places_[m].along_mm);
      if (ends_[own][0] == kNoCorner) along = std::min(along, curves_[own]->length_mm() - along);
      return along > comes_back_ * distance_mm ? kClear * distance_mm : kNone;
    }
    double room = kNone;
    bool meet = false;
    for (const std::uint32_t corner : ends_[own]) {
      if (corner == kNoCorner || !ends_at(other, corner)) continue;
      meet = true;
      const double from = distance(points_[n], corners_[corner].point);
      const double to = distance(q, corners_[corner].point);
      if (to < corner_mm_[corner]) continue;
      room = std::min(room, 2 * kClear * from * distance_mm / (from + to));  // balls of both grow away from the corner
    }
    return meet ? room : kClear * distance_mm;
  }

  bool in_corner_ball(const Place& place) const {
    const auto [begin, end] = ends_[place.curve];
    return begin != kNoCorner &&
           (place.along_mm < corner_mm_[begin] || place.along_mm > curves_[place.curve]->length_mm() - corner_mm_[end]);
  }

  /// Along a curve the radius changes by half of the way at most.
  void grade(std::size_t i) {
    const auto limit = [&](std::size_t n, std::size_t from) {
      const double way = std::abs(places_[n].along_mm - places_[from].along_mm);
      radius_mm_[n] = std::min(radius_mm_[n], radius_mm_[from] + kGrading * way);
    };
    for (std::size_t n = first_place_[i] + 1; n < first_place_[i + 1]; ++n) limit(n, n - 1);
    for (std::size_t n = first_place_[i + 1] - 1; n-- > first_place_[i];) limit(n, n + 1);
  }

  /// How far a place on a curve is from a corner along it, mm; infinite if the curve does not end there. One that comes
  /// back to its corner is as another curve beside it.
  double way_from_corner(const Place& place, std::size_t corner) const {
    double way = std::numeric_limits<double>::infinity();
    if (ends_[place.curve][0] == corner) way = place.along_mm;
    if (ends_[place.curve][1] == corner) way = std::min(way, curves_[place.curve]->length_mm() - place.along_mm);
    return way;
  }

  void choose_corner_radii() {
    corner_mm_.resize(corners_.size());
    for (std::size_t c = 0; c < corners_.size(); ++c) corner_mm_[c] = largest_at(corners_[c].point);
    for (std::size_t i = 0; i < curves_.size(); ++i) {
      if (ends_[i][0] == kNoCorner) continue;
      for (const std::uint32_t corner : ends_[i]) {
        corner_mm_[corner] = std::min(corner_mm_[corner], curves_[i]->length_mm() / 3);
      }
    }
    for (std::size_t c = 0; c < corners_.size(); ++c) {
      const Point& p = corners_[c].point;
      grid_.any_near(p, corner_mm_[c] / 0.4, [&](std::uint32_t m, const Point&, double squared) {
        const double away = std::sqrt(squared);
        if (way_from_corner(places_[m], c) > comes_back_ * away) corner_mm_[c] = std::min(corner_mm_[c], 0.4 * away);
        return false;
      });
      corner_mm_[c] = std::max(corner_mm_[c], smallest_at(p));
    }
  }

  /// The balls between the ends of a curve, in order.
  std::vector<CurveVertex> balls_of(std::size_t i) const {
    const double length_mm = curves_[i]->length_mm();
    std::vector<CurveVertex> vertices;
    const bool is_closed = ends_[i][0] == kNoCorner;
    const double from = is_closed ? 0 : corner_mm_[ends_[i][0]];
    const double to = is_closed ? length_mm : length_mm - corner_mm_[ends_[i][1]];
    if (to <= from) return vertices;  // its corners' balls cover it
    std::vector<double> bounds{from};
    for (const double anchor : anchors_[i]) {
      if (anchor > from && anchor < to) bounds.push_back(anchor);
    }
    bounds.push_back(to);
    std::vector<CurveRoom> rooms;
    for (std::size_t n = first_place_[i]; n < first_place_[i + 1]; ++n) {
      rooms.push_back({places_[n].along_mm, radius_mm_[n]});
    }
    const std::vector<Region> regions = regions_at(*curves_[i]);
    for (std::size_t n = 0; n + 1 < bounds.size(); ++n) {
      CurveStretch stretch{bounds[n], bounds[n + 1]};
      stretch.after_corner = !is_closed && n == 0;
      stretch.before_corner = !is_closed && n + 2 == bounds.size();
      if (is_closed && bounds.size() == 2) stretch.fewest = kFewestInLoop;
      for (const CurveBall& ball : cover_stretch(rooms, stretch)) {
        vertices.push_back({curves_[i]->at(ball.along_mm), ball.radius_mm, 1, regions, false});
      }
    }
    return vertices;
  }

  /// Drops balls whose centre is in one before them, which takes their regions, and shrinks those that hold the centre
  /// of one before them. Returns for each the vertex that stands for it.
  std::vector<std::uint32_t> settle(std::vector<CurveVertex> proposed) {
    std::vector<Point> centers;
    double widest = 0;
    for (const CurveVertex& vertex : proposed) {
      centers.push_back(vertex.point);
      widest = std::max(widest, vertex.radius_mm);
    }
    const PointGrid grid(centers, std::max(widest, std::numeric_limits<double>::min()));
    constexpr std::uint32_t kNobody = 0xffffffff;
    constexpr double kApart = 0.999;  // of the distance to the next centre
    std::vector<std::uint32_t> kept(proposed.size());
    std::vector<bool> dropped(proposed.size(), false);
    for (std::size_t i = 0; i < proposed.size(); ++i) {
      CurveVertex& vertex = proposed[i];
      std::uint32_t host = kNobody;
      double nearest = std::numeric_limits<double>::infinity();
      grid.any_near(vertex.point, widest, [&](std::uint32_t j, const Point&, double squared) {
        if (j >= i || dropped[j]) return false;
        const double away = std::sqrt(squared);
        nearest = std::min(nearest, away);
        if (away * kApart <= sample_.vertices[kept[j]].radius_mm) host = std::min(host, kept[j]);
        return false;
      });
      if (host != kNobody) {
        dropped[i] = true;
        unite_regions(sample_.vertices[host].regions, vertex.regions);
        sample_.vertices[host].is_merged = true;
        sample_.merged.push_back(vertex.point);
        kept[i] = host;
        continue;
      }
      vertex.radius_mm = std::min(vertex.radius_mm, kApart * nearest);
      kept[i] = static_cast<std::uint32_t>(sample_.vertices.size());
      sample_.vertices.push_back(vertex);
    }
    return kept;
  }

  const SizingField& size_;
  double alpha_;
  HintedSpacing hinted_;
  std::vector<std::shared_ptr<const Curve>> curves_;
  std::vector<Corner> corners_;
  bool has_junctions_;
  double smallest_;                                     // ball, of alpha·σ
  double comes_back_;                                   // times the distance
  std::vector<std::uint32_t> stays_;                    // of each corner, the one that it is merged with
  std::vector<std::array<std::uint32_t, 2>> ends_;      // of each curve: such corners; kNoCorner if it is closed
  std::vector<std::vector<Region>> regions_of_corner_;  // of those that stay
  std::vector<bool> merges_;                            // whether others have been merged with it
  std::vector<double> corner_mm_;                       // the radius of each corner's ball
  std::vector<std::vector<double>> anchors_;            // of each curve, where stretches of it begin
  std::vector<Place> places_;
  std::vector<std::size_t> first_place_;  // of each curve, and one more
  std::vector<Point> points_;             // of the places
  std::vector<double> largest_mm_;        // ball that the size allows at each place
  PointGrid grid_;
  std::vector<double> radius_mm_;  // that a ball at each place may have
  CurveSample sample_;
};

}  // namespace

CurveSample sample_curves(const Domain& domain, const SizingField& size, double alpha) {
  return CurveSampler(domain, size, alpha).run();
}

}  // namespace scantet
