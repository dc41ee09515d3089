// Everything follows from three edge vectors, their determinant and the four face normals (of twice the face's area).
// Angles come from sine and cosine, as atan2 has it, which keeps its digits at 0° and 180° where acos loses half of
// them.
#include "scantet/quality/measures.h"

#include <numbers>

#include "scantet/base/symmetric_matrix.h"
#include "scantet/quality/angles_impl.h"

namespace scantet {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kDegrees = 180.0 / 3.14159265358979323846;

// The angle whose sine and cosine are in this proportion. Adding zero turns -0 into 0: no direction at all counts as
// 0°.
double angle_deg(double sine, double cosine) {
  return kDegrees * std::atan2(sine, cosine + 0.0);
}

// The largest product of the three edges at a corner.
double largest_corner(const std::array<double, 6>& edge) {
  return std::max(std::max(edge[0] * edge[1] * edge[2], edge[0] * edge[3] * edge[4]),
                  std::max(edge[1] * edge[3] * edge[5], edge[2] * edge[4] * edge[5]));
}

}  // namespace

double stiffness_ratio(const Point& p, const Point& q, const Point& r, const Point& s) {
  const Vec a = q - p;
  const Vec b = r - p;
  const Vec c = s - p;
  const std::array<Vec, 4> normals{cross(r - q, s - q), cross(c, b), cross(a, c), cross(b, a)};
  const double size = std::abs(dot(a, cross(b, c)));  // 6 times the volume
  Vec squares;
  Vec products;
  for (const Vec& n : normals) {  // the gradient of a corner's shape function is the normal / size
    squares = squares + Vec{n.x * n.x, n.y * n.y, n.z * n.z};
    products = products + Vec{n.x * n.y, n.x * n.z, n.y * n.z};
  }
  const double scale = squares.x + squares.y + squares.z;  // the sum of the eigenvalues; so that no product overflows
  if (size == 0 || !(scale > 0)) return kInfinity;
  squares = (1 / scale) * squares;
  products = (1 / scale) * products;
  const double largest =
      scale * eigenvalue_form({squares.x, squares.y, squares.z, products.x, products.y, products.z}).largest();
  // Of the regular tet with edges of length √2 all eigenvalues of the sum above are 4 at a size of 2: 4 / 2^(4/3).
  const double regular = std::cbrt(4.0);
  const double edge = std::cbrt(size);
  const double ratio = largest / size / edge / regular;
  return std::isnan(ratio) ? kInfinity : std::max(1.0, ratio);
}

TetMeasures measure_tet(const Point& p, const Point& q, const Point& r, const Point& s) {
  const Vec a = q - p;
  const Vec b = r - p;
  const Vec c = s - p;
  const Vec bc = cross(b, c);
  const Vec ca = cross(c, a);
  const Vec ab = cross(a, b);
  const double det = dot(a, bc);
  const double size = std::abs(det);  // 6 times the volume
  const std::array<Vec, 4> outward{cross(r - q, s - q), -1.0 * bc, -1.0 * ca, -1.0 * ab};

  TetMeasures m{};
  m.volume_mm3 = det / 6;
  m.edge_mm = {length(a), length(b), length(c), distance(q, r), distance(q, s), distance(r, s)};
  std::array<double, 6> sines{};
  std::array<double, 6> cosines{};
  for (std::size_t i = 0; i < 6; ++i) {
    // The faces that meet at an edge are opposite to the ends of the opposite edge; |n1 x n2| = |edge| * size.
    const auto& [k, l] = kTetEdges[5 - i];
    sines[i] = m.edge_mm[i] * size;
    cosines[i] = -dot(outward[static_cast<std::size_t>(k)], outward[static_cast<std::size_t>(l)]);
  }
  m.dihedral_deg = angles_deg(sines, cosines);
  const Vec to_center = dot(a, a) * bc + dot(b, b) * ca + dot(c, c) * ab;  // 2 det times too long
  m.circumradius_mm = length(to_center) / (2 * size);
  if (size == 0 || m.circumradius_mm == 0) {  // zero if the products underflow
    m.circumradius_mm = m.radius_edge = kInfinity;
    return m;
  }
  m.circumcentre = p + Vec{to_center.x / (2 * det), to_center.y / (2 * det), to_center.z / (2 * det)};
  double surface = 0;  // twice the surface area
  double largest_face = 0;
  for (const Vec& normal : outward) {
    const double face = length(normal);
    surface += face;
    largest_face = std::max(largest_face, face);
  }
  m.radius_edge = m.circumradius_mm / *std::min_element(m.edge_mm.begin(), m.edge_mm.end());
  m.inverse_aspect = size / surface / m.circumradius_mm;
  m.scaled_jacobian = std::clamp(std::numbers::sqrt2 * det / largest_corner(m.edge_mm), -1.0, 1.0);  // rounding
  m.min_height_mm = size / largest_face;
  return m;
}

std::array<double, 3> triangle_angles_deg(const Point& a, const Point& b, const Point& c) {
  const double twice_area = length(cross(b - a, c - a));
  return {angle_deg(twice_area, dot(b - a, c - a)), angle_deg(twice_area, dot(a - b, c - b)),
          angle_deg(twice_area, dot(a - c, b - c))};
}

}  // namespace scantet
