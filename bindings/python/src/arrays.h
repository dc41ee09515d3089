// Scans and meshes as NumPy's arrays, whose memory is shared.
#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <string>

#include "scantet/base/tet_mesh.h"
#include "scantet/field/scan.h"

namespace scantet::python {

/// Text that may hold bytes that are no UTF-8.
pybind11::str text(const std::string& bytes);

/// A scan of the array's values, which are shared. values: (i, j, k), the first index fastest in memory (Fortran's
/// order), of one of the ten types, in the machine's byte order. frame: (3, 4), index to LPS, mm. Throws Error as
/// make_scan() does.
Scan scan_from_array(const pybind11::array& values, const pybind11::array_t<double>& frame, const std::string& format,
                     const pybind11::object& keeper);

/// The voxels as (i, j, k); read-only. owner: an object that keeps the scan.
pybind11::array voxel_array(const Scan& scan, const pybind11::object& owner);

/// Every array of the mesh by its name, without a copy, read-only; and what has no array: names of regions, patches,
/// curves, sets, fields, materials. owner: an object that keeps the mesh.
pybind11::dict mesh_arrays(const TetMesh& mesh, const pybind11::object& owner);

}  // namespace scantet::python
