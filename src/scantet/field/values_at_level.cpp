// Rows in pieces, on all threads; neighbours are looked at where a voxel is at the level alone.
#include "scantet/field/values_at_level.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "scantet/base/parallel.h"

namespace scantet {
namespace {

constexpr std::size_t kRowsPerPiece = 1024;
/// Of the way from the level to the nearest value on the inside. No simple share: saddles between whole numbers often
/// are half way, and there parts touch at points as they do at the level itself.
constexpr double kClearShare = 0.38;

struct Piece {
  std::int64_t voxels = 0;
  std::int64_t gaps = 0;
  double off = std::numeric_limits<double>::infinity();  ///< of the nearest value on the inside, from the level
};

template <class T>
class Rows {
 public:
  Rows(const T* values, const Scan& scan, double level, InsideSide side)
      : values_(values), size_(scan.size), level_(level), sign_(side == InsideSide::above ? 1 : -1) {}

  void count(std::size_t row, Piece& piece) const {
    const int j = static_cast<int>(row % static_cast<std::size_t>(size_[1]));
    const int k = static_cast<int>(row / static_cast<std::size_t>(size_[1]));
    const T* first = values_ + row * static_cast<std::size_t>(size_[0]);
    for (int i = 0; i < size_[0]; ++i) {
      const double height = height_of(first[i]);
      if (height > 0 && height < piece.off) piece.off = height;
      if (height != 0) continue;
      ++piece.voxels;
      if (is_gap(first + i, {i, j, k})) ++piece.gaps;
    }
  }

 private:
  double height_of(T value) const { return sign_ * (static_cast<double>(value) - level_); }

  bool is_gap(const T* voxel, const std::array<int, 3>& at) const {
    std::int64_t step = 1;
    for (int axis = 0; axis < 3; step *= size_[axis], ++axis) {
      if (at[axis] == 0 || at[axis] == size_[axis] - 1) continue;
      if (height_of(voxel[-step]) > 0 && height_of(voxel[step]) > 0) return true;
    }
    return false;
  }

  const T* values_;
  std::array<int, 3> size_;
  double level_;
  double sign_;
};

}  // namespace

ValuesAtLevel values_at_level(const Scan& scan, double level, InsideSide side) {
  const auto rows = static_cast<std::size_t>(scan.voxel_count() / scan.size[0]);
  std::vector<Piece> pieces((rows + kRowsPerPiece - 1) / kRowsPerPiece);
  std::visit(
      [&](const auto* values) {
        const Rows counter(values, scan, level, side);
        parallel_for(rows, kRowsPerPiece, [&](std::size_t begin, std::size_t end) {
          for (std::size_t row = begin; row < end; ++row) counter.count(row, pieces[begin / kRowsPerPiece]);
        });
      },
      scan.voxels);
  ValuesAtLevel found;
  double off = std::numeric_limits<double>::infinity();
  for (const Piece& piece : pieces) {
    found.voxels += piece.voxels;
    found.gaps += piece.gaps;
    off = std::min(off, piece.off);
  }
  const bool known = found.voxels > 0 && std::isfinite(off);
  found.clear_level = known ? level + (side == InsideSide::above ? kClearShare : -kClearShare) * off : level;
  return found;
}

}  // namespace scantet
