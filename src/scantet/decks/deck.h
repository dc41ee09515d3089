// Small complete inputs for solvers, beside a mesh file: docs/decks.md.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "scantet/base/tet_mesh.h"
#include "scantet/io/mesh_io.h"

namespace scantet {

enum class DeckKind { none, statics, modal, heat, electro };

/// A set that does not move in some directions, or has one temperature or potential.
struct DeckHold {
  std::string set;
  std::string axes = "xyz";  ///< of statics and modal
  double value = 0;          ///< of heat and electro
};

/// What acts on a set.
struct DeckLoad {
  std::string set;
  std::vector<double> numbers;  ///< one: a pressure in MPa, or all heat or current in; three: a force in N, LPS
};

struct Deck {
  DeckKind kind = DeckKind::none;
  std::vector<DeckHold> holds;
  std::vector<DeckLoad> loads;
  std::string template_text;                          ///< empty: the built-in one
  std::vector<std::optional<double>> conductivities;  ///< one a material of the mesh
};

/// "foot", "foot=z", "foot=37". Throws Error: usage.deck.
DeckHold read_hold(const std::string& text, DeckKind kind);

/// "tip=0.5", "tip=0,0,-100". Throws Error: usage.deck.
DeckLoad read_load(const std::string& text, DeckKind kind);

/// "static" and so on; also part of the deck's file name.
const char* deck_word(DeckKind kind);

/// Whether there are decks for meshes of this format: .inp for CalculiX, .xdmf for FEniCSx.
bool takes_deck(const std::string& mesh_path);

/// femur_static.inp for femur.inp, femur_static.py for femur.xdmf.
std::string deck_path(const std::string& mesh_path, DeckKind kind);

/// Throws Error (usage.deck) where the mesh has no such set, or none of what is held or loaded in it.
void check_deck_sets(const Deck& deck, const TetMesh& mesh);

/// The same, and where a material lacks what the solver needs.
void check_deck(const Deck& deck, const TetMesh& mesh);

/// Writes the deck of a mesh file that takes one. deck: checked. options: those that the mesh is written with. Throws
/// Error: output.*.
void write_deck(const Deck& deck, const TetMesh& mesh, const std::string& mesh_path, const MeshWriteOptions& options);

}  // namespace scantet
