#include <algorithm>
#include <bit>
#include <cmath>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "scantet/quality/measures.h"
#include "scantet/report/page_impl.h"
#include "scantet/report/page_mesh_impl.h"
#include "unit/report/report_test_support.h"

namespace scantet {
namespace {

using Json = nlohmann::ordered_json;

std::string page_of(const std::vector<Report>& reports, const std::vector<TetMesh>& meshes,
                    std::size_t most_tets = kMostTetsInPage) {
  std::ostringstream out;
  write_page(out, reports, meshes, most_tets);
  return out.str();
}

std::string between(const std::string& text, const std::string& before, const std::string& after) {
  const std::size_t begin = text.find(before);
  if (begin == std::string::npos) return "";
  return text.substr(begin + before.size(), text.find(after, begin + before.size()) - begin - before.size());
}

Json data_of(const std::string& page) {
  return Json::parse(between(page, "id=\"data\">", "</script>"));
}

std::vector<std::uint8_t> decoded(const std::string& base64) {
  const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::vector<std::uint8_t> bytes;
  std::uint32_t bits = 0;
  unsigned held = 0;
  for (const char c : base64) {
    if (c == '=') break;
    bits = bits << 6U | static_cast<std::uint32_t>(digits.find(c));
    held += 6;
    if (held < 8) continue;
    held -= 8;
    bytes.push_back(static_cast<std::uint8_t>(bits >> held));
  }
  return bytes;
}

std::uint32_t word_at(const std::vector<std::uint8_t>& bytes, std::size_t at) {
  std::uint32_t word = 0;
  for (std::size_t i = 4; i-- > 0;) word = word << 8U | bytes.at(4 * at + i);
  return word;
}

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t found = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++found;
  return found;
}

TEST(Page, HoldsTheReportsAndCharts) {
  const std::vector<TetMesh> meshes{make_cube(2), make_cube(4, 1, 2)};
  const std::vector<Report> reports{plain_report(meshes[0], "a.vtu"), full_report()};
  const Json data = data_of(page_of(reports, meshes));
  ASSERT_EQ(data["meshes"].size(), 2u);
  for (std::size_t i = 0; i < 2; ++i) EXPECT_EQ(data["meshes"][i]["report"], Json::parse(json_report(reports[i])));
  EXPECT_EQ(data["meshes"][0]["name"], "a.vtu");
  EXPECT_NE(data["meshes"][0]["color"], data["meshes"][1]["color"]);
  EXPECT_EQ(data["panels"].size(), 10u);
  EXPECT_EQ(data["worst_lists"].size(), 8u);
  for (const Json& list : data["worst_lists"]) {
    EXPECT_TRUE(data["meshes"][0]["report"]["quality"]["worst"].contains(list["key"].get<std::string>())) << list;
  }
  for (const Json& panel : data["panels"]) EXPECT_EQ(panel["curves"].size(), 2u);
}

TEST(Page, ArraysAreTheMesh) {
  const TetMesh mesh = make_cube(3, 1, 2);
  const Report report = plain_report(mesh, "a.vtu");
  const std::string page = page_of({report}, {mesh});
  const Json about = data_of(page)["meshes"][0]["geometry"];
  ASSERT_EQ(about["vertices"], mesh.vertices.size());
  ASSERT_EQ(about["tets"], mesh.tets.size());
  ASSERT_EQ(about["facets"], mesh.boundary_facets.size());
  EXPECT_FALSE(about.contains("numbers"));
  const std::vector<std::uint8_t> bytes = decoded(between(page, "id=\"mesh-0\">", "</script>"));
  EXPECT_EQ(about["regions"], Json::parse("[1, 2]"));
  // Regions take half a word for each side of a facet, and for each tet: a whole number of words here.
  const std::size_t facets = mesh.boundary_facets.size();
  const std::size_t words = 3 * mesh.vertices.size() + 4 * mesh.tets.size() + 6 * facets + mesh.tets.size() / 2;
  ASSERT_EQ(mesh.tets.size() % 2, 0U);
  ASSERT_EQ(bytes.size(), 4 * words + about["colorings"].size() * mesh.tets.size());
  std::size_t at = 0;
  for (const Point& p : mesh.vertices) {
    for (int axis = 0; axis < 3; ++axis) {
      const double share = std::bit_cast<float>(word_at(bytes, at++));
      const double center = about["center_mm"][static_cast<std::size_t>(axis)].get<double>();
      EXPECT_NEAR(center + share * about["scale_mm"].get<double>(), p[axis], 1e-5);
    }
  }
  for (const Tet& t : mesh.tets) {
    for (const VertexId v : t) ASSERT_EQ(word_at(bytes, at++), v);
  }
  for (const Triangle& f : mesh.boundary_facets) {
    for (const VertexId v : f) ASSERT_EQ(word_at(bytes, at++), v);
  }
  for (std::size_t side = 0; side < 2; ++side) {
    for (std::size_t i = 0; i < facets; ++i) {
      const std::uint32_t beside = word_at(bytes, at++);
      const Region region = mesh.facet_regions[i][side];
      ASSERT_EQ(beside != PageMesh::kNoTet, region != kOutside) << "faces between regions have a tet on either side";
      if (region == kOutside) continue;
      EXPECT_EQ(mesh.tet_regions.at(beside), region);
      const Tet& tet = mesh.tets.at(beside);
      for (const VertexId v : mesh.boundary_facets[i]) EXPECT_NE(std::find(tet.begin(), tet.end(), v), tet.end());
    }
  }
  const auto place_of = [](Region region) {
    return region == kOutside ? std::uint32_t{PageMesh::kNoRegion} : static_cast<std::uint32_t>(region - 1);
  };
  for (const auto& sides : mesh.facet_regions) {
    ASSERT_EQ(word_at(bytes, at++), place_of(sides[0]) | place_of(sides[1]) << 16U);
  }
  for (std::size_t i = 0; i < mesh.tets.size(); i += 2) {
    ASSERT_EQ(word_at(bytes, at++), place_of(mesh.tet_regions[i]) | place_of(mesh.tet_regions[i + 1]) << 16U);
  }
  const Json& first = about["colorings"][0];
  EXPECT_EQ(first["key"], "min_dihedral_deg");
  for (std::size_t i = 0; i < mesh.tets.size(); ++i) {
    const Tet& t = mesh.tets[i];
    const auto angles =
        measure_tet(mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]], mesh.vertices[t[3]]).dihedral_deg;
    const double shown = bytes.at(4 * words + i) / 255.0 * first["high"].get<double>();
    EXPECT_NEAR(shown, *std::min_element(angles.begin(), angles.end()), 0.2);
  }
}

