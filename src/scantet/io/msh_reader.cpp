// Gmsh ASCII files, versions 2.2 and 4.1. A physical group named region_<n> is region n; any other is the region of its
// number. Where an entity has several groups of a name, all but the region's are sets; so are physical surfaces, but
// for those of files of ours that follow from regions, and arrays called set_<name>.
#include <algorithm>
#include <array>
#include <charconv>
#include <map>
#include <set>

#include "scantet/io/mesh_codecs_impl.h"
#include "scantet/io/mesh_tags_impl.h"
#include "scantet/io/tagged_mesh_impl.h"
#include "scantet/io/text_scanner_impl.h"

namespace scantet {
namespace {

constexpr std::int64_t kTetrahedron = 4;  // Gmsh's element types
constexpr std::int64_t kTetrahedron10 = 11;
constexpr std::int64_t kTriangle = 2;
constexpr std::int64_t kTriangle6 = 9;
constexpr std::size_t kIntegerBytes = 2;  // least text of an integer and its separator

class MshReader {
 public:
  MshReader(const std::string& path, const std::string& text)
      : path_(path), scan_(path, text), most_in_groups_(4 * text.size()) {}

  RawMesh read() {
    read_format();
    while (true) {
      const std::string section(scan_.token());
      if (section.empty()) break;
      if (section[0] != '$') scan_.fail("a section is expected, not " + in_quotes(section));
      scan_.rest_of_line();
      read_section(section.substr(1));
    }
    if (is_ours_) drop_derived_sets();
    for (TaggedSet& set : sets_of_groups_) file_.element_sets.push_back(std::move(set));
    sort_by_tag(file_, path_);
    resolve_regions();
    return std::move(file_.mesh);
  }

 private:
  void read_format() {
    if (scan_.token() != "$MeshFormat") scan_.fail("a Gmsh file begins with $MeshFormat");
    const std::string version(scan_.token());
    if (version != "2.2" && version != "4.1" && version != "2") {
      scan_.fail("Gmsh version " + in_quotes(version) + " is not known, 2.2 and 4.1 are (gmsh -save -format msh41)");
    }
    version_4_ = version == "4.1";
    if (scan_.integer() != 0) scan_.fail("binary Gmsh files cannot be read: save as ASCII (gmsh -save -format msh41)");
    scan_.integer();
    end_section("MeshFormat");
  }

  void end_section(const std::string& name) {
    if (scan_.token() != "$End" + name) scan_.fail("$End" + name + " is expected");
  }

  void read_section(const std::string& name) {
    if (name == "PhysicalNames") {
      read_physical_names();
    } else if (name == "Entities" && version_4_) {
      read_entities();
    } else if (name == "Nodes") {
      version_4_ ? read_nodes_4_1() : read_nodes_2_2();
    } else if (name == "Elements") {
      version_4_ ? read_elements_4_1() : read_elements_2_2();
    } else if (name == "NodeData" || name == "ElementData") {
      if (!read_data(name == "NodeData")) skip_section(name);
      return;
    } else {
      if (name != "Comments") file_.mesh.left_out.push_back("$" + name.substr(0, 40));
      skip_section(name);
      return;
    }
    end_section(name);
  }

  void skip_section(const std::string& name) {
    const bool comments = name == "Comments";
    const std::string end = "$End" + name;
    const std::string key = std::string(kSpaceKey) + "=";
    while (scan_.peek() != end) {
      if (scan_.peek().empty()) scan_.fail(end + " is missing");
      const std::string_view line = scan_.rest_of_line();
      is_ours_ = is_ours_ || (comments && line.find(key) != std::string_view::npos);
      if (comments && line.find(key + "RAS") != std::string_view::npos) file_.mesh.ras = true;
    }
    scan_.token();
  }

