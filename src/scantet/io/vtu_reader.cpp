// VTK XML unstructured grids (.vtu): VTK parses the XML, the arrays are decoded and checked here. Files of several
// pieces become one mesh.
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkXMLDataElement.h>
#include <vtkXMLDataParser.h>

#include <algorithm>
#include <charconv>
#include <exception>
#include <set>

#include "scantet/base/error.h"
#include "scantet/io/mesh_codecs_impl.h"
#include "scantet/io/text_scanner_impl.h"
#include "scantet/io/vtk_arrays_impl.h"
#include "scantet/io/vtk_messages_impl.h"
#include "scantet/io/vtu_data_impl.h"

namespace scantet {
namespace {

std::string attribute(vtkXMLDataElement* element, const char* name) {
  const char* const value = element->GetAttribute(name);
  return value == nullptr ? "" : value;
}

template <typename Visit>
void for_each_child(vtkXMLDataElement* element, std::string_view name, const Visit& visit) {
  for (int i = 0; i < element->GetNumberOfNestedElements(); ++i) {
    vtkXMLDataElement* const child = element->GetNestedElement(i);
    if (child->GetName() == name) visit(child);
  }
}

/// Leaves out elements that are nested too deeply, for VTK's elements call each other where they end, and would fill
/// the stack, and those with so many attributes that VTK's search for each takes long. A grid has six levels.
class ShallowParser : public vtkXMLDataParser {
 public:
  static ShallowParser* New() { VTK_STANDARD_NEW_BODY(ShallowParser); }

  bool too_deep() const { return too_deep_; }

 protected:
  void StartElement(const char* name, const char** attributes) override {
    constexpr std::size_t kMostWords = 2000;  // names and values
    std::size_t words = 0;
    while (words < kMostWords && attributes[words] != nullptr) ++words;
    const bool is_left_out = left_out_from_ != 0 || depth_ >= kDeepest || words == kMostWords;
    ++depth_;
    if (!is_left_out) return vtkXMLDataParser::StartElement(name, attributes);
    if (left_out_from_ == 0) left_out_from_ = depth_;
    too_deep_ = true;
  }
  void EndElement(const char* name) override {
    if (left_out_from_ == 0) vtkXMLDataParser::EndElement(name);
    if (left_out_from_ == depth_) left_out_from_ = 0;
    --depth_;
  }

 private:
  static constexpr std::size_t kDeepest = 100;
  std::size_t depth_ = 0;
  std::size_t left_out_from_ = 0;  // the depth; 0: nothing is
  bool too_deep_ = false;
};

class VtuReader {
 public:
  VtuReader(const std::string& path, const std::string& text, vtkXMLDataElement* root)
      : path_(path),
        text_(text),
        root_(root),
        big_endian_(attribute(root, "byte_order") == "BigEndian"),
        decoder_(path, text.size(), big_endian_, attribute(root, "header_type"), attribute(root, "compressor")) {}

  RawMesh read() {
    find_appended_data();
    for_each_child(root_, "UnstructuredGrid", [this](vtkXMLDataElement* grid) {
      for_each_child(grid, "FieldData", [this](vtkXMLDataElement* field) { read_space(field); });
      for_each_child(grid, "Piece", [this](vtkXMLDataElement* piece) { read_piece(piece); });
    });
    return std::move(mesh_);
  }

 private:
  [[noreturn]] void fail(const std::string& what) const { throw_bad_mesh(path_, what); }

  void find_appended_data() {
    for_each_child(root_, "AppendedData", [this](vtkXMLDataElement* element) {
      appended_base64_ = attribute(element, "encoding") != "raw";
      const std::string_view after_tag = content_of(element);
      const std::size_t underscore = after_tag.find('_');
      if (underscore != std::string_view::npos) appended_ = after_tag.substr(underscore + 1);
    });
  }

  /// The text that follows the element's opening tag, up to the end of the file.
  std::string_view content_of(vtkXMLDataElement* element) const {
    const auto begin = static_cast<std::size_t>(element->GetXMLByteIndex());
    char quote = 0;
    for (std::size_t i = begin; i < text_.size(); ++i) {
      const char c = text_[i];
      if (quote == 0 && c == '>') return std::string_view(text_).substr(i + 1);
      if (c == quote) {
        quote = 0;
      } else if (quote == 0 && (c == '"' || c == '\'')) {
        quote = c;
      }
    }
    fail("a tag has no end");
  }

  std::string_view inline_data(vtkXMLDataElement* element) const {
    std::string_view data = content_of(element);
    data = data.substr(0, data.find('<'));
    const std::size_t begin = std::min(data.find_first_not_of(" \t\r\n"), data.size());
    return data.substr(begin);
  }

