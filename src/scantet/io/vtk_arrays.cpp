// VTK's own readers crash on damaged files (lengths and indices are not checked), so only its decompressors and XML
// parser are used; every array is decoded here and every index checked.
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>

#include "scantet/io/text_scanner_impl.h"
#include "scantet/io/vtk_arrays_impl.h"

namespace scantet {
namespace {

constexpr double kTetra = 10;  // VTK's cell types
constexpr double kQuadraticTetra = 24;

template <typename Number>
std::vector<double> decode(std::string_view bytes, bool swap) {
  std::vector<double> numbers(bytes.size() / sizeof(Number));
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    char word[sizeof(Number)];
    std::memcpy(word, bytes.data() + i * sizeof(Number), sizeof(Number));
    if (swap) std::reverse(word, word + sizeof(Number));
    Number number;
    std::memcpy(&number, word, sizeof(Number));
    numbers[i] = static_cast<double>(number);
  }
  return numbers;
}

bool is_index(double value, std::size_t limit) {
  return value >= 0 && value < static_cast<double>(limit) && value == std::floor(value);
}

Region region_of(const std::string& path, const VtkGrid& grid, std::size_t cell) {
  if (!grid.has_regions) return 0;
  const double value = grid.regions[cell];
  const bool fits = value >= std::numeric_limits<Region>::min() && value <= std::numeric_limits<Region>::max();
  if (!fits || value != std::floor(value)) {
    throw_bad_mesh(
        path, "cell " + std::to_string(cell) + " has region " + std::to_string(value) + ", which is no region number");
  }
  return static_cast<Region>(value);
}

/// Adds to the array of this name those of the values that `is_taken` says. An array that a former grid of the file
/// lacked stays too short.
template <typename Taken>
void append(const NamedNumbers& array, std::vector<NamedNumbers>& arrays, const Taken& is_taken) {
  auto place = std::find_if(arrays.begin(), arrays.end(), [&](const auto& known) { return known.name == array.name; });
  if (place == arrays.end()) place = arrays.insert(place, {array.name, {}});
  for (std::size_t i = 0; i < array.values.size(); ++i) {
    if (is_taken(i)) place->values.push_back(array.values[i]);
  }
}

/// Whether cells of VTK's type have at most two dimensions: those of first order, of second, Lagrange's, Bezier's.
bool is_flat(double type) {
  constexpr std::array<int, 14> kFlat{21, 22, 23, 28, 30, 34, 35, 36, 68, 69, 70, 75, 76, 77};
  return (type >= 0 && type < 10) || std::find(kFlat.begin(), kFlat.end(), type) != kFlat.end();
}

bool is_tet(double type) {
  return type == kTetra || type == kQuadraticTetra;
}

}  // namespace

std::size_t bytes_of(NumberType type) {
  switch (type) {
    case NumberType::int8:
    case NumberType::uint8:
      return 1;
    case NumberType::int16:
    case NumberType::uint16:
      return 2;
    case NumberType::int32:
    case NumberType::uint32:
    case NumberType::float32:
      return 4;
    default:
      return 8;
  }
}

std::vector<double> decode_numbers(std::string_view bytes, NumberType type, bool big_endian) {
  const bool swap = big_endian != (std::endian::native == std::endian::big);
  switch (type) {
    case NumberType::int8:
      return decode<std::int8_t>(bytes, swap);
    case NumberType::uint8:
      return decode<std::uint8_t>(bytes, swap);
    case NumberType::int16:
      return decode<std::int16_t>(bytes, swap);
    case NumberType::uint16:
      return decode<std::uint16_t>(bytes, swap);
    case NumberType::int32:
      return decode<std::int32_t>(bytes, swap);
    case NumberType::uint32:
      return decode<std::uint32_t>(bytes, swap);
    case NumberType::int64:
      return decode<std::int64_t>(bytes, swap);
    case NumberType::uint64:
      return decode<std::uint64_t>(bytes, swap);
    case NumberType::float32:
      return decode<float>(bytes, swap);
    case NumberType::float64:
      return decode<double>(bytes, swap);
  }
  return {};
}

