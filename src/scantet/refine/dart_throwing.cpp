// The darts go in batches, each as large as all before it. What of a batch is too near a kept dart is dropped first, in
// parallel; that is nearly everything once the space is full. The rest is settled among itself in rounds: a dart is
// dropped when an earlier one too near it is kept, and kept when all earlier ones too near it are dropped.
#include <atomic>

#include "scantet/base/parallel.h"
#include "scantet/refine/dart_throwing_impl.h"
#include "scantet/refine/point_grid_impl.h"

namespace scantet::refine {
namespace {

constexpr std::size_t kFirstBatch = 4096;
constexpr std::size_t kGrain = 512;

enum class Fate : std::uint8_t { open, kept, dropped };

/// Darts that are settled among themselves: `batch` are indices of darts, ascending, of which the kept ones stay.
void settle(const std::vector<Dart>& darts, double share, std::vector<std::uint32_t>& batch) {
  std::vector<Point> points;
  double widest_mm = 0;
  for (std::uint32_t dart : batch) {
    points.push_back(darts[dart].point);
    widest_mm = std::max(widest_mm, darts[dart].radius_mm);
  }
  const PointGrid grid(points, share * widest_mm);
  std::vector<std::atomic<Fate>> fates(batch.size());
  // In the grid's order: what is visited together is in the cache together.
  std::vector<std::uint32_t> open;
  for (const PointGrid::Entry& entry : grid.entries()) open.push_back(entry.index);
  while (!open.empty()) {
    parallel_for(open.size(), kGrain, [&](std::size_t begin, std::size_t end) {
      for (std::size_t k = begin; k < end; ++k) {
        const std::uint32_t i = open[k];
        Fate fate = Fate::kept;
        grid.any_near(points[i], share * darts[batch[i]].radius_mm, [&](std::uint32_t j, const Point&, double) {
          if (j >= i) return false;
          const Fate other = fates[j].load(std::memory_order_relaxed);
          if (other == Fate::kept) fate = Fate::dropped;
          if (other == Fate::open) fate = Fate::open;
          return other == Fate::kept;
        });
        fates[i].store(fate, std::memory_order_relaxed);
      }
    });
    std::erase_if(open, [&](std::uint32_t i) { return fates[i].load(std::memory_order_relaxed) != Fate::open; });
  }
  std::size_t kept = 0;
  for (std::size_t i = 0; i < batch.size(); ++i) {
    if (fates[i].load(std::memory_order_relaxed) == Fate::kept) batch[kept++] = batch[i];
  }
  batch.resize(kept);
}

}  // namespace

std::vector<Dart> throw_darts(const std::vector<Dart>& darts, double share) {
  std::vector<Dart> kept;
  std::vector<Point> points;
  std::vector<std::uint8_t> free;
  std::vector<std::uint32_t> batch;
  for (std::size_t begin = 0, end = 0; begin < darts.size(); begin = end) {
    end = std::min(darts.size(), std::max(begin + kFirstBatch, 2 * begin));
    double widest_mm = 0;
    for (std::size_t i = begin; i < end; ++i) widest_mm = std::max(widest_mm, darts[i].radius_mm);
    const PointGrid grid(points, share * widest_mm);
    free.assign(end - begin, 0);
    parallel_for(end - begin, kGrain, [&](std::size_t from, std::size_t to) {
      for (std::size_t i = from; i < to; ++i) {
        const Dart& dart = darts[begin + i];
        const bool hit =
            grid.any_near(dart.point, share * dart.radius_mm, [](std::uint32_t, const Point&, double) { return true; });
        free[i] = hit ? 0 : 1;
      }
    });
    batch.clear();
    for (std::size_t i = begin; i < end; ++i) {
      if (free[i - begin] != 0) batch.push_back(static_cast<std::uint32_t>(i));
    }
    settle(darts, share, batch);
    for (std::uint32_t i : batch) {
      kept.push_back(darts[i]);
      points.push_back(darts[i].point);
    }
  }
  return kept;
}

}  // namespace scantet::refine
