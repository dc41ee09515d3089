// Along a line everything is one query.
#include "scantet/cuts/cut_lines.h"

#include <algorithm>
#include <map>
#include <optional>

#include "scantet/base/box_clip.h"

namespace scantet {
namespace {

constexpr double kParallel = 1e-12;  // squared sine of an angle between planes

/// The point on both planes that is nearest to p.
Point on_both(const CutPlane& a, const CutPlane& b, Point p) {
  const double cosine = dot(a.normal, b.normal);
  const double squared_sine = 1 - cosine * cosine;
  for (int step = 0; step < 3; ++step) {
    const double over_a = a.beyond_mm(p);
    const double over_b = b.beyond_mm(p);
    p = p - ((over_a - cosine * over_b) / squared_sine) * a.normal -
        ((over_b - cosine * over_a) / squared_sine) * b.normal;
  }
  // Exact where both planes lie along the axes.
  const Point both = a.nearest(b.nearest(p));
  return std::abs(b.beyond_mm(both)) <= std::abs(b.beyond_mm(p)) ? both : p;
}

class LineFinder {
 public:
  LineFinder(const CutSpace& space, CutCurves& found) : space_(space), found_(found) {}

  std::optional<CutLine> line_of(std::size_t a, std::size_t b) {
    const CutPlane& plane_a = space_.planes[a];
    const CutPlane& plane_b = space_.planes[b];
    CutLine line;
    line.planes = {a, b};
    const Vec along = cross(plane_a.normal, plane_b.normal);
    if (!(squared_length(along) > kParallel)) return std::nullopt;
    line.along = (1 / length(along)) * along;
    line.origin = on_both(plane_a, plane_b, space_.box.center());
    const double reach = 2 * space_.box.diagonal() + distance(line.origin, space_.box.center());
    const auto in_box = clipped({line.origin - reach * line.along, line.origin + reach * line.along}, space_.box);
    if (!in_box) return line;
    const auto stretch = space_.kept(*in_box, line.planes);
    if (!stretch) return line;
    const Segment kept{on_both(plane_a, plane_b, lerp(in_box->source, in_box->target, stretch->enter)),
                       on_both(plane_a, plane_b, lerp(in_box->source, in_box->target, stretch->leave))};
    walk(kept, *stretch, line);
    return line;
  }

 private:
  void walk(const Segment& kept, const KeptStretch& stretch, CutLine& line) {
    Crossings crossings;
    space_.inner.crossings(kept, crossings);
    Region region = crossings.empty() ? space_.inner.region_at(kept.source) : crossings.front().from;
    std::optional<std::size_t> start;
    if (region != kOutside) start = corner_at_end(kept.source, line, stretch.enter_plane, region);
    for (const Crossing& crossing : crossings) {
      const Point p = on_both(space_.planes[line.planes[0]], space_.planes[line.planes[1]], crossing.point);
      const std::size_t corner = add_corner(p, {kOutside, crossing.from, crossing.to});
      line.places.push_back({line.along_mm(p), p, crossing.from, crossing.to, corner});
      add_edge(start, corner, region);
      region = crossing.to;
      start = corner;
    }
    if (region != kOutside) add_edge(start, corner_at_end(kept.target, line, stretch.leave_plane, region), region);
  }

  /// Where three planes meet there is one corner for the three lines.
  std::size_t corner_at_end(const Point& p, const CutLine& line, std::size_t plane, Region region) {
    std::array<std::size_t, 3> planes{line.planes[0], line.planes[1], plane};
    std::sort(planes.begin(), planes.end());
    const auto [place, is_new] = corner_of_planes_.try_emplace(planes, found_.corners.size());
    if (is_new) add_corner(p, {kOutside, region});
    return place->second;
  }

  std::size_t add_corner(const Point& p, std::vector<Region> regions) {
    std::sort(regions.begin(), regions.end());
    regions.erase(std::unique(regions.begin(), regions.end()), regions.end());
    found_.corners.push_back({p, std::move(regions), {}});
    return found_.corners.size() - 1;
  }

  void add_edge(std::optional<std::size_t> start, std::size_t end, Region region) {
    if (region == kOutside || !start || *start == end) return;
    const Point& a = found_.corners[*start].point;
    const Point& b = found_.corners[end].point;
    if (a == b) return;
    found_.curves.push_back(std::make_shared<PolylineCurve>(std::vector{a, b}, std::vector<Region>{region, kOutside},
                                                            std::array{*start, end}));
  }

  const CutSpace& space_;
  CutCurves& found_;
  std::map<std::array<std::size_t, 3>, std::size_t> corner_of_planes_;
};

}  // namespace

std::vector<CutLine> find_cut_lines(const CutSpace& space, CutCurves& found) {
  LineFinder finder(space, found);
  std::vector<CutLine> lines;
  for (std::size_t a = 0; a < space.planes.size(); ++a) {
    for (std::size_t b = a + 1; b < space.planes.size(); ++b) {
      if (auto line = finder.line_of(a, b)) lines.push_back(std::move(*line));
    }
  }
  return lines;
}

}  // namespace scantet
