#include "scantet/report/report.h"

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>

#include "scantet/domain/sizing_field.h"
#include "unit/report/report_test_support.h"

namespace scantet {
namespace {

using Json = nlohmann::ordered_json;

class ReportTest : public IoTest {};

std::vector<std::string> keys(const Json& json) {
  std::vector<std::string> names;
  for (const auto& item : json.items()) names.push_back(item.key());
  return names;
}

bool has_all(const Json& json, const std::vector<std::string>& names) {
  for (const std::string& name : names) {
    if (json.contains(name)) continue;
    ADD_FAILURE() << "no key " << name;
    return false;
  }
  return true;
}

std::size_t count_columns(const std::string& line) {
  return static_cast<std::size_t>(
      std::count_if(line.begin(), line.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xc0U) != 0x80U; }));
}

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

TEST_F(ReportTest, JsonHasTheStableKeys) {
  Report report = full_report();
  report.files = {{"a.vtu", "00ff"}};
  const Json json = Json::parse(json_report({&report, 1}));
  EXPECT_EQ(keys(json), (std::vector<std::string>{"version", "input", "options", "stop", "limit", "components", "mesh",
                                                  "quality", "rules", "bounds", "topology", "audit", "notes",
                                                  "timing_s", "files", "stages", "phases"}));
  EXPECT_EQ(json["files"][0], (Json{{"path", "a.vtu"}, {"sha256", "00ff"}}));
  EXPECT_EQ(json["notes"], Json::array({"a note"}));
  has_all(json["mesh"], {"vertices", "tets", "boundary_facets", "boundary_vertices", "volume_mm3", "regions"});
  has_all(json["quality"],
          {"min_dihedral_deg", "max_dihedral_deg", "min_facet_angle_deg", "max_radius_edge", "max_circumradius_mm"});
  for (const char* measure :
       {"inverse_aspect", "dihedral_deg", "radius_edge", "edge_length_mm", "scaled_jacobian", "largest_dihedral_deg",
        "min_height_mm", "stable_time_step_us", "stiffness_ratio", "volume_mm3"}) {
    ASSERT_TRUE(has_all(json["quality"]["histograms"], {measure}));
    const Json& histogram = json["quality"]["histograms"][measure];
    ASSERT_TRUE(has_all(histogram, {"edges", "counts"}));
    EXPECT_EQ(histogram["edges"].size(), histogram["counts"].size() + 1);
    EXPECT_GT(histogram["counts"].size(), 0u);
    ASSERT_TRUE(has_all(json["quality"]["statistics"], {measure}));
    has_all(json["quality"]["statistics"][measure], {"min", "max", "mean", "p1", "p50", "p99"});
  }
  has_all(json["quality"],
          {"min_edge_length_mm", "min_height_mm", "min_scaled_jacobian", "min_stable_time_step_us",
           "wave_speed_m_per_s", "min_volume_mm3", "median_volume_mm3", "max_stiffness_ratio", "condition_factor"});
  EXPECT_EQ(
      keys(json["quality"]["worst"]),
      (std::vector<std::string>{"min_dihedral_deg", "max_radius_edge", "min_edge_length_mm", "min_height_mm",
                                "min_scaled_jacobian", "max_dihedral_deg", "min_volume_mm3", "max_stiffness_ratio"}));
  has_all(json["topology"], {"handles", "surface_list", "cavity_list"});
  has_all(json["rules"], {"r1", "r2", "r3_1", "r3_2", "unmet"});
  has_all(json["rules"]["unmet"], {"r1", "r2", "r3"});
  has_all(json["topology"], {"components", "boundary_components", "euler", "manifold", "expected", "missing"});
  has_all(json["input"], {"path", "sha256", "frame"});
  has_all(json["limit"], {"rule", "place_mm"});
  EXPECT_EQ(keys(json["components"]), (std::vector<std::string>{"found", "dropped"}));
  EXPECT_EQ(keys(json["components"]["dropped"]), (std::vector<std::string>{"count", "volume_mm3", "largest"}));
  for (const Json& stage : json["stages"]) {
    EXPECT_EQ(keys(stage), (std::vector<std::string>{"stage", "seconds", "points"}));
  }
}

