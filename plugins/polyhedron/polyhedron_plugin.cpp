// Opens surface files; the reader and the domain do the work.
#include <CGAL/Polygon_mesh_processing/measure.h>

#include <algorithm>
#include <charconv>
#include <filesystem>

#include "edge_lines.h"
#include "ply/ply_header.h"
#include "polyhedron_domain.h"
#include "scantet/base/error.h"
#include "scantet/base/file_extension.h"
#include "scantet/plugin/plugin.h"
#include "surface_in_child.h"

namespace polyhedron {
namespace {

constexpr double kShareOfBox = 0.04;
constexpr double kLeastSharp = 1;  // degrees
constexpr double kMostSharp = 180;

double default_size_mm(const PolyhedronDomain& domain) {
  return kShareOfBox * domain.shortest_edge_mm();
}

class PolyhedronPlugin final : public scantet::InputPlugin {
 public:
  std::string name() const override { return "polyhedron"; }
  std::string description() const override { return "closed surfaces: OFF, STL, PLY, OBJ"; }
  int can_open(const std::string& input) const override;
  void declare_options(scantet::OptionSet& options) override {
    options.add("repair", repair_,
                {"Surface", "", "",
                 "Closes a surface that is not closed and parts triangles that meet, where that takes little; scantet "
                 "info --repair says what is done."});
    options.add("sharp-edges", sharp_, scantet::Range::between(kLeastSharp, kMostSharp), "or a file of lines",
                [](const scantet::OptionValue&) {},  // of files is told when they are read
                {"Surface", "DEG|FILE", "an angle in degrees, or a file",
                 "Has the mesh follow the edges at which the directions that two triangles face differ by so many "
                 "degrees or more, and the corners where these meet or turn as much; or the edges along which the "
                 "lines of a file run: elements l of an .obj, or CGAL's polylines. scantet info counts them.",
                 0, "no edge is followed"});
  }
  scantet::OpenedDomain open(const std::string& input, scantet::Progress& progress) override {
    scantet::OpenedDomain opened;
    ReadSurface read = read_surface_apart(input, repair_, progress);
    if (!read.surface) return opened;
    SharpEdges edges = sharp_edges_of(*read.surface);
    auto domain = std::make_unique<PolyhedronDomain>(std::move(*read.surface), std::move(edges));
    opened.default_size_mm = default_size_mm(*domain);
    opened.domain = std::move(domain);
    opened.default_size_reason = scantet::number_text(kShareOfBox) + " x the shortest edge of the surface's box";
    opened.files = {input};
    if (!sharp_.empty() && !sharp_degrees()) opened.files.push_back(sharp_);
    return opened;
  }
  std::vector<scantet::InfoSection> info(const std::string& input, scantet::Progress& progress) override;
  std::optional<scantet::TriangleSurface> surface(const std::string& input, scantet::Progress& progress) override;

 private:
  std::optional<double> sharp_degrees() const;
  /// None if none are asked for.
  SharpEdges sharp_edges_of(const Surface& surface) const;

