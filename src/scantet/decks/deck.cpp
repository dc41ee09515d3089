// A template is copied with its words in double braces replaced.
#include "scantet/decks/deck.h"

#include <algorithm>
#include <filesystem>
#include <ostream>

#include "scantet/base/error.h"
#include "scantet/base/file_extension.h"
#include "scantet/base/options.h"
#include "scantet/decks/deck_words_impl.h"
#include "scantet/io/atomic_file.h"

namespace scantet {
namespace {

using namespace std::string_view_literals;

#include "scantet/decks/deck_templates.inc"

bool is_for_fenicsx(const std::string& mesh_path) {
  return file_extension(mesh_path) == ".xdmf";
}

std::string_view built_in(DeckKind kind, bool fenicsx) {
  switch (kind) {
    case DeckKind::modal:
      return fenicsx ? kPythonModal : kModal;
    case DeckKind::heat:
      return fenicsx ? kPythonHeat : kHeat;
    case DeckKind::electro:
      return fenicsx ? kPythonElectro : kElectro;
    default:
      return fenicsx ? kPythonStatic : kStatic;
  }
}

[[noreturn]] void refuse(const std::string& what, const std::string& remedy) {
  throw Error(Fault::usage, "usage.deck", what, remedy);
}

const MeshSet* find_set(const TetMesh& mesh, const std::string& name) {
  const auto found =
      std::find_if(mesh.sets.begin(), mesh.sets.end(), [&](const MeshSet& set) { return set.name == name; });
  return found == mesh.sets.end() ? nullptr : &*found;
}

const MeshSet& set_of(const TetMesh& mesh, const std::string& option, const std::string& name) {
  if (const MeshSet* const set = find_set(mesh, name)) return *set;
  std::vector<std::string> names;
  for (const MeshSet& set : mesh.sets) names.push_back(set.name);
  const auto meant = closest_name(name, names);
  refuse(option + ": there is no set \"" + name + "\"" + (meant ? "; did you mean " + *meant + "?" : ""),
         "name it with --set \"" + name + "=PLACE\"");
}

/// The template with each word in double braces replaced; what replaces one is not looked through again.
std::string filled(std::string_view text, const DeckWords& words) {
  std::string out;
  while (!text.empty()) {
    const std::size_t begin = std::min(text.find("{{"), text.size());
    const std::size_t end = text.find("}}", begin);
    out += text.substr(0, begin);
    if (end == std::string_view::npos) return out.append(text.substr(begin));
    const std::string_view name = text.substr(begin + 2, end - begin - 2);
    const auto word = std::find_if(words.begin(), words.end(), [&](const auto& known) { return known.first == name; });
    if (word == words.end()) {
      out += "{{";
      text.remove_prefix(begin + 2);
    } else {
      out += word->second;
      text.remove_prefix(end + 2);
    }
  }
  return out;
}

/// Within its line, whatever a file is called: another line of a deck is another command.
std::string on_one_line(std::string text) {
  std::replace_if(
      text.begin(), text.end(), [](unsigned char c) { return c < ' ' || c == 127; }, ' ');
  return text;
}

}  // namespace

const MeshSet& set_named(const TetMesh& mesh, const std::string& name) {
  return *find_set(mesh, name);
}

bool takes_deck(const std::string& mesh_path) {
  return file_extension(mesh_path) == ".inp" || is_for_fenicsx(mesh_path);
}

std::string deck_path(const std::string& mesh_path, DeckKind kind) {
  const std::filesystem::path path(mesh_path);
  const char* const extension = is_for_fenicsx(mesh_path) ? ".py" : ".inp";
  return (path.parent_path() / (path.stem().string() + '_' + deck_word(kind) + extension)).string();
}

void check_deck_sets(const Deck& deck, const TetMesh& mesh) {
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
}

void check_deck(const Deck& deck, const TetMesh& mesh) {
  check_deck_sets(deck, mesh);
  const std::string what = std::string("--deck ") + deck_word(deck.kind);
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
  const bool fenicsx = is_for_fenicsx(mesh_path);
  std::string text = deck.template_text.empty() ? std::string(built_in(deck.kind, fenicsx)) : deck.template_text;
  const std::string name = std::filesystem::path(path).stem().string();
  const std::string mesh_name = std::filesystem::path(mesh_path).filename().string();
  DeckWords words{{"provenance", on_one_line(options.provenance)}, {"name", name}, {"mesh", mesh_name}};
  if (fenicsx) {
    text = filled(text, {{"model", std::string(kPythonModel)}});
    for (auto& [word, by] : words) by = python_text(by);
  }
  for (auto& word : fenicsx ? fenicsx_words(deck, mesh, mesh_path, options) : ccx_words(deck, mesh, options)) {
    words.push_back(std::move(word));
  }
  text = filled(text, words);
  write_file(
      path, [&](std::ostream& out) { out << text; }, options.set);
}

}  // namespace scantet
