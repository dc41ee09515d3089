// Whether two meshes have the same tets is told by coordinates, which are compared as numbers, not by distances: each
// mesh's vertices are numbered in the order of their coordinates, and its tets sorted by these numbers.
#include "scantet/check/mesh_difference.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <tuple>

#include "scantet/base/parallel.h"
#include "scantet/base/tet_volume.h"
#include "scantet/check/distance_impl.h"

namespace scantet {
namespace {

// A tet by places that do not depend on the numbering of its mesh, and its region.
struct PlacedTet {
  Tet corners;  // ascending
  Region region;
  std::uint32_t number;  // in its mesh
  bool at_same_place(const PlacedTet& other) const { return corners == other.corners; }
  friend bool operator<(const PlacedTet& a, const PlacedTet& b) {
    return std::tie(a.corners, a.region, a.number) < std::tie(b.corners, b.region, b.number);
  }
  friend bool operator==(const PlacedTet& a, const PlacedTet& b) { return a.at_same_place(b) && a.region == b.region; }
};

using Pair = std::array<const TetMesh*, 2>;

// The points of both meshes, each once, ascending.
std::vector<Point> all_points(const Pair& meshes) {
  std::vector<Point> points = meshes[0]->vertices;
  points.insert(points.end(), meshes[1]->vertices.begin(), meshes[1]->vertices.end());
  parallel_sort(points, lexicographically_less);
  points.erase(std::unique(points.begin(), points.end()), points.end());
  return points;
}

std::vector<PlacedTet> placed_tets(const TetMesh& mesh, const std::vector<Point>& points) {
  std::vector<VertexId> place(mesh.vertices.size());
  parallel_for(place.size(), 4096, [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v) {
      const auto found = std::lower_bound(points.begin(), points.end(), mesh.vertices[v], lexicographically_less);
      place[v] = static_cast<VertexId>(found - points.begin());
    }
  });
  std::vector<PlacedTet> tets(mesh.tets.size());
  for (std::size_t i = 0; i < tets.size(); ++i) {
    for (std::size_t k = 0; k < 4; ++k) tets[i].corners[k] = place[mesh.tets[i][k]];
    std::sort(tets[i].corners.begin(), tets[i].corners.end());
    tets[i].region = mesh.tet_regions[i];
    tets[i].number = static_cast<std::uint32_t>(i);
  }
  parallel_sort(tets, std::less<>());
  return tets;
}

void compare_tets(const Pair& meshes, MeshDifference& difference) {
  const auto& [a, b] = meshes;
  if (a->vertices == b->vertices && a->tets == b->tets && a->tet_regions == b->tet_regions) {
    difference.same = Sameness::arrays;
    difference.pairs.resize(a->tets.size());
    std::iota(difference.pairs.begin(), difference.pairs.end(), 0U);
    return;
  }
  const std::vector<Point> points = all_points(meshes);
  const std::array<std::vector<PlacedTet>, 2> tets{placed_tets(*a, points), placed_tets(*b, points)};
  const auto alone = [&](int side) {
    const auto& mine = tets[static_cast<std::size_t>(side)];
    const auto& theirs = tets[static_cast<std::size_t>(1 - side)];
    std::uint64_t count = 0;
    auto other = theirs.begin();
    for (const PlacedTet& tet : mine) {
      while (other != theirs.end() && other->corners < tet.corners) ++other;
      count += other == theirs.end() || !other->at_same_place(tet) ? 1 : 0;
    }
    return count;
  };
  difference.tets_alone = {alone(0), alone(1)};
  if (tets[0] == tets[1]) {
    difference.same = Sameness::numbering;
  } else if (std::equal(tets[0].begin(), tets[0].end(), tets[1].begin(), tets[1].end(),
                        [](const PlacedTet& x, const PlacedTet& y) { return x.at_same_place(y); })) {
    difference.same = Sameness::tets;
  } else {
    return;
  }
  difference.pairs.resize(tets[1].size());
  for (std::size_t i = 0; i < tets[1].size(); ++i) difference.pairs[tets[1][i].number] = tets[0][i].number;
}

void compare_regions(const Pair& meshes, MeshDifference& difference) {
  std::map<Region, RegionDifference> regions;
  std::map<std::array<Region, 2>, PatchDifference> patches;
  for (std::size_t side = 0; side < 2; ++side) {
    const TetMesh& mesh = *meshes[side];
    const auto of = [&](Region region) -> RegionDifference::Side& { return regions[region].sides[side]; };
    for (std::size_t i = 0; i < mesh.tets.size(); ++i) {
      RegionDifference::Side& here = of(mesh.tet_regions[i]);
      ++here.tets;
      here.volume_mm3 += tet_volume_mm3(mesh, i);
    }
    for (std::size_t i = 0; i < mesh.boundary_facets.size(); ++i) {
      const double area_mm2 = 0.5 * length(area_normal(corners_of(mesh, i)));
      for (const Region region : mesh.facet_regions[i]) {
        if (region != kOutside) of(region).area_mm2 += area_mm2;
      }
      PatchDifference& patch = patches[mesh.facet_regions[i]];
      ++patch.facets[side];
      patch.area_mm2[side] += area_mm2;
    }
    for (const auto& [region, name] : mesh.region_names) {
      if (regions.count(region) > 0) of(region).name = name;
    }
  }
  for (auto& [region, found] : regions) {
    found.region = region;
    difference.regions.push_back(found);
  }
  for (auto& [pair, found] : patches) {
    found.regions = pair;
    difference.patches.push_back(found);
  }
}

}  // namespace

const char* text_of(Sameness same) {
  switch (same) {
    case Sameness::arrays:
      return "the same vertices and tets, in the same order";
    case Sameness::numbering:
      return "the same tets at the same places, numbered in another order";
    case Sameness::tets:
      return "the same tets at the same places, but of other regions";
    default:
      return "other tets";
  }
}

MeshDifference compare_meshes(const TetMesh& first, const TetMesh& second, const DistanceOptions& options) {
  MeshDifference difference;
  const Pair meshes{&first, &second};
  compare_tets(meshes, difference);
  compare_regions(meshes, difference);
  const FacetTree to_first(first, all_facets(first));
  const FacetTree to_second(second, all_facets(second));
  auto& [first_off, second_off] = difference.facets_off_mm;
  difference.to_second = measuring::distance_between(first, to_second, options, first_off);
  difference.to_first = measuring::distance_between(second, to_first, options, second_off);
  return difference;
}

}  // namespace scantet
