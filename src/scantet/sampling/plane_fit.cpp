// The adjugate of the covariance matrix has the same eigenvectors, and the product of the two large eigenvalues belongs
// to the normal. So any start, multiplied by it a few times, turns to the normal.
#include "scantet/sampling/plane_fit_impl.h"

namespace scantet::engine {

void PlaneFit::add(const Vec& offset, double weight) {
  ++count_;
  weight_ += weight;
  first_ = first_ + weight * offset;
  squares_ = squares_ + weight * Vec{offset.x * offset.x, offset.y * offset.y, offset.z * offset.z};
  products_ = products_ + weight * Vec{offset.y * offset.z, offset.z * offset.x, offset.x * offset.y};
}

std::optional<Vec> PlaneFit::normal() const {
  constexpr int kFewest = 4;
  constexpr double kThickest = 0.2;  // smallest eigenvalue over the middle one
  constexpr int kTurns = 4;
  if (count_ < kFewest) return std::nullopt;
  const Vec m = (1 / weight_) * first_;
  const Vec s = (1 / weight_) * squares_ - Vec{m.x * m.x, m.y * m.y, m.z * m.z};
  const Vec p = (1 / weight_) * products_ - Vec{m.y * m.z, m.z * m.x, m.x * m.y};
  const std::array<Vec, 3> adjugate{{{s.y * s.z - p.x * p.x, p.x * p.y - p.z * s.z, p.z * p.x - p.y * s.y},
                                     {p.x * p.y - p.z * s.z, s.x * s.z - p.y * p.y, p.y * p.z - p.x * s.x},
                                     {p.z * p.x - p.y * s.y, p.y * p.z - p.x * s.x, s.x * s.y - p.z * p.z}}};
  const double areas = adjugate[0].x + adjugate[1].y + adjugate[2].z;
  const double trace = s.x + s.y + s.z;
  const double determinant = s.x * adjugate[0].x + p.z * adjugate[0].y + p.y * adjugate[0].z;
  // λ1λ2λ3·(λ1 + …) over (λ1λ2 + …)² is λ3/λ2 where λ3 is small, and at least a third where all three are alike. It is
  // 0/0 for points on a line.
  if (!(areas > 1e-9 * trace * trace && determinant * trace < kThickest * areas * areas)) return std::nullopt;
  Vec normal = adjugate[0].x > adjugate[1].y ? adjugate[0] : adjugate[1];
  if (adjugate[2].z > std::max(adjugate[0].x, adjugate[1].y)) normal = adjugate[2];
  for (int i = 0; i < kTurns; ++i) {
    normal = (1 / length(normal)) * normal;
    normal = {dot(adjugate[0], normal), dot(adjugate[1], normal), dot(adjugate[2], normal)};
  }
  return (1 / length(normal)) * normal;
}

}  // namespace scantet::engine
