// A file is a soup of polygons until it is shown to be a surface: STL knows no shared vertices, and the other formats
// need not use them. What repair does is safe: it changes no point and adds no facet.
#include "surface_reader.h"

#include <CGAL/IO/polygon_soup_io.h>
#include <CGAL/Polygon_mesh_processing/orient_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Polygon_mesh_processing/repair_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Polygon_mesh_processing/triangulate_faces.h>

#include <cmath>
#include <vector>

#include "ply/ply_header.h"
#include "scantet/base/error.h"
#include "scantet/base/options.h"

namespace polyhedron {
namespace {

namespace pmp = CGAL::Polygon_mesh_processing;

using Points = std::vector<Kernel::Point_3>;
using Polygons = std::vector<std::vector<std::size_t>>;

[[noreturn]] void refuse(const std::string& file, const std::string& what, const std::string& remedy) {
  throw scantet::Error(scantet::Fault::input, "input.surface", file + ": " + what, remedy);
}

std::string text_of(const Kernel::Point_3& p) {
  using scantet::number_text;
  return "(" + number_text(p.x(), 6) + ", " + number_text(p.y(), 6) + ", " + number_text(p.z(), 6) + ") mm";
}

void read_soup(const std::string& file, Points& points, Polygons& polygons) {
  bool read = false;
  try {
    read = (ply::extension_of(file) != ".ply" || ply::read_header(file)) &&
           CGAL::IO::read_polygon_soup(file, points, polygons);
  } catch (const std::exception&) {  // some of the readers throw what the streams do
  }
  if (!read) refuse(file, "cannot be read as a surface", "check the file; .off, .stl, .ply and .obj can be read");
  for (const Kernel::Point_3& p : points) {
    if (!std::isfinite(p.x()) || !std::isfinite(p.y()) || !std::isfinite(p.z())) {
      refuse(file, "a vertex is not finite", "get the file anew from its source");
    }
  }
  for (const auto& polygon : polygons) {
    for (const std::size_t vertex : polygon) {
      if (vertex >= points.size()) refuse(file, "a facet names a vertex that is not there", "get the file anew");
    }
  }
}

void check_closed(const std::string& file, const Surface& surface) {
  std::size_t open_edges = 0;
  Surface::Halfedge_index first;
  for (const Surface::Halfedge_index h : surface.halfedges()) {
    if (!surface.is_border(h)) continue;
    if (open_edges++ == 0) first = h;
  }
  if (open_edges == 0) return;
  refuse(file,
         "the surface is not closed: " + std::to_string(open_edges) +
             " edges have a facet on one side only, one from " + text_of(surface.point(surface.source(first))) +
             " to " + text_of(surface.point(surface.target(first))),
         "fill the holes, in MeshLab for example");
}

void check_self_intersections(const std::string& file, const Surface& surface) {
  std::vector<std::pair<Surface::Face_index, Surface::Face_index>> pairs;
  pmp::self_intersections<CGAL::Sequential_tag>(surface, std::back_inserter(pairs));
  if (pairs.empty()) return;
  const auto corner = surface.target(surface.halfedge(pairs.front().first));
  refuse(file,
         "the surface meets itself: " + std::to_string(pairs.size()) + " pairs of triangles, one of them near " +
             text_of(surface.point(corner)),
         "repair it, in MeshLab for example");
}

}  // namespace

Surface read_surface(const std::string& file) {
  Points points;
  Polygons polygons;
  read_soup(file, points, polygons);
  pmp::repair_polygon_soup(points, polygons);
  if (polygons.empty()) refuse(file, "the surface has no facet", "get the file anew from its source");
  pmp::orient_polygon_soup(points, polygons);
  if (!pmp::is_polygon_soup_a_polygon_mesh(polygons)) {
    refuse(file, "the facets do not make a surface: more than two meet at an edge",
           "repair it, in MeshLab for example");
  }
  Surface surface;
  pmp::polygon_soup_to_polygon_mesh(points, polygons, surface);
  check_closed(file, surface);
  if (!pmp::triangulate_faces(surface)) {
    refuse(file, "a polygon cannot be cut into triangles", "export the surface as triangles");
  }
  check_self_intersections(file, surface);
  return surface;
}

}  // namespace polyhedron
