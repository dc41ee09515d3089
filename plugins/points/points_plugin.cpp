// Opens point sets; what is made of them is reconstruction.h's.
#include "point_reader.h"
#include "reconstruction.h"
#include "scantet/plugin/plugin.h"

namespace points {
namespace {

constexpr double kLeastPerSize = 2;

class PointsPlugin final : public scantet::InputPlugin {
 public:
  std::string name() const override { return "points"; }
  std::string description() const override {
    return "points on a closed surface, with or without normals: XYZ, PWN, PLY without faces";
  }
  int can_open(const std::string& input) const override { return is_point_file(input) ? 90 : 0; }
  void declare_options(scantet::OptionSet& options) override;
  scantet::OpenedDomain open(const std::string& input, scantet::Progress& progress) override;
  std::vector<scantet::InfoSection> info(const std::string& input, scantet::Progress& progress) override;

 private:
  Settings settings_;
};

void PointsPlugin::declare_options(scantet::OptionSet& options) {
  options.add("normals", settings_.normals, {{"given", NormalSource::given}, {"estimate", NormalSource::estimate}},
              {"Points", "SOURCE", "a source of normals",
               "Where the points' normals are from: given are those of the file, if it has any; estimate looks at the "
               "points alone."});
  options.add("grid-step", settings_.grid_step_mm, scantet::Range::above(0),
              {"Points", "MM", "a length in mm", "Step of the grid on which the surface through the points is kept.", 0,
               "half the average spacing of the points"});
}

scantet::OpenedDomain PointsPlugin::open(const std::string& input, scantet::Progress& progress) {
  Reconstruction made = reconstruct(input, settings_, progress);
  scantet::OpenedDomain opened;
  opened.domain = std::move(made.domain);
  opened.default_size_mm = kLeastPerSize * made.least_size_mm();
  opened.default_size_reason = scantet::number_text(kLeastPerSize) + " x the least size for these points";
  opened.min_size_mm = made.least_size_mm();
  opened.min_size_reason = made.least_size_mm() == made.spacing_mm
                               ? "the points are " + scantet::number_text(made.spacing_mm, 3) + " mm apart on average"
                               : "--grid-step is " + scantet::number_text(made.grid_step_mm, 3) + " mm";
  opened.files = {input};
  return opened;
}

std::vector<scantet::InfoSection> PointsPlugin::info(const std::string& input, scantet::Progress& progress) {
  const Reconstruction made = reconstruct(input, settings_, progress);
  if (made.domain == nullptr) return {};
  const auto corner = [](const scantet::Point& p) { return std::vector<double>{p.x, p.y, p.z}; };
  const auto count = [](auto number) { return static_cast<std::int64_t>(number); };
  const std::vector<double> grid(made.grid.begin(), made.grid.end());
  std::int64_t components = 0;
  std::int64_t cavities = 0;
  for (const scantet::Component& c : made.domain->components())
    ++(c.region == scantet::kOutside ? cavities : components);
  return {{"points",
           "Points",
           {{"points", "different points", count(made.points), ""},
            {"spacing_mm", "average spacing", made.spacing_mm, "mm"},
            {"normals", "normals", std::string(made.estimated ? "estimated" : "given"), ""}}},
          {"surface",
           "Surface through them",
           {{"components", "components", components, ""},
            {"cavities", "cavities", cavities, ""},
            {"specks", "specks dropped", count(made.specks), ""},
            {"missed", "points it misses", count(made.fit.missed), ""},
            {"median_distance_mm", "median distance of a point", made.fit.median_mm, "mm"},
            {"most_distance_mm", "95 % are nearer than", made.fit.most_mm, "mm"},
            {"grid", "grid", grid, "nodes"},
            {"grid_step_mm", "grid step", made.grid_step_mm, "mm"},
            {"box_min_mm", "box from", corner(made.domain->bounds().min), "mm"},
            {"box_max_mm", "box to", corner(made.domain->bounds().max), "mm"},
            {"least_size_mm", "least size", made.least_size_mm(), "mm"},
            {"default_size_mm", "default size", kLeastPerSize * made.least_size_mm(), "mm"}}}};
}

}  // namespace
}  // namespace points

SCANTET_PLUGIN(points::PointsPlugin);