TEST_F(ReportTest, JsonHoldsTheValues) {
  const Report report = full_report();
  const Json json = Json::parse(json_report(report));
  EXPECT_EQ(json["version"], "1.2.3");
  EXPECT_EQ(json["stop"], "limit");
  EXPECT_EQ(json["mesh"]["vertices"], 125);
  EXPECT_EQ(json["mesh"]["tets"], 384);
  EXPECT_EQ(json["mesh"]["volume_mm3"].get<double>(), report.quality->total_volume_mm3);
  EXPECT_EQ(json["quality"]["min_dihedral_deg"].get<double>(), report.quality->min_dihedral_deg());
  EXPECT_EQ(json["quality"]["regions"].size(), 2u);
  EXPECT_EQ(json["mesh"]["regions"], json["quality"]["regions"]);
  ASSERT_EQ(json["topology"]["interfaces"].size(), 3u);
  EXPECT_EQ(json["topology"]["interfaces"][1]["regions"], Json::parse("[1, 2]"));
  EXPECT_EQ(json["quality"]["tets_under_deg"]["10"], 0);
  EXPECT_EQ(json["rules"]["r3_1"], 90791);
  EXPECT_EQ(json["rules"]["unmet"]["r3"], 7);
  EXPECT_EQ(json["bounds"][0], Json::parse(R"({"name": "min_dihedral_deg", "asked": 10, "broken": 0, "of": 384})"));
  EXPECT_EQ(json["bounds"][1]["worst"], 1.00004);
  EXPECT_EQ(json["bounds"][1]["place_mm"], Json::parse("[1.0, 2.0, 3.0]"));
  EXPECT_EQ(json["topology"]["components"], 2);
  EXPECT_EQ(json["topology"]["manifold"], true);
  EXPECT_EQ(json["topology"]["expected"]["cavities"], 1);
  EXPECT_EQ(json["topology"]["missing"][0]["kind"], "component");
  EXPECT_EQ(json["topology"]["missing"][0]["witness_mm"], Json::parse("[1.0, 2.0, 3.0]"));
  EXPECT_EQ(json["audit"]["passed"], false);
  EXPECT_EQ(json["audit"]["findings"][0]["code"], "audit.component_missing");
  EXPECT_EQ(json["limit"]["rule"], "R3.1");
  EXPECT_EQ(json["components"]["found"], 58);
  EXPECT_EQ(json["components"]["dropped"]["count"], 2);
  EXPECT_EQ(json["components"]["dropped"]["volume_mm3"], 20.25);
  EXPECT_EQ(json["components"]["dropped"]["largest"][0],
            Json::parse(R"({"volume_mm3": 12.25, "witness_mm": [4.0, 5.0, 6.0], "region": 1})"));
  EXPECT_EQ(json["input"]["frame"]["columns_mm"][1][1], 0.7);
  EXPECT_EQ(keys(json["timing_s"]), (std::vector<std::string>{"read", "refine", "total"}));
  ASSERT_EQ(json["stages"].size(), 3u);
  EXPECT_EQ(json["stages"][0]["stage"], "boundary sample");
  EXPECT_EQ(json["stages"][1]["seconds"], 0.25);
  EXPECT_EQ(json["stages"][2]["points"], 90791);
  EXPECT_EQ(keys(json["options"]),
            (std::vector<std::string>{"size", "facet-distance", "seeding", "verbose", "max-vertices", "output"}));
  EXPECT_EQ(json["options"]["size"], 0.1);
  EXPECT_TRUE(json["options"]["facet-distance"].is_null());
  EXPECT_EQ(json["options"]["verbose"], false);
  EXPECT_TRUE(json["options"]["max-vertices"].is_number_integer());
  EXPECT_EQ(json["options"]["output"].size(), 2u);
}

TEST_F(ReportTest, JsonIsTheSameEveryTime) {
  EXPECT_EQ(json_report(full_report()), json_report(full_report()));
}

TEST_F(ReportTest, JsonLeavesOutWhatIsAbsent) {
  Report report;
  report.version = "1.2.3";
  EXPECT_EQ(keys(Json::parse(json_report(report))), (std::vector<std::string>{"version"}));
  report.input = ReportInput{"mesh.vtu", "", std::nullopt};
  report.timing_s = ReportTiming{};
  const Json json = Json::parse(json_report(report));
  EXPECT_EQ(keys(json["input"]), (std::vector<std::string>{"path"}));
  EXPECT_TRUE(json["timing_s"].is_object());
}

