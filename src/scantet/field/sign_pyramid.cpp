// The parts of the pyramid that do not depend on the voxel type.
#include "scantet/field/sign_pyramid.h"

namespace scantet {

void SignPyramid::keep_small_blocks(const std::vector<std::uint64_t>& any, const std::vector<std::uint64_t>& all, int z,
                                    int part) {
  // Gathers the even bits of each byte in its low half.
  const auto gathered = [](std::uint64_t bits) {
    bits = (bits | bits >> 1) & 0x3333333333333333;
    return (bits | bits >> 2) & 0x0F0F0F0F0F0F0F0F;
  };
  const std::size_t rows = std::size_t{4} * fine_counts_.counts[1];
  const std::size_t words = any.size() / rows;
  for (std::size_t at = 0; at < any.size(); ++at) {
    const std::size_t row = at / words;
    const std::size_t word = at % words;
    const std::uint64_t after = word + 1 < words ? any[at + 1] << 62 : 0;
    const std::uint64_t all_after = word + 1 < words ? all[at + 1] << 62 : 0;
    const std::uint64_t some = any[at] | any[at] >> 1 | any[at] >> 2 | after;
    const std::uint64_t full = all[at] & all[at] >> 1 & (all[at] >> 2 | all_after);
    const std::uint64_t even = 0x5555555555555555;
    std::uint64_t inside = gathered(full & even);
    std::uint64_t mixed = gathered(some & ~full & even);
    const int first = static_cast<int>(8 * word);
    BlockSigns* blocks = fine_.data() + fine_counts_.position(first, static_cast<int>(row / 4), z);
    const int count = std::min(8, fine_counts_.counts[0] - first);
    const std::size_t shift = 4 * (row % 4) + 16 * static_cast<std::size_t>(part);
    for (int x = 0; x < count; ++x, inside >>= 8, mixed >>= 8) {
      blocks[x].inside |= (inside & 0xF) << shift;
      blocks[x].mixed |= (mixed & 0xF) << shift;
    }
  }
}

void SignPyramid::build_coarse() {
  constexpr int kShift = kCoarseShift - kFineShift;
  std::vector<bool> seen(coarse_.size());
  std::size_t position = 0;
  for (int z = 0; z < fine_counts_.counts[2]; ++z) {
    for (int y = 0; y < fine_counts_.counts[1]; ++y) {
      for (int x = 0; x < fine_counts_.counts[0]; ++x) {
        const BlockSign sign = fine_[position++].whole();
        const std::size_t parent = coarse_counts_.position(x >> kShift, y >> kShift, z >> kShift);
        coarse_[parent] = !seen[parent] || coarse_[parent] == sign ? sign : BlockSign::mixed;
        seen[parent] = true;
      }
    }
  }
}

}  // namespace scantet
