// Gmsh ASCII files. The discrete model has one volume entity a region and one surface entity a pair of regions, each
// with its physical group of the same tag. Vertices belong to the lowest surface that uses them, else to their volume.
#include <algorithm>
#include <limits>
#include <map>
#include <numeric>
#include <utility>

#include "scantet/base/element_nodes.h"
#include "scantet/base/error.h"
#include "scantet/base/mesh_topology.h"
#include "scantet/io/atomic_file.h"
#include "scantet/io/mesh_codecs_impl.h"
#include "scantet/io/mesh_tags_impl.h"
#include "scantet/io/text_writer_impl.h"

namespace scantet {
namespace {

/// Groups in parts, each of elements of the same sets: Gmsh's entities do not overlap, but may have several physical
/// groups.
struct GroupParts {
  struct Part {
    std::uint32_t group;
    std::vector<std::uint32_t> sets;
    std::size_t count;  ///< of elements; may be 0
  };
  std::vector<Part> parts;  ///< the first ones are what no set has, one a group
  std::vector<std::uint32_t> part_of;
};

/// group_of: of each element.
GroupParts with_sets(const std::vector<NamedSet>& sets, std::vector<std::uint32_t> MeshSet::*members,
                     const std::vector<std::uint32_t>& group_of, std::size_t groups) {
  GroupParts result;
  result.part_of = group_of;
  for (std::uint32_t g = 0; g < groups; ++g) result.parts.push_back({g, {}, 0});
  for (std::uint32_t s = 0; s < sets.size(); ++s) {
    std::map<std::uint32_t, std::uint32_t> with_set;  // part to what it becomes
    for (const std::uint32_t i : sets[s].set.*members) {
      const std::uint32_t before = result.part_of[i];
      const auto [place, is_new] = with_set.emplace(before, static_cast<std::uint32_t>(result.parts.size()));
      if (is_new) {
        GroupParts::Part part = result.parts[before];
        part.sets.push_back(s);
        result.parts.push_back(std::move(part));
      }
      result.part_of[i] = place->second;
    }
  }
  for (const std::uint32_t part : result.part_of) ++result.parts[part].count;
  return result;
}

constexpr TetOrder kOrder{{0, 1, 2, 3}, {0, 1, 2, 3, 5, 4}};  // Gmsh has the node on 23 before that on 13

class MshWriter {
 public:
  MshWriter(const TetMesh& mesh, const MeshWriteOptions& options, std::ostream& out)
      : mesh_(mesh),
        options_(options),
        tags_(make_tags(mesh)),
        sets_(sets_and_materials(mesh, tags_)),
        surfaces_(with_sets(sets_, &MeshSet::facets, tags_.surface_of_facet, tags_.surfaces.size())),
        volumes_(with_sets(sets_, &MeshSet::tets, tags_.volume_of_tet, tags_.volumes.size())),
        facets_(mesh),
        out_(out) {
    if (!is_second_order(mesh)) return;
    triangle_ = 9;
    tetrahedron_ = 11;
  }

  void write_2_2() {
    begin("2.2", false);
    write_nodes_2_2();
    write_elements_2_2();
    write_fields(order_2_2());
    write_node_sets();
    write_element_sets();
  }
  void write_4_1() {
    begin("4.1", true);
    write_entities();
    write_nodes_4_1();
    write_elements_4_1();
    write_fields(order_4_1());
    write_node_sets();
  }

 private:
  void begin(std::string_view version, bool has_sets) {
    out_ << "$MeshFormat\n" << version << " 0 8\n$EndMeshFormat\n";
    out_ << "$Comments\n" << header_line(options_) << "\n$EndComments\n";
    std::size_t sets = 0;
    for (const auto& [name, set] : sets_) sets += (set.facets.empty() ? 0U : 1U) + (set.tets.empty() ? 0U : 1U);
    out_ << "$PhysicalNames\n" << tags_.surfaces.size() + tags_.volumes.size() + (has_sets ? sets : 0) << '\n';
    for (const SurfaceTag& surface : tags_.surfaces) out_ << "2 " << surface.tag << " \"" << surface.name << "\"\n";
    for (const VolumeTag& volume : tags_.volumes) out_ << "3 " << volume.tag << " \"" << volume.name << "\"\n";
    for (std::size_t i = 0; i < sets_.size() && has_sets; ++i) {
      const auto& [name, set] = sets_[i];
      if (!set.facets.empty()) out_ << "2 " << tag_of_set(i) << " \"" << name << "\"\n";
      if (!set.tets.empty()) out_ << "3 " << tag_of_set(i) << " \"" << name << "\"\n";
    }
    out_ << "$EndPhysicalNames\n";
  }

