// Gmsh ASCII files. The discrete model has one volume entity a region and one surface entity a pair of regions, each
// with its physical group of the same tag. Vertices belong to the lowest surface that uses them, else to their volume.
#include <algorithm>
#include <limits>
#include <utility>

#include "scantet/base/error.h"
#include "scantet/io/atomic_file.h"
#include "scantet/io/mesh_codecs_impl.h"
#include "scantet/io/mesh_tags_impl.h"
#include "scantet/io/text_writer_impl.h"

namespace scantet {
namespace {

constexpr int kTriangle = 2;  // Gmsh's element types
constexpr int kTetrahedron = 4;

class MshWriter {
 public:
  MshWriter(const TetMesh& mesh, const MeshWriteOptions& options, std::ostream& out)
      : mesh_(mesh), options_(options), tags_(make_tags(mesh)), out_(out) {}

  void write_2_2() {
    begin("2.2");
    write_nodes_2_2();
    write_elements_2_2();
  }
  void write_4_1() {
    begin("4.1");
    write_entities();
    write_nodes_4_1();
    write_elements_4_1();
  }

 private:
  void begin(std::string_view version) {
    out_ << "$MeshFormat\n" << version << " 0 8\n$EndMeshFormat\n";
    out_ << "$Comments\n" << header_line(options_) << "\n$EndComments\n";
    out_ << "$PhysicalNames\n" << tags_.surfaces.size() + tags_.volumes.size() << '\n';
    for (const SurfaceTag& surface : tags_.surfaces) out_ << "2 " << surface.tag << " \"" << surface.name << "\"\n";
    for (const VolumeTag& volume : tags_.volumes) out_ << "3 " << volume.tag << " \"" << volume.name << "\"\n";
    out_ << "$EndPhysicalNames\n";
  }

  void write_point(const Point& point) {
    const Point p = in_space(point, options_);
    out_ << p.x << ' ' << p.y << ' ' << p.z << '\n';
  }

  template <std::size_t N>
  void write_ids(const std::array<VertexId, N>& ids) {
    for (VertexId id : ids) out_ << ' ' << std::uint64_t{id} + 1;
    out_ << '\n';
  }

  void write_nodes_2_2() {
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
      out_ << ++element << ' ' << kTriangle << " 2 " << tag << ' ' << tag;
      write_ids(mesh_.boundary_facets[i]);
    }
    for (std::size_t i = 0; i < mesh_.tets.size(); ++i) {
      const int tag = tags_.volumes[tags_.volume_of_tet[i]].tag;
      out_ << ++element << ' ' << kTetrahedron << " 2 " << tag << ' ' << tag;
      write_ids(mesh_.tets[i]);
    }
    out_ << "$EndElements\n";
  }

  void write_box(const Box& box) {
    out_ << ' ' << box.min.x << ' ' << box.min.y << ' ' << box.min.z;
    out_ << ' ' << box.max.x << ' ' << box.max.y << ' ' << box.max.z;
  }

  void write_entities() {
    std::vector<Box> surface_boxes(tags_.surfaces.size());
    std::vector<Box> volume_boxes(tags_.volumes.size());
    for (std::size_t i = 0; i < mesh_.boundary_facets.size(); ++i) {
      for (VertexId v : mesh_.boundary_facets[i]) extend(surface_boxes[tags_.surface_of_facet[i]], v);
    }
    for (std::size_t i = 0; i < mesh_.tets.size(); ++i) {
      for (VertexId v : mesh_.tets[i]) extend(volume_boxes[tags_.volume_of_tet[i]], v);
    }
    out_ << "$Entities\n0 0 " << tags_.surfaces.size() << ' ' << tags_.volumes.size() << '\n';
    for (std::size_t s = 0; s < tags_.surfaces.size(); ++s) {
      out_ << tags_.surfaces[s].tag;
      write_box(surface_boxes[s]);
      out_ << " 1 " << tags_.surfaces[s].tag << " 0\n";
    }
    for (std::size_t v = 0; v < tags_.volumes.size(); ++v) {
      out_ << tags_.volumes[v].tag;
      write_box(volume_boxes[v]);
      out_ << " 1 " << tags_.volumes[v].tag;
      write_bounding_surfaces(tags_.volumes[v].region);
    }
    out_ << "$EndEntities\n";
  }

