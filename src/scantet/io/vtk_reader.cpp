// Legacy .vtk files, versions 1 to 5.1, text or binary (big-endian). The format has no table of contents: every section
// before the last one wanted must be understood well enough to be stepped over.
#include <charconv>

#include "scantet/base/ascii_text.h"
#include "scantet/base/error.h"
#include "scantet/io/mesh_codecs_impl.h"
#include "scantet/io/text_scanner_impl.h"
#include "scantet/io/vtk_arrays_impl.h"

namespace scantet {
namespace {

class LegacyReader {
 public:
  LegacyReader(const std::string& path, const std::string& text) : path_(path), scan_(path, text) {}

  RawMesh read() {
    read_header();
    for (std::string keyword = ascii_upper(scan_.token()); !keyword.empty(); keyword = ascii_upper(scan_.token())) {
      if (!read_geometry(keyword) && !read_attribute(keyword)) {
        scan_.fail(in_quotes(keyword) + " is not a section of a VTK file");
      }
    }
    require_sizes(grid_.cell_numbers, grid_.types.size());
    require_sizes(grid_.point_numbers, grid_.points.size() / 3);
    append_grid(path_, grid_, mesh_);
    return std::move(mesh_);
  }

 private:
  void read_header() {
    constexpr std::string_view kMagic = "# vtk DataFile Version ";
    const std::string first(scan_.rest_of_line());
    if (!first.starts_with(kMagic)) scan_.fail("a legacy VTK file begins with '# vtk DataFile Version'");
    version_5_ = first.substr(kMagic.size()) >= "5";
    mesh_.ras = scan_.rest_of_line().find(std::string(kSpaceKey) + "=RAS") != std::string_view::npos;
    const std::string coding = ascii_upper(scan_.token());
    if (coding != "ASCII" && coding != "BINARY") scan_.fail("ASCII or BINARY is expected");
    binary_ = coding == "BINARY";
    if (ascii_upper(scan_.token()) != "DATASET") scan_.fail("DATASET is expected");
    const std::string dataset = ascii_upper(scan_.token());
    if (dataset != "UNSTRUCTURED_GRID") {
      throw Error(Fault::input, "input.no_tets", "'" + path_ + "' has no tetrahedra: it holds " + in_quotes(dataset),
                  "give a file with a tetrahedral mesh (UNSTRUCTURED_GRID)");
    }
  }

  void require_sizes(const std::vector<NamedNumbers>& arrays, std::size_t expected) const {
    for (const NamedNumbers& array : arrays) {
      if (array.values.size() == expected) continue;
      throw_bad_mesh(path_, "the array " + in_quotes(array.name) + " has " + std::to_string(array.values.size()) +
                                " values instead of " + std::to_string(expected));
    }
  }

  /// True if the section is one of the grid's own.
  bool read_geometry(const std::string& keyword) {
    if (keyword == "POINTS") {
      const std::uint64_t n = scan_.count(1);
      const std::string type(scan_.token());
      grid_.points = read_numbers(3 * n, type);
    } else if (keyword == "CELLS") {
      version_5_ ? read_cells_5() : read_cells_4();
    } else if (keyword == "CELL_TYPES") {
      grid_.types = read_numbers(scan_.count(1), "int");
    } else {
      return false;
    }
    return true;
  }

  void read_cells_4() {
    const std::uint64_t cells = scan_.count(1);
    const std::vector<double> list = read_numbers(scan_.count(1), "int");
    std::size_t next = 0;
    for (std::uint64_t i = 0; i < cells; ++i) {
      if (next >= list.size() || !(list[next] >= 0) || list[next] > static_cast<double>(list.size() - next - 1)) {
        scan_.fail("cell " + std::to_string(i) + " has an impossible number of vertices");
      }
      const auto size = static_cast<std::size_t>(list[next]);
      const auto begin = list.begin() + static_cast<std::ptrdiff_t>(next) + 1;
      grid_.connectivity.insert(grid_.connectivity.end(), begin, begin + static_cast<std::ptrdiff_t>(size));
      grid_.cell_ends.push_back(static_cast<double>(grid_.connectivity.size()));
      next += size + 1;
    }
  }