  void write_point(const Point& point) {
    const Point p = in_space(point, options_);
    out_ << p.x << ' ' << p.y << ' ' << p.z << '\n';
  }

  void write_ids(const ElementNodes& nodes) {
    for (VertexId id : nodes) out_ << ' ' << std::uint64_t{id} + 1;
    out_ << '\n';
  }

  void write_nodes_2_2() {
    node_order_.resize(mesh_.vertices.size());
    std::iota(node_order_.begin(), node_order_.end(), 0U);
    out_ << "$Nodes\n" << mesh_.vertices.size() << '\n';
    for (std::size_t v = 0; v < mesh_.vertices.size(); ++v) {
      out_ << v + 1 << ' ';
      write_point(mesh_.vertices[v]);
    }
    out_ << "$EndNodes\n";
  }

  void write_elements_2_2() {
    out_ << "$Elements\n" << mesh_.boundary_facets.size() + mesh_.tets.size() << '\n';
    std::size_t element = 0;
    for (std::size_t i = 0; i < mesh_.boundary_facets.size(); ++i) {
      const int tag = tags_.surfaces[tags_.surface_of_facet[i]].tag;
      out_ << ++element << ' ' << triangle_ << " 2 " << tag << ' ' << tag;
      write_ids(facets_.of(i));
    }
    for (std::size_t i = 0; i < mesh_.tets.size(); ++i) {
      const int tag = tags_.volumes[tags_.volume_of_tet[i]].tag;
      out_ << ++element << ' ' << tetrahedron_ << " 2 " << tag << ' ' << tag;
      write_ids(nodes_of_tet(mesh_, i, kOrder));
    }
    out_ << "$EndElements\n";
  }

  void write_box(const Box& box) {
    out_ << ' ' << box.min.x << ' ' << box.min.y << ' ' << box.min.z;
    out_ << ' ' << box.max.x << ' ' << box.max.y << ' ' << box.max.z;
  }

  /// The physical group of a set, above all others.
  int tag_of_set(std::size_t set) const { return last_tag() + 1 + static_cast<int>(set); }
  int last_tag() const { return tags_.surfaces.empty() ? tags_.volumes.back().tag : tags_.surfaces.back().tag; }

  /// The tag of an entity: the group's, if it is the part of the group that no set has. Others follow all groups.
  int surface_tag(std::size_t e) const {
    return e < tags_.surfaces.size() ? tags_.surfaces[e].tag : last_tag() + 1 + static_cast<int>(e);
  }
  int volume_tag(std::size_t e) const {
    return e < tags_.volumes.size() ? tags_.volumes[e].tag : last_tag() + 1 + static_cast<int>(e);
  }

  void write_physical_tags(int group, const std::vector<std::uint32_t>& sets) {
    out_ << ' ' << sets.size() + 1 << ' ' << group;
    for (const std::uint32_t set : sets) out_ << ' ' << tag_of_set(set);
  }

  void write_entities() {
    std::vector<Box> surface_boxes(surfaces_.parts.size());
    std::vector<Box> volume_boxes(volumes_.parts.size());
    for (std::size_t i = 0; i < mesh_.boundary_facets.size(); ++i) {
      for (VertexId v : facets_.of(i)) extend(surface_boxes[surfaces_.part_of[i]], v);
    }
    for (std::size_t i = 0; i < mesh_.tets.size(); ++i) {
      for (VertexId v : nodes_of_tet(mesh_, i)) extend(volume_boxes[volumes_.part_of[i]], v);
    }
    out_ << "$Entities\n0 0 " << used(surfaces_) << ' ' << used(volumes_) << '\n';
    for (std::size_t s = 0; s < surfaces_.parts.size(); ++s) {
      if (surfaces_.parts[s].count == 0) continue;
      out_ << surface_tag(s);
      write_box(surface_boxes[s]);
      write_physical_tags(tags_.surfaces[surfaces_.parts[s].group].tag, surfaces_.parts[s].sets);
      out_ << " 0\n";
    }
    for (std::size_t v = 0; v < volumes_.parts.size(); ++v) {
      if (volumes_.parts[v].count == 0) continue;
      out_ << volume_tag(v);
      write_box(volume_boxes[v]);
      const VolumeTag& volume = tags_.volumes[volumes_.parts[v].group];
      write_physical_tags(volume.tag, volumes_.parts[v].sets);
      write_bounding_surfaces(volume.region);
    }
    out_ << "$EndEntities\n";
  }

