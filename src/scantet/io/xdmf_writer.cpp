// XDMF for FEniCSx, ParaView and others: a small .xdmf that describes the arrays, and an .h5 of the same name beside it
// that holds them. FEniCSx looks for that name.
#include <filesystem>
#include <optional>
#include <string>

#include "scantet/base/element_nodes.h"
#include "scantet/base/xml_text.h"
#include "scantet/io/atomic_file.h"
#include "scantet/io/curve_elements_impl.h"
#include "scantet/io/file_names.h"
#include "scantet/io/file_set.h"
#include "scantet/io/hdf5_file_impl.h"
#include "scantet/io/mesh_codecs_impl.h"
#include "scantet/io/mesh_tags_impl.h"
#include "scantet/io/text_writer_impl.h"

namespace scantet {
namespace {

constexpr const char* kGeometry = "/mesh/geometry";
constexpr const char* kTets = "/mesh/topology";
constexpr const char* kRegions = "/mesh/region";
constexpr const char* kFacets = "/boundary/topology";
constexpr const char* kPatches = "/boundary/boundary";
constexpr const char* kEdges = "/curve/topology";
constexpr const char* kCurves = "/curve/curve";

/// Where the array of a set is.
std::string set_path(const char* kind, const std::string& name) {
  return std::string("/set/") + kind + '/' + name;
}

/// Elements one after the other, whose nodes nodes_of tells.
template <typename NodesOf>
void write_elements(const char* path, std::size_t count, const NodesOf& nodes_of, Hdf5File& file) {
  std::vector<std::uint32_t> nodes;
  for (std::size_t i = 0; i < count; ++i) {
    const ElementNodes element = nodes_of(i);
    nodes.insert(nodes.end(), element.begin(), element.end());
  }
  file.write_wide(path, {count, count == 0 ? 3 : nodes.size() / count}, nodes);
}

void write_curves(const TetMesh& mesh, const MeshTags& tags, Hdf5File& file) {
  if (mesh.curve_edges.empty()) return;
  file.make_group("/curve");
  const CurveElements edges(mesh);
  write_elements(
      kEdges, mesh.curve_edges.size(), [&](std::size_t e) { return edges.of(e); }, file);
  std::vector<std::int32_t> numbers;
  for (const std::uint32_t curve : mesh.edge_curves) numbers.push_back(tags.curves[curve].tag);
  file.write(kCurves, {numbers.size()}, numbers);
}

void write_sets(const TetMesh& mesh, const MeshTags& tags, Hdf5File& file) {
  if (mesh.sets.empty()) return;
  file.make_group("/set");
  for (const char* kind : {"nodes", "facets", "elements"}) file.make_group(std::string("/set/") + kind);
  const auto write_flags = [&](const char* kind, std::size_t s, const std::vector<std::uint32_t>& members,
                               std::size_t count) {
    if (members.empty()) return;
    std::vector<std::int32_t> flags(count, 0);
    for (const std::uint32_t i : members) flags[i] = 1;
    file.write(set_path(kind, tags.set_names[s]), {count}, flags);
  };
  for (std::size_t s = 0; s < mesh.sets.size(); ++s) {
    write_flags("nodes", s, mesh.sets[s].vertices, mesh.vertices.size());
    write_flags("facets", s, mesh.sets[s].facets, mesh.boundary_facets.size());
    write_flags("elements", s, mesh.sets[s].tets, mesh.tets.size());
  }
}

void write_arrays(const TetMesh& mesh, const MeshTags& tags, const MeshWriteOptions& options, Hdf5File& file) {
  file.make_group("/mesh");
  std::vector<double> coordinates;
  coordinates.reserve(3 * mesh.vertices.size());
  for (const Point& vertex : mesh.vertices) {
    const Point p = in_space(vertex, options);
    coordinates.insert(coordinates.end(), {p.x, p.y, p.z});
  }
  file.write(kGeometry, {mesh.vertices.size(), 3}, coordinates);
  write_elements(
      kTets, mesh.tets.size(), [&](std::size_t t) { return nodes_of_tet(mesh, t); }, file);
  std::vector<std::int32_t> numbers;
  for (const std::uint32_t volume : tags.volume_of_tet) numbers.push_back(tags.volumes[volume].tag);
  file.write(kRegions, {numbers.size()}, numbers);
  if (!mesh.fields.empty()) file.make_group("/mesh/fields");
  for (const MeshField& field : mesh.fields)
    file.write("/mesh/fields/" + field.name, {field.values.size()}, field.values);
  file.make_group("/boundary");
  const FacetNodes facets(mesh);
  write_elements(
      kFacets, mesh.boundary_facets.size(), [&](std::size_t f) { return facets.of(f); }, file);
  numbers.clear();
  for (const std::uint32_t surface : tags.surface_of_facet) numbers.push_back(tags.surfaces[surface].tag);
  file.write(kPatches, {numbers.size()}, numbers);
  write_curves(mesh, tags, file);
  write_sets(mesh, tags, file);
}

class XdmfWriter {
 public:
  XdmfWriter(const TetMesh& mesh, const MeshTags& tags, std::string arrays, std::ostream& out)
      : mesh_(mesh), tags_(tags), arrays_(std::move(arrays)), out_(out) {}

