// What one side of the level has in a cell: its pieces, and their Euler numbers.
#pragma once

#include <array>
#include <cstdint>

namespace scantet::verify {

/// One side's part in a cell. It is closed: {height ≥ ε} for an ε that is smaller than every height but 0, so that
/// nodes and saddles at the level itself are outside of either side.
struct CellPart {
  std::array<std::uint8_t, 8> piece{};  ///< of each corner in the part: the least corner of its piece
  std::array<std::int8_t, 8> euler{};   ///< of that piece, at its least corner
  std::uint8_t members = 0;             ///< bit c: corner c is in the part
  bool is_known = true;                 ///< false: ties that are not resolved; then the rest may be wrong
  bool has_tied_saddle = false;         ///< a saddle at the level decides over what is joined
};

/// values: at the corners of a cell (bit 0 of the position is x, bit 1 y, bit 2 z); side: 1 for values above the level,
/// -1 for those below.
CellPart part_in_cell(const std::array<double, 8>& values, double level, int side);

/// The corners of a face (f, bits u and v) that are joined across its middle: whether the two of a diagonal, both in
/// the part, with the other two not in it, are one piece.
inline int face_corner(int axis, int side, int n) {
  const int u = 1 << (axis + 1) % 3;
  const int v = 1 << (axis + 2) % 3;
  return (side << axis) + (n & 1 ? u : 0) + (n & 2 ? v : 0);
}

/// How many pieces the part has in the low face of a cell across an axis.
int pieces_in_low_face(const std::array<double, 8>& values, double level, int side, int axis,
                       std::array<int, 2>& corners);

}  // namespace scantet::verify