  static std::size_t used(const GroupParts& parts) {
    return static_cast<std::size_t>(
        std::count_if(parts.parts.begin(), parts.parts.end(), [](const auto& part) { return part.count > 0; }));
  }

  void extend(Box& box, VertexId v) const { box.extend(in_space(mesh_.vertices[v], options_)); }

  /// Surfaces that bound a region: positive where their facets point out of it.
  void write_bounding_surfaces(Region region) {
    std::vector<int> bounding;
    for (std::size_t s = 0; s < surfaces_.parts.size(); ++s) {
      if (surfaces_.parts[s].count == 0) continue;
      const SurfaceTag& surface = tags_.surfaces[surfaces_.parts[s].group];
      if (surface.regions[0] == region) bounding.push_back(surface_tag(s));
      if (surface.regions[1] == region) bounding.push_back(-surface_tag(s));
    }
    out_ << ' ' << bounding.size();
    for (int tag : bounding) out_ << ' ' << tag;
    out_ << '\n';
  }

  /// For each vertex the index of its entity: surfaces first, then volumes.
  std::vector<std::uint32_t> entity_of_vertex() const {
    std::vector<std::uint32_t> entity(mesh_.vertices.size(), std::numeric_limits<std::uint32_t>::max());
    for (std::size_t i = 0; i < mesh_.boundary_facets.size(); ++i) {
      for (VertexId v : facets_.of(i)) entity[v] = std::min(entity[v], surfaces_.part_of[i]);
    }
    const auto surfaces = static_cast<std::uint32_t>(surfaces_.parts.size());
    for (std::size_t i = 0; i < mesh_.tets.size(); ++i) {
      for (VertexId v : nodes_of_tet(mesh_, i)) entity[v] = std::min(entity[v], surfaces + volumes_.part_of[i]);
    }
    return entity;
  }

  void write_nodes_4_1() {
    const std::vector<std::uint32_t> entity = entity_of_vertex();
    std::vector<std::size_t> sizes(surfaces_.parts.size() + volumes_.parts.size(), 0);
    for (std::uint32_t e : entity) ++sizes[e];
    node_order_ = order_by_group(entity, sizes);
    const auto blocks = sizes.size() - static_cast<std::size_t>(std::count(sizes.begin(), sizes.end(), 0U));
    const std::size_t total = mesh_.vertices.size();
    out_ << "$Nodes\n" << blocks << ' ' << total << " 1 " << total << '\n';
    std::size_t first = 0;
    for (std::size_t e = 0; e < sizes.size(); first += sizes[e++]) {
      if (sizes[e] == 0) continue;
      const bool surface = e < surfaces_.parts.size();
      out_ << (surface ? "2 " : "3 ") << (surface ? surface_tag(e) : volume_tag(e - surfaces_.parts.size())) << " 0 "
           << sizes[e] << '\n';
      for (std::size_t i = first; i < first + sizes[e]; ++i) out_ << std::uint64_t{node_order_[i]} + 1 << '\n';
      for (std::size_t i = first; i < first + sizes[e]; ++i) write_point(mesh_.vertices[node_order_[i]]);
    }
    out_ << "$EndNodes\n";
  }

  void write_elements_4_1() {
    const std::size_t facets = mesh_.boundary_facets.size();
    const std::size_t total = facets + mesh_.tets.size();
    out_ << "$Elements\n" << used(surfaces_) + used(volumes_) << ' ' << total << " 1 " << total << '\n';
    const auto of_facet = [&](std::size_t f) { return facets_.of(f); };
    const auto of_tet = [&](std::size_t t) { return nodes_of_tet(mesh_, t, kOrder); };
    write_blocks(surfaces_, "2 ", triangle_, 1, of_facet, &MshWriter::surface_tag);
    write_blocks(volumes_, "3 ", tetrahedron_, facets + 1, of_tet, &MshWriter::volume_tag);
    out_ << "$EndElements\n";
  }

  template <typename NodesOf>
  void write_blocks(const GroupParts& parts, const char* dimension, int type, std::size_t first_number,
                    const NodesOf& nodes_of, int (MshWriter::*tag)(std::size_t) const) {
    std::vector<std::size_t> sizes;
    for (const GroupParts::Part& part : parts.parts) sizes.push_back(part.count);
    const std::vector<std::uint32_t> order = order_by_group(parts.part_of, sizes);
    std::size_t next = 0;
    for (std::size_t e = 0; e < sizes.size(); ++e) {
      if (sizes[e] == 0) continue;
      out_ << dimension << (this->*tag)(e) << ' ' << type << ' ' << sizes[e] << '\n';
      for (const std::size_t end = next + sizes[e]; next < end; ++next) {
        out_ << first_number + order[next];
        write_ids(nodes_of(order[next]));
      }
    }
  }

