// What a PLY file holds, by its header. Shared by the plugins that read some.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace ply {

struct Property {
  std::string name;
  std::string type;       ///< as written: "float", "float32" …
  std::size_t bytes = 0;  ///< of a value in a binary file
  bool list = false;      ///< a list of values; bytes is then 0
};

struct Element {
  std::string name;
  std::uint64_t count = 0;
  std::vector<Property> properties;
};

struct Header {
  bool binary = false;
  std::vector<Element> elements;
  std::uint64_t header_bytes = 0;  ///< up to the data
};

/// nullopt if the file does not open with a sound PLY header of at most 64 KiB; throws nothing. What passes is read by
/// CGAL's reader without complaint.
std::optional<Header> read_header(const std::string& file);

/// Whether the file holds points and nothing with lists, such as faces: with those it is a surface.
bool is_point_set(const Header& header);

/// The first of the vertices' x, y, z, nx, ny and nz that is not there as float or double; nx, ny and nz may be
/// missing. CGAL's reader crashes on others. nullopt: none.
std::optional<std::string> odd_coordinate(const Element& vertices);

/// The element that holds the points; nullptr if there is none.
const Element* vertices_of(const Header& header);

}  // namespace ply
