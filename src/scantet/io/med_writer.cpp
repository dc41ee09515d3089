// MED 4.1, the format of SALOME and code_aster: HDF5 in an arrangement of its own, which its library (of Debian) writes
// with MPI only, so HDF5 writes it here. The names are French: maillage (mesh), mailles (cells), noeuds (nodes),
// familles. An element is of one family; a family says of which groups its elements are. Arrays go column by column.
#include <algorithm>
#include <map>
#include <string>

#include "scantet/base/element_nodes.h"
#include "scantet/base/mesh_topology.h"
#include "scantet/io/atomic_file.h"
#include "scantet/io/curve_elements_impl.h"
#include "scantet/io/hdf5_file_impl.h"
#include "scantet/io/mesh_codecs_impl.h"
#include "scantet/io/mesh_tags_impl.h"

namespace scantet {
namespace {

constexpr std::size_t kFamilyName = 64;
constexpr std::size_t kGroupName = 80;
constexpr std::size_t kDescription = 200;
constexpr std::size_t kFieldName = 64;
/// A tet's first three nodes go round as seen from outside, the other way than ours.
constexpr TetOrder kOrder{{0, 2, 1, 3}, {2, 1, 0, 3, 5, 4}};
constexpr int kBoundaryNodes = 1;  ///< the family of nodes on the boundary; 0 has no groups

/// The name of a group, with its tag where it is too long to be told from others by what fits.
template <typename Tag>
std::string group_name(const Tag& tag) {
  if (tag.name.size() <= kGroupName) return tag.name;
  const std::string number = "_" + std::to_string(tag.tag);
  return tag.name.substr(0, kGroupName - number.size()) + number;
}

class MedWriter {
 public:
  MedWriter(const TetMesh& mesh, const MeshWriteOptions& options, Hdf5File& file)
      : mesh_(mesh), options_(options), tags_(make_tags(mesh)), sets_(sets_and_materials(mesh, tags_)), file_(file) {}

  void write() {
    for (const VolumeTag& volume : tags_.volumes) element_families_[-volume.tag] = {group_name(volume)};
    for (const SurfaceTag& surface : tags_.surfaces) element_families_[-surface.tag] = {group_name(surface)};
    for (const CurveTag& curve : tags_.curves) element_families_[-curve.tag] = {group_name(curve)};
    if (!element_families_.empty()) next_element_family_ = element_families_.begin()->first - 1;
    file_.make_group("/INFOS_GENERALES");
    file_.set_attribute("/INFOS_GENERALES", "MAJ", 4);
    file_.set_attribute("/INFOS_GENERALES", "MIN", 1);
    file_.set_attribute("/INFOS_GENERALES", "REL", 0);
    write_description();
    write_nodes();
    file_.make_group(kStep + "/MAI");
    file_.set_attribute(kStep + "/MAI", "CGT", 1);
    const bool is_second = is_second_order(mesh_);
    const FacetNodes facets(mesh_);
    std::vector<std::int32_t> families = families_of(tags_.volumes, tags_.volume_of_tet);
    add_sets(&MeshSet::tets, next_element_family_, families, element_families_);
    write_cells(tet_type(), is_second ? 310 : 304, mesh_.tets.size(), families,
                [&](std::size_t t) { return nodes_of_tet(mesh_, t, kOrder); });
    families = families_of(tags_.surfaces, tags_.surface_of_facet);
    add_sets(&MeshSet::facets, next_element_family_, families, element_families_);
    write_cells(is_second ? "TR6" : "TR3", is_second ? 206 : 203, mesh_.boundary_facets.size(), families,
                [&](std::size_t f) { return facets.of(f); });
    const CurveElements edges(mesh_);
    write_cells(is_second ? "SE3" : "SE2", is_second ? 103 : 102, mesh_.curve_edges.size(),
                families_of(tags_.curves, mesh_.edge_curves), [&](std::size_t e) { return edges.of(e); });
    write_families();
    if (!mesh_.fields.empty()) file_.make_group("/CHA");
    for (const MeshField& field : mesh_.fields) write_field(field);
  }

 private:
  inline static const std::string kMesh = "/ENS_MAA/mesh";
  inline static const std::string kStep = kMesh + "/-0000000000000000001-0000000000000000001";  // of no time
  inline static const std::string kFamilies = "/FAS/mesh";

