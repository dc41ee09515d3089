// A biased randomised insertion order (Amenta, Choi, Rote: Incremental constructions con BRIO, 2003): random levels,
// each four times as large as those before, sorted along a curve in a level. The first points are inserted one by one.
// Then space is cut into parts, whose points are inserted side by side; a point whose conflict zone reaches over a cut
// waits for the next turn, when the cuts are elsewhere. The last few are inserted one by one again.
#include <atomic>
#include <bit>
#include <cassert>
#include <optional>

#include "scantet/base/coordinate_hash.h"
#include "scantet/base/morton_impl.h"
#include "scantet/base/parallel.h"
#include "scantet/delaunay/bulk_insertion_impl.h"
#include "scantet/delaunay/inserter_impl.h"
#include "scantet/delaunay/lattice_core_impl.h"
#include "scantet/delaunay/partition_impl.h"

namespace scantet::engine {
namespace {

constexpr std::size_t kGrain = 8192;          // points that are ordered at once
constexpr std::size_t kFew = 2000;            // fewer points are not worth a turn
constexpr std::size_t kFirst = 6000;          // points that are inserted before space is cut
constexpr std::size_t kLeastInPart = 6000;    // vertices in a part: fewer have too much surface for their volume
constexpr std::size_t kMostPerVertex = 3;     // points inserted in a turn per vertex there is
constexpr std::size_t kCellsPerPoint = 7;     // that an insertion adds in the mean, and a little more
constexpr std::size_t kCellsInPassing = 512;  // that one insertion may take before it gives back the tets it replaced

constexpr std::size_t kMostInTurn = 300'000;  // so that progress is seen
constexpr int kMostTurns = 8;                 // for points that still wait when all have had a turn

struct Place {
  std::uint64_t code;
  std::uint32_t index;
  std::uint32_t level;
};

constexpr std::uint32_t kLevels = 20;

/// The level of a point. A level has a fourth of the points of the next one.
std::uint32_t level_of(const Point& p) {
  const std::uint64_t h = hash_of_coordinates(p, {kUsualMixing.multiplier, 31});
  return kLevels - 1 - static_cast<std::uint32_t>(std::countr_zero(h | std::uint64_t{1} << (2 * kLevels - 2))) / 2;
}

/// Those with weights as they stand, then the others along a Morton curve.
std::vector<Place> along_a_curve(const std::vector<SamplePoint>& points, std::size_t weighted) {
  const Box box = parallel_bounds(points.size(), [&](std::size_t i) { return points[i].point; });
  std::vector<Place> order(points.size());
  parallel_for(points.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const Point& p = points[i].point;
      order[i] = {morton_code(p, box), static_cast<std::uint32_t>(i), level_of(p)};
    }
  });
  parallel_sort(order, [&](const Place& a, const Place& b) {
    if (a.index < weighted || b.index < weighted) return a.index < b.index;
    if (a.code != b.code) return a.code < b.code;
    const Point& p = points[a.index].point;
    const Point& q = points[b.index].point;
    return p != q ? lexicographically_less(p, q) : a.index < b.index;
  });
  return order;
}

/// A vertex to be inserted, and another near it that is in the triangulation, if one is known.
struct Task {
  PointId vertex;
  PointId near = kNone;
};

/// Inserts in order; returns the points whose zones reach beyond the part. Duplicates keep kNone as their cell.
std::vector<Task> insert_each(const std::vector<Task>& tasks, Triangulation& t, Inserter& inserter) {
  std::vector<Task> beyond;
  ConflictZone zone;
  for (const Task& task : tasks) {
    const CellId near = task.near == kNone ? kNone : t.vertex(task.near).cell;
    const Inserter::Found found = inserter.find_zone(t.point(task.vertex), near, zone, t.weight(task.vertex));
    if (found == Inserter::Found::vertex) continue;
    if (found == Inserter::Found::zone && inserter.has_room_for(zone)) {
      inserter.insert(task.vertex, zone);
      t.find_spheres(inserter.new_cells());
    } else {
      const auto& seen = t.cell(inserter.last_seen()).vertex;
      beyond.push_back({task.vertex, *std::max_element(seen.begin(), seen.end())});
    }
  }
  return beyond;
}