  void read_physical_names() {
    const std::uint64_t n = scan_.count(3 * kIntegerBytes);
    for (std::uint64_t i = 0; i < n; ++i) {
      const std::int64_t dimension = scan_.integer();
      const Region tag = scan_.int32();
      const std::string_view line = scan_.rest_of_line();
      const std::size_t first = line.find('"');
      const std::size_t last = line.rfind('"');
      if (first == last) continue;  // without quotes both are npos
      const std::string name(line.substr(first + 1, last - first - 1));
      Region region = 0;
      if (dimension < 2 && !is_curve_name(name)) {
        file_.mesh.left_out.push_back(named_text(dimension == 0 ? "physical point" : "physical curve", name));
      }
      if (dimension == 3 && is_region(name, region)) {
        region_of_group_[tag] = region;
        is_ours_ = true;  // maybe written again by another program, which keeps no comments
        continue;
      }
      if (dimension == 3 && !name.empty()) file_.mesh.region_names[tag] = name;
      const bool is_derived = is_ours_ && is_boundary_name(name);
      if (dimension == 3 || (dimension == 2 && !is_derived)) {
        set_of_group_.emplace(std::pair(dimension, tag), sets_of_groups_.size());
        sets_of_groups_.push_back({name, {}});
      }
    }
  }

  /// Whether it is region_<n>.
  static bool is_region(std::string_view name, Region& region) {
    constexpr std::string_view kPrefix = "region_";
    if (!name.starts_with(kPrefix)) return false;
    name.remove_prefix(kPrefix.size());
    const auto [end, failure] = std::from_chars(name.data(), name.data() + name.size(), region);
    return failure == std::errc() && end == name.data() + name.size();
  }

  /// Takes away what regions imply.
  void drop_derived_sets() {
    for (const auto& [group, set] : set_of_group_) {
      if (group.first == 2 && is_boundary_name(sets_of_groups_[set].name)) sets_of_groups_[set].tags.clear();
    }
  }

  /// Adds an element to the set that the group is, if it has a name.
  void add_to_group(std::int64_t dimension, Region group, std::int64_t element) {
    if (++in_groups_ > most_in_groups_) scan_.fail("physical groups overlap too often");
    const auto set = set_of_group_.find({dimension, group});
    if (set == set_of_group_.end()) return;
    sets_of_groups_[set->second].tags.push_back(element);
  }

  /// Values of nodes or elements, one each. Return: false, somewhere inside, if they are not that.
  bool read_data(bool of_nodes) {
    const std::uint64_t strings = scan_.count(kIntegerBytes);
    if (strings == 0) return false;
    scan_.rest_of_line();
    std::string_view name = scan_.rest_of_line();
    while (name.ends_with('\r') || name.ends_with(' ')) name.remove_suffix(1);
    if (name.size() < 2 || name.front() != '"' || name.back() != '"') return false;
    name = name.substr(1, name.size() - 2);
    scan_.skip_lines(strings - 1);
    const std::string told = named_text(of_nodes ? "$NodeData" : "$ElementData", name);
    const auto leave_out = [&](const std::string& why) {
      file_.mesh.left_out.push_back(told + why);
      return false;
    };
    const std::uint64_t times = scan_.count(kIntegerBytes);
    for (std::uint64_t i = 0; i < times; ++i) scan_.real();
    const std::uint64_t integers = scan_.count(kIntegerBytes);
    if (integers < 3) return leave_out("");
    scan_.integer();
    if (scan_.integer() != 1) return leave_out(", of several numbers each");
    const std::uint64_t n = scan_.count(2 * kIntegerBytes);
    for (std::uint64_t i = 3; i < integers; ++i) scan_.integer();
    const bool is_set = name.starts_with(kSetPrefix);
    if (!is_set && of_nodes) return leave_out("");
    if (!is_set && !fields_.insert(std::string(name)).second) return leave_out(" of later times");
    read_values(std::string(name), n, is_set, of_nodes);
    end_section(of_nodes ? "NodeData" : "ElementData");
    return true;
  }

  void read_values(const std::string& name, std::uint64_t n, bool is_set, bool of_nodes) {
    TaggedField field{name, {}, {}};
    TaggedSet set{is_set ? name.substr(std::string_view(kSetPrefix).size()) : "", {}};
    for (std::uint64_t i = 0; i < n; ++i) {
      const std::int64_t tag = scan_.integer();
      const double value = scan_.real();
      if (!is_set) {
        field.tags.push_back(tag);
        field.values.push_back(value);
      } else if (value != 0) {
        set.tags.push_back(tag);
      }
    }
    if (!is_set) return file_.fields.push_back(std::move(field));
    (of_nodes ? file_.node_sets : file_.element_sets).push_back(std::move(set));
  }

