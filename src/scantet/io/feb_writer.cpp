// FEBio's XML, version 4.0: the mesh, and a domain a region that asks for a material of the region's name. It has no
// materials and no steps, which are the user's: a deck takes the sections Mesh and MeshDomains from this file.
#include <string>

#include "scantet/base/mesh_topology.h"
#include "scantet/base/xml_text.h"
#include "scantet/io/atomic_file.h"
#include "scantet/io/element_nodes_impl.h"
#include "scantet/io/mesh_codecs_impl.h"
#include "scantet/io/mesh_tags_impl.h"
#include "scantet/io/text_writer_impl.h"

namespace scantet {
namespace {

class FebWriter {
 public:
  FebWriter(const TetMesh& mesh, const MeshWriteOptions& options, std::ostream& out)
      : mesh_(mesh), options_(options), tags_(make_tags(mesh)), facets_(mesh), out_(out) {}

  void write() {
    out_ << "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
         << xml_comment(header_line(options_))
         << "\n<febio_spec version=\"4.0\">\n\t<Module type=\"solid\"/>\n\t<Mesh>\n";
    write_nodes();
    write_regions();
    write_node_sets();
    write_surfaces();
    for (std::size_t s = 0; s < mesh_.sets.size(); ++s) write_set(tags_.set_names[s], mesh_.sets[s]);
    out_ << "\t</Mesh>\n\t<MeshDomains>\n";
    for (const VolumeTag& volume : tags_.volumes) {
      out_ << "\t\t<SolidDomain name=\"" << volume.name << "\" mat=\"" << volume.name << "\"/>\n";
    }
    out_ << "\t</MeshDomains>\n</febio_spec>\n";
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

  void write_regions() {
    for_each_region(tags_, [&](const VolumeTag& volume, std::span<const std::uint32_t> tets) {
      out_ << "\t\t<Elements type=\"" << (is_second_order(mesh_) ? "tet10" : "tet4") << "\" name=\"" << volume.name
           << "\">\n";
      for (const std::uint32_t tet : tets) {
        out_ << "\t\t\t<elem id=\"" << std::uint64_t{tet} + 1 << "\">";
        write_numbers(nodes_of_tet(mesh_, tet));
        out_ << "</elem>\n";
      }
      out_ << "\t\t</Elements>\n";
    });
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

  void write_surface(const std::string& name, std::span<const std::uint32_t> facets) {
    out_ << "\t\t<Surface name=\"" << name << "\">\n";
    const std::string_view shape = is_second_order(mesh_) ? "tri6" : "tri3";
    std::size_t number = 0;
    for (const std::uint32_t facet : facets) {
      out_ << "\t\t\t<" << shape << " id=\"" << ++number << "\">";
      write_numbers(facets_.of(facet));
      out_ << "</" << shape << ">\n";
    }
    out_ << "\t\t</Surface>\n";
  }

  void write_numbers(const ElementNodes& nodes) {
    for (std::size_t i = 0; i < nodes.count; ++i) out_ << (i > 0 ? "," : "") << std::uint64_t{nodes.all[i]} + 1;
  }

  const TetMesh& mesh_;
  const MeshWriteOptions& options_;
  MeshTags tags_;
  FacetNodes facets_;
  TextWriter out_;
};

}  // namespace

void write_feb(const TetMesh& mesh, const std::string& path, const MeshWriteOptions& options) {
  write_file(
      path, [&](std::ostream& out) { FebWriter(mesh, options, out).write(); }, options.set);
}

}  // namespace scantet
