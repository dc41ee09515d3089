// A template is copied with its words in double braces replaced. Forces and flows that are given as a whole are divided
// among nodes as an even load on the facets is.
#include "scantet/decks/deck.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <ostream>

#include "scantet/base/element_nodes.h"
#include "scantet/base/error.h"
#include "scantet/base/options.h"
#include "scantet/io/atomic_file.h"
#include "scantet/io/inp_names.h"

namespace scantet {
namespace {

using namespace std::string_view_literals;

#include "scantet/decks/deck_templates.inc"

std::string_view built_in(DeckKind kind) {
  switch (kind) {
    case DeckKind::modal:
      return kModal;
    case DeckKind::heat:
      return kHeat;
    case DeckKind::electro:
      return kElectro;
    default:
      return kStatic;
  }
}

[[noreturn]] void refuse(const std::string& what, const std::string& remedy) {
  throw Error(Fault::usage, "usage.deck", what, remedy);
}

const MeshSet& set_of(const TetMesh& mesh, const std::string& option, const std::string& name) {
  std::vector<std::string> names;
  for (const MeshSet& set : mesh.sets) {
    if (set.name == name) return set;
    names.push_back(set.name);
  }
  const auto meant = closest_name(name, names);
  refuse(option + ": there is no set \"" + name + "\"" + (meant ? "; did you mean " + *meant + "?" : ""),
         "name it with --set \"" + name + "=PLACE\"");
}

/// Of each node of the set's facets the share of an even load on them that is its own; they add up to 1. Of a facet of
/// six nodes those on its edges have it all: the integrals of the corners' shape functions are 0.
std::map<VertexId, double> load_shares(const TetMesh& mesh, const MeshSet& set) {
  const FacetNodes nodes(mesh);
  std::map<VertexId, double> shares;
  double sum = 0;
  for (const std::uint32_t f : set.facets) {
    const Triangle& t = mesh.boundary_facets[f];
    const Point& a = mesh.vertices[t[0]];
    const double area = length(cross(mesh.vertices[t[1]] - a, mesh.vertices[t[2]] - a));
    const ElementNodes all = nodes.of(f);
    for (const VertexId* v = all.end() - 3; v != all.end(); ++v) shares[*v] += area / 3;
    sum += area;
  }
  for (auto& [v, share] : shares) share /= sum;
  return shares;
}

std::string number(double value) {
  constexpr int kDigits = 12;  // CalculiX reads 20 characters
  std::string text = number_text(value, kDigits);
  if (text.find_first_of(".e") == std::string::npos) text += '.';
  return text;
}

class DeckText {
 public:
  DeckText(const Deck& deck, const TetMesh& mesh, const MeshWriteOptions& options)
      : deck_(deck), mesh_(mesh), options_(options), names_(inp_names(mesh)) {}

  std::string hold() const {
    std::string text;
    for (const DeckHold& hold : deck_.holds) {
      const std::string& name = name_of(set_of(mesh_, "--hold", hold.set));
      if (deck_.kind == DeckKind::heat || deck_.kind == DeckKind::electro) {
        text += name + ", 11, 11, " + number(hold.value) + '\n';
        continue;
      }
      for (const char axis : hold.axes) text += name + ", " + std::to_string(axis - 'x' + 1) + '\n';
    }
    if (text.empty()) text = "** nothing is held\n";
    text.pop_back();
    return text;
  }

  std::string load() const {
    std::string text;
    for (const DeckLoad& load : deck_.loads) {
      const MeshSet& set = set_of(mesh_, "--load", load.set);
      if (deck_.kind == DeckKind::statics && load.numbers.size() == 1) {
        text += "*DSLOAD\n" + name_of(set) + ", P, " + number(load.numbers[0]) + '\n';
        continue;
      }
      const bool is_force = load.numbers.size() == 3;
      const double sign = is_force && options_.ras ? -1 : 1;
      text += is_force ? "*CLOAD\n" : "*CFLUX\n";
      for (const auto& [v, share] : load_shares(mesh_, set)) {
        for (std::size_t i = 0; i < load.numbers.size(); ++i) {
          if (load.numbers[i] == 0) continue;
          const double value = share * load.numbers[i] * (i < 2 && is_force ? sign : 1);
          text += std::to_string(v + 1) + ", " + std::to_string(is_force ? i + 1 : 11) + ", " + number(value) + '\n';
        }
      }
    }
    if (text.empty()) text = "** there is no load\n";
    text.pop_back();
    return text;
  }

