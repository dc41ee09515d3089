#include "results.h"

#include <CGAL/version.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <ctime>
#include <fstream>
#include <optional>
#include <string_view>
#include <thread>

namespace scantet::bench {
namespace {

using Json = nlohmann::json;
using Values = std::vector<double>;

double median(Values values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  if (values.size() % 2 == 1) return *middle;
  return 0.5 * (*middle + *std::max_element(values.begin(), middle));
}

double least(const Values& values) {
  return *std::min_element(values.begin(), values.end());
}

double most(const Values& values) {
  return *std::max_element(values.begin(), values.end());
}

std::vector<const Figures*> figures_of(const CaseResults& results, const std::string& contestant) {
  std::vector<const Figures*> found;
  for (const Run& run : results.runs) {
    if (run.contestant == contestant && run.error.empty()) found.push_back(&run.figures);
  }
  return found;
}

template <class Number>
Values values_of(const std::vector<const Figures*>& figures, Number Figures::*what) {
  Values values;
  for (const Figures* f : figures) values.push_back(static_cast<double>(f->*what));
  return values;
}

struct Ratio {
  const char* name;
  double of_medians;
  double min;
  double max;
};

std::optional<Ratio> ratio(const CaseResults& results, const char* name, const char* over, const char* under) {
  Values by_round;
  Values overs;
  Values unders;
  for (const Run& a : results.runs) {
    for (const Run& b : results.runs) {
      if (a.contestant != over || b.contestant != under || a.round != b.round) continue;
      if (!a.error.empty() || !b.error.empty()) continue;
      overs.push_back(a.figures.seconds);
      unders.push_back(b.figures.seconds);
      by_round.push_back(overs.back() / unders.back());
    }
  }
  if (by_round.empty()) return std::nullopt;
  return Ratio{name, median(overs) / median(unders), least(by_round), most(by_round)};
}

std::vector<Ratio> ratios(const CaseResults& results) {
  std::vector<Ratio> found;
  for (const auto& [name, over, under] :
       std::array<std::array<const char*, 3>, 4>{{{"CGAL / scantet, threads", kCgalN, kScantetN},
                                                  {"CGAL / scantet, 1 thread", kCgal1, kScantet1},
                                                  {"scantet, threads / limit", kScantetN, kLimit},
                                                  {"scantet, 1 thread / threads", kScantet1, kScantetN}}}) {
    if (const auto r = ratio(results, name, over, under)) found.push_back(*r);
  }
  return found;
}

std::optional<bool> same_mesh(const CaseResults& results) {
  const auto several = figures_of(results, kScantetN);
  const auto one = figures_of(results, kScantet1);
  if (several.empty() || one.empty()) return std::nullopt;
  const auto same = [&](const Figures* f) { return f->mesh_sha256 == one.front()->mesh_sha256; };
  return std::all_of(several.begin(), several.end(), same) && std::all_of(one.begin(), one.end(), same);
}

void print_row(const CaseResults& results, const char* contestant) {
  const auto figures = figures_of(results, contestant);
  if (figures.empty()) return;
  const auto middle = [&](auto what) { return median(values_of(figures, what)); };
  const Values seconds = values_of(figures, &Figures::seconds);
  const double peak = middle(&Figures::peak_bytes);
  const double tets = middle(&Figures::tets);
  std::printf("  %-10s %8.3f %8.3f %8.3f %8.3f %8.2f %9.0f", contestant, median(seconds), least(seconds), most(seconds),
              middle(&Figures::cpu_s), 1e6 * median(seconds) / tets, middle(&Figures::vertices));
  std::printf(" %9.0f %10.0f %8.0f %6.0f", middle(&Figures::boundary_vertices), tets, peak / (1 << 20), peak / tets);
  if (contestant != std::string_view(kLimit)) {  // its tets fill the convex hull: their shape tells nothing
    std::printf(" %5.0f %5.0f %7.0f %8.2f", middle(&Figures::components), middle(&Figures::cavities),
                middle(&Figures::regions), least(values_of(figures, &Figures::min_dihedral_deg)));
    std::printf(" %7.0f %7.3f", middle(&Figures::tets_under_10_deg),
                most(values_of(figures, &Figures::max_radius_edge)));
  }
  std::printf("\n");
}

// "model name : AMD EPYC" -> "AMD EPYC"
std::string line_of(const char* path, const std::string& key) {
  std::ifstream in(path);
  for (std::string line; std::getline(in, line);) {
    const std::size_t colon = line.find(':');
    if (!line.starts_with(key) || colon == std::string::npos) continue;
    return line.substr(std::min(line.find_first_not_of(" \t", colon + 1), line.size()));
  }
  return "unknown";
}

std::string today() {
  const std::time_t now = std::time(nullptr);
  char text[16];
  std::strftime(text, sizeof text, "%Y-%m-%d", std::gmtime(&now));
  return text;
}

Json json_of(const CaseResults& results) {
  const Case& c = results.subject;
  Json json{{"name", c.name}, {"scan", c.object()}, {"criteria", c.criteria()}};
  json["size_mm"] = c.size_mm > 0 ? Json(c.size_mm) : Json(nullptr);
  json["runs"] = Json::array();
  for (const Run& run : results.runs) {
    Json entry{{"contestant", run.contestant}, {"round", run.round}};
    if (run.error.empty()) {
      entry["figures"] = run.figures;
    } else {
      entry["error"] = run.error;
    }
    json["runs"].push_back(entry);
  }
  json["ratios"] = Json::array();
  for (const Ratio& r : ratios(results)) {
    json["ratios"].push_back({{"name", r.name}, {"of_medians", r.of_medians}, {"min", r.min}, {"max", r.max}});
  }
  const auto same = same_mesh(results);
  json["same_mesh"] = same ? Json(*same) : Json(nullptr);
  return json;
}

}  // namespace

void print_tables(const CaseResults& results, int threads) {
  const Case& c = results.subject;
  std::printf("\n%s: %s, %s; \"_n\" and \"threads\": %d threads\n", c.name.c_str(), c.object().c_str(),
              c.criteria().c_str(), threads);
  std::printf("  %-10s %8s %8s %8s %8s %8s %9s %9s %10s", "", "median s", "min s", "max s", "CPU s", "us/tet",
              "vertices", "boundary", "tets");
  std::printf(" %8s %6s %5s %5s %7s %8s %7s %7s\n", "peak MiB", "B/tet", "parts", "cavit", "regions", "min dih",
              "<10 deg", "rad-edg");
  for (const char* contestant : {kScantetN, kScantet1, kCgalN, kCgal1, kLimit}) print_row(results, contestant);
  for (const Ratio& r : ratios(results)) {
    std::printf("  %-28s %6.2f   (rounds: %.2f to %.2f)\n", r.name, r.of_medians, r.min, r.max);
  }
  if (const auto same = same_mesh(results)) {
    std::printf("  scantet's mesh on 1 and %d threads: %s\n", threads, *same ? "the same bytes" : "DIFFERENT");
  }
  const auto ours = figures_of(results, kScantetN);
  if (!ours.empty() && ours.front()->object_components > 0) {
    std::printf("  components of the object: %llu; cavities: %llu\n",
                static_cast<unsigned long long>(ours.front()->object_components),
                static_cast<unsigned long long>(ours.front()->object_cavities));
  }
  std::uint64_t unmet = 0;
  for (const Run& run : results.runs) unmet += run.figures.unmet;
  if (unmet > 0) std::printf("  elements that break a rule: %llu\n", static_cast<unsigned long long>(unmet));
}

void print_scaling(const std::vector<CaseResults>& all) {
  for (const char* contestant : {kScantetN, kScantet1}) {
    double first = 0;
    for (const CaseResults& results : all) {
      const auto figures = figures_of(results, contestant);
      if (figures.empty() || results.subject.object() != all.front().subject.object()) continue;
      const double tets = static_cast<double>(figures.front()->tets);
      const double each = 1e6 * median(values_of(figures, &Figures::seconds)) / tets;
      if (first == 0) std::printf("\n%s\n", contestant);
      if (first == 0) first = each;
      std::printf("  %-20s %11.0f tets  %7.3f µs/tet (%+.0f %%)  %5.0f B/tet\n", results.subject.criteria().c_str(),
                  tets, each, 100 * (each / first - 1), median(values_of(figures, &Figures::peak_bytes)) / tets);
    }
  }
}

nlohmann::json json_of(const std::vector<CaseResults>& all, const std::string& command, int threads) {
  Json json{{"command", command}, {"date", today()}, {"threads", threads}};
  json["machine"] = {{"cpu", line_of("/proc/cpuinfo", "model name")},
                     {"cores", std::thread::hardware_concurrency()},
                     {"memory", line_of("/proc/meminfo", "MemTotal")},
                     {"compiler", "GCC " __VERSION__},
                     {"cgal", CGAL_VERSION_STR}};
  json["cases"] = Json::array();
  for (const CaseResults& results : all) json["cases"].push_back(json_of(results));
  return json;
}

}  // namespace scantet::bench
