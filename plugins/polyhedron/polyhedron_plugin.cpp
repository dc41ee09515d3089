// Opens surface files; the reader and the domain do the work.
#include <CGAL/Polygon_mesh_processing/measure.h>

#include <algorithm>
#include <filesystem>

#include "ply/ply_header.h"
#include "polyhedron_domain.h"
#include "scantet/base/error.h"
#include "scantet/base/file_extension.h"
#include "scantet/plugin/plugin.h"
#include "surface_reader.h"

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
    options.add("sharp-edges", sharp_degrees_, scantet::Range::between(kLeastSharp, kMostSharp),
                {"Surface", "DEG", "an angle in degrees",
                 "Has the mesh follow the edges at which the directions that two triangles face differ by so many "
                 "degrees or more, and the corners where these meet or turn as much; scantet info counts them.",
                 0, "no edge is followed"});
  }
  scantet::OpenedDomain open(const std::string& input, scantet::Progress& progress) override {
    scantet::OpenedDomain opened;
    ReadSurface read = read_surface(input, repair_, progress);
    if (!read.surface) return opened;
    auto domain = std::make_unique<PolyhedronDomain>(std::move(*read.surface), sharp_degrees_);
    opened.default_size_mm = default_size_mm(*domain);
    opened.domain = std::move(domain);
    opened.default_size_reason = scantet::number_text(kShareOfBox) + " x the shortest edge of the surface's box";
    opened.files = {input};
    return opened;
  }
  std::vector<scantet::InfoSection> info(const std::string& input, scantet::Progress& progress) override;

 private:
  bool repair_ = false;
  std::optional<double> sharp_degrees_;
};

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
  ReadSurface read = read_surface(input, repair_, progress);
  if (!read.surface) return {};
  const PolyhedronDomain domain(std::move(*read.surface), sharp_degrees_);
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
  if (sharp_degrees_) {
    entries.push_back({"sharp_curves", "curves of sharp edges", count(domain.curves().size()), ""});
    entries.push_back({"sharp_corners", "corners of these", count(domain.corners().size()), ""});
  }
  std::string repairs;
  for (const std::string& repair : read.repairs) repairs += (repairs.empty() ? "" : "; ") + repair;
  if (repair_) entries.push_back({"repairs", "repairs", repairs.empty() ? "none needed" : repairs, ""});
  return {{"surface", "Surface", entries}};
}

}  // namespace
}  // namespace polyhedron

SCANTET_PLUGIN(polyhedron::PolyhedronPlugin);
