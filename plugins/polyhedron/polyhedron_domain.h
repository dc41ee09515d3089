// What a closed surface encloses.
#pragma once

#include <CGAL/AABB_face_graph_triangle_primitive.h>
#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/Side_of_triangle_mesh.h>

#include "scantet/domain/domain.h"
#include "sharp_edges.h"
#include "surface.h"
#include "triangle_grid.h"

namespace polyhedron {

/// Inside (region 1) is what a ray leaves through an odd number of triangles, decided exactly; a surface within another
/// bounds a cavity. The surface itself is outside.
class PolyhedronDomain final : public scantet::Domain {
 public:
  /// surface: closed, of triangles, free of self-intersections. sharp_edges: of this surface.
  explicit PolyhedronDomain(Surface surface, SharpEdges sharp_edges = {});

  /// A little larger than the surface.
  scantet::Box bounds() const override { return box_; }
  scantet::Region region_at(const scantet::Point& p) const override;
  /// Exact in number and order. Only on a segment that meets an edge or a vertex, lies in the plane of a triangle it
  /// meets, or ends on the surface, two crossings within 1e-9 of its length of each other may be taken for none.
  void crossings(const scantet::Segment& segment, scantet::Crossings& out) const override;
  /// The components of what is inside, and the cavities: one for each shell (connected piece of the surface).
  std::vector<scantet::Component> components() const override { return components_; }
  /// The second of its components is the number of the shell that p is on.
  scantet::Patch patch_at(const scantet::Point& p) const override;
  /// The sharp edges.
  std::vector<std::shared_ptr<const scantet::Curve>> curves() const override { return sharp_edges_.curves; }
  std::vector<scantet::Corner> corners() const override { return sharp_edges_.corners; }
  /// The distance to the surface as a share of the box's diagonal.
  std::optional<double> residual_at(const scantet::Point& p) const override;

  const Surface& surface() const { return surface_; }
  /// The shortest edge of the box that just holds the surface.
  double shortest_edge_mm() const { return shortest_edge_mm_; }

 private:
  using Tree = CGAL::AABB_tree<CGAL::AABB_traits<Kernel, CGAL::AABB_face_graph_triangle_primitive<Surface>>>;

  /// The triangles that a segment meets.
  struct Meetings {
    std::vector<double> places;  ///< as shares of the segment's length, ascending; rounded
    bool all_inside = true;      ///< it passes through the inside of each of them; exact
  };
  Meetings meetings_with(const scantet::Segment& segment) const;
  scantet::ComponentId shell_at(const scantet::Point& p) const;

  Surface surface_;
  Tree tree_;
  CGAL::Side_of_triangle_mesh<Surface, Kernel> side_;
  scantet::Box box_;
  double shortest_edge_mm_;
  TriangleGrid grid_;
  std::vector<std::size_t> shell_of_;  // each face
  std::size_t shell_count_ = 0;
  std::vector<scantet::Component> components_;
  SharpEdges sharp_edges_;
};

}  // namespace polyhedron
