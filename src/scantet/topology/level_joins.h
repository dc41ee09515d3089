// How the parts above and below a level hang together beyond the edges of the grid.
#pragma once

#include <cstdint>
#include <vector>

#include "scantet/field/run_sweep.h"
#include "scantet/topology/wall_lines.h"

namespace scantet {

/// A part of one side of the level that reaches an edge or a face whose nodes are all at the level. Two parts of one
/// side that reach the same place are one part if what they reach of it overlaps, or if they are below the level and
/// touch along a line in a face.
struct LevelContact {
  std::int64_t place;    ///< names the edge or face, and for a face the side of the level
  double begin;          ///< of the stretch of an edge that the part reaches, 0 … 1
  double end;            ///< > begin
  WallPart beside_face;  ///< of a face
  std::uint32_t label;   ///< of the part

  friend bool operator<(const LevelContact& a, const LevelContact& b) { return a.place < b.place; }
};

/// Unites the parts that cells between the last two layers of a sweep join, beyond those that edges join. What parts
/// reach at the level goes to `contacts`.
void join_cells(const HeightGrid& heights, const RunSweep& sweep, UnionFind& sets, std::vector<LevelContact>& contacts);

/// Sorts the contacts, and unites the labels of those that overlap.
void join_contacts(std::vector<LevelContact>& contacts, UnionFind& sets);

/// Whether the place of a contact lies in the layer k of nodes.
bool is_in_layer(const LevelContact& contact, const HeightGrid& heights, int k);

}  // namespace scantet
