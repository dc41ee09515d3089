// Patches stay in the order of their regions, those without a piece first.
#include "scantet/domain/patch_pieces.h"

#include <algorithm>
#include <map>
#include <utility>
#include <vector>

namespace scantet {
namespace {

/// The regions of a patch, and its piece.
using Key = std::pair<std::array<Region, 2>, std::size_t>;

/// The patches of the keys, which ascend.
std::vector<MeshPatch> patches_of(const std::vector<Key>& keys, const TetMesh& mesh, const PatchPieces& pieces) {
  std::map<std::array<Region, 2>, std::string> names;
  for (const MeshPatch& patch : mesh.patches) names.try_emplace(patch.regions, patch.name);
  std::map<std::size_t, std::size_t> count;
  for (const Key& key : keys) ++count[key.second];
  std::vector<MeshPatch> patches;
  for (const auto& [regions, piece] : keys) {
    std::string name = piece == 0 ? names[regions] : pieces.name_of_piece(piece);
    if (piece != 0 && count[piece] > 1) name += "_" + region_name(mesh, regions[0]);
    patches.push_back({regions, std::move(name)});
  }
  return patches;
}

}  // namespace

void part_patches(TetMesh& mesh, const Domain& domain) {
  const auto* const pieces = dynamic_cast<const PatchPieces*>(&domain);
  if (pieces == nullptr) return;
  std::vector<Key> key_of;  // each facet
  key_of.reserve(mesh.boundary_facets.size());
  for (std::size_t i = 0; i < mesh.boundary_facets.size(); ++i) {
    const auto& [a, b, c] = mesh.boundary_facets[i];
    const bool is_outer = mesh.facet_regions[i][1] == kOutside;
    const std::size_t piece =
        is_outer ? pieces->piece_of({mesh.vertices[a], mesh.vertices[b], mesh.vertices[c]}) : std::size_t{0};
    key_of.emplace_back(mesh.facet_regions[i], piece);
  }
  std::vector<Key> keys = key_of;
  std::sort(keys.begin(), keys.end());
  keys.erase(std::unique(keys.begin(), keys.end()), keys.end());
  mesh.patches = patches_of(keys, mesh, *pieces);
  for (std::size_t i = 0; i < key_of.size(); ++i) {
    const auto patch = static_cast<std::uint32_t>(std::lower_bound(keys.begin(), keys.end(), key_of[i]) - keys.begin());
    mesh.facet_patches[i] = patch;
    for (const VertexId v : mesh.boundary_facets[i]) {
      if (mesh.strata[v].dimension == 2) mesh.strata[v].index = static_cast<std::int32_t>(patch);
    }
  }
}

}  // namespace scantet
