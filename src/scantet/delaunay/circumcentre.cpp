// Circumcentres are orthocentres of points without weights, to the last bit.
#include "scantet/delaunay/circumcentre.h"

#include <algorithm>
#include <cmath>

#include "scantet/delaunay/orthosphere.h"

namespace scantet::engine {

Point circumcentre(std::array<Point, 4> t) {
  return orthocentre({{{t[0], 0}, {t[1], 0}, {t[2], 0}, {t[3], 0}}});
}

Point circumcentre(const Point& p, const Point& q, const Point& r) {
  return orthocentre({p, 0}, {q, 0}, {r, 0});
}

double radius_edge(const Point& a, const Point& b, const Point& c) {
  const double ab = squared_distance(a, b);
  const double bc = squared_distance(b, c);
  const double ca = squared_distance(c, a);
  const double twice_area = length(cross(b - a, c - a));
  const double shortest = std::sqrt(std::min({ab, bc, ca}));
  return std::sqrt(ab) * std::sqrt(bc) * std::sqrt(ca) / (2 * twice_area * shortest);
}

double squared_shortest_edge(const std::array<Point, 4>& t) {
  return std::min({squared_distance(t[0], t[1]), squared_distance(t[0], t[2]), squared_distance(t[0], t[3]),
                   squared_distance(t[1], t[2]), squared_distance(t[1], t[3]), squared_distance(t[2], t[3])});
}

}  // namespace scantet::engine