TEST(Page, TooManyTetsLeaveTheBoundaryAndTheWorst) {
  const TetMesh mesh = make_cube(6);
  const Report report = plain_report(mesh, "a.vtu");
  const std::string page = page_of({report}, {mesh}, mesh.tets.size() - 1);
  const Json about = data_of(page)["meshes"][0]["geometry"];
  EXPECT_EQ(about["facets"], mesh.boundary_facets.size());
  EXPECT_LT(about["vertices"], mesh.vertices.size());
  std::set<std::uint32_t> worst;
  const Json lists = data_of(page)["meshes"][0]["report"]["quality"]["worst"];
  for (const Json& list : lists) {
    for (const Json& tet : list) worst.insert(tet["tet"].get<std::uint32_t>());
  }
  EXPECT_EQ(about["numbers"], Json(worst));
  EXPECT_EQ(about["tets"], worst.size());
  const PageMesh all = make_page_mesh(mesh, *report.quality, mesh.tets.size());
  EXPECT_TRUE(all.numbers.empty());
  EXPECT_EQ(all.tets.size(), 4 * mesh.tets.size());
  const PageMesh some = make_page_mesh(mesh, *report.quality, 10);
  const std::size_t vertices = some.coordinates.size() / 3;
  for (const std::uint32_t v : some.tets) EXPECT_LT(v, vertices);
  for (const std::uint32_t v : some.facets) EXPECT_LT(v, vertices);
  for (std::size_t i = 0; i < some.numbers.size(); ++i) {
    for (std::size_t k = 0; k < 4; ++k) {
      const Point p = mesh.vertices[mesh.tets[some.numbers[i]][k]];
      const std::size_t v = 3 * std::size_t{some.tets[4 * i + k]};
      EXPECT_NEAR(some.center.x + some.scale_mm * some.coordinates[v], p.x, 1e-5);
    }
  }
}

