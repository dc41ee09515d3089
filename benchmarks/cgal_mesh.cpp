// CGAL's Mesh_3 on a grey image, at the criteria that scantet has by default; the mesh is written to a file, in the
// world of the image. Axes of the image must be at right angles.
//   cgal_mesh SCAN LEVEL SIZE_MM OUT.vtu
#include <cstdio>
#include <cstdlib>

#include "cgal_mesh3_impl.h"
#include "scantet/domain/sizing_field.h"
#include "scantet/io/mesh_io.h"
#include "scantet/reading/scan_reader.h"

namespace scantet::bench {
namespace {

int run(const char* file, double level, double size_mm, const char* out) {
  using Triangulation = CGAL::Mesh_triangulation_3<PeerLabeledDomain, CGAL::Default, CGAL::Sequential_tag>::type;
  using Complex = CGAL::Mesh_complex_3_in_triangulation_3<Triangulation>;
  using Criteria = CGAL::Mesh_criteria_3<Triangulation>;
  namespace params = CGAL::parameters;
  Case c;
  c.scan = file;
  c.level.level = level;
  c.size_mm = size_mm;
  Progress progress;
  const Scan scan = read_scan(file, progress);
  const CGAL::Image_3 image = to_cgal_image(scan);
  const PeerLabeledDomain domain = open_peer_domain(c, image, scan.min_value);
  Complex complex = make_peer_mesh<Complex>(domain, peer_criteria<Criteria>(c, UniformSize(size_mm)), nullptr);
  CGAL::perturb_mesh_3(complex, domain, params::sliver_bound = 10);
  CGAL::exude_mesh_3(complex, params::sliver_bound = 10);
  TetMesh mesh = from_cgal(complex);
  for (Point& p : mesh.vertices) {
    p = scan.frame.to_world(
        {p.x / scan.frame.spacing_mm(0), p.y / scan.frame.spacing_mm(1), p.z / scan.frame.spacing_mm(2)});
  }
  const bool is_mirrored = scan.frame.determinant_mm3() < 0;
  for (Tet& tet : mesh.tets) {
    if (is_mirrored) std::swap(tet[0], tet[1]);
  }
  mesh.boundary_facets.clear();
  mesh.facet_regions.clear();
  build_boundary(mesh);
  write_mesh(mesh, out);
  return 0;
}

}  // namespace
}  // namespace scantet::bench

int main(int argc, char** argv) {
  if (argc != 5) {
    std::fprintf(stderr, "usage: cgal_mesh SCAN LEVEL SIZE_MM OUT.vtu\n");
    return 2;
  }
  try {
    return scantet::bench::run(argv[1], std::atof(argv[2]), std::atof(argv[3]), argv[4]);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "cgal_mesh: %s\n", error.what());
    return 1;
  }
}