/// Inserts by parts into a triangulation of `present` vertices; returns the points that wait.
std::vector<Task> insert_by_parts(const std::vector<Task>& tasks, std::size_t present, Triangulation& t) {
  std::vector<Point> work;
  Box box;
  for (const Task& task : tasks) {
    work.push_back(t.point(task.vertex));
    box.extend(work.back());
  }
  const Vec extent = box.extent();
  const double spacing_mm = std::cbrt(extent.x * extent.y * extent.z / static_cast<double>(present));
  const int depth = std::max(1, partition_depth(std::min(present, tasks.size()), kLeastInPart));
  const Partition partition(work, depth, spacing_mm);
  VertexParts parts = partition.parts_of(t);
  const auto count = static_cast<std::size_t>(partition.count());
  std::vector<std::vector<Task>> lists(count);
  for (const Task& task : tasks) {
    const PartId part = parts[task.vertex];
    const bool near_is_here = task.near != kNone && t.is_vertex(task.near) && parts[task.near] == part;
    lists[part].push_back({task.vertex, near_is_here ? task.near : kNone});
  }
  std::vector<CellId> starts(count, kNone);
  for (PointId v = Triangulation::kCorners; v < t.vertex_slots(); ++v) {
    if (t.is_vertex(v)) starts[parts[v]] = t.vertex(v).cell;
  }
  std::vector<Inserter> inserters;
  for (std::size_t part = 0; part < count; ++part) {
    const std::size_t cells = kCellsPerPoint * lists[part].size() + kCellsInPassing;
    inserters.emplace_back(t, parts, static_cast<PartId>(part), cells, 0);
    inserters.back().start_at(starts[part]);
  }
  std::vector<std::vector<Task>> waiting(count);
  parallel_for(count, 1, [&](std::size_t part, std::size_t) {
    waiting[part] = starts[part] == kNone ? std::move(lists[part]) : insert_each(lists[part], t, inserters[part]);
  });
  std::vector<Task> all;
  for (std::size_t part = 0; part < count; ++part) {
    inserters[part].retire();
    all.insert(all.end(), waiting[part].begin(), waiting[part].end());
  }
  return all;
}

/// Numbers the points along the curve, and orders them by level and, in a level, along the curve.
std::vector<Task> insertion_order(const std::vector<SamplePoint>& points, Triangulation& t) {
  std::vector<double> weights;
  for (const SamplePoint& p : points) {
    if (p.weight == 0) break;
    weights.push_back(p.weight);
  }
  const std::vector<Place> order = along_a_curve(points, weights.size());
  t.set_weights(std::move(weights));
  const PointId first = t.add_vertices(points.size());
  parallel_for(points.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const SamplePoint& p = points[order[i].index];
      t.vertex(first + static_cast<PointId>(i)) = {.point = p.point};
      t.vertex_info(first + static_cast<PointId>(i)) = {.patch = p.patch, .dimension = p.dimension};
    }
  });
  std::array<std::vector<Task>, kLevels> levels;
  for (std::size_t i = 0; i < order.size(); ++i) levels[order[i].level].push_back({first + static_cast<PointId>(i)});
  std::vector<Task> tasks;
  tasks.reserve(points.size());
  for (const auto& level : levels) tasks.insert(tasks.end(), level.begin(), level.end());
  return tasks;
}

}  // namespace

void insert_in_bulk(std::vector<SamplePoint> points, Triangulation& t, Progress& progress, const SeedLattice& lattice) {
  const std::size_t count = points.size();
  t.reserve(count);
  std::vector<Task> tasks = insertion_order(points, t);
  points = {};  // their memory is needed below: it is at its peak in renumber_cells
  // Balls reach farther into the lattice's spheres than points do, which its core does not reckon with.
  std::optional<LatticeCore> core(std::in_place, t.has_weights() ? SeedLattice{} : lattice, t);
  std::erase_if(tasks, [&](const Task& task) { return core->has(task.vertex); });

  const auto insert_one_by_one = [&](const std::vector<Task>& some) {
    Inserter inserter(t);
    insert_each(some, t, inserter);
    inserter.retire();
  };
  const auto at = [&](std::size_t i) { return tasks.begin() + static_cast<std::ptrdiff_t>(i); };
  std::size_t present = std::min(tasks.size(), kFirst);
  std::atomic<bool> inserted = false;
  const auto populate = t.populating(count);
  parallel_for(2, 1, [&](std::size_t job, std::size_t) {
    if (job == 0) {
      insert_one_by_one({at(0), at(present)});
      inserted = true;
    } else {
      populate(inserted);
    }
  });
  std::vector<Task> waiting;
  std::size_t next = present;
  for (int turns = 0;
       (next < tasks.size() || (waiting.size() > kFew && turns < kMostTurns)) && !progress.cancelled();) {
    turns += next == tasks.size() ? 1 : 0;
    const std::size_t more = std::min({tasks.size() - next, kMostPerVertex * present, kMostInTurn});
    waiting.insert(waiting.end(), at(next), at(next + more));
    next += more;
    const std::size_t tried = waiting.size();
    waiting = insert_by_parts(waiting, present, t);
    present += tried - waiting.size();
    progress.report({"sample", "triangulate", present, tasks.size(), 0});
  }
  if (!progress.cancelled()) {
    insert_one_by_one(waiting);
    core->join(t);
  }
  core.reset();
  assert(progress.cancelled() || present + waiting.size() == tasks.size());
  tasks = {};
  for (PointId v = Triangulation::kCorners; v < t.vertex_slots(); ++v) {
    if (!t.is_vertex(v)) t.drop_vertex(v);
  }
  t.renumber_cells();
}

}  // namespace scantet::engine
