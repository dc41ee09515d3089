// Facets that share a vertex with a disk are on one surface; each vertex is joined to the others of a facet. A facet
// without such a vertex is a surface of its own.
#include <algorithm>
#include <atomic>
#include <numeric>

#include "scantet/base/parallel.h"
#include "scantet/surface/boundary_surfaces_impl.h"

namespace scantet::engine {
namespace {

constexpr std::size_t kGrain = 4096;
// Of a facet; at the same time how many regions beside kOutside it bounds.
constexpr std::uint8_t kOuter = 1;
constexpr std::uint8_t kInner = 2;

}  // namespace

BoundarySurfaces::BoundarySurfaces(const RestrictedTriangulation& t, const BoundaryFacets& facets)
    : t_(t), facets_(facets), seen_(facets.codes.size()) {
  join();
  find_split_patches();
}

void BoundarySurfaces::join() {
  const Triangulation& t = t_.triangulation();
  ParallelUnionFind joined(t.vertex_slots());
  std::vector<std::uint8_t> is_on(t.vertex_slots(), 0);
  std::vector<std::int64_t> inner((seen_.size() + kGrain - 1) / kGrain);  // facets, of each stretch
  std::vector<PointId> disks(seen_.size(), kNone);                        // the first vertex of each facet that has one
  std::atomic<bool> has_disks = true;
  parallel_for(seen_.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      seen_[i].patch = facets_.patches[i];
      const std::uint8_t kind = facets_.is_inner[i] == 0 ? kOuter : kInner;
      inner[begin / kGrain] += facets_.is_inner[i];
      for (const PointId v : facets_.corners[i]) {
        std::atomic_ref kinds(is_on[v]);
        const bool is_known = (kinds.load(std::memory_order_relaxed) & kind) != 0;
        if (!is_known) kinds.fetch_or(kind, std::memory_order_relaxed);
        if (!t_.disks().has_disk(v)) {
          has_disks.store(false, std::memory_order_relaxed);
        } else if (disks[i] == kNone) {
          disks[i] = v;
        } else {
          joined.unite(disks[i], v);
        }
      }
    }
  });
  has_disks_ = has_disks;
  const std::int64_t sides = static_cast<std::int64_t>(seen_.size()) + std::accumulate(inner.begin(), inner.end(), 0LL);
  for (const std::uint8_t kinds : is_on) euler_number_ += (kinds & kOuter) + (kinds & kInner);
  euler_number_ -= sides / 2;
  number(joined, disks);
}

/// Numbers the surfaces by their first facets. disks: a vertex with a disk of each facet, or kNone.
void BoundarySurfaces::number(ParallelUnionFind& joined, const std::vector<PointId>& disks) {
  surface_at_.resize(t_.triangulation().vertex_slots());
  parallel_for(surface_at_.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v) surface_at_[v] = joined.find(static_cast<std::uint32_t>(v));
  });
  std::vector<std::uint32_t> number = first_facets(disks);  // of sets, by the vertex that stands for each
  const std::vector<std::uint32_t> firsts =
      parallel_collect<std::uint32_t>(seen_.size(), kGrain, [&](std::size_t begin, std::size_t end, auto& found) {
        for (std::size_t i = begin; i < end; ++i) {
          const bool is_first = disks[i] == kNone || number[surface_at_[disks[i]]] == i;
          if (is_first) found.push_back(static_cast<std::uint32_t>(i));
        }
      });
  for (std::uint32_t surface = 0; surface < firsts.size(); ++surface) {
    const std::uint32_t i = firsts[surface];
    const FacetCode facet = facets_.codes[i];
    surfaces_.push_back({i, 0, false});
    if (disks[i] != kNone) {
      number[surface_at_[disks[i]]] = surface;
    } else {
      of_no_disk_[facet] = surface;
      of_no_disk_[t_.triangulation().cell(facet / 4).neighbor[facet % 4]] = surface;
    }
  }
  runs_ = parallel_collect<std::uint32_t>(seen_.size(), kGrain, [&](std::size_t begin, std::size_t end, auto& runs) {
    for (std::size_t i = begin; i < end; ++i) {
      seen_[i].surface = disks[i] == kNone ? of_no_disk_.find(facets_.codes[i])->second : number[surface_at_[disks[i]]];
      if (i == begin || seen_[i] != seen_[i - 1]) runs.push_back(static_cast<std::uint32_t>(i));
    }
  });
  each_run([&](std::size_t begin, std::size_t end) {
    surfaces_[seen_[begin].surface].facets += static_cast<std::uint32_t>(end - begin);
  });
  parallel_for(surface_at_.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v) surface_at_[v] = number[surface_at_[v]];
  });
}

/// For each vertex that stands for a set of them the place of the first facet with a disk at one of these, or kNone.
std::vector<std::uint32_t> BoundarySurfaces::first_facets(const std::vector<PointId>& disks) const {
  std::vector<std::uint32_t> first(surface_at_.size(), kNone);
  parallel_for(seen_.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    for (auto i = static_cast<std::uint32_t>(begin); i < end; ++i) {
      if (disks[i] == kNone) continue;
      std::atomic_ref least(first[surface_at_[disks[i]]]);
      std::uint32_t known = least.load(std::memory_order_relaxed);
      while (i < known && !least.compare_exchange_weak(known, i, std::memory_order_relaxed)) {
      }
    }
  });
  return first;
}

void BoundarySurfaces::find_split_patches() {
  each_run([&](std::size_t begin, std::size_t) {
    const Seen& seen = seen_[begin];
    if (first_of_.try_emplace(seen.patch, seen.surface).first->second == seen.surface) return;
    is_one_each_ = false;
    if (seen.patch) split_.insert(*seen.patch);
  });
  if (split_.empty()) return;
  each_run([&](std::size_t begin, std::size_t) {
    if (is_split(seen_[begin])) surfaces_[seen_[begin].surface].takes_part = true;
  });
}

std::uint32_t BoundarySurfaces::surface_of(FacetCode facet) const {
  const Triangulation& t = t_.triangulation();
  for (const PointId v : facet_vertices(t.cell(facet / 4), static_cast<int>(facet % 4))) {
    if (t_.disks().has_disk(v)) return surface_at_[v];
  }
  const auto found = of_no_disk_.find(facet);
  return found == of_no_disk_.end() ? kNone : found->second;
}

}  // namespace scantet::engine