  void extend(Box& box, VertexId v) const { box.extend(in_space(mesh_.vertices[v], options_)); }

  /// Surfaces that bound a region: positive where their facets point out of it.
  void write_bounding_surfaces(Region region) {
    std::vector<int> bounding;
    for (const SurfaceTag& surface : tags_.surfaces) {
      if (surface.regions[0] == region) bounding.push_back(surface.tag);
      if (surface.regions[1] == region) bounding.push_back(-surface.tag);
    }
    out_ << ' ' << bounding.size();
    for (int tag : bounding) out_ << ' ' << tag;
    out_ << '\n';
  }

  /// For each vertex the index of its entity: surfaces first, then volumes.
  std::vector<std::uint32_t> entity_of_vertex() const {
    std::vector<std::uint32_t> entity(mesh_.vertices.size(), std::numeric_limits<std::uint32_t>::max());
    for (std::size_t i = 0; i < mesh_.boundary_facets.size(); ++i) {
      for (VertexId v : mesh_.boundary_facets[i]) entity[v] = std::min(entity[v], tags_.surface_of_facet[i]);
    }
    const auto surfaces = static_cast<std::uint32_t>(tags_.surfaces.size());
    for (std::size_t i = 0; i < mesh_.tets.size(); ++i) {
      for (VertexId v : mesh_.tets[i]) entity[v] = std::min(entity[v], surfaces + tags_.volume_of_tet[i]);
    }
    return entity;
  }

  void write_nodes_4_1() {
    const std::vector<std::uint32_t> entity = entity_of_vertex();
    std::vector<std::size_t> sizes(tags_.surfaces.size() + tags_.volumes.size(), 0);
    for (std::uint32_t e : entity) ++sizes[e];
    const std::vector<std::uint32_t> order = order_by_group(entity, sizes);
    const auto blocks = sizes.size() - static_cast<std::size_t>(std::count(sizes.begin(), sizes.end(), 0U));
    const std::size_t total = mesh_.vertices.size();
    out_ << "$Nodes\n" << blocks << ' ' << total << " 1 " << total << '\n';
    std::size_t first = 0;
    for (std::size_t e = 0; e < sizes.size(); first += sizes[e++]) {
      if (sizes[e] == 0) continue;
      const bool surface = e < tags_.surfaces.size();
      out_ << (surface ? "2 " : "3 ")
           << (surface ? tags_.surfaces[e].tag : tags_.volumes[e - tags_.surfaces.size()].tag) << " 0 " << sizes[e]
           << '\n';
      for (std::size_t i = first; i < first + sizes[e]; ++i) out_ << std::uint64_t{order[i]} + 1 << '\n';
      for (std::size_t i = first; i < first + sizes[e]; ++i) write_point(mesh_.vertices[order[i]]);
    }
    out_ << "$EndNodes\n";
  }

  void write_elements_4_1() {
    const std::size_t facets = mesh_.boundary_facets.size();
    const std::size_t total = facets + mesh_.tets.size();
    out_ << "$Elements\n" << tags_.surfaces.size() + tags_.volumes.size() << ' ' << total << " 1 " << total << '\n';
    for_each_surface(tags_, [&](const SurfaceTag& surface, std::span<const std::uint32_t> members) {
      out_ << "2 " << surface.tag << ' ' << kTriangle << ' ' << members.size() << '\n';
      for (const std::uint32_t facet : members) {
        out_ << std::uint64_t{facet} + 1;
        write_ids(mesh_.boundary_facets[facet]);
      }
    });
    for_each_region(tags_, [&](const VolumeTag& volume, std::span<const std::uint32_t> members) {
      out_ << "3 " << volume.tag << ' ' << kTetrahedron << ' ' << members.size() << '\n';
      for (const std::uint32_t tet : members) {
        out_ << facets + tet + 1;
        write_ids(mesh_.tets[tet]);
      }
    });
    out_ << "$EndElements\n";
  }

  const TetMesh& mesh_;
  const MeshWriteOptions& options_;
  MeshTags tags_;
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