  /// In the order in which the elements stand, for meshio takes the values by that, and a triangle has the value of the
  /// tet behind it, for meshio wants one of every element.
  void write_fields(const std::vector<std::size_t>& order) {
    if (mesh_.fields.empty()) return;
    const std::size_t facets = mesh_.boundary_facets.size();
    const std::vector<TetFace> behind = faces_behind_facets(mesh_);
    for (const MeshField& field : mesh_.fields) {
      begin_data("$ElementData", field.name, order.size());
      for (const std::size_t element : order) {
        const std::size_t tet = element < facets ? behind[element].tet : element - facets;
        out_ << element + 1 << ' ' << field.values[tet] << '\n';
      }
      out_ << "$EndElementData\n";
    }
  }

  /// A name, a time, and three whole numbers: time step, components, count.
  void begin_data(const char* section, const std::string& name, std::size_t count) {
    out_ << section << "\n1\n\"" << name << "\"\n1\n0\n3\n0\n1\n" << count << '\n';
  }

  /// Nodes have no physical groups of their own: a value of each, 1 or 0, in the order in which they stand.
  void write_node_sets() {
    for (const auto& [name, set] : sets_) {
      if (set.vertices.empty()) continue;
      begin_data("$NodeData", "set_" + name, mesh_.vertices.size());
      std::vector<std::uint8_t> has(mesh_.vertices.size(), 0);
      for (const VertexId v : set.vertices) has[v] = 1;
      for (const VertexId v : node_order_) out_ << std::uint64_t{v} + 1 << (has[v] != 0 ? " 1\n" : " 0\n");
      out_ << "$EndNodeData\n";
    }
  }

  /// In version 2.2 an element has one physical group: the same for triangles and tets.
  void write_element_sets() {
    const std::size_t facets = mesh_.boundary_facets.size();
    for (const auto& [name, set] : sets_) {
      if (set.facets.empty() && set.tets.empty()) continue;
      std::vector<std::uint8_t> has(facets + mesh_.tets.size(), 0);
      for (const std::uint32_t f : set.facets) has[f] = 1;
      for (const std::uint32_t t : set.tets) has[facets + t] = 1;
      begin_data("$ElementData", "set_" + name, has.size());
      for (std::size_t i = 0; i < has.size(); ++i) out_ << i + 1 << (has[i] != 0 ? " 1\n" : " 0\n");
      out_ << "$EndElementData\n";
    }
  }

  std::vector<std::size_t> order_2_2() const {
    std::vector<std::size_t> order(mesh_.boundary_facets.size() + mesh_.tets.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    return order;
  }
  std::vector<std::size_t> order_4_1() const {
    std::vector<std::size_t> order;
    const auto add = [&](const GroupParts& parts, std::size_t first) {
      std::vector<std::size_t> sizes;
      for (const GroupParts::Part& part : parts.parts) sizes.push_back(part.count);
      for (const std::uint32_t i : order_by_group(parts.part_of, sizes)) order.push_back(first + i);
    };
    add(surfaces_, 0);
    add(volumes_, mesh_.boundary_facets.size());
    return order;
  }

  const TetMesh& mesh_;
  const MeshWriteOptions& options_;
  MeshTags tags_;
  std::vector<NamedSet> sets_;
  GroupParts surfaces_;
  GroupParts volumes_;
  FacetNodes facets_;
  std::vector<VertexId> node_order_;  // in which nodes stand, for meshio takes their values by that
  int triangle_ = 2;                  // Gmsh's element types
  int tetrahedron_ = 4;
  TextWriter out_;
};

}  // namespace

void write_msh(const TetMesh& mesh, const std::string& path, const MeshWriteOptions& options) {
  if (options.gmsh_version != "4.1" && options.gmsh_version != "2.2") {
    throw Error(Fault::usage, "usage.gmsh_version", "cannot write Gmsh version '" + options.gmsh_version + "'",
                "use 4.1 or 2.2");
  }
  if (options.gmsh_version == "2.2") return write_msh2(mesh, path, options);
  write_file(
      path, [&](std::ostream& out) { MshWriter(mesh, options, out).write_4_1(); }, options.set);
}

void write_msh2(const TetMesh& mesh, const std::string& path, const MeshWriteOptions& options) {
  write_file(
      path, [&](std::ostream& out) { MshWriter(mesh, options, out).write_2_2(); }, options.set);
}

}  // namespace scantet
