// The page is made of files that the build embeds: a frame of HTML, its style and scripts, and two kept libraries
// (three.js draws the view, d3 the charts). Data goes into <script> elements that browsers do not run: reports and
// charts as JSON, meshes as base64. The only way out of such an element is "</", so no "<" of the data stays one.
#include <algorithm>
#include <bit>
#include <nlohmann/json.hpp>
#include <ostream>

#include "scantet/report/chart_impl.h"
#include "scantet/report/measures_impl.h"
#include "scantet/report/page_files_impl.h"
#include "scantet/report/page_impl.h"
#include "scantet/report/page_mesh_impl.h"
#include "scantet/report/report_json_impl.h"

namespace scantet {
namespace {

using Json = nlohmann::ordered_json;

Json json_of(const ChartPanel& p) {
  Json json{{"title", p.title}, {"label", p.label},       {"unit", p.unit},       {"density_label", p.density_label},
            {"low", p.low},     {"high", p.high},         {"highest", p.highest}, {"open_ended", p.open_ended},
            {"ticks", p.ticks}, {"curves", Json::array()}};
  for (const ChartCurve& c : p.curves) {
    json["curves"].push_back(
        {{"mesh", c.mesh}, {"edges", c.edges}, {"density", c.density}, {"min", c.min}, {"max", c.max}});
  }
  return json;
}

Json json_of(const PageColoring& c) {
  return {{"key", c.key}, {"title", c.title}, {"unit", c.unit},
          {"low", c.low}, {"high", c.high},   {"low_is_bad", c.low_is_bad}};
}

Json difference_rows_json(const ReportDifference& difference, std::span<const Report> reports) {
  Json json{{"verdict", difference_verdict(difference)},
            {"same", difference.is_same()},
            {"reasons", difference.reasons},
            {"rows", Json::array()}};
  for (const DifferenceRow& row : difference_rows(difference, reports)) {
    json["rows"].push_back({{"what", row.what}, {"values", row.values}, {"change", row.change}});
  }
  return json;
}

// Where the scale of distances ends, of both meshes alike.
double farthest_mm(const ReportDifference& difference) {
  double farthest_mm = 0;
  for (const auto& facets : difference.mesh.facets_off_mm) {
    for (const double off_mm : facets) farthest_mm = std::max(farthest_mm, off_mm);
  }
  return farthest_mm > 0 ? farthest_mm : 1;
}

// What the view must know to read the arrays.
Json json_of(const PageMesh& m) {
  Json json{{"center_mm", {m.center.x, m.center.y, m.center.z}},
            {"scale_mm", m.scale_mm},
            {"vertices", m.coordinates.size() / 3},
            {"tets", m.tets.size() / 4},
            {"facets", m.facets.size() / 3},
            {"colorings", Json::array()}};
  for (const PageColoring& c : m.colorings) json["colorings"].push_back(json_of(c));
  for (const PageColoring& c : m.facet_colorings) json["facet_colorings"].push_back(json_of(c));
  if (!m.regions.empty()) json["regions"] = m.regions;
  if (!m.numbers.empty()) json["numbers"] = m.numbers;
  return json;
}

// What the slices must know to read the voxels.
Json json_of(const ReportScan& scan) {
  const auto list = [](const Vec& v) { return Json{v.x, v.y, v.z}; };
  return {{"size", scan.size},
          {"origin_mm", list(scan.frame.origin())},
          {"columns_mm", {list(scan.frame.column(0)), list(scan.frame.column(1)), list(scan.frame.column(2))}},
          {"low", scan.low},
          {"high", scan.high},
          {"levels", scan.levels},
          {"regions", scan.regions},
          {"note", scan.note}};
}

template <class T>
std::string bytes_of(const std::vector<T>& values) {
  static_assert(std::endian::native == std::endian::little, "otherwise the bytes must be turned round here");
  const auto* const first = reinterpret_cast<const std::uint8_t*>(values.data());
  return base64({first, first + values.size() * sizeof(T)});
}

/// By the bounds that were proved; what has none is as far as can be.
void color_by_certificate(const ReportCertificate& certificate, PageMesh& mesh) {
  const std::vector<double>& bounds = certificate.facets_mm;
  if (bounds.empty()) return;
  double most = 0;
  for (const double bound : bounds) most = std::max(most, bound);
  if (!(most > 0)) return;
  std::vector<double> far = bounds;
  for (double& bound : far) bound = bound < 0 ? most : bound;
  const bool is_of_surface = certificate.proved.certificates.front().is_of_surface;
  color_by_distance(far, most,
                    std::string("distance from the ") + (is_of_surface ? "surface" : "level set") + ", at most", mesh);
}

std::string harmless(const Json& json) {
  std::string text;
  for (const char c : json.dump(-1, ' ', false, Json::error_handler_t::replace)) {
    text += c == '<' ? std::string("\\u003c") : std::string(1, c);
  }
  return text;
}

/// The reports with what a page cannot do without: the measures and the counts of their meshes.
std::vector<Report> measured(std::span<const Report> reports, std::span<const TetMesh> meshes) {
  std::vector<Report> all(reports.begin(), reports.end());
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (!all[i].quality) all[i].quality = measure_quality(meshes[i]);
    if (!all[i].mesh) all[i].mesh = report_mesh(meshes[i], *all[i].quality);
  }
  return all;
}

// Everything of `page` up to the mark, which is left out; the mark ends it.
std::string_view up_to(std::string_view& page, std::string_view mark) {
  const std::size_t at = page.find(mark);
  const std::string_view head = page.substr(0, at);
  page.remove_prefix(at + mark.size());
  return head;
}

}  // namespace