  void read_entities() {
    std::array<std::uint64_t, 4> counts{};
    for (std::uint64_t& n : counts) n = scan_.count(kIntegerBytes);
    for (std::size_t dimension = 0; dimension < 4; ++dimension) {
      for (std::uint64_t i = 0; i < counts[dimension]; ++i) read_entity(dimension);
    }
  }

  void read_entity(std::size_t dimension) {
    const std::int64_t tag = scan_.integer();
    const int box_numbers = dimension == 0 ? 3 : 6;
    for (int i = 0; i < box_numbers; ++i) scan_.real();
    const std::uint64_t groups = scan_.count(kIntegerBytes);
    for (std::uint64_t i = 0; i < groups; ++i) {
      const Region group = scan_.int32();
      if (dimension >= 2) groups_of_entity_[{static_cast<std::int64_t>(dimension), tag}].push_back(group);
    }
    if (dimension == 0) return;
    const std::uint64_t bounding = scan_.count(kIntegerBytes);
    for (std::uint64_t i = 0; i < bounding; ++i) scan_.integer();
  }

  void read_node_tag() {
    file_.node_tags.push_back(scan_.integer());
    if (file_.node_tags.back() < 1)
      scan_.fail("node tag " + std::to_string(file_.node_tags.back()) + " is not positive");
  }

  void read_nodes_2_2() {
    const std::uint64_t n = scan_.count(4 * kIntegerBytes);
    file_.node_tags.reserve(n);
    file_.mesh.vertices.reserve(n);
    for (std::uint64_t i = 0; i < n; ++i) {
      read_node_tag();
      file_.mesh.vertices.push_back(scan_.point());
    }
  }

  void read_nodes_4_1() {
    const std::uint64_t blocks = scan_.count(4 * kIntegerBytes);
    const std::uint64_t total = scan_.count(4 * kIntegerBytes);
    scan_.integer();
    scan_.integer();
    for (std::uint64_t block = 0; block < blocks; ++block) {
      const std::int64_t dimension = scan_.integer();
      scan_.integer();
      const std::int64_t parameters = scan_.integer() != 0 ? dimension : 0;
      const std::uint64_t n = scan_.count(4 * kIntegerBytes);
      for (std::uint64_t i = 0; i < n; ++i) read_node_tag();
      for (std::uint64_t i = 0; i < n; ++i) {
        file_.mesh.vertices.push_back(scan_.point());
        for (std::int64_t p = 0; p < parameters; ++p) scan_.real();
      }
    }
    if (file_.mesh.vertices.size() != total) scan_.fail("$Nodes announces another number of nodes than it holds");
  }

  static bool is_tet(std::int64_t type) { return type == kTetrahedron || type == kTetrahedron10; }

  void read_tet(std::int64_t element, std::int64_t type, Region reference) {
    file_.element_tags.push_back(element);
    std::array<std::uint64_t, 4> tet{};
    for (std::uint64_t& v : tet) v = static_cast<std::uint64_t>(scan_.integer());
    file_.mesh.tets.push_back(tet);
    if (type == kTetrahedron10) {
      std::array<std::uint64_t, 6> nodes{};
      for (std::uint64_t& v : nodes) v = static_cast<std::uint64_t>(scan_.integer());
      std::swap(nodes[4], nodes[5]);  // Gmsh has the node on 23 before that on 13
      file_.mesh.edge_nodes.push_back(nodes);
    }
    file_.mesh.references.push_back(reference);
  }

  /// Whether elements of the type are points, edges, triangles or quadrilaterals of any order.
  static bool is_flat(std::int64_t type) {
    constexpr std::array<std::int64_t, 17> kFlat{1, 2, 3, 8, 9, 10, 15, 16, 20, 21, 22, 23, 24, 25, 26, 27, 28};
    return std::find(kFlat.begin(), kFlat.end(), type) != kFlat.end();
  }

  static bool is_triangle(std::int64_t type) { return type == kTriangle || type == kTriangle6; }

