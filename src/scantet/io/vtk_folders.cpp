// Folders of VTK's files and of STL: SimVascular's mesh-complete, the blocks of a .vtm, an STL a patch. Nodes and
// elements have the numbers that they have in the whole mesh, from 1, which is how SimVascular puts the parts together.
#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkPointData.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <numeric>

#include "scantet/base/error.h"
#include "scantet/base/mesh_topology.h"
#include "scantet/base/xml_text.h"
#include "scantet/io/atomic_folder_impl.h"
#include "scantet/io/curve_elements_impl.h"
#include "scantet/io/file_set.h"
#include "scantet/io/mesh_tags_impl.h"
#include "scantet/io/text_writer_impl.h"
#include "scantet/io/vtk_grids_impl.h"

namespace scantet {
namespace {

constexpr const char* kNodeNumber = "GlobalNodeID";
constexpr const char* kElementNumber = "GlobalElementID";

using Members = std::span<const std::uint32_t>;

class MeshComplete {
 public:
  MeshComplete(const TetMesh& mesh, const MeshWriteOptions& options, const AtomicFolder& folder)
      : mesh_(mesh),
        options_(options),
        tags_(make_tags(mesh)),
        nodes_(mesh),
        behind_(faces_behind_facets(mesh)),
        folder_(folder) {}

  void write() const {
    write_volume();
    std::vector<std::uint32_t> exterior;
    for (std::uint32_t f = 0; f < mesh_.boundary_facets.size(); ++f) {
      if (mesh_.facet_regions[f][1] == kOutside) exterior.push_back(f);
    }
    write_surface("mesh-complete.exterior.vtp", exterior);
    std::vector<std::uint32_t> walls;
    folder_.make_folder("mesh-surfaces");
    for_each_surface(tags_, [&](const SurfaceTag& surface, Members facets) {
      write_surface("mesh-surfaces/" + surface.name + ".vtp", facets);
      const bool is_cap = surface.is_named && is_flat(facets);  // one triangle alone is flat, too
      if (surface.regions[1] == kOutside && !is_cap) walls.insert(walls.end(), facets.begin(), facets.end());
    });
    std::sort(walls.begin(), walls.end());
    write_surface("walls_combined.vtp", walls);
    for (std::size_t s = 0; s < mesh_.sets.size(); ++s) {
      write_surface("mesh-surfaces/" + tags_.set_names[s] + ".vtp", mesh_.sets[s].facets);
    }
  }

 private:
  void write_volume() const {
    const vtkSmartPointer<vtkUnstructuredGrid> grid = make_grid(mesh_, options_);
    add_numbers(grid->GetPointData(), kNodeNumber, mesh_.vertices.size(), [](std::size_t v) { return number_of(v); });
    add_numbers(grid->GetCellData(), kElementNumber, mesh_.tets.size(), [](std::size_t t) { return number_of(t); });
    add_numbers(grid->GetCellData(), "ModelRegionID", mesh_.tets.size(),
                [&](std::size_t t) { return tags_.volumes[tags_.volume_of_tet[t]].tag; });
    add_provenance(grid, options_);
    AtomicFile file(folder_, "mesh-complete.mesh.vtu");
    write_grid(file, grid);
  }

  /// No file where there is nothing. A .vtp has no triangles of second order: SimVascular takes such as polygons of six
  /// nodes, corners first, which is not how a polygon goes round.
  void write_surface(const std::string& name, Members facets) const {
    if (facets.empty()) return;
    const vtkSmartPointer<vtkPolyData> surface = make_surface(mesh_, facets, options_, &nodes_);
    const auto add = [&](const char* array, const auto& number_of_facet) {
      add_numbers(surface->GetCellData(), array, facets.size(),
                  [&](std::size_t i) { return number_of_facet(facets[i]); });
    };
    add(kElementNumber, [&](std::uint32_t f) { return number_of(behind_[f].tet); });
    add("ModelFaceID", [&](std::uint32_t f) { return number_of(tags_.surface_of_facet[f]); });
    add("ModelRegionID", [&](std::uint32_t f) { return tags_.volumes[tags_.volume_of_tet[behind_[f].tet]].tag; });
    add_provenance(surface, options_);
    AtomicFile file(folder_, name);
    write_polygons(file, surface);
  }

  /// Whether all vertices lie in one plane, up to rounding.
  bool is_flat(Members facets) const {
    Vec normal{};
    Box box;
    for (const std::uint32_t f : facets) {
      const Triangle& t = mesh_.boundary_facets[f];
      const Point &a = mesh_.vertices[t[0]], &b = mesh_.vertices[t[1]], &c = mesh_.vertices[t[2]];
      normal = normal + cross(b - a, c - a);
      for (const VertexId v : t) box.extend(mesh_.vertices[v]);
    }
    constexpr double kRounding = 1e-7;
    const double allowed = kRounding * distance(box.min, box.max) * length(normal);
    const Point& origin = mesh_.vertices[mesh_.boundary_facets[facets.front()][0]];
    for (const std::uint32_t f : facets) {
      for (const VertexId v : mesh_.boundary_facets[f]) {
        if (!(std::abs(dot(normal, mesh_.vertices[v] - origin)) <= allowed)) return false;
      }
    }
    return length(normal) > 0;
  }