  void read_cells_5() {
    const std::uint64_t offsets = scan_.count(1);
    const std::uint64_t indices = scan_.count(1);
    if (ascii_upper(scan_.token()) != "OFFSETS") scan_.fail("OFFSETS is expected");
    std::string type(scan_.token());
    grid_.cell_ends = read_numbers(offsets, type);
    if (!grid_.cell_ends.empty()) grid_.cell_ends.erase(grid_.cell_ends.begin());
    if (ascii_upper(scan_.token()) != "CONNECTIVITY") scan_.fail("CONNECTIVITY is expected");
    type = scan_.token();
    grid_.connectivity = read_numbers(indices, type);
  }

  /// True if the section is about attributes of points or cells. All are stepped over but arrays that tell regions,
  /// sets and fields.
  bool read_attribute(const std::string& keyword) {
    if (keyword == "CELL_DATA" || keyword == "POINT_DATA") {
      attributes_ = keyword == "CELL_DATA" ? Attributes::cells : Attributes::points;
      tuples_ = scan_.count(0);
    } else if (keyword == "METADATA") {
      skip_metadata();
    } else if (keyword == "FIELD") {
      scan_.token();
      read_field(scan_.count(1));
    } else if (keyword == "SCALARS") {
      read_scalars();
    } else if (keyword == "COLOR_SCALARS") {
      leave_out(scan_.token());
      read_numbers(tuples_ * scan_.count(1), binary_ ? "unsigned_char" : "float");
    } else if (keyword == "LOOKUP_TABLE") {
      scan_.token();
      read_numbers(4 * scan_.count(1), binary_ ? "unsigned_char" : "float");
    } else if (keyword == "TEXTURE_COORDINATES") {
      leave_out(scan_.token());
      const std::uint64_t components = scan_.count(1);
      const std::string type(scan_.token());
      read_numbers(tuples_ * components, type);
    } else {
      return read_plain_attribute(keyword);
    }
    return true;
  }

  bool read_plain_attribute(const std::string& keyword) {
    std::uint64_t components = 0;
    if (keyword == "VECTORS" || keyword == "NORMALS") components = 3;
    if (keyword == "TENSORS") components = 9;
    if (keyword == "TENSORS6") components = 6;
    if (keyword == "GLOBAL_IDS" || keyword == "PEDIGREE_IDS" || keyword == "EDGE_FLAGS") components = 1;
    if (components == 0) return false;
    const std::string name(scan_.token());
    if (components > 1) leave_out(name);  // others number or mark what is there
    const std::string type(scan_.token());
    read_numbers(components * tuples_, type);
    return true;
  }

  void read_scalars() {
    const std::string name(scan_.token());
    const std::string type(scan_.token());
    std::uint64_t components = 1;
    if (ascii_upper(scan_.peek()) != "LOOKUP_TABLE") components = scan_.count(1);
    if (ascii_upper(scan_.token()) != "LOOKUP_TABLE") scan_.fail("LOOKUP_TABLE is expected");
    scan_.token();
    keep(name, components, type, read_numbers(components * tuples_, type));
  }

  void read_field(std::uint64_t arrays) {
    for (std::uint64_t i = 0; i < arrays; ++i) {
      while (scan_.peek() == "METADATA") {
        scan_.token();
        skip_metadata();
      }
      const std::string name(scan_.token());
      if (name == "NULL_ARRAY") continue;
      const std::uint64_t components = scan_.count(0);
      const std::uint64_t tuples = scan_.count(0);
      const std::string type(scan_.token());
      if (type == "string" || type == "utf8_string") {
        leave_out(name);
        read_strings(name, components * tuples);
      } else {
        keep(name, components, type, read_numbers(components * tuples, type));
      }
    }
  }

  /// Keeps the array if it tells regions, or is of a set or a field.
  void keep(const std::string& name_in_file, std::uint64_t components, const std::string& type,
            std::vector<double> values) {
    if (attributes_ == Attributes::none) return;
    const std::string name = decoded(name_in_file);
    const bool of_cells = attributes_ == Attributes::cells;
    const std::optional<int> rank = region_array_rank(name);
    if (of_cells && components == 1 && rank && *rank < region_rank_) {
      region_rank_ = *rank;
      grid_.has_regions = true;
      grid_.regions = std::move(values);
      return;
    }
    const bool is_real = type == "float" || type == "double";
    if (!is_kept({name, of_cells, is_real, components == 1 && type != "bit"}, mesh_.left_out)) return;
    (of_cells ? grid_.cell_numbers : grid_.point_numbers).push_back({name, std::move(values)});
  }

  /// What is never kept.
  void leave_out(std::string_view name) {
    if (attributes_ == Attributes::none) return;
    is_kept({decoded(name), attributes_ == Attributes::cells, false, false}, mesh_.left_out);
  }

