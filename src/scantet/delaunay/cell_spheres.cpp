// A cell keeps its circumcentre c and two squared distances from it, so that nearly all conflict tests are one
// subtraction, one product and two comparisons. These are right in spite of rounding. For any c, q is inside the sphere
// through the vertices p_i if and only if |q-c|² < Σ λ_i(q) |p_i-c|², where λ are the barycentric coordinates of q. If
// all |p_i-c|² are within δ of R², the sum is within δ·Σ|λ_i(q)| of R². And Σ|λ_i(q)| ≤ (|q-c| + R)·S, where S is the
// sum of the inverse heights, as the plane of each facet meets the ball. Hence q is outside if |q-c| > R + δS, and
// inside if |q-c| < R - δS.
//
// Where vertices have weights, |p_i-c|² - w_i stands for |p_i-c|², and R² may be less than nothing; S is that of the
// ball with the radius ϱ around c that holds the vertices, and in place of (|q-c| + R)·S there is 3ϱS for q within 2ϱ
// of c. Of a point farther away than that δS(|q-c| + ϱ) is less than |q-c|² - R², if δS is less than ϱ/2.
//
// Many spheres are computed side by side with vector instructions, to the same bits as one by one.
#include <cassert>
#include <limits>
#include <span>

#include "scantet/base/sanitizers.h"
#include "scantet/delaunay/circumcentre.h"
#include "scantet/delaunay/triangulation_impl.h"

