// MEDIT ASCII meshes: vertices with reference 1 on the boundary, tets with their region, triangles with a number for
// their pair of regions that a comment explains, edges with one for their curve. Names that the mesh has of its own are
// in these comments, too. Elements of second order are in sections of their own, whose nodes on edges stand in VTK's
// order (as Gmsh reads and writes them).
#include <array>
#include <cctype>

#include "scantet/base/element_nodes.h"
#include "scantet/base/mesh_topology.h"
#include "scantet/io/atomic_file.h"
#include "scantet/io/curve_elements_impl.h"
#include "scantet/io/mesh_codecs_impl.h"
#include "scantet/io/mesh_tags_impl.h"
#include "scantet/io/text_scanner_impl.h"
#include "scantet/io/text_writer_impl.h"

namespace scantet {
namespace {

void write_element(const ElementNodes& nodes, int reference, TextWriter& out) {
  for (const VertexId v : nodes) out << std::uint64_t{v} + 1 << ' ';
  out << reference << '\n';
}

/// Edges of curves and, for Mmg, which of them are sharp without being junctions, and where curves end or meet.
void write_curves(const TetMesh& mesh, const MeshTags& tags, TextWriter& out) {
  const CurveElements edges(mesh);
  std::vector<std::size_t> ridges;
  if (!mesh.curve_edges.empty()) {
    out << (is_second_order(mesh) ? "EdgesP2\n" : "Edges\n") << mesh.curve_edges.size() << '\n';
  }
  for (std::size_t e = 0; e < mesh.curve_edges.size(); ++e) {
    const CurveTag& curve = tags.curves[mesh.edge_curves[e]];
    write_element(edges.of(e), curve.tag, out);
    if (curve.is_sharp && !is_second_order(mesh)) ridges.push_back(e + 1);
  }
  if (!ridges.empty()) out << "Ridges\n" << ridges.size() << '\n';
  for (const std::size_t ridge : ridges) out << ridge << '\n';
  if (!mesh.corners.empty()) out << "Corners\n" << mesh.corners.size() << '\n';
  for (const VertexId corner : mesh.corners) out << std::uint64_t{corner} + 1 << '\n';
}

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
  for (const CurveTag& curve : tags.curves) {
    out << "# edge reference " << curve.tag << ": " << curve.name << ", of regions";
    for (const Region region : curve.regions) out << ' ' << region;
    out << '\n';
  }
  out << "Dimension 3\nVertices\n" << mesh.vertices.size() << '\n';
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    const Point p = in_space(mesh.vertices[v], options);
    out << p.x << ' ' << p.y << ' ' << p.z << (on_boundary[v] != 0 ? " 1\n" : " 0\n");
  }
  const FacetNodes facets(mesh);
  const char* const second = is_second_order(mesh) ? "P2\n" : "\n";
  out << "Triangles" << second << mesh.boundary_facets.size() << '\n';
  for (std::size_t i = 0; i < mesh.boundary_facets.size(); ++i) {
    write_element(facets.of(i), tags.surfaces[tags.surface_of_facet[i]].tag, out);
  }
  write_curves(mesh, tags, out);
  out << "Tetrahedra" << second << mesh.tets.size() << '\n';
  for (std::size_t i = 0; i < mesh.tets.size(); ++i) write_element(nodes_of_tet(mesh, i), mesh.tet_regions[i], out);
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
    } else if (keyword == "Tetrahedra" || keyword == "TetrahedraP2") {
      read_tets(keyword.ends_with("P2"));
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

  /// Indices from 0 on; one of 0 in the file becomes huge: refused later.
  template <std::size_t Count>
  std::array<std::uint64_t, Count> read_nodes() {
    std::array<std::uint64_t, Count> nodes{};
    for (std::uint64_t& v : nodes) v = static_cast<std::uint64_t>(scan_.integer() - 1);
    return nodes;
  }

  void read_tets(bool have_ten_nodes) {
    const std::size_t least_bytes = have_ten_nodes ? 21 : 9;  // "1 2 3 4 0"
    const std::uint64_t n = scan_.count(least_bytes);
    mesh_.tets.reserve(mesh_.tets.size() + n);
    mesh_.references.reserve(mesh_.references.size() + n);
    for (std::uint64_t i = 0; i < n; ++i) {
      mesh_.tets.push_back(read_nodes<4>());
      if (have_ten_nodes) mesh_.edge_nodes.push_back(read_nodes<6>());
      mesh_.references.push_back(scan_.int32());
    }
  }

  void skip_section(std::string_view keyword) {
    constexpr std::array<std::string_view, 8> kNames{"Hexahedra",      "Prisms", "Pyramids",    "Triangles",
                                                     "Quadrilaterals", "Edges",  "TrianglesP2", "EdgesP2"};
    constexpr std::size_t kSolids = 3;  // the first ones
    for (std::size_t i = 0; i < kNames.size(); ++i) {
      if (keyword != kNames[i]) continue;
      constexpr std::size_t kLeastBytes = 5;  // "1 2 0"
      const std::uint64_t n = scan_.count(kLeastBytes);
      mesh_.other_cells += n;
      if (i < kSolids) mesh_.other_solids += n;
      scan_.skip_lines(n + 1);
      return;
    }
    if (keyword != "Ridges" && keyword != "Corners") mesh_.left_out.emplace_back(in_quotes(keyword));  // which follow
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
  write_file(
      path, [&](std::ostream& out) { write_text(mesh, options, out); }, options.set);
}

RawMesh read_medit(const std::string& path) {
  const std::string text = read_whole_file(path);
  return MeditReader(path, text).read();
}

}  // namespace scantet
