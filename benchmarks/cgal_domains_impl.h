// CGAL's own domains of the objects that are compared.
#pragma once

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Image_3.h>
#include <CGAL/Labeled_mesh_domain_3.h>
#include <CGAL/Mesh_complex_3_in_triangulation_3.h>
#include <CGAL/Polyhedral_mesh_domain_3.h>
#include <CGAL/Polyhedral_mesh_domain_with_features_3.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/boost/graph/IO/polygon_mesh_io.h>

#include <stdexcept>

#include "cases.h"
#include "inputs.h"
#include "tanglecube.h"

namespace scantet::bench {

using PeerKernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using PeerPoint = PeerKernel::Point_3;
using PeerLabeledDomain = CGAL::Labeled_mesh_domain_3<PeerKernel>;
using PeerSurface = CGAL::Surface_mesh<PeerPoint>;
using PeerPolyhedralDomain = CGAL::Polyhedral_mesh_domain_3<PeerSurface, PeerKernel>;
using PeerSharpDomain = CGAL::Polyhedral_mesh_domain_with_features_3<PeerKernel, PeerSurface>;

/// Cells of a mesh, and edges of curves if the domain has such.
template <class PeerDomain, class Triangulation>
struct PeerComplex {
  using type = CGAL::Mesh_complex_3_in_triangulation_3<Triangulation>;
};
template <class Triangulation>
struct PeerComplex<PeerSharpDomain, Triangulation> {
  using type = CGAL::Mesh_complex_3_in_triangulation_3<Triangulation, PeerSharpDomain::Corner_index,
                                                       PeerSharpDomain::Curve_index>;
};

inline Point from_cgal(const PeerPoint& p) {
  return {p.x(), p.y(), p.z()};
}

/// The scan as 32-bit floats in CGAL's image type.
inline CGAL::Image_3 to_cgal_image(const Scan& scan) {
  _image* image = _createImage(static_cast<std::size_t>(scan.size[0]), static_cast<std::size_t>(scan.size[1]),
                               static_cast<std::size_t>(scan.size[2]), 1, scan.frame.spacing_mm(0),
                               scan.frame.spacing_mm(1), scan.frame.spacing_mm(2), 4, WK_FLOAT, SGN_SIGNED);
  std::visit(
      [&](const auto* voxels) {
        auto* out = static_cast<float*>(image->data);
        for (std::int64_t i = 0; i < scan.voxel_count(); ++i) out[i] = static_cast<float>(voxels[i]);
      },
      scan.voxels);
  return CGAL::Image_3(image, CGAL::Image_3::OWN_THE_DATA);
}

/// A function's crossings are bisected to 1e-6 of the radius of a ball that holds the object.
inline PeerLabeledDomain open_peer_function(ImplicitFunction function, double radius) {
  namespace params = CGAL::parameters;
  return PeerLabeledDomain::create_implicit_mesh_domain(
      [function](const PeerPoint& p) { return function(from_cgal(p)); },
      PeerKernel::Sphere_3(CGAL::ORIGIN, radius * radius), params::relative_error_bound = 1e-6);
}

inline PeerLabeledDomain open_peer_domain(const Case& c, const CGAL::Image_3& image, double least_value) {
  namespace params = CGAL::parameters;
  if (!c.scan.empty()) {
    return PeerLabeledDomain::create_gray_image_mesh_domain(
        image, params::iso_value = c.level.level, params::value_outside = c.level.outside.value_or(least_value));
  }
  constexpr double kRadius = 4;  // of the tanglecube
  if (c.formula.empty()) return open_peer_function(tanglecube, kRadius);
  return open_peer_function(implicit_function(c.formula), c.formula == "gyroid" ? 6 : kRadius);
}

inline PeerSurface read_peer_surface(const Case& c) {
  PeerSurface surface;
  const std::string file = cgal_data_file(c.surface);
  if (!CGAL::IO::read_polygon_mesh(file, surface)) throw std::runtime_error("CGAL cannot read " + file);
  return surface;
}

}  // namespace scantet::bench
