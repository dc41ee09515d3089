// A point of the domain's boundary that is far from the mesh's becomes a vertex: that brings facets there, where the
// boundary is about as wide as they are. A spike or a sheet thinner than the distance between points has no tets in it,
// and so no facets, however many vertices lie on it alone. It takes points that are as close to each other as it is
// thin; how thin that is is not known, so what is still far off gets closer ones each time.
#include "scantet/app/nearer_points.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>

#include "scantet/base/neighbors.h"
#include "scantet/base/point_grid_impl.h"
#include "scantet/check/boundary_points.h"

namespace scantet {
namespace {

/// Points that keep a distance from each other.
class ApartPoints {
 public:
  explicit ApartPoints(double apart_mm) : apart_mm_(apart_mm) {}

  /// Takes the point unless one is nearer that was taken before.
  void offer(const Point& p) {
    Cube cube;
    for (int axis = 0; axis < 3; ++axis) {
      cube[static_cast<std::size_t>(axis)] = static_cast<std::int64_t>(std::floor(p[axis] / apart_mm_));
    }
    for (const NeighborOffset& step : kNeighborhood) {
      const auto around = cubes_.find({cube[0] + step[0], cube[1] + step[1], cube[2] + step[2]});
      if (around == cubes_.end()) continue;
      for (const Point& q : around->second) {
        if (distance(p, q) < apart_mm_) return;
      }
    }
    cubes_[cube].push_back(p);
    taken_.push_back(p);
  }
  std::vector<Point> take() { return std::move(taken_); }

 private:
  using Cube = std::array<std::int64_t, 3>;

  double apart_mm_;
  std::map<Cube, std::vector<Point>> cubes_;
  std::vector<Point> taken_;
};

struct Far {
  double distance_mm;
  Point point;
};

/// The farthest first.
std::vector<Far> far_points(const BoundaryDistance& distance) {
  std::vector<Far> far;
  for (const FarPlace& place : distance.to_mesh.beyond) far.push_back({place.distance_mm, place.point});
  for (const FarPlace& place : distance.to_domain.beyond) far.push_back({0, place.nearest});
  std::stable_sort(far.begin(), far.end(), [](const Far& a, const Far& b) { return a.distance_mm > b.distance_mm; });
  return far;
}

/// The points that are nearer to a vertex on the domain's boundary than to any facet: that vertex has none.
std::vector<Point> in_vain(const std::vector<Far>& far, const MeshResult& mesh, double limit_mm) {
  std::vector<Point> on_boundary;
  for (std::size_t i = 0; i < mesh.sample.size(); ++i) {
    if (mesh.sample_dimensions[i] < 3) on_boundary.push_back(mesh.sample[i]);
  }
  constexpr double kNearer = 0.9;
  const PointGrid vertices(on_boundary, limit_mm);
  std::vector<Point> found;
  for (const Far& f : far) {
    const auto any = [](std::uint32_t, const Point&, double) { return true; };
    if (vertices.any_near(f.point, kNearer * f.distance_mm, any)) found.push_back(f.point);
  }
  return found;
}

}  // namespace

std::vector<Point> nearer_points(const Domain& domain, const BoundaryDistance& distance, const MeshResult& mesh,
                                 int round) {
  constexpr double kApart = 3;          // times the limit, in the first round
  constexpr double kClosest = 0.25;     // of a cell
  constexpr double kMostPoints = 0.25;  // of the vertices, in a round
  const double limit_mm = distance.limit_mm.value_or(1);
  const std::vector<Far> far = far_points(distance);
  ApartPoints apart(kApart * std::ldexp(limit_mm, -round));
  for (const Far& f : far) apart.offer(f.point);
  std::vector<Point> points = apart.take();
  const double share = std::max(std::ldexp(1, -round - 1), kClosest);
  const std::vector<Point> closer = boundary_points_near(domain, in_vain(far, mesh, limit_mm), share);
  points.insert(points.end(), closer.begin(), closer.end());
  const auto most = static_cast<std::size_t>(kMostPoints * static_cast<double>(mesh.sample.size()));
  points.resize(std::min(points.size(), most));
  return points;
}

}  // namespace scantet
