// Gmsh ASCII files, versions 2.2 and 4.1. A physical group named region_<n> is region n; any other is the region of its
// number.
#include <algorithm>
#include <charconv>
#include <map>

#include "scantet/io/mesh_codecs_impl.h"
#include "scantet/io/tagged_mesh_impl.h"
#include "scantet/io/text_scanner_impl.h"

namespace scantet {
namespace {

constexpr std::int64_t kTetrahedron = 4;  // Gmsh's element types
constexpr std::int64_t kTetrahedron10 = 11;
constexpr std::size_t kIntegerBytes = 2;  // least text of an integer and its separator

class MshReader {
 public:
  MshReader(const std::string& path, const std::string& text) : path_(path), scan_(path, text) {}

  RawMesh read() {
    read_format();
    while (true) {
      const std::string section(scan_.token());
      if (section.empty()) break;
      if (section[0] != '$') scan_.fail("a section is expected, not " + in_quotes(section));
      scan_.rest_of_line();
      read_section(section.substr(1));
    }
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
    } else {
      skip_section(name);
      return;
    }
    end_section(name);
  }

  void skip_section(const std::string& name) {
    const bool comments = name == "Comments";
    while (scan_.peek() != "$End" + name) {
      if (scan_.peek().empty()) scan_.fail("$End" + name + " is missing");
      const std::string_view line = scan_.rest_of_line();
      if (comments && line.find(std::string(kSpaceKey) + "=RAS") != std::string_view::npos) file_.mesh.ras = true;
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
      if (dimension != 3 || first == last) continue;  // without quotes both are npos
      const std::string name(line.substr(first + 1, last - first - 1));
      constexpr std::string_view kPrefix = "region_";
      Region region = 0;
      const auto [end, failure] =
          std::from_chars(name.data() + std::min(kPrefix.size(), name.size()), name.data() + name.size(), region);
      if (name.starts_with(kPrefix) && failure == std::errc() && end == name.data() + name.size()) {
        region_of_group_[tag] = region;
      } else if (!name.empty()) {
        file_.mesh.region_names[tag] = name;
      }
    }
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
      if (dimension == 3 && i == 0) group_of_volume_[tag] = group;
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
      } else {
        ++file_.mesh.other_cells;
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
      if (!is_tet(type)) {
        file_.mesh.other_cells += n;
        scan_.skip_lines(n + 1);
        continue;
      }
      const auto group = group_of_volume_.find(entity);
      const Region reference = dimension == 3 && group != group_of_volume_.end() ? group->second : 0;
      for (std::uint64_t i = 0; i < n; ++i) {
        const std::int64_t element = scan_.integer();
        read_tet(element, type, reference);
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
  std::map<std::int64_t, Region> group_of_volume_;
  std::map<Region, Region> region_of_group_;  // physical groups with a name of ours
};

}  // namespace

RawMesh read_msh(const std::string& path) {
  const std::string text = read_whole_file(path);
  return MshReader(path, text).read();
}

}  // namespace scantet
