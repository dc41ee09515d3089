// Gmsh ASCII files. The discrete model has one volume entity a region, one surface entity a pair of regions, one curve
// entity a curve, each with its physical group of the same tag, and a point entity a corner, all of one group. Vertices
// belong to the lowest entity that has them.
#include <algorithm>
#include <array>
#include <limits>
#include <numeric>
#include <utility>

#include "scantet/base/element_nodes.h"
#include "scantet/base/error.h"
#include "scantet/base/mesh_topology.h"
#include "scantet/io/atomic_file.h"
#include "scantet/io/curve_elements_impl.h"
#include "scantet/io/mesh_codecs_impl.h"
#include "scantet/io/mesh_tags_impl.h"
#include "scantet/io/msh_parts_impl.h"
#include "scantet/io/text_writer_impl.h"

namespace scantet {
namespace {

constexpr TetOrder kOrder{{0, 1, 2, 3}, {0, 1, 2, 3, 5, 4}};  // Gmsh has the node on 23 before that on 13
/// Dimensions in the order in which their elements are numbered.
constexpr std::array<std::size_t, 4> kNumbered{2, 3, 1, 0};

class MshWriter {
 public:
  MshWriter(const TetMesh& mesh, const MeshWriteOptions& options, std::ostream& out)
      : mesh_(mesh),
        options_(options),
        tags_(make_tags(mesh)),
        sets_(sets_and_materials(mesh, tags_)),
        edges_(mesh),
        facets_(mesh),
        out_(out) {
    const bool is_second = is_second_order(mesh);
    std::vector<std::uint32_t> corners(mesh.corners.size());
    std::iota(corners.begin(), corners.end(), 0U);
    kinds_[0] = {15, without_sets(corners, corners.size())};
    kinds_[1] = {is_second ? 8 : 1, without_sets(mesh.edge_curves, tags_.curves.size())};
    kinds_[2] = {is_second ? 9 : 2, with_sets(sets_, &MeshSet::facets, tags_.surface_of_facet, tags_.surfaces.size())};
    kinds_[3] = {is_second ? 11 : 4, with_sets(sets_, &MeshSet::tets, tags_.volume_of_tet, tags_.volumes.size())};
    for (const std::size_t dimension : kNumbered) {
      kinds_[dimension].first = elements_;
      elements_ += count(dimension);
    }
  }