namespace scantet::engine {
namespace {

constexpr std::size_t kLanes = 8;
using Lane = std::array<double, kLanes>;

/// Several tets, coordinate by coordinate.
struct TetLanes {
  std::array<Lane, 4> x;
  std::array<Lane, 4> y;
  std::array<Lane, 4> z;
};

struct SphereLanes {
  Lane x, y, z;  // of the circumcentre
  Lane nearest;  // squared distance of the vertices from it
  Lane farthest;
  Lane determinant;    // of either sign
  Lane largest_value;  // that the determinant could have, squared
};

/// quick_orthocentre() without weights and the distances from it, operation by operation, without its test for flat
/// tets.
#if defined(__x86_64__) && defined(__gnu_linux__) && !defined(SCANTET_IS_SANITIZED)
__attribute__((target_clones("avx2", "default")))
#endif
void measure(const TetLanes& p, SphereLanes& s) {
  for (std::size_t i = 0; i < kLanes; ++i) {
    const double ax = p.x[1][i] - p.x[0][i], ay = p.y[1][i] - p.y[0][i], az = p.z[1][i] - p.z[0][i];
    const double bx = p.x[2][i] - p.x[0][i], by = p.y[2][i] - p.y[0][i], bz = p.z[2][i] - p.z[0][i];
    const double cx = p.x[3][i] - p.x[0][i], cy = p.y[3][i] - p.y[0][i], cz = p.z[3][i] - p.z[0][i];
    const double bcx = by * cz - bz * cy, bcy = bz * cx - bx * cz, bcz = bx * cy - by * cx;
    const double cax = cy * az - cz * ay, cay = cz * ax - cx * az, caz = cx * ay - cy * ax;
    const double abx = ay * bz - az * by, aby = az * bx - ax * bz, abz = ax * by - ay * bx;
    const double det = ax * bcx + ay * bcy + az * bcz;
    const double aa = ax * ax + ay * ay + az * az;
    const double bb = bx * bx + by * by + bz * bz;
    const double cc = cx * cx + cy * cy + cz * cz;
    const double half = 0.5 / det;
    s.x[i] = p.x[0][i] + half * (aa * bcx + bb * cax + cc * abx);
    s.y[i] = p.y[0][i] + half * (aa * bcy + bb * cay + cc * aby);
    s.z[i] = p.z[0][i] + half * (aa * bcz + bb * caz + cc * abz);
    double nearest = std::numeric_limits<double>::infinity();
    double farthest = 0;
    for (std::size_t k = 0; k < 4; ++k) {
      const double dx = p.x[k][i] - s.x[i], dy = p.y[k][i] - s.y[i], dz = p.z[k][i] - s.z[i];
      const double squared = dx * dx + dy * dy + dz * dz;
      nearest = squared < nearest ? squared : nearest;
      farthest = squared > farthest ? squared : farthest;
    }
    s.nearest[i] = nearest;
    s.farthest[i] = farthest;
    s.determinant[i] = det;
    s.largest_value[i] = aa * bb * cc;
  }
}

/// Sets the squared distances up to which, and from which on, it is certain where a point is. The vertices of the
/// sphere have squared distances from `nearest` to `farthest` from its circumcentre. determinant: of either sign.
void keep_sphere(Cell& cell, double nearest, double farthest, double determinant) {
  // No triangle in the sphere has an area of more than 3√3/4 R², so the inverse heights sum up to 11 R² / determinant
  // at most.
  constexpr double kInverseHeights = 22;  // twice that, for the rounding of the determinant
  constexpr double kRounding = 2e-15;     // of a squared distance
  constexpr double kMargin = 4e-7;        // more than the rounding to a float and twice kLittle
  const double off = 0.5 * (farthest - nearest) + kRounding * farthest;
  const double doubt = off * kInverseHeights;  // times R / determinant: δS / R
  constexpr double kLittle = 1e-8;
  double inside = (1 - kMargin) * farthest;
  double outside = (1 + kMargin) * farthest;
  if (!(doubt * doubt * farthest < kLittle * kLittle * determinant * determinant)) {  // true also for NaN
    const double share = doubt * std::sqrt(farthest) / std::abs(determinant);
    const bool hopeless = !(share < 0.5) || !(farthest < 1e30);
    inside = hopeless ? -1 : inside * (1 - share) * (1 - share);
    outside = hopeless ? std::numeric_limits<double>::infinity() : outside * (1 + share) * (1 + share);
  }
  cell.surely_inside = static_cast<float>(inside);
  cell.surely_outside = static_cast<float>(outside);
  assert(cell.surely_inside < cell.surely_outside);
}

/// Computes the sphere of one tet of any shape.
void find_sphere_of(Cell& cell, const std::array<Point, 4>& points) {
  double determinant = 0;
  cell.circumcentre =
      quick_orthocentre({{{points[0], 0}, {points[1], 0}, {points[2], 0}, {points[3], 0}}}, determinant);
  double nearest = std::numeric_limits<double>::infinity();
  double farthest = 0;
  for (const Point& p : points) {
    const double squared = squared_distance(p, cell.circumcentre);
    nearest = std::min(nearest, squared);
    farthest = std::max(farthest, squared);
  }
  keep_sphere(cell, nearest, farthest, determinant);
}

/// The same of a tet of weighted points.
void find_orthosphere_of(Cell& cell, const std::array<WeightedPoint, 4>& points) {
  constexpr double kInverseHeights = 22;  // as in keep_sphere()
  constexpr double kRounding = 4e-15;
  constexpr double kMargin = 4e-7;
  double determinant = 0;
  cell.circumcentre = quick_orthocentre(points, determinant);
  double least = std::numeric_limits<double>::infinity();
  double most = -least;
  double farthest = 0;  // ϱ²
  for (const WeightedPoint& p : points) {
    const double squared = squared_distance(p.point, cell.circumcentre);
    least = std::min(least, squared - p.weight);
    most = std::max(most, squared - p.weight);
    farthest = std::max(farthest, squared);
  }
  const double off = 0.5 * (most - least) + kRounding * farthest;
  const double share = off * kInverseHeights * std::sqrt(farthest) / determinant;  // δS / ϱ
  const bool hopeless = !(share < 0.1) || !(farthest < 1e30);
  const double doubt = 3 * share * farthest + kMargin * farthest;
  cell.surely_inside = static_cast<float>(hopeless ? -std::numeric_limits<double>::infinity() : least - doubt);
  cell.surely_outside = static_cast<float>(hopeless ? std::numeric_limits<double>::infinity() : most + doubt);
}

}  // namespace

template <class PointsOf>
void Triangulation::find_spheres_of(std::span<const CellId> cells, PointsOf points_of_cell) {
  std::array<std::array<Point, 4>, kLanes> points;
  TetLanes tets;
  SphereLanes spheres;
  for (std::size_t begin = 0; begin < cells.size(); begin += kLanes) {
    const std::size_t count = std::min(kLanes, cells.size() - begin);
    for (std::size_t i = 0; i < kLanes; ++i) {
      if (i < count) points[i] = points_of_cell(cells[begin + i]);
      const std::array<Point, 4>& p = points[std::min(i, count - 1)];
      for (std::size_t k = 0; k < 4; ++k) {
        tets.x[k][i] = p[k].x;
        tets.y[k][i] = p[k].y;
        tets.z[k][i] = p[k].z;
      }
    }
    measure(tets, spheres);
    for (std::size_t i = 0; i < count; ++i) {
      Cell& cell = cells_[cells[begin + i]];
      if (may_have_weight(cells[begin + i])) {
        std::array<WeightedPoint, 4> weighted = weighted_points_of(cells[begin + i]);
        sort_points(weighted);
        find_orthosphere_of(cell, weighted);
        continue;
      }
      const double determinant = spheres.determinant[i];
      if (determinant * determinant > kFlat * kFlat * spheres.largest_value[i]) {
        cell.circumcentre = {spheres.x[i], spheres.y[i], spheres.z[i]};
        keep_sphere(cell, spheres.nearest[i], spheres.farthest[i], determinant);
      } else {
        find_sphere_of(cell, points[i]);
      }
    }
  }
}

void Triangulation::find_spheres(std::span<const CellId> cells) {
  find_spheres_of(cells, [&](CellId c) { return points_of(c); });
}

void Triangulation::find_lasting_spheres(std::span<const CellId> cells) {
  const auto sorted_points_of = [&](CellId c) {
    std::array<Point, 4> points = points_of(c);
    sort_points(points);
    return points;
  };
  find_spheres_of(cells, sorted_points_of);
  for (const CellId c : cells) {
    if (!std::isnan(cells_[c].circumcentre.x)) continue;
    cells_[c].circumcentre = may_have_weight(c) ? orthocentre(weighted_points_of(c)) : circumcentre(points_of(c));
  }
}

}  // namespace scantet::engine
