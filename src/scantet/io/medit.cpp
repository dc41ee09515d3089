// MEDIT ASCII meshes: vertices with reference 1 on the boundary, tets with their region, triangles with a number for
// their pair of regions that a comment explains. Names that the mesh has of its own are in these comments, too.
#include <cctype>

#include "scantet/base/error.h"
#include "scantet/base/mesh_topology.h"
#include "scantet/io/atomic_file.h"
#include "scantet/io/mesh_codecs_impl.h"
#include "scantet/io/mesh_tags_impl.h"
#include "scantet/io/text_scanner_impl.h"
#include "scantet/io/text_writer_impl.h"

namespace scantet {
namespace {

void write_text(const TetMesh& mesh, const MeshWriteOptions& options, std::ostream& stream) {
  const MeshTags tags = make_tags(mesh);
  const std::vector<std::uint8_t> on_boundary = vertices_of_boundary(mesh);
  TextWriter out(stream);
  out << "MeshVersionFormatted 2\n# " << header_line(options) << '\n';
  for (const SurfaceTag& surface : tags.surfaces) {
    out << "# triangle reference " << surface.tag << ": ";
    if (surface.is_named) out << surface.name << ", ";
    out << "between regions " << surface.regions[0] << " (behind) and " << surface.regions[1] << " (in front)\n";
  }
  for (const VolumeTag& volume : tags.volumes) {
    if (volume.is_named) out << "# tetrahedron reference " << volume.region << ": " << volume.name << '\n';
  }
  out << "Dimension 3\nVertices\n" << mesh.vertices.size() << '\n';
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    const Point p = in_space(mesh.vertices[v], options);
    out << p.x << ' ' << p.y << ' ' << p.z << (on_boundary[v] != 0 ? " 1\n" : " 0\n");
  }
  out << "Triangles\n" << mesh.boundary_facets.size() << '\n';
  for (std::size_t i = 0; i < mesh.boundary_facets.size(); ++i) {
    for (VertexId v : mesh.boundary_facets[i]) out << std::uint64_t{v} + 1 << ' ';
    out << tags.surfaces[tags.surface_of_facet[i]].tag << '\n';
  }
  out << "Tetrahedra\n" << mesh.tets.size() << '\n';
  for (std::size_t i = 0; i < mesh.tets.size(); ++i) {
    for (VertexId v : mesh.tets[i]) out << std::uint64_t{v} + 1 << ' ';
    out << mesh.tet_regions[i] << '\n';
  }
  out << "End\n";
}

class MeditReader {
 public:
  MeditReader(const std::string& path, const std::string& text) : scan_(path, text, '#') {
    mesh_.ras = text.substr(0, kHeaderBytes).find(std::string(kSpaceKey) + "=RAS") != std::string::npos;
  }

  RawMesh read() {
    if (scan_.token() != "MeshVersionFormatted") scan_.fail("a MEDIT file begins with MeshVersionFormatted");
    scan_.integer();
    for (std::string_view keyword = scan_.token(); keyword != "End"; keyword = scan_.token()) {
      if (keyword.empty()) {
        // Some programs leave out the last keyword; a file that was cut short rarely ends with a whole line.
        if (!scan_.ends_with_newline()) scan_.fail("the file ends without 'End'");
        break;
      }
      read_section(keyword);
    }
    return std::move(mesh_);
  }

 private:
  static constexpr std::size_t kHeaderBytes = 4096;

  void read_section(std::string_view keyword) {
    if (keyword == "Dimension") {
      if (scan_.integer() != 3) scan_.fail("the mesh is not three-dimensional");
    } else if (keyword == "Vertices") {
      read_vertices();
    } else if (keyword == "Tetrahedra") {
      read_tets();
    } else if (std::isalpha(static_cast<unsigned char>(keyword[0])) != 0) {
      skip_section(keyword);
    } else {
      scan_.fail("a keyword is expected, not " + in_quotes(keyword));
    }
  }

  void read_vertices() {
    constexpr std::size_t kLeastBytes = 7;  // "0 0 0 0"
    const std::uint64_t n = scan_.count(kLeastBytes);
    mesh_.vertices.reserve(mesh_.vertices.size() + n);
    for (std::uint64_t i = 0; i < n; ++i) {
      mesh_.vertices.push_back(scan_.point());
      scan_.integer();
    }
  }

  void read_tets() {
    constexpr std::size_t kLeastBytes = 9;  // "1 2 3 4 0"
    const std::uint64_t n = scan_.count(kLeastBytes);
    mesh_.tets.reserve(mesh_.tets.size() + n);
    mesh_.references.reserve(mesh_.references.size() + n);
    for (std::uint64_t i = 0; i < n; ++i) {
      std::array<std::uint64_t, 4> tet{};
      for (std::uint64_t& v : tet)
        v = static_cast<std::uint64_t>(scan_.integer() - 1);  // 0 becomes huge: refused later
      mesh_.tets.push_back(tet);
      mesh_.references.push_back(scan_.int32());
    }
  }

  void skip_section(std::string_view keyword) {
    for (std::string_view name : {"Triangles", "Quadrilaterals", "Hexahedra", "Prisms", "Pyramids", "Edges"}) {
      if (keyword != name) continue;
      constexpr std::size_t kLeastBytes = 5;  // "1 2 0"
      const std::uint64_t n = scan_.count(kLeastBytes);
      mesh_.other_cells += n;
      scan_.skip_lines(n + 1);
      return;
    }
    for (std::string_view next = scan_.peek(); !next.empty() && std::isalpha(static_cast<unsigned char>(next[0])) == 0;
         next = scan_.peek()) {
      scan_.token();
    }
  }

  TextScanner scan_;
  RawMesh mesh_;
};

}  // namespace

void write_medit(const TetMesh& mesh, const std::string& path, const MeshWriteOptions& options) {
  if (!mesh.tet_edge_vertices.empty()) {
    throw Error(Fault::usage, "usage.order", "cannot write '" + path + "': a MEDIT file holds tetrahedra of four nodes",
                "choose another format");
  }
  write_file(
      path, [&](std::ostream& out) { write_text(mesh, options, out); }, options.set);
}

RawMesh read_medit(const std::string& path) {
  const std::string text = read_whole_file(path);
  return MeditReader(path, text).read();
}

}  // namespace scantet
