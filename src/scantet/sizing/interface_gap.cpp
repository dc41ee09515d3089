// Short lines are cast through a point of the boundary. The crossing nearest to it is its own, and says which regions
// its interface parts; the nearest one of another pair of regions is across the gap. The lines go along the axes and
// diagonals of a cube; the best direction is then turned, twice, to where the gap is narrower.
//
// The number of vertices follows from that: where surface balls are no larger than the gap, none reaches from one
// interface to a vertex on another, and R1 has nothing to keep apart; until then it inserts points. So there is about
// one vertex for each square of the gap.
#include "scantet/sizing/interface_gap.h"

#include <array>
#include <limits>
#include <optional>
#include <utility>

#include "scantet/base/parallel.h"

namespace scantet {
namespace {

constexpr double kSpacing = 1.0 / 64;     // of the longest side of the bounds
constexpr double kAreaOfPoint = 1 / 1.5;  // over spacing²: lines along three axes cross a plane 1.5 times on average
constexpr std::size_t kGrain = 64;

using Pair = std::pair<Region, Region>;

Pair pair_of(const Crossing& crossing) {
  return std::minmax(crossing.from, crossing.to);
}

/// The crossing between a pair of regions that is nearest to a point.
struct Nearest {
  Pair regions;
  double squared_mm;
  Point point;
};

/// Casts lines from one point.
class GapSearch {
 public:
  GapSearch(const Domain& domain, const Point& p) : domain_(domain), p_(p) {}

  /// The gap at the point if it is less than reach_mm.
  std::optional<double> run(double reach_mm) {
    const Nearest* other = nullptr;
    for (const double share : {kShort, 1.0}) {
      for (const Vec& direction : kDirections) {
        const Vec half = (share * reach_mm / length(direction)) * direction;
        cast({p_ - half, p_ + half});
      }
      const Nearest* const own = nearest_but(nullptr);
      other = own == nullptr ? nullptr : nearest_but(own);
      if (other != nullptr) break;
    }
    if (other == nullptr || !(other->squared_mm > 0)) return std::nullopt;
    Nearest across = *other;
    for (const double turn : {kTurn, 0.5 * kTurn}) narrow(across, turn);
    const double gap_mm = std::sqrt(across.squared_mm);
    if (gap_mm >= reach_mm) return std::nullopt;
    return gap_mm;
  }

 private:
  static constexpr double kShort = 0.25;  // of the reach: tried first
  static constexpr double kTurn = 0.35;   // tangent; the directions are up to 55° apart
  static constexpr std::array<Vec, 13> kDirections{{{1, 0, 0},
                                                    {0, 1, 0},
                                                    {0, 0, 1},
                                                    {0, 1, 1},
                                                    {0, 1, -1},
                                                    {1, 0, 1},
                                                    {1, 0, -1},
                                                    {1, 1, 0},
                                                    {1, -1, 0},
                                                    {1, 1, 1},
                                                    {1, 1, -1},
                                                    {1, -1, 1},
                                                    {1, -1, -1}}};

  /// Takes note of the nearest crossing of each pair of regions.
  void cast(const Segment& segment) {
    domain_.crossings(segment, crossings_);
    for (const Crossing& crossing : crossings_) {
      const Pair regions = pair_of(crossing);
      const double squared = squared_distance(crossing.point, p_);
      const auto known =
          std::find_if(found_.begin(), found_.end(), [&](const Nearest& n) { return n.regions == regions; });
      if (known == found_.end()) {
        found_.push_back({regions, squared, crossing.point});
      } else if (squared < known->squared_mm) {
        *known = {regions, squared, crossing.point};
      }
    }
  }

  const Nearest* nearest_but(const Nearest* own) const {
    const Nearest* best = nullptr;
    for (const Nearest& n : found_) {
      if (&n != own && (best == nullptr || n.squared_mm < best->squared_mm)) best = &n;
    }
    return best;
  }

  /// Turns the line across the gap to each side.
  void narrow(Nearest& across, double turn) {
    const Vec line = across.point - p_;
    const Vec least = std::abs(line.x) < std::abs(line.y) && std::abs(line.x) < std::abs(line.z) ? Vec{1, 0, 0}
                      : std::abs(line.y) < std::abs(line.z)                                      ? Vec{0, 1, 0}
                                                                                                 : Vec{0, 0, 1};
    const Vec normal = cross(line, least);
    const Vec u = (turn * length(line) / length(normal)) * normal;
    const Vec v = (turn / length(line)) * cross(line, (length(line) / length(normal)) * normal);
    for (const Vec& aside : {u, -1.0 * u, v, -1.0 * v}) {
      domain_.crossings({p_, p_ + line + aside}, crossings_);
      for (const Crossing& crossing : crossings_) {
        const double squared = squared_distance(crossing.point, p_);
        if (pair_of(crossing) == across.regions && squared > 0 && squared < across.squared_mm) {
          across.squared_mm = squared;
          across.point = crossing.point;
        }
      }
    }
  }

  const Domain& domain_;
  Point p_;
  std::vector<Nearest> found_;
  Crossings crossings_;
};

bool has_several_regions(const Domain& domain) {
  const std::vector<Component> components = domain.components();
  return std::any_of(components.begin(), components.end(), [](const Component& c) { return c.region > 1; });
}

std::vector<double> gaps_at(const Domain& domain, const std::vector<Point>& points, const SizingField& size,
                            double alpha) {
  const auto measure = [&](std::size_t begin, std::size_t end, std::vector<double>& out) {
    for (std::size_t i = begin; i < end; ++i) {
      if (const auto gap = GapSearch(domain, points[i]).run(alpha * size.size_at(points[i]))) out.push_back(*gap);
    }
  };
  return parallel_collect<double>(points.size(), kGrain, measure);
}

}  // namespace

InterfaceGaps interface_gaps(const Domain& domain, const SizingField& size, double alpha, Progress& progress) {
  if (!has_several_regions(domain)) return {};
  progress.report({"sizes", "gaps", 0, std::nullopt, 0});
  const Vec extent = domain.bounds().extent();
  const double spacing_mm = kSpacing * std::max({extent.x, extent.y, extent.z});
  // The lines are cast here, not left to a domain that may cast them closer: each point is to stand for the same area.
  std::vector<Point> points;
  std::vector<double> gaps;
  const bool done = run_interruptible(progress, [&] {
    domain.Domain::surface_candidates(spacing_mm, [&](const Point& p) { points.push_back(p); });
    gaps = gaps_at(domain, points, size, alpha);
  });
  if (gaps.empty() || !done) return {};
  std::sort(gaps.begin(), gaps.end());
  InterfaceGaps result;
  result.share = static_cast<double>(gaps.size()) / static_cast<double>(points.size());
  result.least_mm = gaps.front();
  result.median_mm = gaps[gaps.size() / 2];
  const double area_mm2 = kAreaOfPoint * spacing_mm * spacing_mm;
  for (const double gap : gaps) result.expected_vertices += area_mm2 / (gap * gap);
  return result;
}

}  // namespace scantet
