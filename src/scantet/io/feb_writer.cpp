// FEBio's XML, version 4.0: the mesh, and a domain a region that asks for a material of the region's name, or domains
// of a region and one of the mesh's materials each. It has no steps, and without --materials no materials: a deck takes
// the sections Mesh and MeshDomains from this file.
#include <string>

#include "scantet/base/element_nodes.h"
#include "scantet/base/mesh_topology.h"
#include "scantet/base/xml_text.h"
#include "scantet/io/atomic_file.h"
#include "scantet/io/curve_elements_impl.h"
#include "scantet/io/mesh_codecs_impl.h"
#include "scantet/io/mesh_tags_impl.h"
#include "scantet/io/text_writer_impl.h"

namespace scantet {
namespace {

class FebWriter {
 public:
  FebWriter(const TetMesh& mesh, const MeshWriteOptions& options, std::ostream& out)
      : mesh_(mesh),
        options_(options),
        tags_(make_tags(mesh)),
        parts_(make_parts(mesh, tags_)),
        facets_(mesh),
        out_(out) {}

  void write() {
    out_ << "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
         << xml_comment(header_line(options_)) << "\n<febio_spec version=\"4.0\">\n\t<Module type=\"solid\"/>\n";
    write_materials();
    out_ << "\t<Mesh>\n";
    write_nodes();
    write_elements();
    write_node_sets();
    write_surfaces();
    write_curves();
    for (const auto& [name, set] : sets_and_materials(mesh_, tags_)) write_set(name, set);
    if (!mesh_.materials.empty()) write_region_sets();
    out_ << "\t</Mesh>\n\t<MeshDomains>\n";
    for (const PartTag& part : parts_.parts) {
      out_ << "\t\t<SolidDomain name=\"" << part.name << "\" mat=\""
           << (part.material ? tags_.material_names[*part.material] : part.name) << "\"/>\n";
    }
    out_ << "\t</MeshDomains>\n";
    write_fields();
    out_ << "</febio_spec>\n";
  }

 private:
  void write_nodes() {
    out_ << "\t\t<Nodes name=\"nodes\">\n";
    for (std::size_t v = 0; v < mesh_.vertices.size(); ++v) {
      const Point p = in_space(mesh_.vertices[v], options_);
      out_ << "\t\t\t<node id=\"" << v + 1 << "\">" << p.x << ',' << p.y << ',' << p.z << "</node>\n";
    }
    out_ << "\t\t</Nodes>\n";
  }

  /// Linear elastic, where the constants are known; in MPa and tonne/mm³.
  void write_materials() {
    if (mesh_.materials.empty() || !options_.with_material_constants) return;
    out_ << "\t<Material>\n";
    for (std::size_t m = 0; m < mesh_.materials.size(); ++m) {
      const MeshMaterial& material = mesh_.materials[m];
      if (!(material.youngs_modulus_mpa > 0)) continue;
      out_ << "\t\t<material id=\"" << m + 1 << "\" name=\"" << tags_.material_names[m]
           << "\" type=\"isotropic elastic\">";
      if (material.density_tonne_per_mm3 > 0) out_ << "<density>" << material.density_tonne_per_mm3 << "</density>";
      out_ << "<E>" << material.youngs_modulus_mpa << "</E><v>" << material.poissons_ratio << "</v></material>\n";
    }
    out_ << "\t</Material>\n";
  }

  /// Calls take(part, indices of its tets) for each domain.
  template <typename Take>
  void for_each_part(const Take& take) const {
    for_each_group(parts_.parts, parts_.part_of_tet, parts_.tets_in, take);
  }

  void write_elements() {
    for_each_part([&](const PartTag& part, std::span<const std::uint32_t> tets) {
      out_ << "\t\t<Elements type=\"" << (is_second_order(mesh_) ? "tet10" : "tet4") << "\" name=\"" << part.name
           << "\">\n";
      for (const std::uint32_t tet : tets) {
        out_ << "\t\t\t<elem id=\"" << std::uint64_t{tet} + 1 << "\">";
        write_numbers(nodes_of_tet(mesh_, tet));
        out_ << "</elem>\n";
      }
      out_ << "\t\t</Elements>\n";
    });
  }

  /// Of regions that are in several domains.
  void write_region_sets() {
    for_each_region(tags_, [&](const VolumeTag& volume, std::span<const std::uint32_t> tets) {
      write_list("ElementSet", volume.name, {tets.begin(), tets.end()});
    });
  }