  void write_description() {
    file_.make_group("/ENS_MAA");
    file_.make_group(kMesh);
    file_.set_attribute(kMesh, "DES", header_line(options_).substr(0, kDescription));
    for (const char* dimension : {"DIM", "ESP"}) file_.set_attribute(kMesh, dimension, 3);
    file_.set_attribute(kMesh, "NOM", std::string("x               y               z               "));
    file_.set_attribute(kMesh, "UNI", std::string("mm              mm              mm              "));
    file_.set_attribute(kMesh, "UNT", std::string());
    for (const char* none : {"NXI", "NXT"}) file_.set_attribute(kMesh, none, -1);
    for (const char* usual : {"REP", "SRT", "TYP"}) file_.set_attribute(kMesh, usual, 0);
    file_.make_group(kStep);
    file_.set_attribute(kStep, "CGT", 1);
    for (const char* none : {"NDT", "NOR", "NXI", "NXT", "PVI", "PVT"}) file_.set_attribute(kStep, none, -1);
    file_.set_attribute(kStep, "PDT", 0.0);
  }

  void write_nodes() {
    const std::string group = kStep + "/NOE";
    make_entity(group);
    std::vector<double> coordinates;
    coordinates.reserve(3 * mesh_.vertices.size());
    for (double Point::*axis : {&Point::x, &Point::y, &Point::z}) {
      for (const Point& vertex : mesh_.vertices) coordinates.push_back(in_space(vertex, options_).*axis);
    }
    write_array(group + "/COO", std::span<const double>(coordinates), mesh_.vertices.size());
    const std::vector<std::uint8_t> on_boundary = vertices_of_boundary(mesh_);
    std::vector<std::int32_t> families(on_boundary.begin(), on_boundary.end());
    if (!tags_.surfaces.empty()) node_families_[kBoundaryNodes] = {"boundary"};
    std::int32_t next = kBoundaryNodes + 1;
    if (tags_.corners) {  // a group of nodes as the sets are
      sets_.push_back({tags_.corners->name, {{}, mesh_.corners, {}, {}}});
    }
    add_sets(&MeshSet::vertices, next, families, node_families_);
    write_array(group + "/FAM", std::span<const std::int32_t>(families), families.size());
  }

  std::string tet_type() const { return is_second_order(mesh_) ? "T10" : "TE4"; }

  /// nodes_of: the nodes of the cell of a number.
  template <typename NodesOf>
  void write_cells(const std::string& type, int geometry, std::size_t count, const std::vector<std::int32_t>& families,
                   const NodesOf& nodes_of) {
    if (count == 0) return;
    const std::string group = kStep + "/MAI/" + type;
    make_entity(group);
    file_.set_attribute(group, "GEO", geometry);
    const std::size_t per_cell = nodes_of(0).count;
    std::vector<std::int32_t> nodes(per_cell * count);
    for (std::size_t c = 0; c < count; ++c) {
      const ElementNodes of_cell = nodes_of(c);
      for (std::size_t i = 0; i < per_cell; ++i) nodes[i * count + c] = static_cast<std::int32_t>(of_cell.all[i]) + 1;
    }
    write_array(group + "/NOD", std::span<const std::int32_t>(nodes), count);
    write_array(group + "/FAM", std::span<const std::int32_t>(families), count);
  }

  void make_entity(const std::string& group) {
    file_.make_group(group);
    for (const char* one : {"CGS", "CGT"}) file_.set_attribute(group, one, 1);
    file_.set_attribute(group, "PFL", std::string("MED_NO_PROFILE_INTERNAL"));
  }

  template <typename Number>
  void write_array(const std::string& path, std::span<const Number> values, std::size_t entities) {
    file_.write(path, {values.size()}, values);
    file_.set_attribute(path, "CGT", 1);
    file_.set_attribute(path, "NBR", static_cast<std::int32_t>(entities));
  }

  /// The family of each element: the tag of its group, negative as those of elements are.
  template <typename Tag>
  static std::vector<std::int32_t> families_of(const std::vector<Tag>& groups, const std::vector<std::uint32_t>& of) {
    std::vector<std::int32_t> families;
    families.reserve(of.size());
    for (const std::uint32_t group : of) families.push_back(-groups[group].tag);
    return families;
  }

  using Families = std::map<std::int32_t, std::vector<std::string>>;  // number to groups