  /// A name where %20 stands for a blank, as VTK writes them.
  static std::string decoded(std::string_view name) {
    std::string text;
    for (std::size_t i = 0; i < name.size(); ++i) {
      int code = 0;
      const char* const digits = name.data() + i + 1;
      const bool is_code =
          name[i] == '%' && name.size() > i + 2 && std::from_chars(digits, digits + 2, code, 16).ptr == digits + 2;
      text.push_back(is_code ? static_cast<char>(code) : name[i]);
      if (is_code) i += 2;
    }
    return text;
  }

  void skip_metadata() {
    scan_.rest_of_line();
    while (!scan_.at_end() && !scan_.rest_of_line().empty()) {
    }
  }

  /// A string each line, or, in binary files, a length in 1, 2, 4 or 8 bytes (by its two highest bits) and the text.
  void read_strings(const std::string& name, std::uint64_t n) {
    scan_.rest_of_line();
    for (std::uint64_t i = 0; i < n; ++i) {
      if (scan_.at_end()) scan_.fail("a string array ends too early");
      const std::string_view text = binary_ ? scan_.bytes(binary_length()) : scan_.rest_of_line();
      if (name == kSpaceKey && text == "RAS") mesh_.ras = true;
    }
  }

  std::size_t binary_length() {
    const auto first = static_cast<unsigned char>(scan_.bytes(1)[0]);
    const int more = first >> 6 == 3 ? 0 : first >> 6 == 2 ? 1 : first >> 6 == 1 ? 3 : 7;
    std::size_t length = first & 0x3F;
    for (int i = 0; i < more; ++i) length = length << 8 | static_cast<unsigned char>(scan_.bytes(1)[0]);
    return length;
  }

  /// Numbers after the end of the current line. Nothing is allocated before it is known that the file is long enough.
  std::vector<double> read_numbers(std::uint64_t n, const std::string& type_name) {
    const std::uint64_t bits = bits_of(type_name);
    scan_.rest_of_line();
    constexpr std::uint64_t kMost = std::uint64_t{1} << 56;
    if (n > kMost) scan_.fail("a count of " + std::to_string(n) + " is impossible");
    if (binary_) {
      const std::string_view bytes = scan_.bytes((n * bits + 7) / 8);
      return bits == 1 ? std::vector<double>{} : decode_numbers(bytes, number_type(type_name), true);
    }
    scan_.require_room(n, 2);
    std::vector<double> numbers(n);
    for (double& number : numbers) number = scan_.real();
    return numbers;
  }

  std::uint64_t bits_of(const std::string& name) const { return name == "bit" ? 1 : 8 * bytes_of(number_type(name)); }

  NumberType number_type(const std::string& name) const {
    constexpr std::pair<std::string_view, NumberType> kTypes[] = {{"char", NumberType::int8},
                                                                  {"signed_char", NumberType::int8},
                                                                  {"unsigned_char", NumberType::uint8},
                                                                  {"short", NumberType::int16},
                                                                  {"unsigned_short", NumberType::uint16},
                                                                  {"int", NumberType::int32},
                                                                  {"unsigned_int", NumberType::uint32},
                                                                  {"long", NumberType::int64},
                                                                  {"unsigned_long", NumberType::uint64},
                                                                  {"vtktypeint64", NumberType::int64},
                                                                  {"vtktypeuint64", NumberType::uint64},
                                                                  {"vtkidtype", NumberType::int32},
                                                                  {"float", NumberType::float32},
                                                                  {"double", NumberType::float64}};
    const std::string lower = ascii_lower(name);
    for (const auto& [known, type] : kTypes) {
      if (known == lower) return type;
    }
    scan_.fail(in_quotes(name) + " is not a type of numbers");
  }

  const std::string& path_;
  TextScanner scan_;
  RawMesh mesh_;
  VtkGrid grid_;
  bool version_5_ = false;
  bool binary_ = false;
  enum class Attributes { none, points, cells };
  Attributes attributes_ = Attributes::none;  // what the current ones belong to
  std::uint64_t tuples_ = 0;                  // how many of them there are
  int region_rank_ = 1000;                    // of the array that grid_.regions came from
};

}  // namespace

RawMesh read_vtk(const std::string& path) {
  const std::string text = read_whole_file(path);
  return LegacyReader(path, text).read();
}

}  // namespace scantet
