// The mesh's vectors are arrays of plain numbers as they are; NumPy is told their shapes.
#include "arrays.h"

#include <pybind11/stl.h>

#include <array>
#include <memory>
#include <type_traits>
#include <vector>

#include "python_domain.h"
#include "scantet/base/error.h"
#include "scantet/field/scan_from_memory.h"

namespace scantet::python {
namespace {

namespace py = pybind11;

py::array read_only(py::array array) {
  py::detail::array_proxy(array.ptr())->flags &= ~py::detail::npy_api::NPY_ARRAY_WRITEABLE_;
  return array;
}

template <class Number>
py::array view(const std::vector<Number>& values, const py::object& owner) {
  return read_only(py::array(py::dtype::of<Number>(), {values.size()}, {sizeof(Number)}, values.data(), owner));
}

template <class Number, std::size_t Width>
py::array view(const std::vector<std::array<Number, Width>>& rows, const py::object& owner) {
  static_assert(sizeof(std::array<Number, Width>) == Width * sizeof(Number));
  return read_only(py::array(py::dtype::of<Number>(), std::vector<std::size_t>{rows.size(), Width},
                             std::vector<std::size_t>{Width * sizeof(Number), sizeof(Number)}, rows.data(), owner));
}

py::array view(const std::vector<Point>& points, const py::object& owner) {
  return read_only(py::array(py::dtype::of<double>(), std::vector<std::size_t>{points.size(), 3},
                             std::vector<std::size_t>{sizeof(Point), sizeof(double)}, points.data(), owner));
}

/// One member of each stratum.
template <class Number>
py::array strata_view(const std::vector<Stratum>& strata, const Number Stratum::*member, const py::object& owner) {
  const void* const first = strata.empty() ? nullptr : &(strata.front().*member);
  return read_only(py::array(py::dtype::of<Number>(), {strata.size()}, {sizeof(Stratum)}, first, owner));
}

py::dict region_names(const TetMesh& mesh) {
  py::dict names;
  for (const Region region : mesh.tet_regions) {
    const py::int_ key(region);
    if (!names.contains(key)) names[key] = text(region_name(mesh, region));
  }
  return names;
}

py::dict sets_of(const TetMesh& mesh, const py::object& owner) {
  py::dict sets;
  for (const MeshSet& set : mesh.sets) {
    py::dict members;
    members["vertices"] = view(set.vertices, owner);
    members["facets"] = view(set.facets, owner);
    members["tets"] = view(set.tets, owner);
    sets[text(set.name)] = members;
  }
  return sets;
}

py::list materials_of(const TetMesh& mesh) {
  py::list materials;
  for (const MeshMaterial& material : mesh.materials) {
    py::dict one;
    one["name"] = text(material.name);
    one["youngs_modulus_mpa"] = material.youngs_modulus_mpa;
    one["poissons_ratio"] = material.poissons_ratio;
    one["density_tonne_per_mm3"] = material.density_tonne_per_mm3;
    materials.append(one);
  }
  return materials;
}

py::list patches_of(const TetMesh& mesh) {
  py::list patches;
  for (const MeshPatch& patch : mesh.patches) {
    patches.append(py::make_tuple(text(patch_name(patch)), patch.regions[0], patch.regions[1]));
  }
  return patches;
}

py::list curves_of(const TetMesh& mesh) {
  py::list curves;
  for (const MeshCurve& curve : mesh.curves) {
    curves.append(py::make_tuple(text(curve.name), py::tuple(py::cast(curve.regions))));
  }
  return curves;
}

template <class... Numbers>
VoxelPointer pointer_to(const py::array& values, std::variant<const Numbers*...>*) {
  VoxelPointer found;
  const bool known = (... || (py::isinstance<py::array_t<Numbers>>(values) &&
                              (found = static_cast<const Numbers*>(values.data()), true)));
  if (known) return found;
  throw Error(Fault::input, "input.pixel_type",
              "the array has values of type " + py::str(values.dtype()).cast<std::string>(),
              "convert it to an 8- to 64-bit integer, float or double");
}

}  // namespace

py::str text(const std::string& bytes) {
  return py::reinterpret_steal<py::str>(
      PyUnicode_DecodeUTF8(bytes.data(), static_cast<py::ssize_t>(bytes.size()), "replace"));
}

Scan scan_from_array(const py::array& values, const py::array_t<double>& frame, const std::string& format,
                     const py::object& keeper) {
  if (values.ndim() != 3 || (values.flags() & py::array::f_style) == 0) {
    throw Error(Fault::input, "input.dimension", "the array is not of three dimensions, the first of them fastest");
  }
  std::array<int, 3> size{};
  for (int axis = 0; axis < 3; ++axis) size[static_cast<std::size_t>(axis)] = static_cast<int>(values.shape(axis));
  const auto at = frame.unchecked<2>();
  if (at.shape(0) != 3 || at.shape(1) != 4) throw py::value_error("a frame is an array (3, 4)");
  std::array<Vec, 3> columns;
  for (py::ssize_t axis = 0; axis < 3; ++axis) {
    columns[static_cast<std::size_t>(axis)] = {at(0, axis), at(1, axis), at(2, axis)};
  }
  const Frame placed(columns, {at(0, 3), at(1, 3), at(2, 3)});
  const VoxelPointer pointer = pointer_to(values, static_cast<VoxelPointer*>(nullptr));
  const auto owner = shared_object(py::make_tuple(values, keeper));
  const py::gil_scoped_release released;
  return make_scan(pointer, size, placed, owner, format);
}

py::array voxel_array(const Scan& scan, const py::object& owner) {
  return std::visit(
      [&](const auto* voxels) {
        using Voxel = std::remove_cvref_t<decltype(*voxels)>;
        std::vector<std::size_t> shape;
        std::vector<std::size_t> strides;
        std::size_t stride = sizeof(Voxel);
        for (const int side : scan.size) {
          shape.push_back(static_cast<std::size_t>(side));
          strides.push_back(stride);
          stride *= static_cast<std::size_t>(side);
        }
        return read_only(py::array(py::dtype::of<Voxel>(), shape, strides, voxels, owner));
      },
      scan.voxels);
}

py::dict mesh_arrays(const TetMesh& mesh, const py::object& owner) {
  py::dict arrays;
  arrays["vertices"] = view(mesh.vertices, owner);
  arrays["tets"] = view(mesh.tets, owner);
  arrays["tet_regions"] = view(mesh.tet_regions, owner);
  arrays["boundary_facets"] = view(mesh.boundary_facets, owner);
  arrays["facet_regions"] = view(mesh.facet_regions, owner);
  arrays["facet_patches"] = view(mesh.facet_patches, owner);
  arrays["vertex_dimension"] = strata_view(mesh.strata, &Stratum::dimension, owner);
  arrays["vertex_stratum"] = strata_view(mesh.strata, &Stratum::index, owner);
  arrays["curve_edges"] = view(mesh.curve_edges, owner);
  arrays["edge_curves"] = view(mesh.edge_curves, owner);
  arrays["corners"] = view(mesh.corners, owner);
  arrays["tet_edge_vertices"] = view(mesh.tet_edge_vertices, owner);
  arrays["tet_materials"] = view(mesh.tet_materials, owner);
  arrays["region_names"] = region_names(mesh);
  arrays["patches"] = patches_of(mesh);
  arrays["curves"] = curves_of(mesh);
  arrays["sets"] = sets_of(mesh, owner);
  arrays["materials"] = materials_of(mesh);
  py::dict fields;
  for (const MeshField& field : mesh.fields) fields[text(field.name)] = view(field.values, owner);
  arrays["fields"] = fields;
  return arrays;
}

}  // namespace scantet::python