std::optional<int> region_array_rank(std::string_view name) {
  constexpr std::string_view kNames[] = {"region", "medit:ref", "gmsh:physical", "CellEntityIds"};
  const auto* const found = std::find(std::begin(kNames), std::end(kNames), name);
  if (found == std::end(kNames)) return std::nullopt;
  return static_cast<int>(found - std::begin(kNames));
}

bool is_kept(const VtkArray& array, std::vector<std::string>& left_out) {
  constexpr std::string_view kDerived[] = {"on_boundary", "GlobalNodeID", "GlobalElementID", "ModelRegionID"};
  const bool tells_regions = array.of_cells && region_array_rank(array.name);
  const bool is_derived = std::find(std::begin(kDerived), std::end(kDerived), array.name) != std::end(kDerived);
  if (array.is_single && (tells_regions || is_derived || array.name.starts_with("vtk"))) return false;  // or VTK's own
  const bool is_set = array.name.starts_with(kSetPrefix);
  if (array.is_single && (is_set || (array.of_cells && array.is_real))) return true;
  left_out.push_back(named_text(array.of_cells ? "cell array" : "point array", array.name));
  return false;
}

void append_grid(const std::string& path, const VtkGrid& grid, RawMesh& mesh) {
  const std::size_t first_point = mesh.vertices.size();
  const std::size_t points = grid.points.size() / 3;
  for (std::size_t i = 0; i < points; ++i) {
    mesh.vertices.push_back({grid.points[3 * i], grid.points[3 * i + 1], grid.points[3 * i + 2]});
  }
  const std::size_t cells = grid.types.size();
  if (grid.cell_ends.size() != cells) throw_bad_mesh(path, "its cells and their types differ in number");
  if (grid.has_regions && grid.regions.size() != cells) throw_bad_mesh(path, "its cells and regions differ in number");
  double begin = 0;
  for (std::size_t i = 0; i < cells; ++i) {
    const double end = grid.cell_ends[i];
    const bool is_quadratic = grid.types[i] == kQuadraticTetra;
    if (!is_tet(grid.types[i])) {
      ++mesh.other_cells;
      if (!is_flat(grid.types[i])) ++mesh.other_solids;
      begin = end;
      continue;
    }
    if (end - begin != (is_quadratic ? 10 : 4) || !is_index(begin, grid.connectivity.size()) ||
        !is_index(end - 1, grid.connectivity.size())) {
      throw_bad_mesh(path, "cell " + std::to_string(i) + " is a tet that does not have " +
                               (is_quadratic ? "ten" : "four") + " vertices");
    }
    const auto node = [&](std::size_t k) {
      const double vertex = grid.connectivity[static_cast<std::size_t>(begin) + k];
      if (!is_index(vertex, points)) {
        throw_bad_mesh(path, "cell " + std::to_string(i) + " uses a vertex that does not exist (there are " +
                                 std::to_string(points) + ")");
      }
      return first_point + static_cast<std::uint64_t>(vertex);
    };
    mesh.tets.push_back({node(0), node(1), node(2), node(3)});
    if (is_quadratic) mesh.edge_nodes.push_back({node(4), node(5), node(6), node(7), node(8), node(9)});
    mesh.references.push_back(region_of(path, grid, i));
    begin = end;
  }
  constexpr std::size_t kMostArrays = 10'000;  // each is looked for among those of former grids
  if (grid.cell_numbers.size() + grid.point_numbers.size() > kMostArrays)
    throw_bad_mesh(path, "it has too many arrays");
  for (const NamedNumbers& array : grid.cell_numbers) {
    append(array, mesh.tet_numbers, [&](std::size_t i) { return is_tet(grid.types[i]); });
  }
  for (const NamedNumbers& array : grid.point_numbers) {
    append(array, mesh.vertex_numbers, [](std::size_t) { return true; });
  }
}

}  // namespace scantet
