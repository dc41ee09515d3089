// Meshes, and parts of them, as VTK's data. Private to io/.
#pragma once

#include <vtkCellArray.h>
#include <vtkDataSetAttributes.h>
#include <vtkIntArray.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>
#include <vtkTypeInt32Array.h>
#include <vtkTypeInt64Array.h>
#include <vtkUnstructuredGrid.h>

#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "scantet/base/element_nodes.h"
#include "scantet/io/atomic_file.h"
#include "scantet/io/mesh_codecs_impl.h"

namespace scantet {

vtkSmartPointer<vtkPoints> make_points(const std::vector<Point>& vertices, const MeshWriteOptions& options);

/// Cells of `per_cell` nodes each, which nodes_of(i) lists.
template <typename Array, typename NodesOf>
vtkSmartPointer<vtkCellArray> make_cells(std::size_t count, std::size_t per_cell, const NodesOf& nodes_of) {
  using Id = typename Array::ValueType;
  const std::size_t nodes = per_cell * count;
  const std::size_t ends = count + 1;
  vtkNew<Array> connectivity;
  vtkNew<Array> offsets;
  connectivity->SetNumberOfValues(static_cast<vtkIdType>(nodes));
  offsets->SetNumberOfValues(static_cast<vtkIdType>(ends));
  Id* next = connectivity->GetPointer(0);
  for (std::size_t i = 0; i < count; ++i) {
    for (const VertexId v : nodes_of(i)) *next++ = static_cast<Id>(v);
  }
  for (std::size_t i = 0; i < ends; ++i) {
    const std::size_t end = per_cell * i;
    offsets->SetValue(static_cast<vtkIdType>(i), static_cast<Id>(end));
  }
  auto result = vtkSmartPointer<vtkCellArray>::New();
  result->SetData(offsets, connectivity);
  return result;
}

/// Some cells with their own vertices only, in the mesh's order.
struct VtkPiece {
  vtkSmartPointer<vtkPoints> points;
  vtkSmartPointer<vtkCellArray> cells;
  std::vector<VertexId> vertices;  ///< of the mesh, one a point
};

/// `count` cells, at least one, all of as many nodes, which nodes_of(i) lists.
template <typename NodesOf>
VtkPiece make_piece(const TetMesh& mesh, const MeshWriteOptions& options, std::size_t count, const NodesOf& nodes_of) {
  constexpr VertexId kUnused = std::numeric_limits<VertexId>::max();
  std::vector<VertexId> new_id(mesh.vertices.size(), kUnused);
  for (std::size_t i = 0; i < count; ++i) {
    for (const VertexId v : nodes_of(i)) new_id[v] = 0;
  }
  VtkPiece piece;
  std::vector<Point> vertices;
  for (std::size_t v = 0; v < new_id.size(); ++v) {
    if (new_id[v] == kUnused) continue;
    new_id[v] = static_cast<VertexId>(vertices.size());
    vertices.push_back(mesh.vertices[v]);
    piece.vertices.push_back(static_cast<VertexId>(v));
  }
  piece.points = make_points(vertices, options);
  const std::size_t per_cell = count == 0 ? 0 : nodes_of(0).count;
  piece.cells = make_cells<vtkTypeInt64Array>(count, per_cell, [&](std::size_t i) {
    ElementNodes nodes = nodes_of(i);
    for (std::size_t k = 0; k < nodes.count; ++k) nodes.all[k] = new_id[nodes.all[k]];
    return nodes;
  });
  return piece;
}

/// One whole number an item, under a name.
template <typename NumberOf>
void add_numbers(vtkDataSetAttributes* data, const char* name, std::size_t count, const NumberOf& number_of) {
  vtkNew<vtkIntArray> numbers;
  numbers->SetName(name);
  numbers->SetNumberOfValues(static_cast<vtkIdType>(count));
  for (std::size_t i = 0; i < count; ++i) numbers->SetValue(static_cast<vtkIdType>(i), number_of(i));
  data->AddArray(numbers);
}

/// All tets with regions, fields and sets.
vtkSmartPointer<vtkUnstructuredGrid> make_grid(const TetMesh& mesh, const MeshWriteOptions& options);

/// Adds the provenance as an array of characters, which all programs can read. A string array, which meshio cannot
/// read, is added only where it is needed: 3D Slicer takes files for LPS unless a string array says RAS.
void add_provenance(vtkDataObject* data, const MeshWriteOptions& options);

/// The array kRegionNames, if regions have names.
void add_region_names(const TetMesh& mesh, vtkDataObject* data);

/// These boundary facets, as flat triangles between corners; or with all nodes that `with_edges` lists, as polygons.
vtkSmartPointer<vtkPolyData> make_surface(const TetMesh& mesh, std::span<const std::uint32_t> facets,
                                          const MeshWriteOptions& options, const FacetNodes* with_edges = nullptr);

/// Writes the file whole, and commits it. Throws Error (output.*) with the system's reason, which VTK does not tell.
void write_grid(AtomicFile& file, vtkUnstructuredGrid* grid);
void write_polygons(AtomicFile& file, vtkPolyData* surface);
void write_triangles(AtomicFile& file, vtkPolyData* surface, const MeshWriteOptions& options);  ///< STL

}  // namespace scantet