  std::string conductivity() const {
    std::string text;
    for (std::size_t m = 0; m < mesh_.materials.size(); ++m) {
      const std::string& name = names_.materials[m];
      text += "*MATERIAL, NAME=" + name + "_CONDUCTIVE\n*CONDUCTIVITY\n" + number(deck_.conductivities[m].value_or(0)) +
              "\n*SOLID SECTION, ELSET=" + name + ", MATERIAL=" + name + "_CONDUCTIVE\n";
    }
    if (!text.empty()) text.pop_back();
    return text;
  }

 private:
  /// In the mesh file.
  const std::string& name_of(const MeshSet& set) const {
    return names_.sets[static_cast<std::size_t>(&set - mesh_.sets.data())];
  }

  const Deck& deck_;
  const TetMesh& mesh_;
  const MeshWriteOptions& options_;
  InpNames names_;
};

void replace_all(std::string& text, const std::string& word, const std::string& by) {
  const std::string whole = "{{" + word + "}}";
  for (std::size_t at = text.find(whole); at != std::string::npos; at = text.find(whole, at + by.size())) {
    text.replace(at, whole.size(), by);
  }
}

}  // namespace

std::string deck_path(const std::string& mesh_path, DeckKind kind) {
  const std::filesystem::path path(mesh_path);
  return (path.parent_path() / (path.stem().string() + '_' + deck_word(kind) + ".inp")).string();
}

void check_deck(const Deck& deck, const TetMesh& mesh) {
  const std::string what = std::string("--deck ") + deck_word(deck.kind);
  for (const DeckHold& hold : deck.holds) {
    if (set_of(mesh, "--hold", hold.set).vertices.empty()) {
      refuse("--hold: the set " + hold.set + " has no nodes", "leave facets: or elements: out of it");
    }
  }
  for (const DeckLoad& load : deck.loads) {
    if (set_of(mesh, "--load", load.set).facets.empty()) {
      refuse("--load: the set " + load.set + " has no facets", "leave nodes: or elements: out of it");
    }
  }
  if (mesh.materials.empty()) refuse(what + ": the mesh has no materials", "give them with --materials FILE.json");
  for (std::size_t m = 0; m < mesh.materials.size(); ++m) {
    const MeshMaterial& material = mesh.materials[m];
    const bool is_mechanical = deck.kind == DeckKind::statics || deck.kind == DeckKind::modal;
    const char* missing = nullptr;
    if (is_mechanical && !(material.youngs_modulus_mpa > 0)) missing = "youngs_modulus_mpa";
    if (deck.kind == DeckKind::modal && !(material.density_tonne_per_mm3 > 0)) missing = "density_g_per_cm3";
    if (!is_mechanical && !(deck.conductivities[m].value_or(0) > 0)) missing = "conductivity";
    if (missing != nullptr) {
      refuse(what + ": the material " + material.name + " has no " + missing, "add it to the file of --materials");
    }
  }
}

void write_deck(const Deck& deck, const TetMesh& mesh, const std::string& mesh_path, const MeshWriteOptions& options) {
  const std::string path = deck_path(mesh_path, deck.kind);
  std::string text = deck.template_text.empty() ? std::string(built_in(deck.kind)) : deck.template_text;
  const DeckText parts(deck, mesh, options);
  replace_all(text, "provenance", options.provenance);
  replace_all(text, "name", std::filesystem::path(path).stem().string());
  replace_all(text, "mesh", std::filesystem::path(mesh_path).filename().string());
  replace_all(text, "hold", parts.hold());
  replace_all(text, "load", parts.load());
  replace_all(text, "conductivity", parts.conductivity());
  write_file(
      path, [&](std::ostream& out) { out << text; }, options.set);
}

}  // namespace scantet
