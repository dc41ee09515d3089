// What a triangulation needs of the curves' sample, and what keeps the first points of patches and regions off it.
#include <algorithm>
#include <optional>

#include "scantet/domain/curve_regions.h"
#include "scantet/refine/curves_impl.h"

namespace scantet::engine {
namespace {

constexpr double kApart = 0.46;      // of alpha·σ: half of what the boundary sample is apart
constexpr double kHintShare = 0.25;  // of the local feature size near a hint of size: the same

}  // namespace

Curves::Curves(const Domain& domain, const SizingField& size, double alpha)
    : sample_(sample_curves(domain, size, alpha)), apart_mm_(kApart * alpha * size.min_size()), widest_mm_(apart_mm_) {
  for (const CurveVertex& vertex : sample_.vertices) {
    points_.push_back(vertex.point);
    widest_mm_ = std::max(widest_mm_, vertex.radius_mm);
  }
  if (points_.empty()) return;
  grid_ = PointGrid(points_, widest_mm_);
  std::vector<SizeHint> hints;
  domain.size_hints([&](const SizeHint& hint) { hints.push_back(hint); });
  hinted_ = HintedSpacing(std::move(hints), kHintShare, apart_mm_);
  const auto curves = domain.curves();
  if (have_junctions(curves)) return;
  for (const auto& [ends, curve] : sample_.pieces) {
    pieces_.push_back(
        {{Triangulation::kCorners + ends[0], Triangulation::kCorners + ends[1]}, regions_at(*curves[curve])});
  }
}

std::vector<SamplePoint> Curves::weighted_points() const {
  std::vector<SamplePoint> points;
  for (const CurveVertex& v : sample_.vertices) {
    points.push_back({v.point, v.dimension, {}, v.radius_mm * v.radius_mm});
  }
  return points;
}

Junctions Curves::junctions() const {
  std::vector<Junction> junctions;
  for (const CurveVertex& vertex : sample_.vertices) junctions.push_back({vertex.regions, vertex.is_merged});
  return Junctions(std::move(junctions), pieces_);
}

SharpEdges Curves::sharp_edges(const Domain& domain) const {
  SharpEdges sharp;
  std::vector<std::optional<std::uint32_t>> number;
  for (const auto& curve : domain.curves()) {
    const std::vector<Region> regions = regions_at(*curve);
    const bool is_sharp = regions.size() <= 2;
    number.push_back(is_sharp ? std::optional(static_cast<std::uint32_t>(sharp.curves.size())) : std::nullopt);
    if (is_sharp) sharp.curves.push_back({regions, curve->name(), true});
  }
  for (const CurveSample::Piece& piece : sample_.pieces) {
    if (!number[piece.curve]) continue;
    const auto [a, b] = piece.vertices;
    sharp.edges.push_back({{Triangulation::kCorners + a, Triangulation::kCorners + b}, *number[piece.curve]});
  }
  return sharp;
}

bool Curves::is_near(const Point& p) const {
  const double apart_mm = hinted_.at(p, apart_mm_);
  return grid_.any_near(p, widest_mm_, [&](std::uint32_t i, const Point&, double squared) {
    const double reach_mm = std::max(sample_.vertices[i].radius_mm, apart_mm);
    return squared <= reach_mm * reach_mm;
  });
}

void Curves::drop_near(std::vector<Point>& points) const {
  if (empty()) return;
  std::erase_if(points, [&](const Point& p) { return is_near(p); });
}

}  // namespace scantet::engine
