// The darts go in batches, each about as large as all before it. First the darts of a batch that are too near a kept
// dart are dropped, in parallel; that is nearly all of them once the space is full. The others are settled among
// themselves in rounds: a dart is dropped when an earlier one too near it is kept, and kept when all earlier ones too
// near it are dropped. Neither the batches nor the rounds change what is kept: each dart's fate follows from those of
// the earlier ones.
#include <array>
#include <atomic>
#include <numeric>
#include <optional>

#include "scantet/base/parallel.h"
#include "scantet/base/point_grid_impl.h"
#include "scantet/sampling/dart_throwing_impl.h"

namespace scantet::engine {
namespace {

constexpr std::size_t kGrain = 512;
constexpr std::size_t kBatches = 5;

enum class Fate : std::uint8_t { open, kept, dropped };
using Indices = std::vector<std::uint32_t>;

bool earlier(const Dart& a, const Dart& b) {
  return a.turn != b.turn ? a.turn < b.turn : lexicographically_less(a.point, b.point);
}

constexpr std::size_t kProbes = 1024;  // darts that stand for all of them; some may be the same

/// A radius in the middle of those of the darts: rows of that width suit most searches.
double middle_radius(std::span<const Dart> darts) {
  if (darts.empty()) return 0;
  std::vector<double> radii;
  for (std::size_t i = 0; i < kProbes; ++i) radii.push_back(darts[i * darts.size() / kProbes].radius_mm);
  std::nth_element(radii.begin(), radii.begin() + kProbes / 2, radii.end());
  return radii[kProbes / 2];
}

/// The darts in batches by turn, within a batch in the order they have: the first batch has about 1/16 of them, each
/// further one as many as all before it.
std::array<Indices, kBatches> batches(std::span<const Dart> darts) {
  std::vector<std::uint64_t> turns;
  for (std::size_t i = 0; i < kProbes; ++i) turns.push_back(darts[i * darts.size() / kProbes].turn);
  std::sort(turns.begin(), turns.end());
  const std::array<std::uint64_t, kBatches - 1> ends{turns[kProbes / 16], turns[kProbes / 8], turns[kProbes / 4],
                                                     turns[kProbes / 2]};
  constexpr std::size_t kPiece = 16384;
  using Piece = std::array<Indices, kBatches>;
  std::vector<Piece> pieces((darts.size() + kPiece - 1) / kPiece);
  parallel_for(darts.size(), kPiece, [&](std::size_t begin, std::size_t end) {
    Piece piece;
    for (std::size_t i = begin; i < end; ++i) {
      const auto batch = std::lower_bound(ends.begin(), ends.end(), darts[i].turn) - ends.begin();
      piece[static_cast<std::size_t>(batch)].push_back(static_cast<std::uint32_t>(i));
    }
    pieces[begin / kPiece] = std::move(piece);
  });
  Piece result;
  for (std::size_t batch = 0; batch < kBatches; ++batch) {
    for (const Piece& piece : pieces) {
      result[batch].insert(result[batch].end(), piece[batch].begin(), piece[batch].end());
    }
  }
  return result;
}

/// Leaves those of the batch that are not too near a kept dart.
std::vector<Dart> free_of(std::span<const Dart> kept, std::span<const Dart> darts, double share, const Indices& batch) {
  const PointGrid grid(points_of(kept), share * middle_radius(darts));
  const auto collect = [&](std::size_t begin, std::size_t end, std::vector<Dart>& free) {
    std::optional<Point> last;  // the kept dart that was too near: darts come cell by cell, so it often is again
    for (std::size_t i = begin; i < end; ++i) {
      const Dart& dart = darts[batch[i]];
      const double reach = share * dart.radius_mm;
      if (last && squared_distance(*last, dart.point) < reach * reach) continue;
      const auto remember = [&](std::uint32_t, const Point& p, double) {
        last = p;
        return true;
      };
      if (!grid.any_near(dart.point, reach, remember)) free.push_back(dart);
    }
  };
  return parallel_collect<Dart>(batch.size(), kGrain, collect);
}

/// Whether the darts have very many others within their reach, on average of some of them.
bool is_crowded(const PointGrid& grid, std::span<const Dart> darts, double share) {
  constexpr std::size_t kLooks = 64;
  constexpr std::size_t kMany = 2048;  // a sample of one size has some twenty, one next to much smaller sizes hundreds
  if (darts.size() <= kMany) return false;
  std::size_t seen = 0;
  for (std::size_t i = 0; i < kLooks; ++i) {
    const Dart& dart = darts[i * darts.size() / kLooks];
    grid.any_near(dart.point, share * dart.radius_mm,
                  [&](std::uint32_t, const Point&, double) { return ++seen > kLooks * kMany; });
  }
  return seen > kLooks * kMany;
}

/// Takes an eighth of the darts, or a little less, out of them: those whose turn is first. Takes none if too many have
/// the same turn.
std::vector<Dart> take_first(std::vector<Dart>& darts) {
  std::vector<std::uint64_t> turns;
  turns.reserve(darts.size());
  for (const Dart& dart : darts) turns.push_back(dart.turn);
  const auto eighth = turns.begin() + static_cast<std::ptrdiff_t>(turns.size() / 8);
  std::nth_element(turns.begin(), eighth, turns.end());
  const auto rest =
      std::stable_partition(darts.begin(), darts.end(), [&](const Dart& dart) { return dart.turn < *eighth; });
  std::vector<Dart> first(darts.begin(), rest);
  darts.erase(darts.begin(), rest);
  return first;
}

/// Leaves those of the darts that are kept when they are thrown alone. Of a crowd the first are settled first: few of
/// the others are left then.
void settle(std::vector<Dart>& darts, double share) {
  const PointGrid grid(points_of(darts), share * middle_radius(darts));
  if (is_crowded(grid, darts, share)) {
    std::vector<Dart> first = take_first(darts);
    if (!first.empty()) {
      settle(first, share);
      Indices all(darts.size());
      std::iota(all.begin(), all.end(), 0U);
      darts = free_of(first, darts, share, all);
      settle(darts, share);
      darts.insert(darts.begin(), first.begin(), first.end());
      return;
    }
  }
  std::vector<std::atomic<Fate>> fates(darts.size());
  Indices open;  // in the grid's order: what is visited together is in the cache together
  for (const PointGrid::Entry& entry : grid.entries()) open.push_back(entry.index);
  while (!open.empty()) {
    const auto decide = [&](std::size_t begin, std::size_t end, Indices& still_open) {
      for (std::size_t k = begin; k < end; ++k) {
        const std::uint32_t i = open[k];
        Fate fate = Fate::kept;
        grid.any_near(darts[i].point, share * darts[i].radius_mm, [&](std::uint32_t j, const Point&, double) {
          // Of two that are alike in turn and point, the first in the vector goes first.
          if (earlier(darts[i], darts[j]) || (j >= i && !earlier(darts[j], darts[i]))) return false;
          const Fate other = fates[j].load(std::memory_order_relaxed);
          if (other == Fate::kept) fate = Fate::dropped;
          if (other == Fate::open) fate = Fate::open;
          return other == Fate::kept;
        });
        fates[i].store(fate, std::memory_order_relaxed);
        if (fate == Fate::open) still_open.push_back(i);
      }
    };
    open = parallel_collect<std::uint32_t>(open.size(), kGrain, decide);
  }
  std::size_t kept = 0;
  for (std::size_t i = 0; i < darts.size(); ++i) {
    if (fates[i].load(std::memory_order_relaxed) == Fate::kept) darts[kept++] = darts[i];
  }
  darts.resize(kept);
}

}  // namespace

std::vector<Point> points_of(std::span<const Dart> darts) {
  std::vector<Point> points;
  points.reserve(darts.size());
  for (const Dart& dart : darts) points.push_back(dart.point);
  return points;
}

LargeVector<Dart> throw_darts(std::span<const Dart> darts, double share) {
  LargeVector<Dart> kept;
  if (darts.empty()) return kept;
  kept.reserve(darts.size());  // memory that is not written costs nothing; growing does
  for (const Indices& batch : batches(darts)) {
    std::vector<Dart> free = free_of(kept, darts, share, batch);
    settle(free, share);
    kept.insert(kept.end(), free.begin(), free.end());
  }
  parallel_sort(kept, earlier);
  return kept;
}

}  // namespace scantet::engine
