// What CalculiX's templates ask for. Forces and flows that are given as a whole are divided among nodes as an even load
// on the facets is.
#include <map>

#include "scantet/base/element_nodes.h"
#include "scantet/base/options.h"
#include "scantet/decks/deck_words_impl.h"
#include "scantet/io/file_names.h"

namespace scantet {
namespace {

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
      const std::string& name = name_of(set_named(mesh_, hold.set));
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
      const MeshSet& set = set_named(mesh_, load.set);
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

}  // namespace

DeckWords ccx_words(const Deck& deck, const TetMesh& mesh, const MeshWriteOptions& options) {
  const DeckText text(deck, mesh, options);
  return {{"hold", text.hold()}, {"load", text.load()}, {"conductivity", text.conductivity()}};
}

}  // namespace scantet
