// What a mesh carries for a solver: named places, materials; and decks beside it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "scantet/base/options.h"
#include "scantet/base/progress.h"
#include "scantet/base/tet_mesh.h"
#include "scantet/decks/deck.h"
#include "scantet/materials/material_file.h"
#include "scantet/places/place.h"
#include "scantet/places/scan_values.h"
#include "scantet/plugin/input_plugin.h"

namespace scantet {

/// As texts.
struct ModelOptions {
  std::vector<std::string> sets;  ///< "foot=z < -40"
  std::string materials;          ///< a file; empty: none
  DeckKind deck = DeckKind::none;
  std::vector<std::string> holds;  ///< "foot", "foot=z", "foot=37"
  std::vector<std::string> loads;  ///< "tip=0.5", "tip=0,0,-100"
  std::string deck_template;       ///< a file; empty: the built-in one
};

/// Declares --set, --materials, --deck and what goes with it.
void declare_model_options(OptionSet& options, ModelOptions& model);

/// What is added to a mesh, read before there is one, so that mistakes are told before hours of work.
struct ModelPlan {
  std::vector<NamedPlace> sets;
  ScanTable scans;
  std::optional<MaterialFile> materials;
  Deck deck;
  std::vector<std::string> files;  ///< that were read
};

/// outputs: of the mesh. Throws Error: usage.place, usage.materials, usage.deck, input.* of the scans. If progress is
/// cancelled, scans may be missing.
ModelPlan plan_model(const ModelOptions& options, const std::vector<std::string>& outputs, Progress& progress);

/// That the input has the regions that places ask for, if it lists any: before hours of work. Throws Error:
/// usage.place.
void check_regions(const ModelPlan& plan, const OpenedDomain& opened);

/// Adds sets and materials to the mesh; materials are fields, too. Throws Error: as items_in_place(),
/// assign_materials() and check_deck().
void add_model(ModelPlan& plan, TetMesh& mesh);

/// The decks that are written beside these meshes.
std::vector<std::string> deck_files(DeckKind kind, const std::vector<std::string>& outputs);

}  // namespace scantet
