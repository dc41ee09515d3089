// How a trilinear function joins the corners of its cell, and where its saddles are.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "scantet/field/trilinear_cell.h"

namespace scantet {

/// What the signs at the corners leave open once the corners of one sign are joined along the cell's edges; inside is
/// height > 0. pattern: bit c is set if corner c is inside. Return: bit `axis` (0 … 2) is set if the cell's low face
/// across that axis is ambiguous (its corners alternate in sign), and kBodyOpen if the corners of one sign form two
/// groups or more.
std::uint8_t open_questions(unsigned pattern);
inline constexpr std::uint8_t kBodyOpen = 8;

/// Corners of the cell's low face across `axis`, at (0,0), (1,0), (0,1), (1,1) in the other axes in ascending order.
std::array<int, 4> low_face(int axis);

/// The axes of a face across `axis`, ascending.
constexpr std::array<int, 2> face_axes(int axis) {
  return {axis == 0 ? 1 : 0, axis == 2 ? 1 : 2};
}

/// A node of the low face of a cell across `axis`, moved by `step` across it. n: 0 … 3, as in low_face().
std::array<int, 3> low_face_node(const std::array<int, 3>& cell, int axis, int n, int step);

/// The saddle of the bilinear function of a face.
struct FaceSaddle {
  double u;  ///< its place along the first of the face's axes, from 0 to 1
  double v;  ///< along the second
  double value;
  double twist;  ///< the mixed derivative; the pure ones are zero

  /// At its place, the bilinear function with these values at the corners.
  double at_its_place(const std::array<double, 4>& h) const { return mix(mix(h[0], h[1], u), mix(h[2], h[3], u), v); }
  /// Its place on the low face of a cell across `axis`, as an index.
  Vec index(const std::array<int, 3>& cell, int axis) const;
};

/// Pre: the face is ambiguous, or both heights at the ends of one diagonal are greater than both at the other's.
FaceSaddle face_saddle(const std::array<double, 4>& h);

/// The two corners that are joined through the low face of a cell across `axis`, which must be ambiguous. None if its
/// saddle is at the level itself; line_joins() has what touches along a line from there. Guarantee: exact wherever the
/// products of two heights are.
std::optional<std::array<int, 2>> low_face_join(const CellHeights& h, int axis);

/// The join through the body of a cell that the joins along its edges and faces may leave out. Return: two corners of
/// one sign whose groups are joined by the part of the cell where the function has that sign. Guarantee: with the joins
/// along edges and faces, these make up exactly the components of {h > 0} and of {h < 0} in the cell, if no corner is
/// at 0. A cell has at most one such join.
std::optional<std::array<int, 2>> body_join(const CellHeights& h);

/// Pairs of corners below zero whose groups touch along a line through the cell, which joins them: the function is a
/// product there, and zero on the line, and the parts above touch, too. Return: how many of `out` are set; a line may
/// be found several times. Guarantee: exact wherever the products of two heights are.
int line_joins(const CellHeights& h, std::array<std::array<int, 2>, 6>& out);

/// A point where the gradient vanishes.
struct Saddle {
  Vec position;                 ///< in the cell's own coordinates
  double value;                 ///< height there
  std::array<double, 3> mixed;  ///< the second derivatives ∂yz, ∂xz, ∂xy there; the pure ones are zero
};

/// The isolated critical points strictly inside the cell. Return: how many of `out` are set, at most 2.
int body_saddles(const CellHeights& h, std::array<Saddle, 2>& out);

}  // namespace scantet
