#include "scantet/app/model_options.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>
#include <utility>

#include "scantet/base/ascii_text.h"
#include "scantet/base/error.h"
#include "scantet/base/file_extension.h"
#include "scantet/base/regular_file.h"
#include "scantet/io/input_files.h"
#include "scantet/io/mesh_losses.h"
#include "scantet/materials/assign_materials.h"
#include "scantet/places/place_items.h"
#include "scantet/reading/scan_reader.h"

namespace scantet {
namespace {

void read_scans(const std::vector<std::string>& names, ModelPlan& plan, Progress& progress) {
  for (const std::string& name : names) {
    if (plan.scans.count(name) > 0 || progress.cancelled()) continue;
    constexpr bool kMayBeConstant = true;
    Scan scan = read_scan(name, progress, kMayBeConstant);
    if (progress.cancelled()) return;
    for (const std::string& file : input_files(name)) plan.files.push_back(file);
    plan.scans.emplace(name, ScanValues(std::move(scan)));
  }
}

}  // namespace

void declare_model_options(OptionSet& options, ModelOptions& model) {
  options.add(
      "set", model.sets,
      {"Model", "NAME=PLACE", "a named place",
       "Names a place in the files, to be held or loaded: \"foot=z < -40\", \"load=facets: patch(outer) and "
       "ball(0, 0, 90, 12)\", \"hot=elements: scan(\"pet.nrrd\") > 3\". A place is a box, ball, cylinder, half-space, "
       "region, patch, curve, border, normal, nearest, scan or set, joined by and, or, minus and not "
       "(docs/places.md). Without nodes:, facets: or elements: the set holds all three."});
  options.add("materials", model.materials,
              {"Model", "FILE", "a file name",
               "Materials of the mesh, from a JSON file: constants for places or regions, or a law from the values of "
               "a scan to density and stiffness, averaged over each tetrahedron, in bins (docs/materials.md)."});
  options.add(
      "deck", model.deck,
      {{"none", DeckKind::none},
       {"static", DeckKind::statics},
       {"modal", DeckKind::modal},
       {"heat", DeckKind::heat},
       {"electro", DeckKind::electro}},
      {"Model", "KIND", "a kind of analysis",
       "Writes a complete input for a solver beside each mesh that has one: femur_static.inp for CalculiX beside "
       "femur.inp, femur_static.py for FEniCSx beside femur.xdmf. It needs --materials (docs/decks.md)."});
  options.add(
      "hold", model.holds,
      {"Model", "SET", "the name of a set",
       "What is held in the deck: foot, foot=z (along that axis only), or with heat and electro a temperature or "
       "potential, foot=37."});
  options.add("load", model.loads,
              {"Model", "SET=VALUE", "a load",
               "What acts on the facets of a set in the deck. static: a pressure in MPa, tip=0.5, or a force in N, "
               "tip=0,0,-100; heat: the whole heat in, W; electro: the whole current in, A."});
  options.add("deck-template", model.deck_template,
              {"Model", "FILE", "a file name",
               "A template to write the deck from, instead of the built-in one (share/scantet/decks)."});
}

namespace {

void refuse_deck(const std::string& what, const std::string& remedy) {
  throw Error(Fault::usage, "usage.deck", what, remedy);
}

Deck plan_deck(const ModelOptions& options, const std::vector<std::string>& outputs) {
  Deck deck;
  deck.kind = options.deck;
  if (options.deck == DeckKind::none) {
    const bool is_given = !options.holds.empty() || !options.loads.empty() || !options.deck_template.empty();
    if (is_given)
      refuse_deck("--hold, --load, --deck-template: they do nothing without a deck", "add --deck static, say");
    return deck;
  }
  if (options.materials.empty()) refuse_deck("--deck: a deck needs materials", "give them with --materials FILE.json");
  std::set<std::string> formats;
  for (const std::string& file : outputs) {
    if (!takes_deck(file)) continue;
    formats.insert(file_extension(file));
    const std::string name = std::filesystem::path(file).filename().string();
    if (file_extension(file) == ".inp" && name.find_first_of(" \t") != std::string::npos) {
      refuse_deck("--deck: CalculiX reads no names with blanks, and the deck is to read " + file, "name it without");
    }
  }
  if (formats.empty()) {
    refuse_deck("--deck: no mesh is written that the deck is for",
                "add -o FILE.inp for CalculiX, -o FILE.xdmf for FEniCSx");
  }
  if (formats.size() > 1 && !options.deck_template.empty()) {
    refuse_deck("--deck-template: one template cannot serve CalculiX and FEniCSx", "write .inp and .xdmf in two runs");
  }
  for (const std::string& text : options.holds) deck.holds.push_back(read_hold(text, options.deck));
  for (const std::string& text : options.loads) deck.loads.push_back(read_load(text, options.deck));
  if (!options.deck_template.empty()) {
    check_regular_file(options.deck_template);
    std::ifstream stream(options.deck_template, std::ios::binary);
    if (!stream) refuse_deck("--deck-template: " + options.deck_template + " cannot be read", "check the path");
    deck.template_text.assign(std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>());
  }
  return deck;
}

/// The constants of materials as fields, for formats without materials.
void add_fields(TetMesh& mesh) {
  MeshField number{kMaterialFields[0], {}};
  MeshField modulus{kMaterialFields[1], {}};
  MeshField density{kMaterialFields[2], {}};
  for (const std::uint32_t m : mesh.tet_materials) {
    modulus.values.push_back(mesh.materials[m].youngs_modulus_mpa);
    density.values.push_back(mesh.materials[m].density_tonne_per_mm3);
    number.values.push_back(m + 1);
  }
  for (MeshField* field : {&number, &modulus, &density}) mesh.fields.push_back(std::move(*field));
}

void check_sets_of(const NamedPlace& place, const std::string& option, const TetMesh& named) {
  for (const std::string& name : sets_of(place.place)) {
    const auto is_it = [&](const MeshSet& other) { return other.name == name; };
    if (std::any_of(named.sets.begin(), named.sets.end(), is_it)) continue;
    throw Error(Fault::usage, "usage.place",
                option + ": \"" + place.text + "\": no set before it is called \"" + name + "\"",
                "give --set " + name + "=PLACE first");
  }
}

/// What needs no mesh: sets that places, materials and decks ask for are there, before hours of work.
void check_set_names(const ModelPlan& plan) {
  TetMesh named;  // nothing but sets, with something in them
  for (const NamedPlace& set : plan.sets) {
    check_sets_of(set, "--set", named);
    const auto has = [&](PlaceItems items) {
      return std::vector<std::uint32_t>(set.items == PlaceItems::all || set.items == items ? 1 : 0);
    };
    named.sets.push_back({set.name, has(PlaceItems::nodes), has(PlaceItems::facets), has(PlaceItems::elements)});
  }
  if (plan.materials) {
    for (const PlaceMaterial& each : plan.materials->places) check_sets_of(each.place, "--materials", named);
  }
  if (plan.deck.kind != DeckKind::none) check_deck_sets(plan.deck, named);
}

/// Empty if the input does not list them.
std::set<Region> known_regions(const OpenedDomain& opened) {
  std::set<Region> known;
  for (const Component& component : opened.domain->components()) known.insert(component.region);
  if (opened.grid) {
    for (const GridRegion& region : opened.grid().regions) known.insert(region.region);
  }
  known.erase(kOutside);
  return known;
}

void refuse_taken_names(const ModelPlan& plan, const TetMesh& mesh) {
  for (const NamedPlace& named : plan.sets) {
    const auto is_same = [&](const std::string& other) { return ascii_lower(other) == ascii_lower(named.name); };
    const bool is_patch = std::any_of(mesh.patches.begin(), mesh.patches.end(),
                                      [&](const MeshPatch& p) { return is_same(patch_name(p)); });
    const bool is_region = std::any_of(mesh.region_names.begin(), mesh.region_names.end(),
                                       [&](const auto& region) { return is_same(region.second); });
    if (!is_patch && !is_region) continue;
    throw Error(Fault::usage, "usage.place",
                "--set: \"" + named.text + "\": a " + (is_patch ? "boundary" : "region") + " of the mesh has this name",
                "choose another name for the set");
  }
}

}  // namespace

ModelPlan plan_model(const ModelOptions& options, const std::vector<std::string>& outputs, Progress& progress) {
  ModelPlan plan;
  for (const std::string& text : options.sets) {
    plan.sets.push_back(read_named_place("--set", text));
    const std::string name = ascii_lower(plan.sets.back().name);
    const auto is_same = [&](const NamedPlace& other) { return ascii_lower(other.name) == name; };
    if (std::count_if(plan.sets.begin(), plan.sets.end(), is_same) > 1) {
      throw Error(Fault::usage, "usage.place", "--set: \"" + text + "\": another set is called " + name,
                  "give each set a name of its own; capitals make no difference");
    }
  }
  plan.deck = plan_deck(options, outputs);
  if (!options.deck_template.empty()) plan.files.push_back(options.deck_template);
  if (!options.materials.empty()) {
    plan.materials = read_material_file(options.materials);
    plan.files.push_back(options.materials);
  }
  check_set_names(plan);
  for (const NamedPlace& named : plan.sets) read_scans(scans_of(named.place), plan, progress);
  if (plan.materials) {
    for (const PlaceMaterial& each : plan.materials->places) read_scans(scans_of(each.place.place), plan, progress);
    if (plan.materials->law) read_scans({plan.materials->law->scan}, plan, progress);
  }
  return plan;
}

void check_regions(const ModelPlan& plan, const OpenedDomain& opened) {
  std::vector<std::pair<const NamedPlace*, std::string>> places;  // and their options
  for (const NamedPlace& set : plan.sets) places.emplace_back(&set, "--set");
  if (plan.materials) {
    for (const PlaceMaterial& each : plan.materials->places) places.emplace_back(&each.place, "--materials");
  }
  std::erase_if(places, [](const auto& place) { return regions_of_place(place.first->place).empty(); });
  if (places.empty()) return;
  TetMesh named;  // nothing but names
  std::vector<std::string> names;
  const std::set<Region> known = known_regions(opened);
  for (const Region region : known) {
    const std::string name = opened.domain->name_of_region(region);
    if (!name.empty()) named.region_names[region] = name;
    names.push_back(region_name(named, region));
  }
  for (const auto& [place, option] : places) {
    for (const std::string& asked : regions_of_place(place->place)) {
      const auto is_it = [&](Region r) { return std::to_string(r) == asked || region_name(named, r) == asked; };
      if (known.empty() || std::any_of(known.begin(), known.end(), is_it)) continue;
      const auto meant = closest_name(asked, names);
      throw Error(Fault::usage, "usage.place",
                  option + ": \"" + place->text + "\": no region of the object is called \"" + asked + "\"",
                  meant ? "did you mean " + *meant + "?" : "scantet info lists the regions");
    }
  }
}

void add_model(ModelPlan& plan, TetMesh& mesh) {
  refuse_taken_names(plan, mesh);
  for (const NamedPlace& named : plan.sets) mesh.sets.push_back(items_in_place(mesh, named, plan.scans));
  if (plan.materials) {
    plan.deck.conductivities = assign_materials(*plan.materials, plan.scans, mesh);
    add_fields(mesh);
  }
  if (plan.deck.kind != DeckKind::none) check_deck(plan.deck, mesh);
}

std::vector<std::string> deck_files(DeckKind kind, const std::vector<std::string>& outputs) {
  std::vector<std::string> files;
  for (const std::string& file : outputs) {
    if (kind != DeckKind::none && takes_deck(file)) files.push_back(deck_path(file, kind));
  }
  return files;
}

}  // namespace scantet
