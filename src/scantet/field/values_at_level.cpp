// Rows in pieces, on all threads. Around its saddle the field on a face is level + k u v, for k the sum of the four
// heights off the level; at a level moved by d its two branches are 2 sqrt(2 d / k) apart, in voxels.
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
/// The same where the level itself is between values: nearer, as no voxel is at it.
constexpr double kMostOffSaddles = 0.24;
/// Of the branches of the level set, voxels.
constexpr double kApartAtSaddles = 0.2;

struct Piece {
  std::int64_t voxels = 0;
  std::int64_t gaps = 0;
  std::int64_t saddles = 0;
  double heights = 0;                                    ///< of the corners of those saddles, off the level, in all
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
      count_saddles(first + i, {i, j, k}, height, piece);
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

  /// Of the three faces whose least corner the voxel is.
  void count_saddles(const T* voxel, const std::array<int, 3>& at, double height, Piece& piece) const {
    std::array<std::int64_t, 3> step{1, size_[0], std::int64_t{size_[0]} * size_[1]};
    std::array<double, 3> beside{};  // heights with the other sign; 0: there is none
    for (int axis = 0; axis < 3; ++axis) {
      if (at[axis] == size_[axis] - 1) continue;
      const double next = height_of(voxel[step[axis]]);
      if (height * next < 0) beside[axis] = next;
    }
    for (int a = 0; a < 2; ++a) {
      for (int b = a + 1; b < 3; ++b) {
        if (beside[a] == 0 || beside[b] == 0) continue;
        const double across = height_of(voxel[step[a] + step[b]]);
        const double product = height * across;
        if (product <= 0 || !std::isfinite(product) || product != beside[a] * beside[b]) continue;
        ++piece.saddles;
        piece.heights += std::abs(height) + std::abs(across) + std::abs(beside[a]) + std::abs(beside[b]);
      }
    }
  }

  const T* values_;
  std::array<int, 3> size_;
  double level_;
  double sign_;
};

/// From the level to a clear one, on the inside.
double way_to_clear(const Piece& found) {
  if (!std::isfinite(found.off)) return 0;
  if (found.voxels > 0) return kClearShare * found.off;
  if (found.saddles == 0) return 0;
  const double mean = found.heights / static_cast<double>(found.saddles);
  return std::min(kApartAtSaddles * kApartAtSaddles / 8 * mean, kMostOffSaddles * found.off);
}

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
  Piece all;
  for (const Piece& piece : pieces) {
    all.voxels += piece.voxels;
    all.gaps += piece.gaps;
    all.saddles += piece.saddles;
    all.heights += piece.heights;
    all.off = std::min(all.off, piece.off);
  }
  return {all.voxels, all.gaps, all.saddles, level + (side == InsideSide::above ? 1 : -1) * way_to_clear(all)};
}

}  // namespace scantet
