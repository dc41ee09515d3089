// Arrays of numbers as VTK's files hold them, and a mesh made of such arrays. Private to io/.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "scantet/io/mesh_codecs_impl.h"

namespace scantet {

enum class NumberType { int8, uint8, int16, uint16, int32, uint32, int64, uint64, float32, float64 };

std::size_t bytes_of(NumberType type);

/// Numbers from bytes; trailing bytes that make no whole number are left out. Integers above 2^53 are rounded: an index
/// that large is refused anyway.
std::vector<double> decode_numbers(std::string_view bytes, NumberType type, bool big_endian);

/// One unstructured grid as arrays. What a file lacks is empty.
struct VtkGrid {
  std::vector<double> points;        ///< x, y, z of each point
  std::vector<double> connectivity;  ///< point indices of all cells, one after the other
  std::vector<double> cell_ends;     ///< one a cell: where its indices end in `connectivity`
  std::vector<double> types;         ///< one a cell: VTK's cell type
  std::vector<double> regions;       ///< one a cell, if has_regions
  bool has_regions = false;
  std::vector<NamedNumbers> cell_numbers;   ///< one value a cell
  std::vector<NamedNumbers> point_numbers;  ///< one value a point
};

/// How much an array's name says that it tells regions: the smaller the better; none if it does not.
std::optional<int> region_array_rank(std::string_view name);

/// What is known of an array of points or cells before its values are looked at.
struct VtkArray {
  std::string name;
  bool of_cells;
  bool is_real;    ///< of floating-point numbers
  bool is_single;  ///< one number each
};

/// Whether the array is one of a set or, of cells, a field. If it is not, and neither follows from the mesh nor tells
/// regions, left_out gets it in words.
bool is_kept(const VtkArray& array, std::vector<std::string>& left_out);

/// Adds the grid's points and tets to a mesh. Throws Error (input.bad_mesh) if the arrays do not fit together.
void append_grid(const std::string& path, const VtkGrid& grid, RawMesh& mesh);

}  // namespace scantet
