// Pieces of junctions joined into curves.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "scantet/labels/junction_pieces.h"

namespace scantet {

/// Nodes, and edges along which three or more regions meet. Places are in voxel units.
struct JunctionGraph {
  struct Node {
    Vec index;
    std::vector<Region> regions;  ///< that meet there, ascending
  };
  struct Edge {
    std::array<std::uint32_t, 2> nodes{};  ///< the lesser one first
    std::vector<Region> regions;           ///< that meet along it, ascending
  };
  std::vector<Node> nodes;  ///< some may have no edge
  std::vector<Edge> edges;  ///< no two between the same nodes, none from a node to itself
};

/// A walk along edges, from a corner to a corner with none between.
struct JunctionChain {
  std::vector<std::uint32_t> nodes;  ///< one more than edges; a closed one ends where it starts
  std::vector<std::uint32_t> edges;
  std::vector<Region> regions;  ///< ascending
  bool closed = false;          ///< has no corner
};

/// The nodes with more than two edges, all of them between the same three regions; ascending.
std::vector<std::uint32_t> find_crossings(const JunctionGraph& graph);

/// Joins pieces where their ends are the same point. Points less than `apart` from each other become one.
JunctionGraph join_pieces(const std::vector<JunctionPiece>& pieces, double apart);

/// All edges of the graph as chains, always in the same order. Corners are nodes that have not two edges, or where the
/// regions change.
std::vector<JunctionChain> find_chains(const JunctionGraph& graph);

/// What shorten_graph() took away.
struct Contracted {
  std::size_t chains = 0;             ///< whose ends became one corner
  std::size_t loops = 0;              ///< left out: they end where they start
  std::vector<std::uint32_t> merged;  ///< nodes that took in others, ascending
};

/// Contracts chains that are shorter than `shortest` to corners, and leaves out such loops.
Contracted contract_short_chains(JunctionGraph& graph, const std::vector<JunctionChain>& chains, double shortest);

}  // namespace scantet
