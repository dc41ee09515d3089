// What the forms of a report share, and the choice among them.
#include "scantet/report/report.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <functional>
#include <ostream>

#include "scantet/base/error.h"
#include "scantet/base/file_extension.h"
#include "scantet/io/atomic_file.h"
#include "scantet/report/chart_impl.h"
#include "scantet/report/difference.h"
#include "scantet/report/numbers_impl.h"
#include "scantet/report/page_impl.h"
#include "scantet/report/report_forms.h"

namespace scantet {
namespace {

template <typename Number>
ReportValue number_of(const std::string& text) {
  Number value{};
  const char* const end = text.data() + text.size();
  const auto result = std::from_chars(text.data(), end, value);
  if (result.ec != std::errc() || result.ptr != end) return text;
  return value;
}

ReportValue value_of(const Option& option) {
  const std::vector<std::string> texts = option.read();
  if (option.kind == OptionKind::list) return texts;
  if (texts.empty()) return nullptr;
  if (option.kind == OptionKind::numbers && texts.size() > 1) {
    std::vector<double> numbers;
    numbers.reserve(texts.size());
    for (const std::string& text : texts) numbers.push_back(std::get<double>(number_of<double>(text)));
    return numbers;
  }
  switch (option.kind) {
    case OptionKind::flag:
      return texts.front() == "true";
    case OptionKind::number:
    case OptionKind::numbers:
      return number_of<double>(texts.front());
    case OptionKind::integer:
      return number_of<std::uint64_t>(texts.front());
    default:
      return texts.front();
  }
}

using Reports = std::span<const Report>;
using Meshes = std::span<const TetMesh>;
using Difference = const ReportDifference*;

struct Form {
  std::string extension;
  std::function<void(std::ostream&, Reports, Meshes, Difference)> write;
};

const std::vector<Form>& forms() {
  static const std::vector<Form> all{
      {".json",
       [](std::ostream& out, Reports reports, Meshes, Difference difference) {
         out << (difference != nullptr ? difference_json(*difference, reports) : json_report(reports));
       }},
      {".csv", [](std::ostream& out, Reports reports, Meshes, Difference) { out << csv_report(reports); }},
      {".html", [](std::ostream& out, Reports reports, Meshes meshes,
                   Difference difference) { write_page(out, reports, meshes, kMostTetsInPage, difference); }},
      {".svg", [](std::ostream& out, Reports reports, Meshes, Difference) { write_svg(out, reports); }},
      {".png", [](std::ostream& out, Reports reports, Meshes, Difference) { write_png(out, reports); }}};
  return all;
}

}  // namespace

std::string broken_text(const ReportBound& bound) {
  constexpr int kDigits = 4;
  constexpr int kMostDigits = 9;
  const double worst = bound.worst.value_or(0);
  int digits = kDigits;  // as many as tell the worst from what was asked for
  while (digits < kMostDigits && number_text(worst, digits) == number_text(bound.asked)) ++digits;
  const Point p = bound.place.value_or(Point{});
  return bound.what + (bound.is_least ? " under " : " over ") + number_text(bound.asked) + ": " +
         grouped(bound.broken) + " of " + grouped(bound.of) + ", the worst with " +
         (std::isinf(worst) ? number(worst) : number_text(worst, digits)) + " at (" + number(p.x) + ", " + number(p.y) +
         ", " + number(p.z) + ") mm";
}

std::string short_edges_text(const ReportShortEdges& edges) {
  const ShortEdgePlace& worst = edges.places.front();
  const Point& p = worst.place;
  return grouped(edges.count) + " of " + grouped(edges.of) + (edges.count == 1 ? " edges is" : " edges are") +
         " shorter than " + edges.than + ", at " + grouped(edges.places.size()) +
         (edges.places.size() == 1 ? " place" : " places") + ", the shortest " + number(worst.length_mm) + " mm at (" +
         number(p.x) + ", " + number(p.y) + ", " + number(p.z) + ") mm";
}

ReportMesh report_mesh(const TetMesh& mesh, const QualitySummary& quality) {
  std::vector<bool> used(mesh.vertices.size(), false);  // on_boundary may flag vertices that no facet has
  for (const Triangle& facet : mesh.boundary_facets) {
    for (const VertexId v : facet) used[v] = true;
  }
  const auto count = static_cast<std::uint64_t>(std::count(used.begin(), used.end(), true));
  return {mesh.vertices.size(),     mesh.tets.size(), mesh.boundary_facets.size(), count,
          quality.total_volume_mm3, quality.regions};
}

std::vector<ReportOption> report_options(const OptionSet& options) {
  std::vector<ReportOption> report;
  for (const Option& option : options.options()) report.push_back({option.name, value_of(option)});
  return report;
}

const std::vector<std::string>& report_extensions() {
  static const std::vector<std::string> extensions = [] {
    std::vector<std::string> names;
    for (const Form& form : forms()) names.push_back(form.extension);
    return names;
  }();
  return extensions;
}

void write_report(std::span<const Report> reports, std::span<const TetMesh> meshes, const std::string& path,
                  FileSet* set, const ReportDifference* difference) {
  const std::string extension = file_extension(path);
  for (const Form& form : forms()) {
    if (form.extension == extension) {
      write_file(
          path, [&](std::ostream& out) { form.write(out, reports, meshes, difference); }, set);
      return;
    }
  }
  std::string known;
  for (const Form& form : forms()) known += (known.empty() ? "" : " ") + form.extension;
  throw Error(Fault::usage, "usage.format",
              path + ": " + (extension.empty() ? "no extension" : "unknown extension " + extension) + " for a report",
              "the extension chooses the format: " + known);
}

}  // namespace scantet