  /// Visits the arrays of a section. No name may be there twice.
  template <typename Visit>
  void for_each_array(vtkXMLDataElement* section, const Visit& visit) const {
    std::set<std::string> names;
    for_each_child(section, "DataArray", [&](vtkXMLDataElement* array) {
      const std::string name = attribute(array, "Name");
      if (!name.empty() && !names.insert(name).second) fail("the array " + in_quotes(name) + " is there twice");
      visit(array);
    });
  }

  std::vector<double> numbers(vtkXMLDataElement* array) {
    if (attribute(array, "format") == "ascii") {
      std::vector<double> values;
      TextScanner scan(path_, inline_data(array));
      while (!scan.peek().empty()) values.push_back(scan.real());
      return values;
    }
    const NumberType type = number_type(attribute(array, "type"));
    const std::string data = bytes(array);
    decoder_.count(data.size() / bytes_of(type) * sizeof(double));
    return decode_numbers(data, type, big_endian_);
  }

  std::string bytes(vtkXMLDataElement* array) {
    if (attribute(array, "format") != "appended") return decoder_.decode(inline_data(array), true);
    const std::string text = attribute(array, "offset");
    std::size_t offset = 0;
    const auto [end, failure] = std::from_chars(text.data(), text.data() + text.size(), offset);
    if (failure != std::errc() || end != text.data() + text.size() || offset > appended_.size()) {
      fail("the array " + in_quotes(attribute(array, "Name")) + " begins at the impossible offset " + in_quotes(text));
    }
    return decoder_.decode(appended_.substr(offset), appended_base64_);
  }

  NumberType number_type(const std::string& name) const {
    constexpr std::pair<std::string_view, NumberType> kTypes[] = {
        {"Int8", NumberType::int8},       {"UInt8", NumberType::uint8},    {"Int16", NumberType::int16},
        {"UInt16", NumberType::uint16},   {"Int32", NumberType::int32},    {"UInt32", NumberType::uint32},
        {"Int64", NumberType::int64},     {"UInt64", NumberType::uint64},  {"Float32", NumberType::float32},
        {"Float64", NumberType::float64}, {"vtkIdType", NumberType::int64}};
    for (const auto& [known, type] : kTypes) {
      if (known == name) return type;
    }
    fail(in_quotes(name) + " is not a type of numbers");
  }

  /// RAS is said by the string array that 3D Slicer reads, or by our provenance. Names of regions are in an array of
  /// characters; strings of that name, as vtkScantetMesher gives them, come from other writers.
  void read_space(vtkXMLDataElement* field) {
    for (const char* kind : {"Array", "DataArray"}) {
      for_each_child(field, kind, [this](vtkXMLDataElement* array) {
        const std::string name = attribute(array, "Name");
        if (name == kSpaceKey && characters(array).starts_with("RAS")) mesh_.ras = true;
        if (name == kProvenance) mesh_.provenance = characters(array);
        if (name == kRegionNames && attribute(array, "type") != "String") read_region_names(characters(array));
        if (name == kProvenance && characters(array).starts_with(std::string(kSpaceKey) + "=RAS")) mesh_.ras = true;
      });
    }
  }

  void read_region_names(const std::string& lines) {
    for (std::size_t begin = 0; begin < lines.size();) {
      const std::size_t end = std::min(lines.find('\n', begin), lines.size());
      const std::string_view line = std::string_view(lines).substr(begin, end - begin);
      Region region = 0;
      const auto [rest, failure] = std::from_chars(line.data(), line.data() + line.size(), region);
      const auto digits = static_cast<std::size_t>(rest - line.data());
      if (failure != std::errc() || line.size() < digits + 2 || line[digits] != ' ') {
        fail(in_quotes(line) + " is no number and name of a region");
      }
      mesh_.region_names[region] = line.substr(digits + 1);
      begin = end + 1;
    }
  }

  std::string characters(vtkXMLDataElement* array) {
    if (attribute(array, "format") != "ascii") return bytes(array);
    std::string text;
    for (double code : numbers(array)) text.push_back(code > 0 && code < 127 ? static_cast<char>(code) : '\0');
    return text;
  }

  std::size_t count(vtkXMLDataElement* piece, const char* name) const {
    const std::string text = attribute(piece, name);
    std::size_t value = 0;
    const auto [end, failure] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (failure != std::errc() || end != text.data() + text.size()) fail(std::string(name) + " is " + in_quotes(text));
    return value;
  }

