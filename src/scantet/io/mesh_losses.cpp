// The table of formats says what each holds; here that is compared with what the mesh has.
#include "scantet/io/mesh_losses.h"

#include <algorithm>
#include <array>
#include <vector>

#include "scantet/base/name_list.h"
#include "scantet/io/mesh_io.h"

namespace scantet {
namespace {

using Names = std::vector<std::string>;

/// "sets (foot, tip, a, b and 3 more)"; nothing without names.
void add_phrase(const std::string& what, const Names& names, std::vector<std::string>& phrases) {
  if (names.empty()) return;
  constexpr std::size_t kShown = 4;
  phrases.push_back("no " + what + " (" + name_list(names, kShown) + ")");
}

void add_sets(const TetMesh& mesh, const MeshFormat& format, std::vector<std::string>& phrases) {
  struct Kind {
    MeshExtra extra;
    const char* what;
    bool (*has)(const MeshSet&);
  };
  const std::array<Kind, 3> kinds{
      {{MeshExtra::node_sets, "sets of nodes", [](const MeshSet& s) { return !s.vertices.empty(); }},
       {MeshExtra::facet_sets, "sets of facets", [](const MeshSet& s) { return !s.facets.empty(); }},
       {MeshExtra::tet_sets, "sets of elements", [](const MeshSet& s) { return !s.tets.empty(); }}}};
  const auto holds = [&](const Kind& kind) { return format.can_hold(kind.extra); };
  if (std::none_of(kinds.begin(), kinds.end(), holds)) {
    Names names;
    for (const MeshSet& set : mesh.sets) names.push_back(set.name);
    return add_phrase("sets", names, phrases);
  }
  for (const Kind& kind : kinds) {
    if (holds(kind)) continue;
    Names names;
    for (const MeshSet& set : mesh.sets) {
      if (kind.has(set)) names.push_back(set.name);
    }
    add_phrase(kind.what, names, phrases);
  }
}

/// Fields but for those that are the constants of the mesh's materials.
Names fields_of(const TetMesh& mesh) {
  Names names;
  for (const MeshField& field : mesh.fields) {
    const bool is_of_material =
        std::find(kMaterialFields.begin(), kMaterialFields.end(), field.name) != kMaterialFields.end();
    if (mesh.materials.empty() || !is_of_material) names.push_back(field.name);
  }
  return names;
}

}  // namespace

std::string loss_text(const TetMesh& mesh, const std::string& path, bool with_names) {
  const MeshFormat* const format = mesh_format_of(path);
  if (format == nullptr) return {};
  std::vector<std::string> phrases;
  add_sets(mesh, *format, phrases);
  if (!format->can_hold(MeshExtra::fields)) add_phrase("fields", fields_of(mesh), phrases);
  if (!format->can_hold(MeshExtra::materials)) {
    Names names;
    for (const MeshMaterial& material : mesh.materials) names.push_back(material.name);
    add_phrase("materials", names, phrases);
  }
  if (with_names && format->holds == MeshContent::tets && !format->can_hold(MeshExtra::region_names)) {
    Names names;
    for (const auto& [region, name] : mesh.region_names) names.push_back(name);
    add_phrase("names of regions that programs read", names, phrases);
  }
  std::string text;
  for (std::size_t i = 0; i < phrases.size(); ++i) {
    text += (i == 0 ? path + " holds " : i + 1 < phrases.size() ? ", " : " and ") + phrases[i];
  }
  return text;
}

}  // namespace scantet