TEST_F(ReportTest, JsonHasNoTopologyOfWhatIsNoMesh) {
  Report report;
  TetMesh mesh = make_cube(1);
  mesh.tets[0][0] = 99;
  report.audit = audit(mesh, nullptr);
  const Json json = Json::parse(json_report(report));
  EXPECT_FALSE(json.contains("topology"));
  EXPECT_EQ(json["audit"]["complete"], false);
  EXPECT_EQ(json["audit"]["findings"].size(), 1u);
  EXPECT_NE(text_report(report).find("repair"), std::string::npos);
}

TEST_F(ReportTest, JsonNumbersReadBackExactly) {
  Report report;
  report.mesh = ReportMesh{1, 2, 3, 4, 0.1 + 0.2, {}};
  report.limit = LimitReport{"R1", {1.0 / 3, -0.0, 5e-324}, 1.7976931348623157e308};
  const Json json = Json::parse(json_report(report));
  EXPECT_EQ(json["mesh"]["volume_mm3"].get<double>(), 0.1 + 0.2);
  EXPECT_EQ(json["limit"]["place_mm"][0].get<double>(), 1.0 / 3);
  EXPECT_EQ(json["limit"]["place_mm"][2].get<double>(), 5e-324);
  EXPECT_EQ(json["limit"]["insertion_radius_mm"].get<double>(), 1.7976931348623157e308);
}

TEST_F(ReportTest, WhatHasNoValueIsNullInJson) {
  Report report;
  report.quality = measure_quality({});
  const std::string empty = json_report(report);
  EXPECT_TRUE(Json::parse(empty)["quality"]["min_dihedral_deg"].is_null());
  TetMesh flat;
  flat.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}};
  flat.tets = {{0, 1, 2, 3}};
  report.quality = measure_quality(flat);
  const std::string text = json_report(report);
  EXPECT_TRUE(Json::parse(text)["quality"]["max_radius_edge"].is_null());
  for (const std::string& json : {empty, text}) {
    EXPECT_EQ(json.find("nan"), std::string::npos);
    EXPECT_EQ(json.find(": inf"), std::string::npos);
  }
  EXPECT_NE(text_report(report).find("infinite"), std::string::npos);
}

TEST_F(ReportTest, PathsThatAreNotUtf8StillMakeJson) {
  Report report;
  report.input = ReportInput{"caf\xe9.nrrd", "", std::nullopt};
  EXPECT_TRUE(Json::parse(json_report(report))["input"]["path"].is_string());
}

TEST_F(ReportTest, CsvRowsAreTheBins) {
  const Report report = full_report();
  const auto lines = lines_of(csv_report(report));
  ASSERT_FALSE(lines.empty());
  EXPECT_EQ(lines[0], "measure,bin_low,bin_high,count");
  std::map<std::string, std::uint64_t> total;
  std::map<std::string, double> last_high;
  for (std::size_t i = 1; i < lines.size(); ++i) {
    std::istringstream row(lines[i]);
    std::string measure, low, high, count;
    std::getline(row, measure, ',');
    std::getline(row, low, ',');
    std::getline(row, high, ',');
    std::getline(row, count);
    if (last_high.count(measure) > 0) {
      EXPECT_EQ(std::stod(low), last_high[measure]) << lines[i];
    }
    EXPECT_LT(std::stod(low), std::stod(high)) << lines[i];
    last_high[measure] = std::stod(high);
    total[measure] += std::stoull(count);
  }
  EXPECT_EQ(total.size(), 11u);
  EXPECT_EQ(total["dihedral_deg"], 6u * 384);
  EXPECT_EQ(total["inverse_aspect"], 384u);
  EXPECT_EQ(total["edge_length_mm"], report.quality->edge_length_mm.count);
  EXPECT_EQ(lines_of(csv_report(Report{})).size(), 1u);
}

