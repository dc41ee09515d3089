// What FEniCSx's templates ask for: rows of Python's lists. Arrays come from the mesh's own HDF5 file.
#include <filesystem>

#include "scantet/base/options.h"
#include "scantet/decks/deck_words_impl.h"
#include "scantet/io/file_names.h"

namespace scantet {
namespace {

std::string quoted(const std::string& text) {
  return '"' + python_text(text) + '"';
}

/// A number as Python reads it; None for what is not known.
std::string number(double value, bool is_known = true) {
  constexpr int kDigits = 15;
  return is_known ? number_text(value, kDigits) : "None";
}

}  // namespace

std::string python_text(const std::string& text) {
  std::string escaped;
  for (const char c : text) {
    if (c == '\\' || c == '"') escaped += '\\';
    if (c == '\n') {
      escaped += "\\n";
    } else {
      escaped += c;
    }
  }
  return escaped;
}

DeckWords fenicsx_words(const Deck& deck, const TetMesh& mesh, const std::string& mesh_path,
                        const MeshWriteOptions& options) {
  const std::vector<std::string> names = xdmf_set_names(mesh);
  const auto name_of = [&](const std::string& set) {
    return quoted(names[static_cast<std::size_t>(&set_named(mesh, set) - mesh.sets.data())]);
  };
  std::string materials;
  for (std::size_t m = 0; m < mesh.materials.size(); ++m) {
    const MeshMaterial& material = mesh.materials[m];
    const double conductivity = deck.conductivities[m].value_or(0);
    materials += "    (" + quoted(material.name) + ", " +
                 number(material.youngs_modulus_mpa, material.youngs_modulus_mpa > 0) + ", " +
                 number(material.poissons_ratio, material.youngs_modulus_mpa > 0) + ", " +
                 number(material.density_tonne_per_mm3, material.density_tonne_per_mm3 > 0) + ", " +
                 number(conductivity, conductivity > 0) + "),\n";
  }
  std::string hold;
  const bool is_mechanical = deck.kind == DeckKind::statics || deck.kind == DeckKind::modal;
  for (const DeckHold& held : deck.holds) {
    hold += "    (" + name_of(held.set) + ", " + (is_mechanical ? quoted(held.axes) : number(held.value)) + "),\n";
  }
  std::string load;
  for (const DeckLoad& loaded : deck.loads) {
    load += "    (" + name_of(loaded.set) + ", [";
    for (std::size_t i = 0; i < loaded.numbers.size(); ++i) {
      const bool is_turned = options.ras && loaded.numbers.size() == 3 && i < 2;
      load += (i > 0 ? ", " : "") + number(is_turned ? -loaded.numbers[i] : loaded.numbers[i]);
    }
    load += "]),\n";
  }
  for (std::string* const rows : {&materials, &hold, &load}) {
    if (!rows->empty()) rows->pop_back();
  }
  const std::string arrays = std::filesystem::path(mesh_path).filename().replace_extension(".h5").string();
  return {{"materials", materials}, {"hold", hold}, {"load", load}, {"arrays", python_text(arrays)}};
}

}  // namespace scantet
