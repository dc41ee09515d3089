// Runs scantet and CGAL Mesh_3 on the same objects at the same criteria, alternating, each run in a process of its own;
// prints tables and writes the runs as JSON. docs/benchmarks.md is made from that; scripts/benchmark.sh does it all.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <exception>
#include <fstream>
#include <memory>
#include <set>
#include <stdexcept>

#include "child.h"
#include "contestants.h"
#include "results.h"

namespace scantet::bench {
namespace {

struct Request {
  std::vector<std::string> cases;
  std::vector<std::string> contestants{kScantetN, kCgalN, kScantet1, kCgal1, kLimit};
  int runs = 0;  ///< 0: what each case says
  int threads = 2;
  bool scaling = false;
  std::string volumes = ".";
  std::string json;
};

Figures run_once(const std::string& contestant, const Case& c, int threads, std::FILE* points) {
  if (contestant == kScantetN) return run_scantet(c, threads, points);
  if (contestant == kScantet1) return run_scantet(c, 1, points);
  if (contestant == kCgalN) return run_cgal_parallel(c, threads);
  if (contestant == kCgal1) return run_cgal_sequential(c);
  return run_limit(points);
}

Run run_in_child(const std::string& contestant, int round, const Case& c, int threads, std::FILE* points) {
  Run run{contestant, round, {}, {}};
  try {
    const auto work = [&] { return nlohmann::json(run_once(contestant, c, threads, points)).dump(); };
    run.figures = nlohmann::json::parse(in_child(work)).get<Figures>();
    std::printf("%s, round %d: %-10s %.3f s\n", c.name.c_str(), round, contestant.c_str(), run.figures.seconds);
  } catch (const std::exception& error) {
    run.error = error.what();
    std::printf("%s, round %d: %-10s %s\n", c.name.c_str(), round, contestant.c_str(), error.what());
  }
  std::fflush(stdout);
  return run;
}

// One run of each contestant a round, so that a slow minute of the machine meets them all.
CaseResults run_case(const Case& c, const Request& request) {
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> points(std::tmpfile(), &std::fclose);
  if (!points) throw std::runtime_error("cannot make a temporary file");
  CaseResults results{c, {}};
  const int rounds = request.runs > 0 ? request.runs : c.runs;
  for (int round = 1; round <= rounds; ++round) {
    for (const std::string& contestant : request.contestants) {
      if (!c.has(contestant)) continue;
      results.runs.push_back(run_in_child(contestant, round, c, request.threads, points.get()));
    }
  }
  return results;
}

std::vector<Case> chosen_cases(const Request& request) {
  const std::set<std::string> wanted(request.cases.begin(), request.cases.end());
  std::vector<Case> chosen;
  for (const Case& c : all_cases(request.volumes)) {
    if (!wanted.empty() && wanted.count(c.name) == 0) continue;
    std::string why;
    if (c.available(why)) {
      chosen.push_back(c);
    } else {
      std::fprintf(stderr, "compare: %s left out: %s\n", c.name.c_str(), why.c_str());
    }
  }
  if (chosen.empty()) throw std::runtime_error("no case is left to run");
  return chosen;
}

// False if a run failed or the threads did not agree.
bool compare(const Request& request, const std::string& command) {
  std::vector<CaseResults> all;
  for (const Case& c : chosen_cases(request)) all.push_back(run_case(c, request));
  for (const CaseResults& results : all) print_tables(results, request.threads);
  if (request.scaling) print_scaling(all);
  const auto json = json_of(all, command, request.threads);
  if (!request.json.empty()) {
    std::ofstream out(request.json);
    out << json.dump(2) << '\n';
    if (!out.flush()) throw std::runtime_error("cannot write " + request.json);
  }
  return std::none_of(json["cases"].begin(), json["cases"].end(), [](const auto& c) {
    return c["same_mesh"] == false ||
           std::any_of(c["runs"].begin(), c["runs"].end(), [](const auto& run) { return run.contains("error"); });
  });
}

std::vector<std::string> names(const std::vector<Case>& cases) {
  std::vector<std::string> found;
  found.reserve(cases.size());
  for (const Case& c : cases) found.push_back(c.name);
  return found;
}

}  // namespace
}  // namespace scantet::bench

int main(int argc, char** argv) {
  using namespace scantet::bench;
  Request request;
  CLI::App app("scantet and CGAL Mesh_3 on the same objects at the same criteria", "compare");
  const auto contestants = request.contestants;
  app.add_option("--cases", request.cases, "default: all")->delimiter(',')->check(CLI::IsMember(names(all_cases(""))));
  app.add_option("--contestants", request.contestants, "in the order of their runs; limit after scantet")
      ->delimiter(',')
      ->check(CLI::IsMember(contestants))
      ->capture_default_str();
  app.add_option("--runs", request.runs, "of each contestant on each case; default: 5, fewer for large meshes")
      ->check(CLI::PositiveNumber);
  app.add_option("--threads", request.threads, "of the contestants called _n")->check(CLI::Range(2, 256));
  app.add_option("--volumes", request.volumes, "the folder with skull.nrrd");
  app.add_option("--json", request.json, "the file to write");
  app.add_flag("--scaling", request.scaling, "scantet alone on the skull at 2, 1 and 0.5 mm");
  CLI11_PARSE(app, argc, argv);
  if (request.scaling) {
    request.cases = {"skull", "skull_1mm", "skull_0.5mm"};
    request.contestants = {kScantetN, kScantet1};
  }
  std::string command = "compare";
  for (int i = 1; i < argc; ++i) command += std::string(" ") + argv[i];
  try {
    return compare(request, command) ? 0 : 1;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "compare: %s\n", error.what());
    return 1;
  }
}