TEST_F(ReportTest, SizesAgainstTheFieldAreReportedWhereThereIsOne) {
  const TetMesh mesh = make_cube(3);
  const UniformSize size(10);
  const std::vector<Report> reports{plain_report(mesh, "a.vtu"), plain_report(mesh, "a.nrrd", &size)};
  const Json without = Json::parse(json_report(reports[0]))["quality"];
  const Json with = Json::parse(json_report(reports[1]))["quality"];
  EXPECT_FALSE(without["histograms"].contains("size_ratio"));
  EXPECT_FALSE(without["statistics"].contains("size_ratio"));
  EXPECT_EQ(with["statistics"]["size_ratio"]["max"].get<double>(), reports[1].quality->max_circumradius_mm() / 10);
  EXPECT_EQ(with["histograms"]["size_ratio"]["counts"].size() + 1, with["histograms"]["size_ratio"]["edges"].size());
  EXPECT_EQ(csv_report(reports[0]).find("size_ratio"), std::string::npos);
  EXPECT_NE(csv_report(reports[1]).find("\nsize_ratio,0,"), std::string::npos);
  EXPECT_FALSE(without.contains("min_edge_size_ratio"));
  EXPECT_FALSE(without["worst"].contains("min_edge_size_ratio"));
  EXPECT_EQ(with["min_edge_size_ratio"].get<double>(), reports[1].quality->edge_length_mm.min / 10);
  EXPECT_EQ(with["worst"]["min_edge_size_ratio"][0]["value"], with["min_edge_size_ratio"]);
  EXPECT_NE(csv_report(reports[1]).find("\nedge_size_ratio,0,"), std::string::npos);
  EXPECT_EQ(text_report(reports[0]).find("edge length / size asked for"), std::string::npos);
  EXPECT_NE(text_report(reports[1]).find("edge length / size asked for"), std::string::npos);
}

TEST_F(ReportTest, SeveralReportsStandSideBySide) {
  const std::vector<Report> reports{plain_report(make_cube(2), "one/a \"b\".vtu"), plain_report(make_cube(3), "c.vtu")};
  const Json json = Json::parse(json_report(reports));
  EXPECT_EQ(keys(json), std::vector<std::string>{"meshes"});
  ASSERT_EQ(json["meshes"].size(), 2u);
  for (std::size_t i = 0; i < 2; ++i) EXPECT_EQ(json["meshes"][i], Json::parse(json_report(reports[i])));
  const auto lines = lines_of(csv_report(reports));
  EXPECT_EQ(lines[0], "mesh,measure,bin_low,bin_high,count");
  const auto first = lines_of(csv_report(reports[0]));
  ASSERT_EQ(lines.size(), first.size() + lines_of(csv_report(reports[1])).size() - 1);
  EXPECT_EQ(lines[1], "\"a \"\"b\"\".vtu\"," + first[1]);
  EXPECT_EQ(lines.back().rfind("\"c.vtu\",volume_mm3,", 0), 0u) << lines.back();
}

TEST_F(ReportTest, ExtensionChoosesTheForm) {
  const Report report = full_report();
  const TetMesh mesh = make_cube(4, 1, 2);
  const auto write = [&](const std::string& name) { write_report({&report, 1}, {&mesh, 1}, file(name)); };
  write("r.json");
  write("r.CSV");
  EXPECT_EQ(content_of(file("r.json")), json_report(report));
  EXPECT_EQ(content_of(file("r.CSV")), csv_report(report));
  for (const std::string& extension : report_extensions()) {
    write("x" + extension);
    EXPECT_GT(content_of(file("x" + extension)).size(), 1000u) << extension;
    write("y" + extension);
    EXPECT_TRUE(content_of(file("x" + extension)) == content_of(file("y" + extension)))
        << "not the same bytes: " << extension;
  }
}

TEST_F(ReportTest, RefusesUnknownFormsAndUnwritablePlaces) {
  const auto fault_of = [](const std::string& path) -> std::string {
    try {
      const Report report = full_report();
      const TetMesh mesh = make_cube(4, 1, 2);
      write_report({&report, 1}, {&mesh, 1}, path);
    } catch (const Error& e) {
      EXPECT_NE(std::string(e.what()).find(path), std::string::npos) << e.what();
      EXPECT_FALSE(e.remedy().empty());
      return e.code();
    }
    return "no error";
  };
  EXPECT_EQ(fault_of(file("r.xml")), "usage.format");
  EXPECT_EQ(fault_of(file("r")), "usage.format");
  for (const std::string& extension : report_extensions()) {
    EXPECT_EQ(fault_of(file("none/r" + extension)), "output.cannot_write");
  }
  EXPECT_EQ(files_in_folder(), 0u);
}