  static int number_of(std::size_t index) { return static_cast<int>(index + 1); }

  const TetMesh& mesh_;
  const MeshWriteOptions& options_;
  MeshTags tags_;
  FacetNodes nodes_;
  std::vector<TetFace> behind_;
  const AtomicFolder& folder_;
};

/// Blocks: regions, boundaries, curves, sets; each block is a grid of its own.
class Blocks {
 public:
  Blocks(const TetMesh& mesh, const MeshWriteOptions& options, const AtomicFolder& folder)
      : mesh_(mesh), options_(options), tags_(make_tags(mesh)), facets_(mesh), folder_(folder) {
    if (!mesh.boundary_facets.empty()) behind_ = faces_behind_facets(mesh);
  }

  /// The files in the folder, in the order of the blocks: the block's name, the grid's name, the file.
  std::vector<std::array<std::string, 3>> write() {
    folder_.make_folder("regions");
    for_each_region(tags_, [&](const VolumeTag& volume, Members tets) { write_tets("regions", volume.name, tets); });
    folder_.make_folder("boundaries");
    for_each_surface(
        tags_, [&](const SurfaceTag& surface, Members facets) { write_facets("boundaries", surface.name, facets); });
    write_curves();
    if (!mesh_.sets.empty()) folder_.make_folder("sets");
    for (std::size_t s = 0; s < mesh_.sets.size(); ++s) {
      const MeshSet& set = mesh_.sets[s];
      const std::string& name = tags_.set_names[s];
      if (!set.vertices.empty()) write_nodes("sets", name + "_nodes", set.vertices);
      if (!set.facets.empty()) write_facets("sets", name + "_facets", set.facets);
      if (!set.tets.empty()) write_tets("sets", name + "_elements", set.tets);
    }
    return files_;
  }

 private:
  void write_tets(const char* block, const std::string& name, Members tets) {
    const auto grid = make_block(is_second_order(mesh_) ? VTK_QUADRATIC_TETRA : VTK_TETRA, tets.size(),
                                 [&](std::size_t i) { return nodes_of_tet(mesh_, tets[i]); });
    vtkCellData* const cells = grid->GetCellData();
    const auto number_of = [&](std::size_t i) { return static_cast<int>(tets[i] + 1); };
    add_numbers(cells, kElementNumber, tets.size(), number_of);
    add_numbers(cells, "region", tets.size(), [&](std::size_t i) { return mesh_.tet_regions[tets[i]]; });
    for (const MeshField& field : mesh_.fields) {
      vtkNew<vtkDoubleArray> values;
      values->SetName(field.name.c_str());
      for (const std::uint32_t tet : tets) values->InsertNextValue(field.values[tet]);
      cells->AddArray(values);
    }
    write(block, name, grid);
  }

  void write_facets(const char* block, const std::string& name, Members facets) {
    const auto grid = make_block(is_second_order(mesh_) ? VTK_QUADRATIC_TRIANGLE : VTK_TRIANGLE, facets.size(),
                                 [&](std::size_t i) { return facets_.of(facets[i]); });
    add_numbers(grid->GetCellData(), kElementNumber, facets.size(),
                [&](std::size_t i) { return static_cast<int>(behind_[facets[i]].tet + 1); });
    write(block, name, grid);
  }

  void write_curves() {
    if (tags_.curves.empty() && !tags_.corners) return;
    folder_.make_folder("curves");
    const CurveElements edges(mesh_);
    for_each_curve(mesh_, tags_, [&](const CurveTag& curve, Members members) {
      const auto grid = make_block(is_second_order(mesh_) ? VTK_QUADRATIC_EDGE : VTK_LINE, members.size(),
                                   [&](std::size_t i) { return edges.of(members[i]); });
      add_numbers(grid->GetCellData(), kElementNumber, members.size(),
                  [&](std::size_t i) { return static_cast<int>(edges.tet_of(members[i]) + 1); });
      write("curves", curve.name, grid);
    });
    if (tags_.corners) write_nodes("curves", tags_.corners->name, mesh_.corners);
  }

  void write_nodes(const char* block, const std::string& name, const std::vector<VertexId>& nodes) {
    const auto grid = make_block(VTK_VERTEX, nodes.size(), [&](std::size_t i) {
      ElementNodes node;
      node.count = 1;
      node.all[0] = nodes[i];
      return node;
    });
    write(block, name, grid);
  }

