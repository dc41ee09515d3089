#include "scantet/domain/noise.h"

#include <cstdint>

namespace scantet {

bool is_noise(const Domain& domain, const SizingField& size) {
  constexpr std::uint64_t kMany = 50'000;
  std::uint64_t count = 0;
  double filled_mm3 = 0;  // by a cube for each
  domain.size_hints([&](const SizeHint& hint) {
    const double side_mm = size.size_at(hint.point);
    filled_mm3 += side_mm * side_mm * side_mm;
    ++count;
  });
  const Vec extent = domain.bounds().extent();
  return count > kMany && filled_mm3 > extent.x * extent.y * extent.z;
}

}  // namespace scantet