TEST_F(ReportTest, TextSaysWhatPeopleNeed) {
  std::string text;  // in one line
  std::istringstream words(text_report(full_report()));
  for (std::string word; words >> word;) text += word + " ";
  for (const char* part :
       {"125 vertices",
        "384 tets",
        "mm³",
        "dihedral",
        "radius-edge",
        "2 components",
        "Euler number",
        "manifold",
        "R3.1 90,791",
        "met: dihedral angle, degrees >= 10",
        "unmet: R3: circumradius / size of tets over 1: 7 of 384, the worst with 1.00004 at (1, 2, 3) mm",
        "13.75 s",
        "boundary sample 0.75 s (500 points), classify 0.25 s, R3.1 8.50 s",
        "R3.1 kept inserting points",
        "audit.component_missing",
        "Remedy: mesh with a smaller --size",
        "the input has 3",
        "dropped 2 of 58 components, the largest of them 12.25 mm³ at (4, 5, 6) mm, together 20.25 mm³",
        "inverse aspect ratio",
        "█",
        "scaled Jacobian from 0.",
        "least height 1.251 mm",
        "0.8337 µs at 1,500 m/s",
        "least volume ",
        "iterative: the condition number up to ",
        "worst smallest dihedral angle 33.49°: tet 355 at (4.121",
        "shortest edge ",
        "largest dihedral angle "}) {
    EXPECT_NE(text.find(part), std::string::npos) << part << "\n" << text;
  }
}

TEST_F(ReportTest, TextSaysThatNoneWasDropped) {
  Report report;
  report.components = DroppedComponents{1, {}};
  EXPECT_EQ(text_report(report), "dropped    none of 1 component\n");
}

TEST_F(ReportTest, TextFitsTheWidth) {
  const Report report = full_report();
  for (const int width : {40, 60, 80, 132}) {
    for (const bool unicode : {true, false}) {
      for (const std::string& line : lines_of(text_report(report, {width, unicode}))) {
        EXPECT_LE(count_columns(line), static_cast<std::size_t>(width)) << line;
        if (unicode) continue;
        EXPECT_TRUE(std::all_of(line.begin(), line.end(), [](char c) { return c >= ' ' && c <= '~'; })) << line;
      }
    }
  }
}

TEST_F(ReportTest, TextBarsShowTheCounts) {
  Report report;
  report.quality = measure_quality(make_cube(3));
  Histogram& h = report.quality->dihedral_deg.histogram;
  h.counts.assign(h.counts.size(), 0);
  h.counts[0] = 1;
  h.counts[3] = 500000;
  h.counts[6] = 1000000;
  std::vector<std::size_t> bars;
  for (const std::string& line : lines_of(text_report(report, {80, false}))) {
    const auto marks = static_cast<std::size_t>(std::count(line.begin(), line.end(), '#'));
    if (line.ends_with("%")) bars.push_back(marks);
  }
  ASSERT_GE(bars.size(), 12u);
  EXPECT_EQ(bars[0], 1u) << "what is there shows";
  EXPECT_GT(bars[2], 20u);
  EXPECT_NEAR(static_cast<double>(bars[1]), 0.5 * static_cast<double>(bars[2]), 1);
  EXPECT_EQ(bars[3], 0u);
}

TEST_F(ReportTest, TextOfNothingIsEmpty) {
  EXPECT_EQ(text_report(Report{}), "");
}

TEST_F(ReportTest, OptionsKeepTheirKinds) {
  double size = 2.5;
  std::optional<double> bound;
  std::uint64_t seed = 7;
  std::string text = "x";
  std::vector<std::string> files{"a", "b"};
  bool flag = true;
  OptionSet set;
  set.add("size", size, Range::above(0), {});
  set.add("bound", bound, Range::above(0), {});
  set.add("seed", seed, Range::at_least(0), {});
  set.add("text", text, {});
  set.add("files", files, {});
  set.add("flag", flag, {});
  size = 1.25;
  Report report;
  report.options = report_options(set);
  const Json json = Json::parse(json_report(report))["options"];
  EXPECT_EQ(json.dump(), R"({"size":1.25,"bound":null,"seed":7,"text":"x","files":["a","b"],"flag":true})");
}

}  // namespace
}  // namespace scantet
