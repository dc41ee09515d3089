// Opens surface files; the reader and the domain do the work.
#include <CGAL/Polygon_mesh_processing/connected_components.h>
#include <CGAL/Polygon_mesh_processing/measure.h>

#include <algorithm>
#include <filesystem>

#include "ply/ply_header.h"
#include "polyhedron_domain.h"
#include "scantet/base/error.h"
#include "scantet/domain/plugin.h"
#include "surface_reader.h"

namespace polyhedron {
namespace {

constexpr double kShareOfBox = 0.04;

double default_size_mm(const scantet::Domain& domain) {
  const scantet::Vec extent = domain.bounds().extent();
  return kShareOfBox * std::min({extent.x, extent.y, extent.z});
}

class PolyhedronPlugin final : public scantet::InputPlugin {
 public:
  std::string name() const override { return "polyhedron"; }
  std::string description() const override { return "closed surfaces: OFF, STL, PLY, OBJ"; }
  int can_open(const std::string& input) const override;
  void declare_options(scantet::OptionSet&) override {}
  scantet::OpenedDomain open(const std::string& input, scantet::Progress&) override {
    scantet::OpenedDomain opened;
    opened.domain = std::make_unique<PolyhedronDomain>(read_surface(input));
    opened.default_size_mm = default_size_mm(*opened.domain);
    opened.default_size_reason = scantet::number_text(kShareOfBox) + " x the shortest edge of the box";
    opened.files = {input};
    return opened;
  }
  std::vector<scantet::InfoSection> info(const std::string& input, scantet::Progress&) override;
};

int PolyhedronPlugin::can_open(const std::string& input) const {
  const std::string extension = ply::extension_of(input);
  const bool known = extension == ".off" || extension == ".stl" || extension == ".ply" || extension == ".obj";
  std::error_code code;
  if (!known || !std::filesystem::is_regular_file(input, code) || std::filesystem::file_size(input, code) == 0)
    return 0;
  const std::optional<ply::Header> header = extension == ".ply" ? ply::read_header(input) : std::nullopt;
  return header && ply::is_point_set(*header) ? 0 : 90;
}

std::vector<scantet::InfoSection> PolyhedronPlugin::info(const std::string& input, scantet::Progress&) {
  const PolyhedronDomain domain(read_surface(input));
  const Surface& surface = domain.surface();
  const auto corner = [](const scantet::Point& p) { return std::vector<double>{p.x, p.y, p.z}; };
  const auto count = [](auto number) { return static_cast<std::int64_t>(number); };
  Surface coloured = surface;
  const auto pieces = CGAL::Polygon_mesh_processing::connected_components(
      coloured, coloured.add_property_map<Surface::Face_index, std::size_t>("f:piece").first);
  return {{"surface",
           "Surface",
           {{"triangles", "triangles", count(surface.number_of_faces()), ""},
            {"vertices", "vertices", count(surface.number_of_vertices()), ""},
            {"pieces", "connected pieces", count(pieces), ""},
            {"area_mm2", "area", CGAL::to_double(CGAL::Polygon_mesh_processing::area(surface)), "mm²"},
            {"box_min_mm", "box from", corner(domain.bounds().min), "mm"},
            {"box_max_mm", "box to", corner(domain.bounds().max), "mm"},
            {"default_size_mm", "default size", default_size_mm(domain), "mm"}}}};
}

}  // namespace
}  // namespace polyhedron

SCANTET_PLUGIN(polyhedron::PolyhedronPlugin);
