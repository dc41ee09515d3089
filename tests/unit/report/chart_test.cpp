#include <cairo.h>
#include <vtkNew.h>
#include <vtkSmartPointer.h>
#include <vtkXMLDataElement.h>
#include <vtkXMLUtilities.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <sstream>

#include "scantet/domain/sizing_field.h"
#include "scantet/report/chart_impl.h"
#include "unit/report/report_test_support.h"

namespace scantet {
namespace {

std::string svg_of(std::span<const Report> reports) {
  std::ostringstream out;
  write_svg(out, reports);
  return out.str();
}

class ChartTest : public IoTest {
 protected:
  // The pixels as 0xrrggbb.
  std::vector<std::uint32_t> pixels_of(std::span<const Report> reports) {
    std::ostringstream out;
    write_png(out, reports);
    put_content(file("chart.png"), out.str());
    cairo_surface_t* const surface = cairo_image_surface_create_from_png(file("chart.png").c_str());
    EXPECT_EQ(cairo_surface_status(surface), CAIRO_STATUS_SUCCESS);
    width_ = cairo_image_surface_get_width(surface);
    height_ = cairo_image_surface_get_height(surface);
    const int stride = cairo_image_surface_get_stride(surface);
    std::vector<std::uint32_t> pixels;
    for (int y = 0; y < height_; ++y) {
      const auto* const row =
          reinterpret_cast<const std::uint32_t*>(cairo_image_surface_get_data(surface) + y * stride);
      for (int x = 0; x < width_; ++x) pixels.push_back(row[x] & 0xffffffU);
    }
    cairo_surface_destroy(surface);
    return pixels;
  }
  int width_ = 0;
  int height_ = 0;
};

double area(const ChartCurve& curve) {
  double sum = 0;
  for (std::size_t i = 0; i < curve.density.size(); ++i)
    sum += curve.density[i] * (curve.edges[i + 1] - curve.edges[i]);
  return sum;
}

std::uint32_t rgb(std::size_t mesh) {
  return static_cast<std::uint32_t>(std::stoul(mesh_color(mesh).substr(1), nullptr, 16));
}

// As Cairo writes a colour into an SVG file: "rgb(0%,44.705882%,69.803922%)".
std::string svg_color(std::size_t mesh) {
  std::ostringstream text;
  text.precision(8);
  const auto percent = [&](int shift) { return 100 * static_cast<double>((rgb(mesh) >> shift) & 0xffU) / 255; };
  text << "rgb(" << percent(16) << "%," << percent(8) << "%," << percent(0) << "%)";
  return text.str();
}

void count_elements(vtkXMLDataElement* element, std::size_t& paths, std::set<std::string>& ids, std::size_t& with_id) {
  if (std::string(element->GetName()) == "path") ++paths;
  if (element->GetId() != nullptr) {
    ids.insert(element->GetId());
    ++with_id;
  }
  for (int i = 0; i < element->GetNumberOfNestedElements(); ++i) {
    count_elements(element->GetNestedElement(i), paths, ids, with_id);
  }
}

TEST_F(ChartTest, EveryCurveHasAreaOne) {
  const UniformSize size(4);
  const std::vector<Report> reports{plain_report(make_cube(2), "a", &size), plain_report(make_cube(9), "b")};
  const std::vector<ChartPanel> panels = chart_panels(reports);
  ASSERT_EQ(panels.size(), 12u);
  for (const ChartPanel& panel : panels) {
    for (const ChartCurve& curve : panel.curves) {
      EXPECT_NEAR(area(curve), 1, 1e-12) << panel.title;
      EXPECT_TRUE(std::is_sorted(curve.edges.begin(), curve.edges.end())) << panel.title;
      EXPECT_GE(curve.edges.front(), panel.low) << panel.title;
      EXPECT_LE(curve.edges.back(), panel.high * (1 + 1e-12)) << panel.title;
      EXPECT_LE(*std::max_element(curve.density.begin(), curve.density.end()), panel.highest);
    }
    EXPECT_EQ(panel.curves.size(), panel.title.ends_with("against the sizing field") ? 1u : 2u);
    EXPECT_GE(panel.ticks.size(), 4u) << panel.title;
  }
}

// One flat tet makes the radius-edge ratio infinite: the axis does not follow it.
TEST_F(ChartTest, LastBinOfAnOpenHistogramIsAsWideAsTheOthers) {
  TetMesh mesh = make_cube(3);
  const Tet t = mesh.tets[20];
  mesh.vertices[t[3]] = lerp(mesh.vertices[t[0]], mesh.vertices[t[1]], 0.4999);
  const Report report = plain_report(mesh, "a");
  ASSERT_GT(report.quality->max_radius_edge(), 5);
  const ChartPanel panel = chart_panels({&report, 1})[2];
  EXPECT_TRUE(panel.open_ended);
  EXPECT_LT(panel.high, 2.1);
  EXPECT_NEAR(area(panel.curves[0]), 1, 1e-12);
  EXPECT_GT(panel.curves[0].density.back(), 0);
  EXPECT_EQ(panel.curves[0].max, report.quality->max_radius_edge());
}

TEST_F(ChartTest, TicksAreRoundNumbersInTheRange) {
  for (const auto& [low, high] :
       {std::pair{0.0, 1.0}, {0.0, 3.7}, {-12.0, 4567.0}, {0.6, 2.05}, {1e-9, 7e-9}, {0.0, 1e40}}) {
    const std::vector<double> ticks = round_ticks(low, high, 0, 6);
    EXPECT_GE(ticks.size(), 4u) << low << " to " << high;
    EXPECT_LE(ticks.size(), 12u) << low << " to " << high;
    const double step = ticks[1] - ticks[0];
    for (const double tick : ticks) {
      EXPECT_GE(tick, low - 1e-6 * step);
      EXPECT_LE(tick, high + 1e-6 * step);
      EXPECT_NEAR(tick / step, std::round(tick / step), 1e-6);
    }
    const double digits = step / std::pow(10, std::floor(std::log10(step) + 1e-9));
    EXPECT_TRUE(std::abs(digits - 1) < 1e-6 || std::abs(digits - 2) < 1e-6 || std::abs(digits - 5) < 1e-6) << step;
  }
  EXPECT_EQ(round_ticks(0, 180, 30, 6), (std::vector<double>{0, 30, 60, 90, 120, 150, 180}));
}

TEST_F(ChartTest, SvgIsWellFormedAndTheSameEveryTime) {
  const std::vector<Report> reports{plain_report(make_cube(2), "a"), plain_report(make_cube(3), "<b> & \"c\"")};
  const std::string svg = svg_of(reports);
  const auto root = vtkSmartPointer<vtkXMLDataElement>::Take(vtkXMLUtilities::ReadElementFromString(svg.c_str()));
  ASSERT_NE(root, nullptr);
  EXPECT_STREQ(root->GetName(), "svg");
  std::size_t paths = 0;
  std::size_t with_id = 0;
  std::set<std::string> ids;
  count_elements(root, paths, ids, with_id);
  EXPECT_GT(paths, 40u);
  EXPECT_EQ(ids.size(), with_id) << "an id appears twice";
  EXPECT_TRUE(svg == svg_of(reports));
}

TEST_F(ChartTest, MeshesHaveColoursOfTheirOwn) {
  std::vector<Report> reports;
  for (int n = 1; n <= 3; ++n) reports.push_back(plain_report(make_cube(n), std::to_string(n)));
  const std::string svg = svg_of(reports);
  const std::string one = svg_of({reports.data(), 1});
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_NE(svg.find(svg_color(i)), std::string::npos) << svg_color(i);
    EXPECT_EQ(one.find(svg_color(i)) != std::string::npos, i == 0) << svg_color(i);
  }
  std::set<std::string> colors;
  for (std::size_t i = 0; i < kMeshColors; ++i) colors.insert(mesh_color(i));
  EXPECT_EQ(colors.size(), kMeshColors);
}

TEST_F(ChartTest, PngShowsTheCurves) {
  const std::vector<Report> reports{plain_report(make_cube(2), "a"), plain_report(make_cube(5), "b")};
  const std::vector<std::uint32_t> pixels = pixels_of(reports);
  EXPECT_GE(width_, 1200);
  EXPECT_GE(height_, 600);
  EXPECT_EQ(pixels.front(), 0xffffffU) << "white paper";
  for (std::size_t i = 0; i < 2; ++i) EXPECT_GT(std::count(pixels.begin(), pixels.end(), rgb(i)), 1000) << i;
  EXPECT_EQ(std::count(pixels.begin(), pixels.end(), rgb(2)), 0);
}

TEST_F(ChartTest, MoreMeshesThanColoursAndNoneAtAll) {
  std::vector<Report> many;
  for (int i = 0; i < 20; ++i) many.push_back(plain_report(make_cube(1), "mesh.vtu"));
  EXPECT_FALSE(svg_of(many).empty());
  const Report nothing = plain_report({}, "empty.vtu");
  EXPECT_TRUE(chart_panels({&nothing, 1}).empty());
  EXPECT_NE(svg_of({&nothing, 1}).find("</svg>"), std::string::npos);
}

TEST_F(ChartTest, LengthsOfAnySize) {
  for (const double scale : {1e-30, 1e30, 1e50}) {
    TetMesh mesh = make_cube(2);
    for (Point& p : mesh.vertices) p = scale * p;
    const Report report = plain_report(mesh, "a");
    for (const ChartPanel& panel : chart_panels({&report, 1})) {
      EXPECT_TRUE(std::isfinite(panel.highest) && panel.highest > 0) << panel.title << scale;
      EXPECT_NEAR(area(panel.curves[0]), 1, 1e-9) << panel.title << scale;
    }
    EXPECT_FALSE(pixels_of({&report, 1}).empty());
  }
}

TEST_F(ChartTest, NamesTellTheMeshesApart) {
  std::vector<Report> reports(6);
  const char* const paths[] = {"x/ours.vtu", "theirs.msh", "a/same.vtu", "b/same.vtu", "b/same.vtu", "caf\xe9.vtu"};
  for (std::size_t i = 0; i < 6; ++i) reports[i].input = ReportInput{paths[i], "", std::nullopt};
  EXPECT_EQ(mesh_names(reports), (std::vector<std::string>{"ours.vtu", "theirs.msh", "a/same.vtu", "b/same.vtu",
                                                           "b/same.vtu (2)", "caf\xef\xbf\xbd.vtu"}));
}

}  // namespace
}  // namespace scantet
