// Meshes of scantet's as data sets of VTK's, and back.
#pragma once

#include <scantet/adapters/from_vtk.h>
#include <scantet/app/mesh_scan.h>

class vtkDataSet;
class vtkPolyData;
class vtkUnstructuredGrid;

namespace vtkscantet {

/// The tets with their arrays, as vtkScantetMesher has them. axes: of the grid.
void fill_grid(const scantet::MeshOutcome& outcome, scantet::VtkAxes axes, vtkUnstructuredGrid& grid);

/// The boundary with the grid's points.
void fill_boundary(const scantet::MeshOutcome& outcome, vtkUnstructuredGrid& grid, vtkPolyData& boundary);

/// The tets of a grid, of second order by their corners, with its cell array `region` if it has one that fits. Other
/// cells are left out.
scantet::TetMesh tets_of(vtkUnstructuredGrid& grid);

}  // namespace vtkscantet