void write_page(std::ostream& out, std::span<const Report> reports, std::span<const TetMesh> meshes,
                std::size_t most_tets, const ReportDifference* difference) {
  const auto is_whole = [](const Report& r) { return r.quality && r.mesh; };
  if (!std::all_of(reports.begin(), reports.end(), is_whole)) {
    write_page(out, measured(reports, meshes), meshes, most_tets, difference);
    return;
  }
  const std::vector<std::string> names = mesh_names(reports);
  std::string_view page = page_files::kFrame;
  const auto element = [&](std::string_view tag, std::string_view content) {
    out << '<' << tag << ">\n" << content << "\n</" << tag.substr(0, tag.find(' ')) << ">\n";
  };
  out << up_to(page, "<!-- style -->");
  element("style", page_files::kStyle);
  out << up_to(page, "<!-- data -->");
  Json data{{"meshes", Json::array()}, {"panels", Json::array()}, {"worst_lists", Json::array()}};
  for (const ReportWorst& list : report_worst_lists()) {
    const auto has_list = [&](const Report& r) { return r.quality && !((*r.quality).*list.tets).empty(); };
    if (std::none_of(reports.begin(), reports.end(), has_list)) continue;
    data["worst_lists"].push_back({{"key", list.key}, {"title", list.title}, {"unit", list.unit}});
  }
  for (std::size_t i = 0; i < reports.size(); ++i) {
    PageMesh mesh = make_page_mesh(meshes[i], *reports[i].quality, most_tets);
    if (difference != nullptr) {
      color_by_distance(difference->mesh.facets_off_mm.at(i), farthest_mm(*difference),
                        "distance from the other mesh's boundary", mesh);
    }
    if (reports[i].certificate) color_by_certificate(*reports[i].certificate, mesh);
    out << "<script type=\"application/octet-stream\" id=\"mesh-" << i << "\">";
    write_arrays(out, mesh);
    out << "</script>\n";
    data["meshes"].push_back(
        {{"name", names[i]}, {"color", mesh_color(i)}, {"report", json_of(reports[i])}, {"geometry", json_of(mesh)}});
    if (!reports[i].scan) continue;
    out << "<script type=\"application/octet-stream\" id=\"scan-" << i << "\">" << bytes_of(reports[i].scan->values)
        << "</script>\n";
    out << "<script type=\"application/octet-stream\" id=\"scan-field-" << i << "\">"
        << bytes_of(reports[i].scan->field) << "</script>\n";
    data["meshes"].back()["scan"] = json_of(*reports[i].scan);
  }
  for (const ChartPanel& panel : chart_panels(reports)) data["panels"].push_back(json_of(panel));
  if (difference != nullptr) data["difference"] = difference_rows_json(*difference, reports);
  element("script type=\"application/json\" id=\"data\"", harmless(data));
  out << up_to(page, "<!-- scripts -->");
  for (const std::string_view script : page_files::kScripts) element("script", script);
  out << page;
}

}  // namespace scantet
