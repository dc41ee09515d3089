// ϱ_f as CGAL's facet angle: a triangle whose circumradius is ϱ times its shortest edge has smallest angle asin(1 /
// 2ϱ).
#include "cgal_peer.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Image_3.h>
#include <CGAL/Labeled_mesh_domain_3.h>
#include <CGAL/Mesh_complex_3_in_triangulation_3.h>
#include <CGAL/Mesh_criteria_3.h>
#include <CGAL/Mesh_triangulation_3.h>
#include <CGAL/make_mesh_3.h>

#include <chrono>
#include <cmath>

namespace scantet::bench {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using PeerDomain = CGAL::Labeled_mesh_domain_3<Kernel>;
using Triangulation = CGAL::Mesh_triangulation_3<PeerDomain, CGAL::Default, CGAL::Sequential_tag>::type;
using Complex = CGAL::Mesh_complex_3_in_triangulation_3<Triangulation>;
using Criteria = CGAL::Mesh_criteria_3<Triangulation>;
namespace params = CGAL::parameters;

/// The scan as 32-bit floats in CGAL's image type.
CGAL::Image_3 to_cgal_image(const Scan& scan) {
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

}  // namespace

PeerRun run_cgal_mesh3(const Scan& scan, const LevelSetSettings& settings, double size_mm,
                       const MesherOptions& options) {
  const CGAL::Image_3 image = to_cgal_image(scan);
  const PeerDomain domain = PeerDomain::create_gray_image_mesh_domain(
      image, params::iso_value = settings.level, params::value_outside = settings.outside.value_or(scan.min_value));
  const double facet_angle_deg = std::asin(0.5 / options.facet_radius_edge) * 180 / M_PI;
  const Criteria criteria(params::facet_angle = facet_angle_deg, params::facet_size = options.alpha * size_mm,
                          params::facet_distance = options.facet_distance_mm.value_or(1e9),
                          params::cell_radius_edge_ratio = options.cell_radius_edge, params::cell_size = size_mm);
  const auto start = std::chrono::steady_clock::now();
  const Complex mesh = CGAL::make_mesh_3<Complex>(domain, criteria, params::no_perturb(), params::no_exude());
  const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
  return {mesh.triangulation().number_of_vertices(), mesh.number_of_cells_in_complex(), elapsed.count()};
}

}  // namespace scantet::bench
