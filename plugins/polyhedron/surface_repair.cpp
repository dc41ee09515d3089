// CGAL's tools, from the one that changes least to the one that changes most. What they leave is for the reader's
// checks to refuse.
#include "surface_repair.h"

#include <CGAL/Polygon_mesh_processing/border.h>
#include <CGAL/Polygon_mesh_processing/connected_components.h>
#include <CGAL/Polygon_mesh_processing/repair_self_intersections.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Polygon_mesh_processing/stitch_borders.h>
#include <CGAL/Polygon_mesh_processing/triangulate_faces.h>
#include <CGAL/Polygon_mesh_processing/triangulate_hole.h>

namespace polyhedron {
namespace {

namespace pmp = CGAL::Polygon_mesh_processing;

std::string counted(std::size_t count, const std::string& one, const std::string& many) {
  return std::to_string(count) + " " + (count == 1 ? one : many);
}

void stitch(Surface& surface, std::vector<std::string>& done) {
  const std::size_t pairs = pmp::stitch_borders(surface);
  if (pairs > 0) done.push_back("joined " + counted(pairs, "pair", "pairs") + " of border edges");
}

void drop_scraps(Surface& surface, std::vector<std::string>& done) {
  constexpr std::size_t kFewestFacets = 4;
  const std::size_t before = surface.number_of_faces();
  pmp::keep_large_connected_components(surface, kFewestFacets);
  const std::size_t dropped = before - surface.number_of_faces();
  if (dropped > 0) done.push_back("dropped " + counted(dropped, "facet", "facets") + " that enclose nothing");
}

void fill_holes(Surface& surface, std::vector<std::string>& done) {
  std::vector<Surface::Halfedge_index> borders;
  pmp::extract_boundary_cycles(surface, std::back_inserter(borders));
  std::size_t filled = 0;
  std::size_t largest = 0;
  for (const Surface::Halfedge_index border : borders) {
    const std::size_t edges = CGAL::halfedges_around_face(border, surface).size();
    if (edges > kMostHoleEdges) continue;
    std::vector<Surface::Face_index> patch;
    pmp::triangulate_hole(surface, border, std::back_inserter(patch));
    if (patch.empty()) continue;
    ++filled;
    largest = std::max(largest, edges);
  }
  if (filled == 0) return;
  done.push_back("filled " + counted(filled, "hole", "holes") + ", the largest of " + std::to_string(largest) +
                 " edges");
}

void part_intersecting(Surface& surface, std::vector<std::string>& done) {
  std::vector<std::pair<Surface::Face_index, Surface::Face_index>> pairs;
  pmp::self_intersections<CGAL::Sequential_tag>(surface, std::back_inserter(pairs));
  if (pairs.empty()) return;
  if (!pmp::experimental::remove_self_intersections(surface)) return;
  done.push_back("replaced the surroundings of " + counted(pairs.size(), "pair", "pairs") +
                 " of triangles that met each other");
}

}  // namespace

void repair_surface(Surface& surface, std::vector<std::string>& done) {
  stitch(surface, done);
  drop_scraps(surface, done);
  pmp::triangulate_faces(surface);
  fill_holes(surface, done);
  part_intersecting(surface, done);
  surface.collect_garbage();
}

}  // namespace polyhedron
