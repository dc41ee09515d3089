// A file is a soup of polygons until it is shown to be a surface: STL knows no shared vertices, and the other formats
// need not use them. What is always done to it is safe: no point is moved and no facet added.
//
// The facets of .obj files are read here: CGAL's reader leaves out the rest of a facet from a corner on that it cannot
// read, and the facet with it.
#include "surface_reader.h"

#include <CGAL/IO/polygon_soup_io.h>
#include <CGAL/Polygon_mesh_processing/orient_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Polygon_mesh_processing/repair_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Polygon_mesh_processing/triangulate_faces.h>

#include <charconv>
#include <cmath>
#include <fstream>
#include <string_view>
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

/// The facets of a .obj file: corners "7", "7/2", "7//3" or "7/2/3", the first number of which is the vertex, from 1
/// on, or from -1 backwards. Throws if there is no such vertex.
class ObjFacets {
 public:
  explicit ObjFacets(const std::string& file) : file_(file) {
    std::ifstream stream(file, std::ios::binary);
    for (std::string line; std::getline(stream, line);) {
      ++line_;
      add_line(line);
    }
    if (largest_ > vertices_) refuse_vertex(line_of_largest_, std::to_string(largest_));
  }
  Polygons take() { return std::move(polygons_); }

 private:
  static constexpr std::string_view kSpaces = " \t\r\v\f";

  [[noreturn]] void refuse_vertex(std::size_t line, std::string_view corner) const {
    refuse(file_,
           "line " + std::to_string(line) + ": a facet names vertex " + std::string(corner.substr(0, 40)) +
               ", which is not there",
           "get the file anew from its source");
  }

  /// The next word of the line, cut off it; empty if there is none.
  static std::string_view take_word(std::string_view& line) {
    line.remove_prefix(std::min(line.find_first_not_of(kSpaces), line.size()));
    const std::string_view word = line.substr(0, line.find_first_of(kSpaces));
    line.remove_prefix(word.size());
    return word;
  }

  void add_line(std::string_view line) {
    const std::string_view kind = take_word(line);
    if (kind == "v") ++vertices_;
    if (kind != "f") return;
    polygons_.emplace_back();
    for (std::string_view word = take_word(line); !word.empty() && word[0] != '#'; word = take_word(line)) {
      polygons_.back().push_back(vertex_of(word));
    }
  }

  std::size_t vertex_of(std::string_view corner) {
    std::int64_t number = 0;
    const char* const end = corner.data() + corner.size();
    const auto [stop, code] = std::from_chars(corner.data() + (corner[0] == '+' ? 1 : 0), end, number);
    const bool read = code == std::errc{} && (stop == end || *stop == '/');
    if (!read || number == 0 || number < -vertices_) refuse_vertex(line_, corner);
    if (number < 0) return static_cast<std::size_t>(vertices_ + number);
    if (number > largest_) {
      largest_ = number;
      line_of_largest_ = line_;
    }
    return static_cast<std::size_t>(number - 1);
  }

  const std::string& file_;
  Polygons polygons_;
  std::size_t line_ = 0;
  std::int64_t vertices_ = 0;  // so far
  std::int64_t largest_ = 0;   // of the corners' numbers
  std::size_t line_of_largest_ = 0;
};

void check_indices(const std::string& file, std::size_t points, const Polygons& polygons) {
  for (std::size_t n = 0; n < polygons.size(); ++n) {
    for (const std::size_t vertex : polygons[n]) {
      if (vertex < points) continue;
      refuse(file,
             "facet " + std::to_string(n + 1) + " names vertex " + std::to_string(static_cast<std::int64_t>(vertex)) +
                 ", which is not there: they are numbered from 0, and there are " + std::to_string(points),
             "get the file anew from its source");
    }
  }
}

/// Throws if CGAL's reader would crash on the vertices of a PLY file.
void check_ply(const std::string& file) {
  const std::optional<ply::Header> header = ply::read_header(file);
  const ply::Element* vertices = header ? ply::vertices_of(*header) : nullptr;
  if (vertices == nullptr) refuse(file, "is not a PLY file of a surface", "get the file anew from its source");
  if (const auto odd = ply::odd_coordinate(*vertices)) {
    refuse(file, "property " + *odd + " of its vertices is not there as float or double",
           "export the surface with x, y and z as float or double");
  }
}

void read_soup(const std::string& file, Points& points, Polygons& polygons) {
  bool read = false;
  const bool is_obj = scantet::file_extension(file) == ".obj";
  Polygons facets;
  if (is_obj) facets = ObjFacets(file).take();
  if (scantet::file_extension(file) == ".ply") check_ply(file);
  try {
    read = CGAL::IO::read_polygon_soup(file, points, polygons);
  } catch (const std::exception&) {  // some of the readers throw what the streams do
  }
  if (!read) refuse(file, "cannot be read as a surface", "check the file; .off, .stl, .ply and .obj can be read");
  if (is_obj) polygons = std::move(facets);
  for (const Kernel::Point_3& p : points) {
    if (!std::isfinite(p.x()) || !std::isfinite(p.y()) || !std::isfinite(p.z())) {
      refuse(file, "a vertex is not finite", "get the file anew from its source");
    }
  }
  check_indices(file, points.size(), polygons);
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