  /// One value an element, domain by domain, which FEBio's materials take as maps. An attribute `type` would name what
  /// makes the values.
  void write_fields() {
    if (mesh_.fields.empty()) return;
    out_ << "\t<MeshData>\n";
    for (const MeshField& field : mesh_.fields) {
      for_each_part([&](const PartTag& part, std::span<const std::uint32_t> tets) {
        out_ << "\t\t<ElementData name=\"" << field.name << "\" elem_set=\"" << part.name
             << "\" data_type=\"scalar\">\n";
        for (std::size_t i = 0; i < tets.size(); ++i) {
          out_ << "\t\t\t<e lid=\"" << i + 1 << "\">" << field.values[tets[i]] << "</e>\n";
        }
        out_ << "\t\t</ElementData>\n";
      });
    }
    out_ << "\t</MeshData>\n";
  }

  void write_node_sets() {
    for_each_region(tags_, [&](const VolumeTag& volume, std::span<const std::uint32_t> tets) {
      write_node_set("nodes_" + volume.name, vertices_of_tets(mesh_, tets));
    });
    if (!mesh_.boundary_facets.empty()) write_node_set("boundary", vertices_of_boundary(mesh_));
  }

  void write_node_set(const std::string& name, const std::vector<std::uint8_t>& member) {
    std::vector<std::uint32_t> vertices;
    for (std::size_t v = 0; v < member.size(); ++v) {
      if (member[v] != 0) vertices.push_back(static_cast<std::uint32_t>(v));
    }
    write_list("NodeSet", name, vertices);
  }

  void write_list(const char* kind, const std::string& name, const std::vector<std::uint32_t>& members) {
    constexpr std::size_t kPerLine = 16;
    out_ << "\t\t<" << kind << " name=\"" << name << "\">\n\t\t\t";
    for (std::size_t i = 0; i < members.size(); ++i) {
      if (i > 0) out_ << (i % kPerLine == 0 ? ",\n\t\t\t" : ",");
      out_ << std::uint64_t{members[i]} + 1;
    }
    out_ << "\n\t\t</" << kind << ">\n";
  }

  void write_set(const std::string& name, const MeshSet& set) {
    if (!set.vertices.empty()) write_list("NodeSet", name, set.vertices);
    if (!set.tets.empty()) write_list("ElementSet", name, set.tets);
    if (!set.facets.empty()) write_surface(name, set.facets);
  }

  void write_surfaces() {
    for_each_surface(tags_, [&](const SurfaceTag& surface, std::span<const std::uint32_t> facets) {
      write_surface(surface.name, facets);
    });
  }

  void write_curves() {
    const CurveElements edges(mesh_);
    const std::string_view shape = is_second_order(mesh_) ? "line3" : "line2";
    for_each_curve(mesh_, tags_, [&](const CurveTag& curve, std::span<const std::uint32_t> members) {
      write_elements_of("Edge", curve.name, shape, members, [&](std::uint32_t edge) { return edges.of(edge); });
    });
    if (tags_.corners) write_list("NodeSet", tags_.corners->name, mesh_.corners);
  }

  void write_surface(const std::string& name, std::span<const std::uint32_t> facets) {
    write_elements_of("Surface", name, is_second_order(mesh_) ? "tri6" : "tri3", facets,
                      [&](std::uint32_t facet) { return facets_.of(facet); });
  }

  /// Elements of a place that has a name, numbered from 1.
  template <typename NodesOf>
  void write_elements_of(const char* kind, const std::string& name, std::string_view shape,
                         std::span<const std::uint32_t> members, const NodesOf& nodes_of) {
    out_ << "\t\t<" << kind << " name=\"" << name << "\">\n";
    std::size_t number = 0;
    for (const std::uint32_t member : members) {
      out_ << "\t\t\t<" << shape << " id=\"" << ++number << "\">";
      write_numbers(nodes_of(member));
      out_ << "</" << shape << ">\n";
    }
    out_ << "\t\t</" << kind << ">\n";
  }

  void write_numbers(const ElementNodes& nodes) {
    for (std::size_t i = 0; i < nodes.count; ++i) out_ << (i > 0 ? "," : "") << std::uint64_t{nodes.all[i]} + 1;
  }

  const TetMesh& mesh_;
  const MeshWriteOptions& options_;
  MeshTags tags_;
  MeshParts parts_;
  FacetNodes facets_;
  TextWriter out_;
};

}  // namespace

void write_feb(const TetMesh& mesh, const std::string& path, const MeshWriteOptions& options) {
  write_file(
      path, [&](std::ostream& out) { FebWriter(mesh, options, out).write(); }, options.set);
}

}  // namespace scantet
