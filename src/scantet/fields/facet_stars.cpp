// A counting sort; the sides at one vertex are sorted when they are asked for.
#include <algorithm>

#include "scantet/base/parallel.h"
#include "scantet/fields/facet_stars_impl.h"

namespace scantet {
namespace {

constexpr std::size_t kTets = 16384;

/// Facets of a positively oriented tet, as seen from outside.
constexpr std::uint32_t kFacets[4][3] = {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}};

Triangle facet_of(const Tet& tet, std::uint32_t facet) {
  const auto& f = kFacets[facet];
  return {tet[f[0]], tet[f[1]], tet[f[2]]};
}

struct Entry {
  std::uint64_t others;  // the two larger vertices, the smaller one first
  std::uint32_t side;
  bool is_turned;
};

Entry entry_of(const Tet& tet, std::uint32_t side) {
  Triangle t = facet_of(tet, side % 4);
  std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
  const auto [low, high] = std::minmax(t[1], t[2]);
  return {(std::uint64_t{low} << 32) | high, side, t[1] > t[2]};
}

}  // namespace

FacetStars::FacetStars(const TetMesh& mesh, const std::vector<std::uint8_t>& is_chosen)
    : mesh_(&mesh), of_vertex_(mesh.vertices.size()) {
  const auto each_side = [&](const auto& visit) {
    parallel_for(mesh.tets.size(), kTets, [&](std::size_t begin, std::size_t end) {
      for (std::size_t t = begin; t < end; ++t) {
        if (is_chosen[t] == 0) continue;
        for (std::uint32_t facet = 0; facet < 4; ++facet) {
          const Triangle corners = facet_of(mesh.tets[t], facet);
          visit(std::min({corners[0], corners[1], corners[2]}), static_cast<std::uint32_t>(4 * t + facet));
        }
      }
    });
  };
  each_side([&](VertexId v, std::uint32_t) { of_vertex_.count(v); });
  sides_.resize(of_vertex_.close());
  each_side([&](VertexId v, std::uint32_t side) { sides_[of_vertex_.place(v)] = side; });
}

void FacetStars::facets_of(std::size_t vertex, std::vector<Facet>& facets) const {
  facets.clear();
  thread_local std::vector<Entry> entries;
  entries.clear();
  for (std::size_t i = of_vertex_.begin(vertex); i < of_vertex_.end(vertex); ++i) {
    entries.push_back(entry_of(mesh_->tets[sides_[i] / 4], sides_[i]));
  }
  std::sort(entries.begin(), entries.end(), [](const Entry& a, const Entry& b) {
    return a.others != b.others ? a.others < b.others : a.side < b.side;
  });
  for (std::size_t i = 0; i < entries.size(); ++i) {
    const Entry& entry = entries[i];
    const bool is_second = i > 0 && entries[i - 1].others == entry.others && facets.back().count == 1;
    if (!is_second) {
      facets.push_back({{static_cast<VertexId>(vertex), static_cast<VertexId>(entry.others >> 32),
                         static_cast<VertexId>(entry.others)},
                        0,
                        {}});
    }
    Facet& facet = facets.back();
    facet.sides[facet.count++] = {entry.side / 4, entry.side % 4, entry.is_turned};
  }
}

}  // namespace scantet
