// Points are sorted by the cube that they are in. How flat the boundary is in a cube its points' second moments tell:
// the least eigenvalue is the mean square of their distances from the plane that fits best.
#include "scantet/size_options/boundary_look.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "scantet/base/large_pages.h"
#include "scantet/base/parallel.h"
#include "scantet/base/symmetric_matrix.h"

namespace scantet {
namespace {

constexpr double kLinesPerSize = 3;  // enough to tell a bend
constexpr double kMostLines = 1e6;
constexpr double kSmallCube = 2;       // spacings of lines
constexpr double kFlat = 0.08;         // of a cube's side: how far points may be off their plane
constexpr std::size_t kFewPoints = 4;  // of which no bend can be told

/// Second moments of points.
class Moments {
 public:
  void add(const Vec& p) {
    ++count_;
    sum_ = sum_ + p;
    squares_ = squares_ + Vec{p.x * p.x, p.y * p.y, p.z * p.z};
    products_ = products_ + Vec{p.y * p.z, p.x * p.z, p.x * p.y};
  }
  std::size_t count() const { return count_; }
  /// Mean square distance from the plane that fits best: the least eigenvalue of the covariance.
  double off_plane() const {
    const double share = 1 / static_cast<double>(count_);
    const Vec m = share * sum_;
    const Vec d = share * squares_ - Vec{m.x * m.x, m.y * m.y, m.z * m.z};
    const Vec o = share * products_ - Vec{m.y * m.z, m.x * m.z, m.x * m.y};
    return std::max(0.0, eigenvalue_form({d.x, d.y, d.z, o.z, o.y, o.x}).least());
  }

 private:
  std::size_t count_ = 0;
  Vec sum_{};
  Vec squares_{};
  Vec products_{};
};

// Of millions in a noisy scan.
struct Placed {
  std::uint64_t cube;
  std::array<float, 3> offset;

  Vec place() const { return {offset[0], offset[1], offset[2]}; }  // from the corner of the domain's box, mm
};

Placed placed(const Vec& v) {
  return {0, {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)}};
}

/// Cubes of sides least_mm · 2^n. The largest that is no larger than the size at a place counts there.
class Cubes {
 public:
  explicit Cubes(double least_mm) : least_mm_(least_mm) {}

  double side_mm(double size_mm) const { return least_mm_ * std::exp2(level(size_mm)); }
  std::uint64_t at(const Vec& place, double size_mm) const {
    constexpr int kBits = 19;  // of a cube's number along an axis
    const int n = level(size_mm);
    auto cube = static_cast<std::uint64_t>(n);
    for (int axis = 0; axis < 3; ++axis) {
      const double number = std::floor(place[axis] / (least_mm_ * std::exp2(n)));
      cube = cube << kBits | static_cast<std::uint64_t>(std::clamp(number, 0.0, (1 << kBits) - 1.0));
    }
    return cube;
  }

 private:
  int level(double size_mm) const {
    constexpr double kRounding = 1e-9;
    constexpr double kMostLevels = 40;
    return static_cast<int>(std::clamp(std::floor(std::log2(size_mm / least_mm_) + kRounding), 0.0, kMostLevels));
  }
  double least_mm_;
};

/// Calls visit(first, last) for the points of each cube. side_at(place): the size that the cubes go by there.
template <class SizeAt, class Visit>
void visit_cubes(LargeVector<Placed>& points, const Cubes& cubes, const SizeAt& size_at, const Visit& visit) {
  constexpr std::size_t kGrain = 4096;
  parallel_for(points.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t n = begin; n < end; ++n) points[n].cube = cubes.at(points[n].place(), size_at(points[n].place()));
  });
  std::sort(points.begin(), points.end(), [](const Placed& a, const Placed& b) { return a.cube < b.cube; });
  for (auto first = points.begin(); first != points.end();) {
    auto last = first;
    while (last != points.end() && last->cube == first->cube) ++last;
    visit(first, last);
    first = last;
  }
}

}  // namespace

std::optional<BoundaryLook> look_at_boundary(const Domain& domain, const SizingField& size,
                                             std::optional<double> finest_mm, Progress& progress) {
  const Box bounds = domain.bounds();
  const Vec extent = bounds.extent();
  const double least_mm = size.min_size();
  const double faces_mm2 = extent.x * extent.y + extent.y * extent.z + extent.z * extent.x;
  const double least_spacing_mm = std::sqrt(faces_mm2 / kMostLines);
  const double wanted_mm = std::min(finest_mm.value_or(least_mm), least_mm / kLinesPerSize);
  const double spacing_mm = std::max(wanted_mm, least_spacing_mm);
  // Where the size is too small for so many lines, larger cubes are counted.
  const double scale = std::max(1.0, kLinesPerSize * least_spacing_mm / least_mm);
  const auto size_at = [&](const Vec& place) { return scale * size.size_at(bounds.min + place); };

  constexpr std::size_t kRoom = std::size_t{1} << 23;  // memory that is not written costs nothing; growing does
  LargeVector<Placed> points;
  points.reserve(kRoom);
  const bool done = run_interruptible(progress, [&] {
    domain.surface_candidates(spacing_mm, [&](const Point& p) { points.push_back(placed(p - bounds.min)); });
  });
  if (!done) return std::nullopt;
  BoundaryLook look;
  const Cubes of_size(scale * least_mm);
  visit_cubes(points, of_size, size_at, [&](auto first, auto) {
    const double asked_mm = size_at(first->place());
    const double side_mm = of_size.side_mm(asked_mm);
    look.cubes += scale * scale * side_mm * side_mm / (asked_mm * asked_mm);
  });
  if (progress.cancelled()) return std::nullopt;
  const Cubes small(kSmallCube * spacing_mm);
  const auto small_at = [&](const Vec& place) {
    const double share = size_at(place) * kSmallCube / kLinesPerSize;
    return finest_mm ? std::min(share, std::max(kSmallCube * *finest_mm, kSmallCube * spacing_mm)) : share;
  };
  visit_cubes(points, small, small_at, [&](auto first, auto last) {
    Moments moments;
    for (auto point = first; point != last; ++point) moments.add(point->place() - first->place());
    const double flat_mm = kFlat * small.side_mm(small_at(first->place()));
    look.bent += moments.count() >= kFewPoints && moments.off_plane() > flat_mm * flat_mm ? 1 : 0;
  });
  return look;
}

}  // namespace scantet
