// What the Cairo drawing and the page's charts share. A histogram's counts become a density; a bin that holds "all
// above" is as wide as its neighbours, however far its largest value lies.
#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <numeric>
#include <set>

#include "scantet/report/chart_impl.h"
#include "scantet/report/measures_impl.h"

namespace scantet {
namespace {

ChartCurve curve_of(std::size_t mesh, const Distribution& d, bool open_ended) {
  ChartCurve curve{mesh, d.histogram.edges, {}, d.min, d.max};
  std::vector<double>& e = curve.edges;
  const std::size_t bins = d.histogram.counts.size();
  if (open_ended) e[bins] = e[bins - 1] + (e[1] - e[0]);
  for (std::size_t i = 0; i < bins; ++i) {
    const double share = static_cast<double>(d.histogram.counts[i]) / static_cast<double>(d.count);
    curve.density.push_back(share / (e[i + 1] - e[i]));
  }
  return curve;
}

ChartPanel panel_of(const MeasureAxis& axis, std::vector<ChartCurve> curves) {
  ChartPanel panel{axis.title, axis.label, axis.unit,       axis.density, axis.low,
                   axis.low,   0,          axis.open_ended, {},           std::move(curves)};
  for (const ChartCurve& curve : panel.curves) {
    panel.low = std::min(panel.low, curve.edges.front());
    panel.high = std::max(panel.high, curve.edges.back());
    panel.highest = std::max(panel.highest, *std::max_element(curve.density.begin(), curve.density.end()));
  }
  panel.high = axis.high.value_or(panel.high);
  constexpr int kTicks = 6;
  panel.ticks = round_ticks(panel.low, panel.high, axis.tick_step, kTicks);
  return panel;
}

// Bytes that are not UTF-8 are replaced, as in the JSON.
std::string valid_utf8(const std::string& text) {
  using Json = nlohmann::json;
  return Json::parse(Json(text).dump(-1, ' ', false, Json::error_handler_t::replace)).get<std::string>();
}

}  // namespace

std::vector<double> round_ticks(double low, double high, double step, int count) {
  if (step == 0) {
    const double wanted = (high - low) / count;
    const double power = std::pow(10, std::floor(std::log10(wanted)));
    const double digits = wanted / power;
    step = power * (digits < 1.5 ? 1 : digits < 3.5 ? 2 : digits < 7.5 ? 5 : 10);
  }
  constexpr double kRounding = 1e-9;
  std::vector<double> ticks;
  const double first = std::ceil(low / step - kRounding);
  const double last = std::floor(high / step + kRounding);
  for (double i = first; i <= last; ++i) ticks.push_back(i * step + 0.0);
  return ticks;
}

std::vector<ChartPanel> chart_panels(std::span<const Report> reports) {
  std::vector<ChartPanel> panels;
  for (const ReportMeasure& measure : report_measures()) {
    if (!measure.axis) continue;
    std::vector<ChartCurve> curves;
    for (std::size_t i = 0; i < reports.size(); ++i) {
      if (!reports[i].quality) continue;
      const Distribution* const d = measure.distribution(*reports[i].quality);
      if (d != nullptr && d->count > 0) curves.push_back(curve_of(i, *d, measure.axis->open_ended));
    }
    if (!curves.empty()) panels.push_back(panel_of(*measure.axis, std::move(curves)));
  }
  return panels;
}

// Okabe and Ito's palette without its yellow, which is lost on white.
std::string mesh_color(std::size_t mesh) {
  static constexpr std::array<const char*, kMeshColors> kColors{"#0072b2", "#d55e00", "#009e73", "#cc79a7",
                                                                "#56b4e9", "#e69f00", "#000000"};
  return kColors[mesh % kColors.size()];
}

std::vector<std::string> mesh_names(std::span<const Report> reports) {
  std::vector<std::string> paths;
  std::map<std::string, std::set<std::string>> paths_of_name;
  const auto name_of = [](const std::string& path) {
    const std::string name = std::filesystem::path(path).filename().string();
    return name.empty() ? path : name;
  };
  for (std::size_t i = 0; i < reports.size(); ++i) {
    paths.push_back(reports[i].input ? reports[i].input->path : "mesh " + std::to_string(i + 1));
    paths_of_name[name_of(paths.back())].insert(paths.back());
  }
  std::vector<std::string> names;
  std::map<std::string, int> seen;
  for (const std::string& path : paths) {
    const int times = ++seen[path];
    const std::string name = name_of(path);
    const std::string unique = paths_of_name[name].size() == 1 ? name : path;
    names.push_back(valid_utf8(times == 1 ? unique : unique + " (" + std::to_string(times) + ")"));
  }
  return names;
}

}  // namespace scantet