  /// Its corners; the rest of the line is left out.
  void read_triangle(std::int64_t element) {
    TaggedTriangle triangle{element, {}};
    for (std::uint64_t& v : triangle.corners) v = static_cast<std::uint64_t>(scan_.integer());
    file_.triangles.push_back(triangle);
    scan_.rest_of_line();
    ++file_.mesh.other_cells;
  }

  void read_elements_2_2() {
    const std::uint64_t n = scan_.count(4 * kIntegerBytes);
    for (std::uint64_t i = 0; i < n; ++i) {
      const std::int64_t element = scan_.integer();
      const std::int64_t type = scan_.integer();
      const std::uint64_t tags = scan_.count(kIntegerBytes);
      Region group = 0;
      for (std::uint64_t t = 0; t < tags; ++t) {
        const std::int64_t tag = scan_.integer();
        if (t == 0 && tag >= INT32_MIN && tag <= INT32_MAX) group = static_cast<Region>(tag);
      }
      if (is_tet(type)) {
        read_tet(element, type, group);
      } else if (is_triangle(type)) {
        read_triangle(element);
        add_to_group(2, group, element);
      } else {
        ++file_.mesh.other_cells;
        if (!is_flat(type)) ++file_.mesh.other_solids;
        scan_.rest_of_line();
      }
    }
  }

  void read_elements_4_1() {
    const std::uint64_t blocks = scan_.count(4 * kIntegerBytes);
    const std::uint64_t total = scan_.count(2 * kIntegerBytes);
    scan_.integer();
    scan_.integer();
    std::uint64_t found = 0;
    for (std::uint64_t block = 0; block < blocks; ++block) {
      const std::int64_t dimension = scan_.integer();
      const std::int64_t entity = scan_.integer();
      const std::int64_t type = scan_.integer();
      const std::uint64_t n = scan_.count(2 * kIntegerBytes);
      found += n;
      const auto known = groups_of_entity_.find({dimension, entity});
      static const std::vector<Region> none;
      const std::vector<Region>& groups = known == groups_of_entity_.end() ? none : known->second;
      if (is_triangle(type)) {
        scan_.rest_of_line();
        for (std::uint64_t i = 0; i < n; ++i) {
          const std::int64_t element = scan_.integer();
          read_triangle(element);
          for (const Region group : groups) add_to_group(2, group, element);
        }
      } else if (is_tet(type)) {
        const Region reference = dimension == 3 && !groups.empty() ? groups.front() : 0;
        for (std::uint64_t i = 0; i < n; ++i) {
          const std::int64_t element = scan_.integer();
          read_tet(element, type, reference);
          for (std::size_t g = 1; g < groups.size(); ++g) add_to_group(3, groups[g], element);
        }
      } else {
        file_.mesh.other_cells += n;
        if (!is_flat(type)) file_.mesh.other_solids += n;
        scan_.skip_lines(n + 1);
      }
    }
    if (found != total) scan_.fail("$Elements announces another number of elements than it holds");
  }

  void resolve_regions() {
    for (Region& reference : file_.mesh.references) {
      const auto named = region_of_group_.find(reference);
      if (named != region_of_group_.end()) reference = named->second;
    }
  }

  const std::string& path_;
  TextScanner scan_;
  TaggedMesh file_;
  bool version_4_ = false;
  using DimensionAndTag = std::pair<std::int64_t, std::int64_t>;
  std::map<DimensionAndTag, std::vector<Region>> groups_of_entity_;
  std::map<Region, Region> region_of_group_;  // physical groups with a name of ours
  std::vector<TaggedSet> sets_of_groups_;     // of other names
  std::map<DimensionAndTag, std::size_t> set_of_group_;
  std::set<std::string> fields_;  // whose values were read
  bool is_ours_ = false;
  std::size_t in_groups_ = 0;   // elements, each as often as it is in a group
  std::size_t most_in_groups_;  // so that time and memory are bounded by the file's size
};

}  // namespace

RawMesh read_msh(const std::string& path) {
  const std::string text = read_whole_file(path);
  return MshReader(path, text).read();
}

}  // namespace scantet
