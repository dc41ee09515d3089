// One run of CGAL's Mesh_3. Instantiated once a concurrency tag, each in a translation unit of its own.
#pragma once

#include <CGAL/Mesh_complex_3_in_triangulation_3.h>
#include <CGAL/Mesh_criteria_3.h>
#include <CGAL/Mesh_triangulation_3.h>
#include <CGAL/make_mesh_3.h>

#include <cmath>
#include <type_traits>
#include <unordered_map>

#include "cgal_domains_impl.h"
#include "cgal_labels_impl.h"
#include "contestants.h"
#include "inputs.h"
#include "scantet/base/mesh_topology.h"
#include "tanglecube.h"

namespace scantet::bench {

/// scantet's σ, times a factor, as CGAL asks for it.
struct PeerSize {
  const SizingField* field;
  double factor;
  template <class Index>
  double operator()(const PeerPoint& p, int, const Index&) const {
    return factor * field->size_at(from_cgal(p));
  }
};

template <class Criteria>
Criteria peer_criteria(const Case& c, const SizingField& field) {
  namespace params = CGAL::parameters;
  const double facet_angle_deg = std::asin(0.5 / c.options.bounds.facet_radius_edge) * 180 / M_PI;
  if (c.size_mm > 0) {
    if (c.sharp_deg > 0) {
      return Criteria(params::edge_size = c.options.bounds.alpha * c.size_mm, params::facet_angle = facet_angle_deg,
                      params::facet_size = c.options.bounds.alpha * c.size_mm,
                      params::cell_radius_edge_ratio = c.options.bounds.cell_radius_edge,
                      params::cell_size = c.size_mm);
    }
    return Criteria(params::facet_angle = facet_angle_deg, params::facet_size = c.options.bounds.alpha * c.size_mm,
                    params::cell_radius_edge_ratio = c.options.bounds.cell_radius_edge, params::cell_size = c.size_mm);
  }
  return Criteria(params::facet_angle = facet_angle_deg, params::facet_size = PeerSize{&field, c.options.bounds.alpha},
                  params::cell_radius_edge_ratio = c.options.bounds.cell_radius_edge,
                  params::cell_size = PeerSize{&field, 1});
}

template <class Complex>
TetMesh from_cgal(const Complex& complex) {
  TetMesh mesh;
  std::unordered_map<const void*, VertexId> ids;
  const auto id_of = [&](typename Complex::Vertex_handle v) {
    const auto [place, added] = ids.try_emplace(&*v, static_cast<VertexId>(mesh.vertices.size()));
    if (added) mesh.vertices.push_back(from_cgal(v->point().point()));
    return place->second;
  };
  for (auto cell = complex.cells_in_complex_begin(); cell != complex.cells_in_complex_end(); ++cell) {
    mesh.tets.push_back(
        {id_of(cell->vertex(0)), id_of(cell->vertex(1)), id_of(cell->vertex(2)), id_of(cell->vertex(3))});
    mesh.tet_regions.push_back(static_cast<Region>(complex.subdomain_index(cell)));
  }
  build_boundary(mesh);
  return mesh;
}

/// labels: null if the domain is of no segmentation. With one, the guide's way for images of many components: points
/// are put around each of them first, as make_mesh_3's own random ones miss small ones.
template <class Complex, class PeerDomain, class Criteria>
Complex make_peer_mesh(const PeerDomain& domain, const Criteria& criteria, const PeerLabels* labels) {
  namespace params = CGAL::parameters;
  if (labels == nullptr) {
    return CGAL::make_mesh_3<Complex>(domain, criteria, params::no_perturb(), params::no_exude());
  }
  Complex mesh;
  if constexpr (std::is_same_v<PeerDomain, PeerLabeledDomain>) {
    add_points_around_labels(mesh, domain, criteria, *labels);
    CGAL::refine_mesh_3(mesh, domain, criteria, params::no_perturb(), params::no_exude());
  }
  return mesh;
}

template <class Tag, class PeerDomain>
void mesh_with_cgal(const Case& c, const PeerDomain& domain, Figures& figures, const PeerLabels* labels = nullptr) {
  using Triangulation = typename CGAL::Mesh_triangulation_3<PeerDomain, CGAL::Default, Tag>::type;
  using Complex = typename PeerComplex<PeerDomain, Triangulation>::type;
  using Criteria = CGAL::Mesh_criteria_3<Triangulation>;
  const std::unique_ptr<SizingField> field = sizing(c);
  const Criteria criteria = peer_criteria<Criteria>(c, *field);
  const Meter meter;
  namespace params = CGAL::parameters;
  Complex mesh = make_peer_mesh<Complex>(domain, criteria, labels);
  const Stopwatch optimizing;
  if (c.optimize == Optimize::full) {
    CGAL::perturb_mesh_3(mesh, domain, params::sliver_bound = c.min_dihedral_deg);
    CGAL::exude_mesh_3(mesh, params::sliver_bound = c.min_dihedral_deg);
  }
  if (c.optimize == Optimize::exude) CGAL::exude_mesh_3(mesh);
  const double optimize_s = optimizing.seconds();
  meter.read(figures);
  if (c.optimizing_alone) figures.seconds = optimize_s;
  figures.stop = "converged";
  describe(from_cgal(mesh), figures);
}

template <class Tag>
Figures run_cgal(const Case& c) {
  Figures figures;
  if (!c.surface.empty()) {
    const Stopwatch preparing;
    const PeerSurface surface = read_peer_surface(c);
    if (c.sharp_deg > 0) {
      PeerSharpDomain domain(surface);
      domain.detect_features(c.sharp_deg);
      figures.prepare_s = preparing.seconds();
      mesh_with_cgal<Tag>(c, domain, figures);
      return figures;
    }
    const PeerPolyhedralDomain domain(surface);
    figures.prepare_s = preparing.seconds();
    mesh_with_cgal<Tag>(c, domain, figures);
    return figures;
  }
  if (c.labels) {
    const Stopwatch preparing;
    const PeerLabels labels(open_scan(c));
    const PeerLabeledDomain domain = PeerLabeledDomain::create_labeled_image_mesh_domain(
        labels.image(), CGAL::parameters::weights = labels.weights());
    figures.prepare_s = preparing.seconds();
    mesh_with_cgal<Tag>(c, domain, figures, &labels);
    return figures;
  }
  CGAL::Image_3 image;
  double least_value = 0;
  if (!c.scan.empty()) {
    const Scan scan = open_scan(c);
    least_value = scan.min_value;
    const Stopwatch preparing;
    image = to_cgal_image(scan);
    figures.prepare_s = preparing.seconds();
  }
  mesh_with_cgal<Tag>(c, open_peer_domain(c, image, least_value), figures);
  return figures;
}

}  // namespace scantet::bench
