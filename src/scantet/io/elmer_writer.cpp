// Elmer's own mesh: a folder of five text files. An element is of one body, a boundary element of one boundary, by
// number; mesh.names has their names, which Elmer takes where a case says "Use Mesh Names = True". Materials are
// sections of a case, not of a mesh: they are in a file of their own, for a case to include.
#include <algorithm>
#include <string>

#include "scantet/base/element_nodes.h"
#include "scantet/base/mesh_topology.h"
#include "scantet/io/atomic_file.h"
#include "scantet/io/atomic_folder_impl.h"
#include "scantet/io/mesh_codecs_impl.h"
#include "scantet/io/mesh_tags_impl.h"
#include "scantet/io/text_writer_impl.h"

namespace scantet {
namespace {

constexpr std::string_view kFiles[] = {"mesh.header", "mesh.nodes", "mesh.elements", "mesh.boundary", "mesh.names"};
constexpr std::string_view kMaterials = "materials.sif";

class ElmerWriter {
 public:
  ElmerWriter(const TetMesh& mesh, const MeshWriteOptions& options)
      : mesh_(mesh),
        options_(options),
        tags_(make_tags(mesh)),
        parts_(make_parts(mesh, tags_)),
        is_second_(is_second_order(mesh)) {}

  void write(const AtomicFolder& folder) const {
    using Part = void (ElmerWriter::*)(TextWriter&) const;
    constexpr Part kParts[] = {&ElmerWriter::write_header, &ElmerWriter::write_nodes, &ElmerWriter::write_elements,
                               &ElmerWriter::write_boundary, &ElmerWriter::write_names};
    for (std::size_t i = 0; i < std::size(kFiles); ++i) {
      write_file(folder, std::string(kFiles[i]), [&](std::ostream& stream) {
        TextWriter out(stream);
        (this->*kParts[i])(out);
      });
    }
    if (mesh_.materials.empty()) return;
    write_file(folder, std::string(kMaterials), [&](std::ostream& stream) {
      TextWriter out(stream);
      write_materials(out);
    });
  }

 private:
  int tetrahedron() const { return is_second_ ? 510 : 504; }
  int triangle() const { return is_second_ ? 306 : 303; }

  void write_header(TextWriter& out) const {
    const std::size_t triangles = mesh_.boundary_facets.size();
    out << mesh_.vertices.size() << ' ' << mesh_.tets.size() << ' ' << triangles << '\n';
    out << (triangles == 0 ? 1 : 2) << '\n';
    if (triangles > 0) out << triangle() << ' ' << triangles << '\n';
    out << tetrahedron() << ' ' << mesh_.tets.size() << '\n';
  }

  void write_nodes(TextWriter& out) const {
    for (std::size_t v = 0; v < mesh_.vertices.size(); ++v) {
      const Point p = in_space(mesh_.vertices[v], options_);
      out << v + 1 << " -1 " << p.x << ' ' << p.y << ' ' << p.z << '\n';
    }
  }

  void write_elements(TextWriter& out) const {
    for (std::size_t t = 0; t < mesh_.tets.size(); ++t) {
      out << t + 1 << ' ' << parts_.parts[parts_.part_of_tet[t]].tag << ' ' << tetrahedron();
      write_ids(nodes_of_tet(mesh_, t), out);
    }
  }

  /// A boundary element names the elements on both sides, 0 where there is none.
  void write_boundary(TextWriter& out) const {
    const FacetNodes nodes(mesh_);
    const std::vector<TetFace> behind = faces_behind_facets(mesh_);
    const std::vector<TetFace> before = faces_before_facets(mesh_);
    for (std::size_t f = 0; f < mesh_.boundary_facets.size(); ++f) {
      const bool is_outer = mesh_.facet_regions[f][1] == kOutside;
      out << f + 1 << ' ' << tags_.surfaces[tags_.surface_of_facet[f]].tag << ' ' << std::uint64_t{behind[f].tet} + 1
          << ' ' << (is_outer ? 0 : std::uint64_t{before[f].tet} + 1) << ' ' << triangle();
      write_ids(nodes.of(f), out);
    }
  }

  void write_names(TextWriter& out) const {
    std::string comment = header_line(options_);
    std::replace(comment.begin(), comment.end(), '$', ' ');  // which begins a name
    out << "! " << comment << "\n! ----- names for bodies -----\n";
    for (const PartTag& part : parts_.parts) out << "$ " << part.name << " = " << part.tag << '\n';
    out << "! ----- names for boundaries -----\n";
    for (const SurfaceTag& surface : tags_.surfaces) out << "$ " << surface.name << " = " << surface.tag << '\n';
  }

  /// Isotropic, linear, where the constants are known; and of each region and material a body that has it.
  void write_materials(TextWriter& out) const {
    out << "! " << header_line(options_) << "\n! in MPa, mm and tonnes\n";
    for (std::size_t m = 0; m < mesh_.materials.size(); ++m) {
      const MeshMaterial& material = mesh_.materials[m];
      out << "Material " << m + 1 << "\n  Name = \"" << tags_.material_names[m] << "\"\n";
      if (material.youngs_modulus_mpa > 0 && options_.with_material_constants) {
        out << "  Youngs Modulus = Real " << material.youngs_modulus_mpa << "\n  Poisson Ratio = Real "
            << material.poissons_ratio << '\n';
        if (material.density_tonne_per_mm3 > 0) {
          out << "  Density = Real " << material.density_tonne_per_mm3 << '\n';
        }
      }
      out << "End\n";
    }
    for (std::size_t i = 0; i < parts_.parts.size(); ++i) {
      const PartTag& part = parts_.parts[i];
      out << "Body " << i + 1 << "\n  Target Bodies(1) = " << part.tag << "\n  Name = \"" << part.name
          << "\"\n  Equation = 1\n  Material = " << *part.material + 1 << "\nEnd\n";
    }
  }

  static void write_ids(const ElementNodes& nodes, TextWriter& out) {
    for (const VertexId v : nodes) out << ' ' << std::uint64_t{v} + 1;
    out << '\n';
  }

  const TetMesh& mesh_;
  const MeshWriteOptions& options_;
  MeshTags tags_;
  MeshParts parts_;
  bool is_second_;
};

}  // namespace

bool is_elmer_file(std::string_view name) {
  return name == kMaterials || std::find(std::begin(kFiles), std::end(kFiles), name) != std::end(kFiles);
}

void write_elmer(const TetMesh& mesh, const std::string& path, const MeshWriteOptions& options) {
  AtomicFolder folder(path, is_elmer_file, options.set);
  ElmerWriter(mesh, options).write(folder);
  folder.commit();
}

}  // namespace scantet
