// What stands in a template for its words in double braces. Private to decks/.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "scantet/decks/deck.h"

namespace scantet {

/// Words and what each is replaced by.
using DeckWords = std::vector<std::pair<std::string, std::string>>;

/// The set of this name, which the mesh has (check_deck()).
const MeshSet& set_named(const TetMesh& mesh, const std::string& name);

/// Text as it stands within quotes in Python.
std::string python_text(const std::string& text);

/// Of templates for CalculiX. options: those that the mesh is written with.
DeckWords ccx_words(const Deck& deck, const TetMesh& mesh, const MeshWriteOptions& options);
/// Of templates for FEniCSx, in Python. mesh_path: of the .xdmf.
DeckWords fenicsx_words(const Deck& deck, const TetMesh& mesh, const std::string& mesh_path,
                        const MeshWriteOptions& options);

}  // namespace scantet
