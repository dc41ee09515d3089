#include "scantet/size_options/vertex_estimate.h"

namespace scantet {

double vertices_of_size(const Domain& domain, double size_mm) {
  constexpr double kShareOfBox = 0.05;
  double volume_mm3 = 0;
  for (const Component& component : domain.components()) {
    if (component.region != kOutside) volume_mm3 += component.volume_mm3;
  }
  if (volume_mm3 == 0) {
    const Vec extent = domain.bounds().extent();
    volume_mm3 = kShareOfBox * extent.x * extent.y * extent.z;
  }
  return volume_mm3 / size_mm / size_mm / size_mm;
}

double vertices_inside(const Domain& domain, const SizingField& size) {
  constexpr int kCells = 40;  // along each axis
  const Box bounds = domain.bounds();
  const Vec cell = (1.0 / kCells) * bounds.extent();
  double vertices = 0;
  for (int n = 0; n < kCells * kCells * kCells; ++n) {
    const Vec place{n % kCells + 0.5, n / kCells % kCells + 0.5, n / kCells / kCells + 0.5};
    const Point p = bounds.min + Vec{place.x * cell.x, place.y * cell.y, place.z * cell.z};
    if (domain.region_at(p) == kOutside) continue;
    const double there = size.size_at(p);
    vertices += cell.x * cell.y * cell.z / (there * there * there);
  }
  return vertices;
}

double vertices_on_boundary(const std::vector<Cone>& sizes, double apart_mm) {
  double vertices = 0;
  for (const Cone& cone : sizes) vertices += apart_mm * apart_mm / (cone.height_mm * cone.height_mm);
  return vertices;
}

}  // namespace scantet
