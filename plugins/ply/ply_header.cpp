// CGAL's reader tells a surface from a point set only by reading it, prints what it does not like, crashes on a
// property without an element, and believes any count. So the header is read here first, for the choice among plugins
// and for the checks.
#include "ply_header.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <fstream>
#include <sstream>

namespace ply {
namespace {

constexpr std::uint64_t kLongest = 65536;

struct Type {
  const char* name;
  std::size_t bytes;
};
constexpr std::array kTypes{Type{"char", 1},  Type{"int8", 1},    Type{"uchar", 1},  Type{"uint8", 1},
                            Type{"short", 2}, Type{"int16", 2},   Type{"ushort", 2}, Type{"uint16", 2},
                            Type{"int", 4},   Type{"int32", 4},   Type{"uint", 4},   Type{"uint32", 4},
                            Type{"float", 4}, Type{"float32", 4}, Type{"double", 8}, Type{"float64", 8}};

/// 0 if there is no such type.
std::size_t bytes_of(const std::string& type) {
  const auto found = std::find_if(kTypes.begin(), kTypes.end(), [&](const Type& t) { return type == t.name; });
  return found == kTypes.end() ? 0 : found->bytes;
}

bool read_property(std::istringstream& words, Header& header) {
  Property property;
  if (header.elements.empty() || !(words >> property.type)) return false;
  property.list = property.type == "list";
  if (property.list) {
    std::string count_type;
    if (!(words >> count_type >> property.type) || bytes_of(count_type) == 0) return false;
  }
  property.bytes = bytes_of(property.type);
  if (property.bytes == 0 || !(words >> property.name)) return false;
  if (property.list) property.bytes = 0;
  header.elements.back().properties.push_back(std::move(property));
  return true;
}

bool read_element(std::istringstream& words, Header& header) {
  Element element;
  std::string count;
  if (!(words >> element.name >> count) || !std::isdigit(static_cast<unsigned char>(count[0]))) return false;
  std::istringstream number(count);
  if (!(number >> element.count)) return false;
  header.elements.push_back(std::move(element));
  return true;
}

}  // namespace

std::optional<Header> read_header(const std::string& file) {
  std::ifstream stream(file, std::ios::binary);
  std::string start(kLongest, '\0');
  stream.read(start.data(), static_cast<std::streamsize>(start.size()));
  start.resize(static_cast<std::size_t>(stream.gcount()));
  Header header;
  std::istringstream lines(start);
  std::string line;
  for (int number = 1; std::getline(lines, line); ++number) {
    std::istringstream words(line);
    std::string keyword;
    std::string format;
    words >> keyword;
    if (number == 1) {
      if (keyword != "ply") return std::nullopt;
    } else if (number == 2) {
      std::string version;
      if (keyword != "format" || !(words >> format >> version)) return std::nullopt;
      header.binary = format == "binary_little_endian" || format == "binary_big_endian";
      if (!header.binary && format != "ascii") return std::nullopt;
    } else if (keyword == "end_header") {
      if (lines.eof()) return std::nullopt;
      header.header_bytes = static_cast<std::uint64_t>(lines.tellg());
      return header;
    } else if (keyword.empty() || (keyword == "element" && !read_element(words, header)) ||
               (keyword == "property" && !read_property(words, header))) {
      return std::nullopt;
    }
  }
  return std::nullopt;
}

const Element* vertices_of(const Header& header) {
  const auto found = std::find_if(header.elements.begin(), header.elements.end(),
                                  [](const Element& e) { return e.name == "vertex" || e.name == "vertices"; });
  return found == header.elements.end() ? nullptr : &*found;
}

std::optional<std::string> odd_coordinate(const Element& vertices) {
  for (const std::string name : {"x", "y", "z", "nx", "ny", "nz"}) {
    const auto found = std::find_if(vertices.properties.begin(), vertices.properties.end(),
                                    [&](const Property& p) { return p.name == name; });
    const bool is_needed = name.size() == 1;
    const bool is_there = found != vertices.properties.end();
    if (!is_there && !is_needed) continue;
    if (!is_there || found->list || (found->type[0] != 'f' && found->type[0] != 'd')) return name;
  }
  return std::nullopt;
}

bool is_point_set(const Header& header) {
  const auto has_lists = [](const Element& e) {
    return e.count > 0 && std::any_of(e.properties.begin(), e.properties.end(), [](const auto& p) { return p.list; });
  };
  return vertices_of(header) != nullptr && std::none_of(header.elements.begin(), header.elements.end(), has_lists);
}

}  // namespace ply