  template <typename NodesOf>
  vtkSmartPointer<vtkUnstructuredGrid> make_block(int type, std::size_t count, const NodesOf& nodes_of) const {
    const VtkPiece piece = make_piece(mesh_, options_, count, nodes_of);
    auto grid = vtkSmartPointer<vtkUnstructuredGrid>::New();
    grid->SetPoints(piece.points);
    grid->SetCells(type, piece.cells);
    add_numbers(grid->GetPointData(), kNodeNumber, piece.vertices.size(),
                [&](std::size_t i) { return static_cast<int>(piece.vertices[i] + 1); });
    return grid;
  }

  void write(const char* block, const std::string& name, vtkUnstructuredGrid* grid) {
    const std::string file_name = std::string(block) + '/' + name + ".vtu";
    add_provenance(grid, options_);
    AtomicFile file(folder_, file_name);
    write_grid(file, grid);
    files_.push_back({block, name, file_name});
  }

  const TetMesh& mesh_;
  const MeshWriteOptions& options_;
  MeshTags tags_;
  FacetNodes facets_;
  std::vector<TetFace> behind_;
  const AtomicFolder& folder_;
  std::vector<std::array<std::string, 3>> files_;
};

void write_index(const std::vector<std::array<std::string, 3>>& files, const std::string& folder,
                 const MeshWriteOptions& options, std::ostream& stream) {
  TextWriter out(stream);
  out << "<?xml version=\"1.0\"?>\n"
      << xml_comment(header_line(options))
      << "\n<VTKFile type=\"vtkMultiBlockDataSet\" version=\"1.0\" byte_order=\"LittleEndian\" "
         "header_type=\"UInt64\">\n  <vtkMultiBlockDataSet>\n";
  std::string open;
  std::size_t blocks = 0;
  std::size_t in_block = 0;
  for (const auto& [block, name, file] : files) {
    if (block != open) {
      if (!open.empty()) out << "    </Block>\n";
      out << "    <Block index=\"" << blocks++ << "\" name=\"" << block << "\">\n";
      open = block;
      in_block = 0;
    }
    out << "      <DataSet index=\"" << in_block++ << "\" name=\"" << name << "\" file=\""
        << xml_escaped(folder + "/" + file) << "\"/>\n";
  }
  out << "    </Block>\n  </vtkMultiBlockDataSet>\n</VTKFile>\n";
}

}  // namespace

bool is_mesh_complete_file(std::string_view name) {
  constexpr std::string_view kSurfaces = "mesh-surfaces/";
  for (const std::string_view one :
       {std::string_view("mesh-complete.mesh.vtu"), std::string_view("mesh-complete.exterior.vtp"),
        std::string_view("walls_combined.vtp"), kSurfaces}) {
    if (name == one) return true;
  }
  return name.starts_with(kSurfaces) && name.ends_with(".vtp");
}

bool is_block_file(std::string_view name) {
  for (const std::string_view folder : {"regions/", "boundaries/", "curves/", "sets/"}) {
    if (name == folder || (name.starts_with(folder) && name.ends_with(".vtu"))) return true;
  }
  return false;
}

bool is_stl_file(std::string_view name) {
  return name.ends_with(".stl");
}

std::string vtm_blocks_path(const std::string& path) {
  return std::filesystem::path(path).replace_extension(".blocks").string();
}

void write_mesh_complete(const TetMesh& mesh, const std::string& path, const MeshWriteOptions& options) {
  require_32_bits(mesh, path, "SimVascular");
  AtomicFolder folder(path, is_mesh_complete_file, options.set);
  MeshComplete(mesh, options, folder).write();
  folder.commit();
}

void write_vtm(const TetMesh& mesh, const std::string& path, const MeshWriteOptions& options) {
  require_32_bits(mesh, path, "VTK's multi-block files");
  const std::string blocks = vtm_blocks_path(path);
  FileSet both;  // the blocks appear first, so that what lists them finds them
  FileSet& set = options.set != nullptr ? *options.set : both;
  AtomicFolder folder(blocks, is_block_file, &set);
  const auto files = Blocks(mesh, options, folder).write();
  folder.commit();
  const std::string name = std::filesystem::path(blocks).filename().string();
  write_file(
      path, [&](std::ostream& out) { write_index(files, name, options, out); }, &set);
  both.commit();
}

void write_stls(const TetMesh& mesh, const std::string& path, const MeshWriteOptions& options) {
  AtomicFolder folder(path, is_stl_file, options.set);
  const MeshTags tags = make_tags(mesh);
  const auto write_one = [&](const std::string& name, Members facets) {
    if (facets.empty()) return;
    AtomicFile file(folder, name + ".stl");
    write_triangles(file, make_surface(mesh, facets, options), options);
  };
  for_each_surface(tags, [&](const SurfaceTag& surface, Members facets) { write_one(surface.name, facets); });
  for (std::size_t s = 0; s < mesh.sets.size(); ++s) write_one(tags.set_names[s], mesh.sets[s].facets);
  folder.commit();
}

}  // namespace scantet