TEST(Page, AReportWithoutMeasuresGetsThoseOfItsMesh) {
  const std::vector<TetMesh> meshes{make_cube(2), make_cube(3)};
  Report bare;
  bare.version = "1.2.3";
  const Json data = data_of(page_of({plain_report(meshes[0], "a.vtu"), bare}, meshes));
  const Report full = plain_report(meshes[1], "b.vtu");
  const Json& report = data["meshes"][1]["report"];
  EXPECT_EQ(report["quality"], Json::parse(json_report({full}))["quality"]);
  EXPECT_EQ(report["mesh"]["tets"], meshes[1].tets.size());
  EXPECT_EQ(data["meshes"][1]["geometry"]["tets"], meshes[1].tets.size());
}

TEST(Page, NamesCannotBecomeMarkup) {
  const std::string name = "</script><script>alert(1)</script><!--<script>&\"'.vtu";
  const TetMesh mesh = make_cube(1);
  Report report = plain_report(mesh, "dir/" + name);
  report.options = std::vector<ReportOption>{{"<b>", "<img src=x onerror=alert(2)>"}};
  report.audit->findings.push_back({"code", 1, "<script>alert(3)</script>", "</SCRIPT>", {}});
  const std::string plain = page_of({plain_report(mesh, "a.vtu")}, {mesh});
  const std::string page = page_of({report}, {mesh});
  for (const char* mark : {"<script", "</script", "<!--", "<img", "<b>"})
    EXPECT_EQ(count(page, mark), count(plain, mark)) << mark;
  EXPECT_EQ(count(page, "</SCRIPT"), 0u);
  EXPECT_EQ(data_of(page)["meshes"][0]["name"], "script><!--<script>&\"'.vtu") << "what follows the last slash";
  EXPECT_EQ(data_of(page)["meshes"][0]["report"]["input"]["path"], "dir/" + name);
}

TEST(Page, LoadsNothing) {
  const TetMesh mesh = make_cube(1);
  const std::string page = page_of({plain_report(mesh, "a.vtu")}, {mesh});
  EXPECT_NE(page.find("default-src 'none'"), std::string::npos);
  EXPECT_EQ(page.find(" src="), std::string::npos);
  EXPECT_EQ(page.find("<link"), std::string::npos);
  EXPECT_EQ(page.find("@import"), std::string::npos);
  EXPECT_NE(page.find("THREE"), std::string::npos);
  EXPECT_NE(page.find("d3_select"), std::string::npos);
}

TEST(Page, MeshesOfAnySizeAndPlaceFillTheView) {
  for (const double scale : {1e-20, 1.0, 1e50}) {
    TetMesh mesh = make_cube(2);
    for (Point& p : mesh.vertices) p = scale * (p + Vec{1000, 0, 0});
    const PageMesh page = make_page_mesh(mesh, measure_quality(mesh), kMostTetsInPage);
    const auto [low, high] = std::minmax_element(page.coordinates.begin(), page.coordinates.end());
    EXPECT_NEAR(*low, -1 / std::sqrt(3), 1e-3) << scale;
    EXPECT_NEAR(*high, 1 / std::sqrt(3), 1e-3) << scale;
  }
}

}  // namespace
}  // namespace scantet