  void write(const MeshWriteOptions& options) {
    out_ << "<?xml version=\"1.0\"?>\n"
         << xml_comment(header_line(options)) << "\n<Xdmf Version=\"3.0\">\n  <Domain>\n";
    const bool is_second = is_second_order(mesh_);
    write_grid("mesh", is_second ? "Tetrahedron_10" : "Tetrahedron", is_second ? 10 : 4, mesh_.tets.size(), kTets,
               "region", kRegions, tags_.volumes);
    write_grid("boundary", is_second ? "Triangle_6" : "Triangle", is_second ? 6 : 3, mesh_.boundary_facets.size(),
               kFacets, "boundary", kPatches, tags_.surfaces);
    if (!mesh_.curve_edges.empty()) {
      write_grid("curve", is_second ? "Edge_3" : "Polyline", is_second ? 3 : 2, mesh_.curve_edges.size(), kEdges,
                 "curve", kCurves, tags_.curves);
    }
    out_ << "  </Domain>\n</Xdmf>\n";
  }

 private:
  /// Elements with one tag each, and the names of the tags.
  template <typename Tag>
  void write_grid(const char* name, const char* shape, std::size_t corners, std::size_t count,
                  std::string_view topology, const char* attribute, const char* values, const std::vector<Tag>& tags) {
    out_ << "    <Grid Name=\"" << name << "\" GridType=\"Uniform\">\n      <Topology TopologyType=\"" << shape
         << "\" NumberOfElements=\"" << count << "\" NodesPerElement=\"" << corners << "\">\n";
    write_item(count, corners, "Int", 8, topology);
    out_ << "      </Topology>\n      <Geometry GeometryType=\"XYZ\">\n";
    write_item(mesh_.vertices.size(), 3, "Float", 8, kGeometry);
    out_ << "      </Geometry>\n      <Attribute Name=\"" << attribute
         << "\" AttributeType=\"Scalar\" Center=\"Cell\">\n";
    write_item(count, 1, "Int", 4, values);
    out_ << "      </Attribute>\n";
    if (topology == kTets) {
      write_fields(count);
      write_sets(true);
    } else if (topology == kFacets) {
      write_sets(false);
    }
    for (const Tag& tag : tags) {
      out_ << "      <Information Name=\"" << tag.name << "\" Value=\"" << tag.tag << "\"/>\n";
    }
    out_ << "    </Grid>\n";
  }

  void write_fields(std::size_t count) {
    for (std::size_t m = 0; m < mesh_.materials.size(); ++m) {  // of the field "material"
      out_ << "      <Information Name=\"material_" << tags_.material_names[m] << "\" Value=\"" << m + 1 << "\"/>\n";
    }
    for (const MeshField& field : mesh_.fields) {
      out_ << "      <Attribute Name=\"" << field.name << "\" AttributeType=\"Scalar\" Center=\"Cell\">\n";
      write_item(count, 1, "Float", 8, ("/mesh/fields/" + field.name).c_str());
      out_ << "      </Attribute>\n";
    }
  }

  /// The sets of what a grid has.
  void write_sets(bool is_of_tets) {
    for (std::size_t s = 0; s < mesh_.sets.size(); ++s) {
      const MeshSet& set = mesh_.sets[s];
      if (is_of_tets) {
        write_attribute(s, "Node", "nodes", set.vertices, mesh_.vertices.size());
        write_attribute(s, "Cell", "elements", set.tets, mesh_.tets.size());
      } else {
        write_attribute(s, "Cell", "facets", set.facets, mesh_.boundary_facets.size());
      }
    }
  }

  void write_attribute(std::size_t s, const char* center, const char* kind, const std::vector<std::uint32_t>& members,
                       std::size_t count) {
    if (members.empty()) return;
    out_ << "      <Attribute Name=\"set_" << tags_.set_names[s] << "\" AttributeType=\"Scalar\" Center=\"" << center
         << "\">\n";
    write_item(count, 1, "Int", 4, set_path(kind, tags_.set_names[s]).c_str());
    out_ << "      </Attribute>\n";
  }

  void write_item(std::size_t rows, std::size_t columns, const char* type, int bytes, std::string_view path) {
    out_ << "        <DataItem Dimensions=\"" << rows;
    if (columns > 1) out_ << ' ' << columns;
    out_ << "\" NumberType=\"" << type << "\" Precision=\"" << bytes << "\" Format=\"HDF\">" << xml_escaped(arrays_)
         << ':' << path << "</DataItem>\n";
  }

  const TetMesh& mesh_;
  const MeshTags& tags_;
  std::string arrays_;
  TextWriter out_;
};

}  // namespace

std::string xdmf_arrays_path(const std::string& path) {
  return std::filesystem::path(path).replace_extension(".h5").string();
}

std::vector<std::string> xdmf_set_names(const TetMesh& mesh) {
  return make_tags(mesh).set_names;
}

void write_xdmf(const TetMesh& mesh, const std::string& path, const MeshWriteOptions& options) {
  const MeshTags tags = make_tags(mesh);
  const std::string arrays = xdmf_arrays_path(path);
  FileSet both;  // the arrays appear first, so that what describes them finds them
  FileSet& set = options.set != nullptr ? *options.set : both;
  AtomicFile file(arrays, ".part", &set);
  Hdf5File hdf5(file);
  write_arrays(mesh, tags, options, hdf5);
  hdf5.close();
  file.commit();
  const std::string name = std::filesystem::path(arrays).filename().string();
  write_file(
      path, [&](std::ostream& out) { XdmfWriter(mesh, tags, name, out).write(options); }, &set);
  both.commit();
}

}  // namespace scantet
