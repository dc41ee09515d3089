// Regions are few and tets many: distinct values are collected by skipping repeats, then looked up by bisection.
#include <algorithm>
#include <numeric>

#include "scantet/io/mesh_tags_impl.h"

namespace scantet {
namespace {

template <typename T>
std::vector<T> distinct(const std::vector<T>& values) {
  std::vector<T> found;
  for (const T& value : values) {
    const auto place = std::lower_bound(found.begin(), found.end(), value);
    if (place == found.end() || *place != value) found.insert(place, value);
  }
  return found;
}

template <typename T>
std::vector<std::uint32_t> index_in(const std::vector<T>& values, const std::vector<T>& groups) {
  std::vector<std::uint32_t> index;
  index.reserve(values.size());
  for (const T& value : values) {
    index.push_back(static_cast<std::uint32_t>(std::lower_bound(groups.begin(), groups.end(), value) - groups.begin()));
  }
  return index;
}

std::vector<std::size_t> count(const std::vector<std::uint32_t>& group_of, std::size_t groups) {
  std::vector<std::size_t> sizes(groups, 0);
  for (std::uint32_t group : group_of) ++sizes[group];
  return sizes;
}

}  // namespace

MeshTags make_tags(const TetMesh& mesh) {
  MeshTags tags;
  const std::vector<Region> regions = distinct(mesh.tet_regions);
  constexpr Region kLargestTag = 1'000'000'000;  // leaves room for the surfaces in an int
  const bool as_they_are = regions.empty() || (regions.front() > 0 && regions.back() <= kLargestTag);
  int next = 1;
  for (Region region : regions) {
    const int tag = as_they_are ? region : next;
    tags.volumes.push_back({region, tag, "region_" + std::to_string(region)});
    next = tag + 1;
  }
  const auto pairs = distinct(mesh.facet_regions);
  for (const auto& [behind, in_front] : pairs) {
    tags.surfaces.push_back(
        {{behind, in_front}, next++, "boundary_" + std::to_string(behind) + "_" + std::to_string(in_front)});
  }
  tags.volume_of_tet = index_in(mesh.tet_regions, regions);
  tags.surface_of_facet = index_in(mesh.facet_regions, pairs);
  tags.tets_in = count(tags.volume_of_tet, regions.size());
  tags.facets_in = count(tags.surface_of_facet, pairs.size());
  return tags;
}

std::vector<std::uint32_t> order_by_group(const std::vector<std::uint32_t>& group_of,
                                          const std::vector<std::size_t>& size_of) {
  std::vector<std::size_t> next(size_of.size(), 0);
  std::exclusive_scan(size_of.begin(), size_of.end(), next.begin(), std::size_t{0});
  std::vector<std::uint32_t> order(group_of.size());
  for (std::size_t i = 0; i < group_of.size(); ++i) order[next[group_of[i]]++] = static_cast<std::uint32_t>(i);
  return order;
}

}  // namespace scantet