  /// Gives what is in sets families of its own, one for each combination of a family and sets, away from zero from
  /// `next` on.
  void add_sets(std::vector<std::uint32_t> MeshSet::*members, std::int32_t& next, std::vector<std::int32_t>& families,
                Families& known) const {
    const std::int32_t step = next < 0 ? -1 : 1;
    for (const auto& [name, set] : sets_) {
      std::map<std::int32_t, std::int32_t> with_set;  // family to what it becomes
      for (const std::uint32_t i : set.*members) {
        const auto [place, is_new] = with_set.emplace(families[i], next);
        if (is_new) {
          std::vector<std::string> groups = known[families[i]];
          groups.push_back(name.substr(0, kGroupName));
          known[next] = std::move(groups);
          next += step;
        }
        families[i] = place->second;
      }
    }
    known.erase(0);  // the family of no group is always there
  }

  void write_families() {
    file_.make_group("/FAS");
    file_.make_group(kFamilies);
    file_.make_group(kFamilies + "/FAMILLE_ZERO");
    file_.set_attribute(kFamilies + "/FAMILLE_ZERO", "NUM", 0);
    file_.make_group(kFamilies + "/ELEME");
    for (auto family = element_families_.rbegin(); family != element_families_.rend(); ++family) {
      write_family("ELEME", family->first, family->second);
    }
    file_.make_group(kFamilies + "/NOEUD");
    for (const auto& [number, groups] : node_families_) write_family("NOEUD", number, groups);
  }

  /// A field (champ) of one component at the only step, one value a cell.
  void write_field(const MeshField& field) {
    constexpr int kDouble = 6;
    const std::string group = "/CHA/" + field.name.substr(0, kFieldName);
    file_.make_group(group);
    file_.set_attribute(group, "MAI", std::string("mesh"));
    file_.set_attribute(group, "NCO", 1);
    file_.set_attribute(group, "NOM", std::string("value           "));
    file_.set_attribute(group, "TYP", kDouble);
    file_.set_attribute(group, "UNI", std::string("                "));
    file_.set_attribute(group, "UNT", std::string());
    const std::string step = group + "/-0000000000000000001-0000000000000000001";
    file_.make_group(step);
    for (const char* none : {"NDT", "NOR", "RDT", "ROR"}) file_.set_attribute(step, none, -1);
    file_.set_attribute(step, "PDT", 0.0);
    // Which kinds of entities and which shapes of cells have values, as bits, in all steps and in this one.
    constexpr std::uint32_t kOnCells = 1U << 0;
    const std::uint32_t tets = is_second_order(mesh_) ? 1U << 15 : 1U << 10;
    for (const std::string& level : {group, step}) {
      file_.set_bits(level, "LEN", kOnCells);
      file_.set_bits(level, "LGC", tets);
    }
    for (const char* same_in_one_step : {"LAA", "LCA"}) file_.set_attribute(group, same_in_one_step, 1);
    const std::string cells = step + "/MAI." + tet_type();
    file_.make_group(cells);
    file_.set_attribute(cells, "GAU", std::string());
    file_.set_attribute(cells, "PFL", std::string("MED_NO_PROFILE_INTERNAL"));
    const std::string values = cells + "/MED_NO_PROFILE_INTERNAL";
    file_.make_group(values);
    file_.set_attribute(values, "GAU", std::string());
    file_.set_attribute(values, "NBR", static_cast<std::int32_t>(field.values.size()));
    file_.set_attribute(values, "NGA", 1);
    file_.write(values + "/CO", {field.values.size()}, std::span<const double>(field.values));
  }

  /// A family whose elements are of these groups.
  void write_family(const std::string& kind, int number, const std::vector<std::string>& groups) {
    const std::string name = ("FAM_" + std::to_string(number) + "_" + groups.front()).substr(0, kFamilyName);
    const std::string family = kFamilies + "/" + kind + "/" + name;
    file_.make_group(family);
    file_.set_attribute(family, "NUM", number);
    file_.make_group(family + "/GRO");
    file_.set_attribute(family + "/GRO", "NBR", static_cast<std::int32_t>(groups.size()));
    file_.write(family + "/GRO/NOM", groups, kGroupName);
  }

  const TetMesh& mesh_;
  const MeshWriteOptions& options_;
  MeshTags tags_;
  std::vector<NamedSet> sets_;
  Hdf5File& file_;
  Families element_families_;
  Families node_families_;
  std::int32_t next_element_family_ = -1;
};

}  // namespace

void write_med(const TetMesh& mesh, const std::string& path, const MeshWriteOptions& options) {
  require_32_bits(mesh, path, "MED");
  AtomicFile file(path, ".part", options.set);
  Hdf5File hdf5(file);
  MedWriter(mesh, options, hdf5).write();
  hdf5.close();
  file.commit();
}

}  // namespace scantet
