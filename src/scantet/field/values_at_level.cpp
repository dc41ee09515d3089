// Rows in pieces, on all threads.
#include "scantet/field/values_at_level.h"

#include <array>
#include <vector>

#include "scantet/base/parallel.h"
#include "scantet/field/at_level_count.h"

namespace scantet {
namespace {

constexpr std::size_t kRowsPerPiece = 1024;
template <class T>
class Rows {
 public:
  Rows(const T* values, const Scan& scan, double level, InsideSide side)
      : values_(values), size_(scan.size), level_(level), sign_(side == InsideSide::above ? 1 : -1) {}

  void count(std::size_t row, AtLevelCount& count) const {
    const int j = static_cast<int>(row % static_cast<std::size_t>(size_[1]));
    const int k = static_cast<int>(row / static_cast<std::size_t>(size_[1]));
    const std::int64_t layer = std::int64_t{size_[0]} * size_[1];
    const T* voxel = values_ + row * static_cast<std::size_t>(size_[0]);
    for (int i = 0; i < size_[0]; ++i, ++voxel) {
      const auto height = [&](int x, int y, int z) {
        return height_of(voxel[x + std::int64_t{size_[0]} * y + layer * z]);
      };
      count.add_value(height(0, 0, 0), 1);
      count.add_node({i, j, k}, {}, size_, height);
    }
  }

 private:
  double height_of(T value) const { return sign_ * (static_cast<double>(value) - level_); }

  const T* values_;
  std::array<int, 3> size_;
  double level_;
  double sign_;
};

}  // namespace

ValuesAtLevel values_at_level(const Scan& scan, double level, InsideSide side) {
  const auto rows = static_cast<std::size_t>(scan.voxel_count() / scan.size[0]);
  std::vector<AtLevelCount> pieces((rows + kRowsPerPiece - 1) / kRowsPerPiece);
  std::visit(
      [&](const auto* values) {
        const Rows counter(values, scan, level, side);
        parallel_for(rows, kRowsPerPiece, [&](std::size_t begin, std::size_t end) {
          for (std::size_t row = begin; row < end; ++row) counter.count(row, pieces[begin / kRowsPerPiece]);
        });
      },
      scan.voxels);
  AtLevelCount all;
  for (const AtLevelCount& piece : pieces) all.add(piece);
  return all.values_at(level, side);
}

}  // namespace scantet
