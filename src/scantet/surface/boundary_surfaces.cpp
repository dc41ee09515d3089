// Facets that share a vertex with a disk are on one surface; each vertex is joined to the others of a facet. A facet
// without such a vertex is a surface of its own.
#include <algorithm>
#include <atomic>

#include "scantet/base/parallel.h"
#include "scantet/surface/boundary_surfaces_impl.h"

namespace scantet::engine {
namespace {

constexpr std::size_t kGrain = 4096;

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
  std::vector<PointId> disks(seen_.size(), kNone);  // the first vertex of each facet that has one
  std::atomic<bool> has_disks = true;
  parallel_for(seen_.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      seen_[i].patch = facets_.patches[i];
      for (const PointId v : facets_.corners[i]) {
        std::atomic_ref(is_on[v]).store(1, std::memory_order_relaxed);
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
  vertices_ = std::count(is_on.begin(), is_on.end(), 1);
  number(joined, disks);
}

/// disks: a vertex with a disk of each facet, or kNone.
void BoundarySurfaces::number(ParallelUnionFind& joined, const std::vector<PointId>& disks) {
  const Triangulation& t = t_.triangulation();
  surface_at_.resize(t.vertex_slots());
  parallel_for(surface_at_.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v) surface_at_[v] = joined.find(static_cast<std::uint32_t>(v));
  });
  std::vector<std::uint32_t> number(t.vertex_slots(), kNone);  // by the vertex that stands for a set
  for (std::size_t i = 0; i < seen_.size(); ++i) {
    const FacetCode facet = facets_.codes[i];
    std::uint32_t& surface = disks[i] == kNone ? of_no_disk_[facet] : number[surface_at_[disks[i]]];
    if (disks[i] == kNone || surface == kNone) {
      surface = static_cast<std::uint32_t>(surfaces_.size());
      surfaces_.push_back({static_cast<std::uint32_t>(i), 0, false});
      if (disks[i] == kNone) of_no_disk_[t.cell(facet / 4).neighbor[facet % 4]] = surfaces_.size() - 1;
    }
    seen_[i].surface = surface;
    ++surfaces_[surface].facets;
  }
  parallel_for(surface_at_.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v) surface_at_[v] = number[surface_at_[v]];
  });
}

void BoundarySurfaces::find_split_patches() {
  const auto each_change = [&](const auto& visit) {  // facets in a row are mostly of one surface and patch
    for (std::size_t i = 0; i < seen_.size(); ++i) {
      if (i == 0 || seen_[i] != seen_[i - 1]) visit(seen_[i]);
    }
  };
  each_change([&](const Seen& seen) {
    if (first_of_.try_emplace(seen.patch, seen.surface).first->second == seen.surface) return;
    is_one_each_ = false;
    if (seen.patch) split_.insert(*seen.patch);
  });
  if (split_.empty()) return;
  each_change([&](const Seen& seen) {
    if (is_split(seen)) surfaces_[seen.surface].takes_part = true;
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
