// The arrays are filled once, in the mesh's order; parts of a mesh have their vertices numbered anew.
#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkPointData.h>
#include <vtkStringArray.h>
#include <vtkUnsignedCharArray.h>

#include "scantet/base/error.h"
#include "scantet/base/mesh_topology.h"
#include "scantet/base/options.h"
#include "scantet/io/vtk_grids_impl.h"

namespace scantet {
namespace {

/// An array of 1 where `members` says so, else 0.
void add_flags(vtkDataSetAttributes* data, const std::string& name, const std::vector<std::uint32_t>& members,
               std::size_t count) {
  if (members.empty()) return;
  vtkNew<vtkUnsignedCharArray> flags;
  flags->SetName(name.c_str());
  flags->SetNumberOfValues(static_cast<vtkIdType>(count));
  std::fill_n(flags->GetPointer(0), count, static_cast<unsigned char>(0));
  for (const std::uint32_t i : members) flags->SetValue(static_cast<vtkIdType>(i), 1);
  data->AddArray(flags);
}

/// A field array of one character a value: meshio cannot read arrays of strings.
void add_text(vtkDataObject* data, const char* name, const std::string& text) {
  vtkNew<vtkUnsignedCharArray> characters;
  characters->SetName(name);
  characters->SetNumberOfValues(static_cast<vtkIdType>(text.size()));
  std::copy(text.begin(), text.end(), characters->GetPointer(0));
  data->GetFieldData()->AddArray(characters);
}

/// A byte for each element in each set, at once.
void add_sets(const TetMesh& mesh, vtkUnstructuredGrid* grid) {
  constexpr double kMostBytes = 4e9;
  const double bytes =
      static_cast<double>(mesh.sets.size()) * static_cast<double>(mesh.vertices.size() + mesh.tets.size());
  if (bytes > kMostBytes) {
    throw Error(Fault::output, "output.cannot_write",
                std::to_string(mesh.sets.size()) + " sets of this mesh would take " + number_text(bytes / 1e9, 3) +
                    " GB in VTK's formats, which have a number for each element in each",
                "write .inp or .msh, or leave sets out");
  }
  for (const MeshSet& set : mesh.sets) {
    add_flags(grid->GetPointData(), kSetPrefix + set.name, set.vertices, mesh.vertices.size());
    add_flags(grid->GetCellData(), kSetPrefix + set.name, set.tets, mesh.tets.size());
  }
}

}  // namespace

vtkSmartPointer<vtkPoints> make_points(const std::vector<Point>& vertices, const MeshWriteOptions& options) {
  vtkNew<vtkDoubleArray> coordinates;
  coordinates->SetNumberOfComponents(3);
  coordinates->SetNumberOfTuples(static_cast<vtkIdType>(vertices.size()));
  double* next = coordinates->GetPointer(0);
  for (const Point& vertex : vertices) {
    const Point p = in_space(vertex, options);
    *next++ = p.x;
    *next++ = p.y;
    *next++ = p.z;
  }
  auto points = vtkSmartPointer<vtkPoints>::New();
  points->SetData(coordinates);
  return points;
}

vtkSmartPointer<vtkUnstructuredGrid> make_grid(const TetMesh& mesh, const MeshWriteOptions& options) {
  auto grid = vtkSmartPointer<vtkUnstructuredGrid>::New();
  grid->SetPoints(make_points(mesh.vertices, options));
  constexpr std::size_t kMax32 = std::numeric_limits<std::int32_t>::max();
  const std::size_t per_cell = is_second_order(mesh) ? 10 : 4;
  const bool fits_32_bits = mesh.vertices.size() <= kMax32 && per_cell * mesh.tets.size() <= kMax32;
  const auto nodes_of = [&](std::size_t t) { return nodes_of_tet(mesh, t); };
  grid->SetCells(is_second_order(mesh) ? VTK_QUADRATIC_TETRA : VTK_TETRA,
                 fits_32_bits ? make_cells<vtkTypeInt32Array>(mesh.tets.size(), per_cell, nodes_of)
                              : make_cells<vtkTypeInt64Array>(mesh.tets.size(), per_cell, nodes_of));
  add_numbers(grid->GetCellData(), "region", mesh.tets.size(), [&](std::size_t t) { return mesh.tet_regions[t]; });
  for (const MeshField& field : mesh.fields) {
    vtkNew<vtkDoubleArray> values;
    values->SetName(field.name.c_str());
    values->SetNumberOfValues(static_cast<vtkIdType>(field.values.size()));
    std::copy(field.values.begin(), field.values.end(), values->GetPointer(0));
    grid->GetCellData()->AddArray(values);
  }
  const std::vector<std::uint8_t> flags = vertices_of_boundary(mesh);
  vtkNew<vtkUnsignedCharArray> on_boundary;
  on_boundary->SetName("on_boundary");
  on_boundary->SetNumberOfValues(static_cast<vtkIdType>(flags.size()));
  std::copy(flags.begin(), flags.end(), on_boundary->GetPointer(0));
  grid->GetPointData()->AddArray(on_boundary);
  add_sets(mesh, grid);
  return grid;
}

void add_provenance(vtkDataObject* data, const MeshWriteOptions& options) {
  add_text(data, kProvenance, header_line(options));
  if (!options.ras) return;
  vtkNew<vtkStringArray> space;
  space->SetName(kSpaceKey);
  space->InsertNextValue("RAS");
  data->GetFieldData()->AddArray(space);
}

void add_region_names(const TetMesh& mesh, vtkDataObject* data) {
  std::string lines;
  for (const auto& [region, name] : mesh.region_names) {
    lines += std::to_string(region) + ' ';
    for (const char c : name) lines += c == '\n' || c == '\r' ? ' ' : c;
    lines += '\n';
  }
  if (!lines.empty()) add_text(data, kRegionNames, lines);
}

vtkSmartPointer<vtkPolyData> make_surface(const TetMesh& mesh, std::span<const std::uint32_t> facets,
                                          const MeshWriteOptions& options, const FacetNodes* with_edges) {
  const auto nodes_of = [&](std::size_t i) {
    if (with_edges != nullptr) return with_edges->of(facets[i]);
    ElementNodes nodes;
    nodes.count = 3;
    std::copy_n(mesh.boundary_facets[facets[i]].begin(), 3, nodes.all.begin());
    return nodes;
  };
  const VtkPiece piece = make_piece(mesh, options, facets.size(), nodes_of);
  auto surface = vtkSmartPointer<vtkPolyData>::New();
  surface->SetPoints(piece.points);
  surface->SetPolys(piece.cells);
  add_numbers(surface->GetPointData(), "GlobalNodeID", piece.vertices.size(),
              [&](std::size_t i) { return static_cast<int>(piece.vertices[i] + 1); });
  return surface;
}

}  // namespace scantet
