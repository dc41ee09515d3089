// A file is a soup of polygons until it is shown to be a surface: STL knows no shared vertices, and the other formats
// need not use them. What is always done to it is safe: no point is moved and no facet added.
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
#include "scantet/base/file_extension.h"
#include "scantet/base/geometry.h"
#include "scantet/base/options.h"
#include "surface_repair.h"

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
    read = (scantet::file_extension(file) != ".ply" || ply::read_header(file)) &&
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

/// Products of six lengths have to be numbers, and differences of coordinates to have digits.
void check_coordinates(const std::string& file, const Points& points) {
  constexpr double kSmallest = 1e-15;
  constexpr double kLargest = 1e16;
  constexpr double kFarthest = 1e13;  // from the origin, in diagonals of the box
  scantet::Box box;
  double farthest = 0;
  for (const Kernel::Point_3& p : points) {
    box.extend({p.x(), p.y(), p.z()});
    farthest = std::max({farthest, std::abs(p.x()), std::abs(p.y()), std::abs(p.z())});
  }
  if (points.empty()) return;
  const auto number = [](double value) { return scantet::number_text(value, 3) + " mm"; };
  if (farthest > kLargest || box.diagonal() < kSmallest) {
    refuse(file, "its coordinates go up to " + number(farthest) + ", over " + number(box.diagonal()),
           "scale it to a size between 1e-15 and 1e15 mm");
  }
  if (farthest > kFarthest * box.diagonal()) {
    refuse(file,
           "it is " + number(farthest) + " from the origin and only " + number(box.diagonal()) +
               " large: its coordinates have too few digits",
           "move it to the origin");
  }
}

void check_closed(const std::string& file, const Surface& surface, bool repaired) {
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
         repaired ? "--repair could not fill all holes; fill them, in MeshLab for example"
                  : "--repair fills holes of up to " + std::to_string(kMostHoleEdges) + " edges");
}

void check_self_intersections(const std::string& file, const Surface& surface, bool repaired) {
  std::vector<std::pair<Surface::Face_index, Surface::Face_index>> pairs;
  pmp::self_intersections<CGAL::Sequential_tag>(surface, std::back_inserter(pairs));
  if (pairs.empty()) return;
  const auto corner = surface.target(surface.halfedge(pairs.front().first));
  refuse(file,
         "the surface meets itself: " + std::to_string(pairs.size()) + " pairs of triangles, one of them near " +
             text_of(surface.point(corner)),
         repaired ? "--repair could not part them; do it in MeshLab for example" : "try --repair");
}

}  // namespace

ReadSurface read_surface(const std::string& file, bool repair, scantet::Progress& progress) {
  ReadSurface result;
  Points points;
  Polygons polygons;
  const auto cancelled = [&](const char* doing) {
    progress.report({"read", doing, polygons.size(), std::nullopt, 0});
    return progress.cancelled();
  };
  read_soup(file, points, polygons);
  check_coordinates(file, points);
  if (cancelled("facets")) return result;
  pmp::repair_polygon_soup(points, polygons);
  if (polygons.empty()) refuse(file, "the surface has no facet", "get the file anew from its source");
  pmp::orient_polygon_soup(points, polygons);
  if (!pmp::is_polygon_soup_a_polygon_mesh(polygons)) {
    refuse(file, "the facets do not make a surface: more than two meet at an edge",
           "repair it, in MeshLab for example");
  }
  Surface surface;
  pmp::polygon_soup_to_polygon_mesh(points, polygons, surface);
  if (repair && cancelled("repair")) return result;
  if (repair) repair_surface(surface, result.repairs);
  if (surface.number_of_faces() == 0) refuse(file, "no facet encloses anything", "get the file anew from its source");
  check_closed(file, surface, repair);
  if (!pmp::triangulate_faces(surface)) {
    refuse(file, "a polygon cannot be cut into triangles", "export the surface as triangles");
  }
  if (cancelled("self-intersections")) return result;
  check_self_intersections(file, surface, repair);
  result.surface = std::move(surface);
  return result;
}

}  // namespace polyhedron