  bool repair_ = false;
  std::string sharp_;  // an angle in degrees or the file of lines
};

std::optional<double> PolyhedronPlugin::sharp_degrees() const {
  double degrees = 0;
  const char* const end = sharp_.data() + sharp_.size();
  const auto [stop, code] = std::from_chars(sharp_.data(), end, degrees);
  return !sharp_.empty() && code == std::errc{} && stop == end ? std::optional(degrees) : std::nullopt;
}

SharpEdges PolyhedronPlugin::sharp_edges_of(const Surface& surface) const {
  if (sharp_.empty()) return {};
  if (const auto degrees = sharp_degrees()) return find_sharp_edges(surface, *degrees);
  constexpr double kTurn = 30;  // degrees: where a line turns by as much is a corner
  const FollowedLines lines = follow_lines(surface, read_edge_lines(sharp_));
  return chains_of(surface, {{lines.edges.begin(), lines.edges.end()}, lines.ends}, kTurn);
}

int PolyhedronPlugin::can_open(const std::string& input) const {
  const std::string extension = scantet::file_extension(input);
  const bool known = extension == ".off" || extension == ".stl" || extension == ".ply" || extension == ".obj";
  std::error_code code;
  if (!known || !std::filesystem::is_regular_file(input, code) || std::filesystem::file_size(input, code) == 0)
    return 0;
  const std::optional<ply::Header> header = extension == ".ply" ? ply::read_header(input) : std::nullopt;
  return header && ply::is_point_set(*header) ? 0 : 90;
}

std::vector<scantet::InfoSection> PolyhedronPlugin::info(const std::string& input, scantet::Progress& progress) {
  ReadSurface read = read_surface_apart(input, repair_, progress);
  if (!read.surface) return {};
  SharpEdges edges = sharp_edges_of(*read.surface);
  const PolyhedronDomain domain(std::move(*read.surface), std::move(edges));
  const Surface& surface = domain.surface();
  const auto corner = [](const scantet::Point& p) { return std::vector<double>{p.x, p.y, p.z}; };
  const auto count = [](auto number) { return static_cast<std::int64_t>(number); };
  std::int64_t components = 0;
  double volume_mm3 = 0;
  for (const scantet::Component& component : domain.components()) {
    if (component.region == scantet::kOutside) continue;
    ++components;
    volume_mm3 += component.volume_mm3;
  }
  const auto cavities = count(domain.components().size()) - components;
  const auto euler =
      count(surface.number_of_vertices()) - count(surface.number_of_edges()) + count(surface.number_of_faces());
  std::vector<scantet::InfoEntry> entries{
      {"triangles", "triangles", count(surface.number_of_faces()), ""},
      {"vertices", "vertices", count(surface.number_of_vertices()), ""},
      {"components", "components", components, ""},
      {"cavities", "cavities", cavities, ""},
      {"euler", "Euler number of the surface", euler, ""},
      {"area_mm2", "area", CGAL::to_double(CGAL::Polygon_mesh_processing::area(surface)), "mm²"},
      {"volume_mm3", "volume", volume_mm3, "mm³"},
      {"box_min_mm", "box from", corner(domain.bounds().min), "mm"},
      {"box_max_mm", "box to", corner(domain.bounds().max), "mm"},
      {"default_size_mm", "default size", default_size_mm(domain), "mm"}};
  if (!sharp_.empty()) {
    entries.push_back({"sharp_curves", "curves of sharp edges", count(domain.curves().size()), ""});
    entries.push_back({"sharp_corners", "corners of these", count(domain.corners().size()), ""});
  }
  std::string repairs;
  for (const std::string& repair : read.repairs) repairs += (repairs.empty() ? "" : "; ") + repair;
  if (repair_) entries.push_back({"repairs", "repairs", repairs.empty() ? "none needed" : repairs, ""});
  return {{"surface", "Surface", entries}};
}

std::optional<scantet::TriangleSurface> PolyhedronPlugin::surface(const std::string& input,
                                                                  scantet::Progress& progress) {
  const ReadSurface read = read_surface_apart(input, repair_, progress);
  if (!read.surface) return std::nullopt;
  const Surface& from = *read.surface;
  scantet::TriangleSurface to;
  std::vector<scantet::VertexId> number(from.num_vertices());
  for (const auto v : from.vertices()) {
    number[v] = static_cast<scantet::VertexId>(to.vertices.size());
    const auto& p = from.point(v);
    to.vertices.push_back({p.x(), p.y(), p.z()});
  }
  for (const auto f : from.faces()) {
    scantet::Triangle facet{};
    std::size_t n = 0;
    for (const auto v : from.vertices_around_face(from.halfedge(f))) facet[n++] = number[v];
    to.facets.push_back(facet);
  }
  return to;
}

}  // namespace
}  // namespace polyhedron

SCANTET_PLUGIN(polyhedron::PolyhedronPlugin);
