// The arrays are those of a .vtu that scantet writes, and of the same types.
#include "grids.h"

#include <scantet/report/report_forms.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkIdList.h>
#include <vtkIntArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>
#include <vtkStringArray.h>
#include <vtkTypeInt64Array.h>
#include <vtkUnsignedCharArray.h>
#include <vtkUnstructuredGrid.h>

#include <set>
#include <string>
#include <vector>

namespace vtkscantet {
namespace {

template <class Array, class Values>
vtkSmartPointer<Array> make_array(const std::string& name, const Values& values) {
  auto array = vtkSmartPointer<Array>::New();
  array->SetName(name.c_str());
  array->SetNumberOfValues(static_cast<vtkIdType>(values.size()));
  vtkIdType next = 0;
  for (const auto& value : values) array->SetValue(next++, static_cast<typename Array::ValueType>(value));
  return array;
}

vtkSmartPointer<vtkStringArray> make_texts(const char* name, const std::vector<std::string>& texts) {
  auto array = vtkSmartPointer<vtkStringArray>::New();
  array->SetName(name);
  for (const std::string& text : texts) array->InsertNextValue(text);
  return array;
}

/// Cells of one size; ids(cell, out) says of which points.
template <class Ids>
vtkSmartPointer<vtkCellArray> make_cells(std::size_t count, std::size_t width, const Ids& ids) {
  vtkNew<vtkTypeInt64Array> connectivity;
  vtkNew<vtkTypeInt64Array> offsets;
  connectivity->SetNumberOfValues(static_cast<vtkIdType>(width * count));
  offsets->SetNumberOfValues(static_cast<vtkIdType>(count + 1));
  for (std::size_t i = 0; i < count; ++i) ids(i, connectivity->GetPointer(static_cast<vtkIdType>(width * i)));
  for (std::size_t i = 0; i <= count; ++i) {
    offsets->SetValue(static_cast<vtkIdType>(i), static_cast<vtkTypeInt64>(width * i));
  }
  auto cells = vtkSmartPointer<vtkCellArray>::New();
  cells->SetData(offsets, connectivity);
  return cells;
}

/// Subtraction, so that zero stays +0.
vtkSmartPointer<vtkPoints> make_points(const std::vector<scantet::Point>& vertices, scantet::VtkAxes axes) {
  const bool is_ras = axes == scantet::VtkAxes::ras;
  auto points = vtkSmartPointer<vtkPoints>::New();
  points->SetDataTypeToDouble();
  points->SetNumberOfPoints(static_cast<vtkIdType>(vertices.size()));
  vtkIdType next = 0;
  for (const scantet::Point& p : vertices) {
    points->SetPoint(next++, is_ras ? 0 - p.x : p.x, is_ras ? 0 - p.y : p.y, p.z);
  }
  return points;
}

void add_flags(vtkDataSetAttributes& data, const std::string& name, const std::vector<std::uint32_t>& members,
               std::size_t count) {
  if (members.empty()) return;
  std::vector<unsigned char> flags(count, 0);
  for (const std::uint32_t i : members) flags[i] = 1;
  data.AddArray(make_array<vtkUnsignedCharArray>(name, flags));
}

void add_cell_arrays(const scantet::TetMesh& mesh, vtkCellData& data) {
  data.AddArray(make_array<vtkIntArray>("region", mesh.tet_regions));
  for (const scantet::MeshField& field : mesh.fields) {
    data.AddArray(make_array<vtkDoubleArray>(field.name, field.values));
  }
  for (const scantet::MeshSet& set : mesh.sets) add_flags(data, "set_" + set.name, set.tets, mesh.tets.size());
}

void add_point_arrays(const scantet::TetMesh& mesh, vtkPointData& data) {
  std::vector<unsigned char> on_boundary(mesh.vertices.size());
  for (std::size_t v = 0; v < on_boundary.size(); ++v) {
    on_boundary[v] = mesh.on_boundary(static_cast<scantet::VertexId>(v)) ? 1 : 0;
  }
  data.AddArray(make_array<vtkUnsignedCharArray>("on_boundary", on_boundary));
  for (const scantet::MeshSet& set : mesh.sets) add_flags(data, "set_" + set.name, set.vertices, mesh.vertices.size());
}

void add_facts(const scantet::MeshOutcome& outcome, vtkFieldData& data) {
  const std::set<scantet::Region> regions(outcome.mesh.tet_regions.begin(), outcome.mesh.tet_regions.end());
  std::vector<std::string> names;
  for (const scantet::Region region : regions) names.push_back(scantet::region_name(outcome.mesh, region));
  data.AddArray(make_array<vtkIntArray>("region_ids", regions));
  data.AddArray(make_texts("region_names", names));
  data.AddArray(make_texts("findings", outcome.findings));
  data.AddArray(make_texts("notes", outcome.notes));
  data.AddArray(make_texts("report", {scantet::json_report(outcome.report)}));
}

}  // namespace

void fill_grid(const scantet::MeshOutcome& outcome, scantet::VtkAxes axes, vtkUnstructuredGrid& grid) {
  const scantet::TetMesh& mesh = outcome.mesh;
  grid.SetPoints(make_points(mesh.vertices, axes));
  const bool is_second_order = !mesh.tet_edge_vertices.empty();
  const auto ids = [&](std::size_t t, vtkTypeInt64* out) {
    out = std::copy(mesh.tets[t].begin(), mesh.tets[t].end(), out);
    if (is_second_order) std::copy(mesh.tet_edge_vertices[t].begin(), mesh.tet_edge_vertices[t].end(), out);
  };
  grid.SetCells(is_second_order ? VTK_QUADRATIC_TETRA : VTK_TETRA,
                make_cells(mesh.tets.size(), is_second_order ? 10 : 4, ids));
  add_cell_arrays(mesh, *grid.GetCellData());
  add_point_arrays(mesh, *grid.GetPointData());
  add_facts(outcome, *grid.GetFieldData());
}

void fill_boundary(const scantet::MeshOutcome& outcome, vtkUnstructuredGrid& grid, vtkPolyData& boundary) {
  const scantet::TetMesh& mesh = outcome.mesh;
  boundary.SetPoints(grid.GetPoints());
  boundary.SetPolys(make_cells(mesh.boundary_facets.size(), 3, [&](std::size_t f, vtkTypeInt64* out) {
    std::copy(mesh.boundary_facets[f].begin(), mesh.boundary_facets[f].end(), out);
  }));
  boundary.GetCellData()->AddArray(make_array<vtkIntArray>("patch", mesh.facet_patches));
  vtkNew<vtkIntArray> regions;
  regions->SetName("regions");
  regions->SetNumberOfComponents(2);
  regions->SetNumberOfTuples(static_cast<vtkIdType>(mesh.facet_regions.size()));
  for (std::size_t f = 0; f < mesh.facet_regions.size(); ++f) {
    for (int side = 0; side < 2; ++side) {
      regions->SetTypedComponent(static_cast<vtkIdType>(f), side,
                                 mesh.facet_regions[f][static_cast<std::size_t>(side)]);
    }
  }
  boundary.GetCellData()->AddArray(regions);
  for (const scantet::MeshSet& set : mesh.sets) {
    add_flags(*boundary.GetCellData(), "set_" + set.name, set.facets, mesh.boundary_facets.size());
  }
  std::vector<std::string> names;
  for (const scantet::MeshPatch& patch : mesh.patches) names.push_back(scantet::patch_name(patch));
  boundary.GetFieldData()->AddArray(make_texts("patch_names", names));
}

scantet::TetMesh tets_of(vtkUnstructuredGrid& grid) {
  scantet::TetMesh mesh;
  mesh.vertices.resize(static_cast<std::size_t>(grid.GetNumberOfPoints()));
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    double p[3];
    grid.GetPoint(static_cast<vtkIdType>(v), p);
    mesh.vertices[v] = {p[0], p[1], p[2]};
  }
  auto* const regions = vtkIntArray::SafeDownCast(grid.GetCellData()->GetArray("region"));
  vtkNew<vtkIdList> ids;
  for (vtkIdType cell = 0; cell < grid.GetNumberOfCells(); ++cell) {
    const int type = grid.GetCellType(cell);
    if (type != VTK_TETRA && type != VTK_QUADRATIC_TETRA) continue;
    grid.GetCellPoints(cell, ids);
    scantet::Tet tet{};
    for (std::size_t i = 0; i < 4; ++i) tet[i] = static_cast<scantet::VertexId>(ids->GetId(static_cast<vtkIdType>(i)));
    mesh.tets.push_back(tet);
    if (regions != nullptr) mesh.tet_regions.push_back(regions->GetValue(cell));
  }
  return mesh;
}

}  // namespace vtkscantet