  void write_2_2() {
    begin("2.2", false);
    write_nodes_2_2();
    write_elements_2_2();
    std::vector<std::size_t> order(elements_);
    std::iota(order.begin(), order.end(), std::size_t{0});
    write_fields(order);
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
  /// The elements of one dimension.
  struct Kind {
    int type = 0;  ///< Gmsh's
    GroupParts parts;
    std::size_t first = 0;  ///< number of the first element, from 0
  };

  std::size_t count(std::size_t dimension) const { return kinds_[dimension].parts.part_of.size(); }

  ElementNodes nodes_of(std::size_t dimension, std::size_t element) const {
    if (dimension == 3) return nodes_of_tet(mesh_, element, kOrder);
    if (dimension == 2) return facets_.of(element);
    if (dimension == 1) return edges_.of(element);
    ElementNodes corner;
    corner.all[0] = mesh_.corners[element];
    corner.count = 1;
    return corner;
  }

  int group_tag(std::size_t dimension, std::size_t group) const {
    if (dimension == 3) return tags_.volumes[group].tag;
    if (dimension == 2) return tags_.surfaces[group].tag;
    return dimension == 1 ? tags_.curves[group].tag : tags_.corners->tag;
  }

  std::size_t groups(std::size_t dimension) const {
    if (dimension == 3) return tags_.volumes.size();
    return dimension == 2 ? tags_.surfaces.size() : tags_.curves.size();
  }

  /// The tag of an entity: the group's, if it is the part of the group that no set has. Others follow all groups.
  /// Corners are counted.
  int entity_tag(std::size_t dimension, std::size_t e) const {
    if (dimension == 0) return static_cast<int>(e) + 1;
    return e < groups(dimension) ? group_tag(dimension, e) : tags_.last_tag + 1 + static_cast<int>(e);
  }

  /// The physical group of a set, above all others.
  int tag_of_set(std::size_t set) const { return tags_.last_tag + 1 + static_cast<int>(set); }

  void begin(std::string_view version, bool has_sets) {
    out_ << "$MeshFormat\n" << version << " 0 8\n$EndMeshFormat\n";
    out_ << "$Comments\n" << header_line(options_) << "\n$EndComments\n";
    std::size_t names = tags_.surfaces.size() + tags_.volumes.size() + tags_.curves.size() + (tags_.corners ? 1 : 0);
    for (std::size_t i = 0; i < sets_.size() && has_sets; ++i) {
      names += (sets_[i].set.facets.empty() ? 0U : 1U) + (sets_[i].set.tets.empty() ? 0U : 1U);
    }
    out_ << "$PhysicalNames\n" << names << '\n';
    for (const SurfaceTag& surface : tags_.surfaces) write_name(2, surface.tag, surface.name);
    for (const VolumeTag& volume : tags_.volumes) write_name(3, volume.tag, volume.name);
    for (const CurveTag& curve : tags_.curves) write_name(1, curve.tag, curve.name);
    if (tags_.corners) write_name(0, tags_.corners->tag, tags_.corners->name);
    for (std::size_t i = 0; i < sets_.size() && has_sets; ++i) {
      const auto& [name, set] = sets_[i];
      if (!set.facets.empty()) write_name(2, tag_of_set(i), name);
      if (!set.tets.empty()) write_name(3, tag_of_set(i), name);
    }
    out_ << "$EndPhysicalNames\n";
  }

  void write_name(int dimension, int tag, const std::string& name) {
    out_ << dimension << ' ' << tag << " \"" << name << "\"\n";
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
    out_ << "$Elements\n" << elements_ << '\n';
    std::size_t element = 0;
    for (const std::size_t dimension : kNumbered) {
      const Kind& kind = kinds_[dimension];
      for (std::size_t i = 0; i < count(dimension); ++i) {
        const int tag = group_tag(dimension, kind.parts.parts[kind.parts.part_of[i]].group);
        out_ << ++element << ' ' << kind.type << " 2 " << tag << ' ' << tag;
        write_ids(nodes_of(dimension, i));
      }
    }
    out_ << "$EndElements\n";
  }

  /// Entities have boxes, but for points.
  void write_entities() {
    out_ << "$Entities\n";
    for (std::size_t d = 0; d < kinds_.size(); ++d) out_ << kinds_[d].parts.used() << (d < 3 ? ' ' : '\n');
    for (std::size_t dimension = 0; dimension < kinds_.size(); ++dimension) {
      const GroupParts& parts = kinds_[dimension].parts;
      std::vector<Box> boxes(parts.parts.size());
      for (std::size_t i = 0; i < count(dimension); ++i) {
        for (VertexId v : nodes_of(dimension, i)) boxes[parts.part_of[i]].extend(in_space(mesh_.vertices[v], options_));
      }
      for (std::size_t e = 0; e < boxes.size(); ++e) {
        if (parts.parts[e].count == 0) continue;
        out_ << entity_tag(dimension, e);
        write_box(boxes[e], dimension);
        const auto& [group, sets, elements] = parts.parts[e];
        out_ << ' ' << sets.size() + 1 << ' ' << group_tag(dimension, group);
        for (const std::uint32_t set : sets) out_ << ' ' << tag_of_set(set);
        if (dimension == 3) write_bounding_surfaces(tags_.volumes[group].region);
        out_ << (dimension == 1 || dimension == 2 ? " 0\n" : "\n");
      }
    }
    out_ << "$EndEntities\n";
  }

  void write_box(const Box& box, std::size_t dimension) {
    out_ << ' ' << box.min.x << ' ' << box.min.y << ' ' << box.min.z;
    if (dimension > 0) out_ << ' ' << box.max.x << ' ' << box.max.y << ' ' << box.max.z;
  }

  /// Surfaces that bound a region: positive where their facets point out of it.
  void write_bounding_surfaces(Region region) {
    const std::vector<GroupParts::Part>& parts = kinds_[2].parts.parts;
    std::vector<int> bounding;
    for (std::size_t s = 0; s < parts.size(); ++s) {
      if (parts[s].count == 0) continue;
      const SurfaceTag& surface = tags_.surfaces[parts[s].group];
      if (surface.regions[0] == region) bounding.push_back(entity_tag(2, s));
      if (surface.regions[1] == region) bounding.push_back(-entity_tag(2, s));
    }
    out_ << ' ' << bounding.size();
    for (int tag : bounding) out_ << ' ' << tag;
  }

  /// For each vertex the index of its entity, counted through all dimensions from points on.
  std::vector<std::uint32_t> entity_of_vertex() const {
    std::vector<std::uint32_t> entity(mesh_.vertices.size(), std::numeric_limits<std::uint32_t>::max());
    std::uint32_t first = 0;
    for (std::size_t dimension = 0; dimension < kinds_.size(); ++dimension) {
      const GroupParts& parts = kinds_[dimension].parts;
      for (std::size_t i = 0; i < count(dimension); ++i) {
        for (VertexId v : nodes_of(dimension, i)) entity[v] = std::min(entity[v], first + parts.part_of[i]);
      }
      first += static_cast<std::uint32_t>(parts.parts.size());
    }
    return entity;
  }

  void write_nodes_4_1() {
    const std::vector<std::uint32_t> entity = entity_of_vertex();
    std::size_t entities = 0;
    for (const Kind& kind : kinds_) entities += kind.parts.parts.size();
    std::vector<std::size_t> sizes(entities, 0);
    for (std::uint32_t e : entity) ++sizes[e];
    node_order_ = order_by_group(entity, sizes);
    const auto blocks = sizes.size() - static_cast<std::size_t>(std::count(sizes.begin(), sizes.end(), 0U));
    const std::size_t total = mesh_.vertices.size();
    out_ << "$Nodes\n" << blocks << ' ' << total << " 1 " << total << '\n';
    std::size_t next = 0;
    std::size_t e = 0;
    for (std::size_t dimension = 0; dimension < kinds_.size(); ++dimension) {
      for (std::size_t part = 0; part < kinds_[dimension].parts.parts.size(); ++part, ++e) {
        if (sizes[e] == 0) continue;
        out_ << dimension << ' ' << entity_tag(dimension, part) << " 0 " << sizes[e] << '\n';
        const std::size_t end = next + sizes[e];
        for (std::size_t i = next; i < end; ++i) out_ << std::uint64_t{node_order_[i]} + 1 << '\n';
        for (; next < end; ++next) write_point(mesh_.vertices[node_order_[next]]);
      }
    }
    out_ << "$EndNodes\n";
  }

  void write_elements_4_1() {
    std::size_t blocks = 0;
    for (const Kind& kind : kinds_) blocks += kind.parts.used();
    out_ << "$Elements\n" << blocks << ' ' << elements_ << " 1 " << elements_ << '\n';
    for (const std::size_t dimension : kNumbered) {
      const auto& [type, parts, first] = kinds_[dimension];
      const std::vector<std::uint32_t> order = parts.order();
      std::size_t next = 0;
      for (std::size_t e = 0; e < parts.parts.size(); ++e) {
        if (parts.parts[e].count == 0) continue;
        out_ << dimension << ' ' << entity_tag(dimension, e) << ' ' << type << ' ' << parts.parts[e].count << '\n';
        for (const std::size_t end = next + parts.parts[e].count; next < end; ++next) {
          out_ << first + order[next] + 1;
          write_ids(nodes_of(dimension, order[next]));
        }
      }
    }
    out_ << "$EndElements\n";
  }

  /// Of each element the tet that it is, that is behind it, or that has it.
  std::vector<std::uint32_t> tet_of_element() const {
    std::vector<std::uint32_t> tets;
    for (const TetFace& face : faces_behind_facets(mesh_)) tets.push_back(face.tet);
    for (std::uint32_t t = 0; t < mesh_.tets.size(); ++t) tets.push_back(t);
    for (std::size_t e = 0; e < mesh_.curve_edges.size(); ++e) tets.push_back(edges_.tet_of(e));
    if (mesh_.corners.empty()) return tets;
    std::vector<std::uint32_t> with_vertex(mesh_.vertices.size(), 0);
    for (std::uint32_t t = 0; t < mesh_.tets.size(); ++t) {
      for (const VertexId v : mesh_.tets[t]) with_vertex[v] = t;
    }
    for (const VertexId corner : mesh_.corners) tets.push_back(with_vertex[corner]);
    return tets;
  }

  /// In the order in which the elements stand, for meshio takes the values by that; triangles, lines and points have
  /// the value of their tet, for meshio wants one of every element.
  void write_fields(const std::vector<std::size_t>& order) {
    if (mesh_.fields.empty()) return;
    const std::vector<std::uint32_t> tets = tet_of_element();
    for (const MeshField& field : mesh_.fields) {
      begin_data("$ElementData", field.name, order.size());
      for (const std::size_t element : order) out_ << element + 1 << ' ' << field.values[tets[element]] << '\n';
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

  std::vector<std::size_t> order_4_1() const {
    std::vector<std::size_t> order;
    for (const std::size_t dimension : kNumbered) {
      for (const std::uint32_t i : kinds_[dimension].parts.order()) order.push_back(kinds_[dimension].first + i);
    }
    return order;
  }

  const TetMesh& mesh_;
  const MeshWriteOptions& options_;
  MeshTags tags_;
  std::vector<NamedSet> sets_;
  CurveElements edges_;
  FacetNodes facets_;
  std::array<Kind, 4> kinds_;  // by dimension
  std::size_t elements_ = 0;
  std::vector<VertexId> node_order_;  // in which nodes stand, for meshio takes their values by that
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