  /// The array if it has as many values as it must.
  std::vector<double> numbers(vtkXMLDataElement* array, std::size_t expected) {
    std::vector<double> values = numbers(array);
    if (values.size() == expected) return values;
    fail("the array " + in_quotes(attribute(array, "Name")) + " has " + std::to_string(values.size()) +
         " values instead of " + std::to_string(expected));
  }

  void read_piece(vtkXMLDataElement* piece) {
    const std::size_t points = count(piece, "NumberOfPoints");
    const std::size_t cells = count(piece, "NumberOfCells");
    constexpr std::size_t kMost = std::size_t{1} << 60;
    if (points > kMost) fail("NumberOfPoints is " + std::to_string(points));
    VtkGrid grid;
    for_each_child(piece, "Points", [&](vtkXMLDataElement* section) {
      for_each_array(section, [&](vtkXMLDataElement* array) { grid.points = numbers(array, 3 * points); });
    });
    for_each_child(piece, "Cells", [&](vtkXMLDataElement* section) {
      for_each_array(section, [&](vtkXMLDataElement* array) {
        const std::string name = attribute(array, "Name");
        if (name == "connectivity") grid.connectivity = numbers(array);
        if (name == "offsets") grid.cell_ends = numbers(array, cells);
        if (name == "types") grid.types = numbers(array, cells);
      });
    });
    for_each_child(piece, "CellData", [&](vtkXMLDataElement* section) { read_regions(section, cells, grid); });
    for_each_child(piece, "CellData",
                   [&](vtkXMLDataElement* section) { read_numbers(section, cells, true, grid.cell_numbers); });
    for_each_child(piece, "PointData",
                   [&](vtkXMLDataElement* section) { read_numbers(section, points, false, grid.point_numbers); });
    if (grid.points.size() != 3 * points || grid.types.size() != cells) fail("points or cells are missing");
    append_grid(path_, grid, mesh_);
  }

  void read_regions(vtkXMLDataElement* section, std::size_t cells, VtkGrid& grid) {
    vtkXMLDataElement* best = nullptr;
    int best_rank = 0;
    for_each_child(section, "DataArray", [&](vtkXMLDataElement* array) {
      const std::string components = attribute(array, "NumberOfComponents");
      const std::optional<int> rank = region_array_rank(attribute(array, "Name"));
      if (!rank || !(components.empty() || components == "1") || (best != nullptr && *rank >= best_rank)) return;
      best = array;
      best_rank = *rank;
    });
    if (best == nullptr) return;
    grid.has_regions = true;
    grid.regions = numbers(best, cells);
  }

  /// Arrays of sets, and of cells those that are fields.
  void read_numbers(vtkXMLDataElement* section, std::size_t count, bool of_cells, std::vector<NamedNumbers>& found) {
    for_each_array(section, [&](vtkXMLDataElement* array) {
      const std::string name = attribute(array, "Name");
      const std::string components = attribute(array, "NumberOfComponents");
      const bool is_real = attribute(array, "type").starts_with("Float");
      if (is_kept({name, of_cells, is_real, components.empty() || components == "1"}, mesh_.left_out)) {
        found.push_back({name, numbers(array, count)});
      }
    });
    for_each_child(section, "Array", [&](vtkXMLDataElement* array) {  // of strings
      is_kept({attribute(array, "Name"), of_cells, false, false}, mesh_.left_out);
    });
  }

  const std::string& path_;
  const std::string& text_;
  vtkXMLDataElement* root_;
  bool big_endian_;
  VtuDecoder decoder_;
  std::string_view appended_;
  bool appended_base64_ = true;
  RawMesh mesh_;
};

}  // namespace

RawMesh read_vtu(const std::string& path) {
  const std::string text = read_whole_file(path);
  const VtkMessages messages;
  vtkNew<ShallowParser> parser;
  parser->SetFileName(path.c_str());
  parser->SetIgnoreCharacterData(1);
  const bool parsed = parser->Parse() != 0 && parser->GetRootElement() != nullptr;
  if (parser->too_deep()) throw_bad_mesh(path, "its elements are nested too deeply, or have too many attributes");
  if (!parsed || messages.failed()) {
    throw_bad_mesh(path, messages.failed() ? messages.first_error() : "it is not a VTK XML file");
  }
  vtkXMLDataElement* const root = parser->GetRootElement();
  if (root->GetName() != std::string_view("VTKFile")) throw_bad_mesh(path, "it is not a VTK XML file");
  if (attribute(root, "type") != "UnstructuredGrid") {
    throw Error(Fault::input, "input.no_tets",
                "'" + path + "' has no tetrahedra: it holds " + in_quotes(attribute(root, "type")),
                "give a file with a tetrahedral mesh (UnstructuredGrid)");
  }
  return VtuReader(path, text, root).read();
}

}  // namespace scantet
