// How fast the oracle of any input answers: region queries at random points of its box, and segment queries along
// random segments of the length of the input's default size (as dual edges have it), those of them that cross, and
// whole lines through the box.
//
//   plugin_speed INPUT [--benchmark_… flags]      e.g. plugin_speed implicit:tanglecube
#include <benchmark/benchmark.h>

#include <cstdio>
#include <exception>
#include <functional>
#include <random>
#include <vector>

#include "inputs.h"
#include "queries.h"

namespace {

using scantet::Point;
using scantet::Segment;
using scantet::bench::ask_crossings;
using scantet::bench::ask_regions;

constexpr int kQuestions = 20'000;

struct Questions {
  std::vector<Point> points;
  std::vector<Segment> edges;
  std::vector<Segment> crossing_edges;
  std::vector<Segment> lines;
};

Questions questions_about(const scantet::Domain& domain, double size_mm) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> unit(0, 1);
  const scantet::Box box = domain.bounds();
  const auto point = [&] {
    Point p;
    for (int axis = 0; axis < 3; ++axis) p[axis] = box.min[axis] + unit(random) * box.extent()[axis];
    return p;
  };
  Questions questions;
  scantet::Crossings crossings;
  while (questions.crossing_edges.size() < kQuestions) {
    const Point p = point();
    const Point q = point();
    const Segment edge{p, p + (size_mm / distance(p, q)) * (q - p)};
    domain.crossings(edge, crossings);
    if (!crossings.empty()) questions.crossing_edges.push_back(edge);
    if (questions.points.size() == kQuestions) continue;
    questions.points.push_back(p);
    questions.edges.push_back(edge);
    questions.lines.push_back({p, q});
  }
  return questions;
}

void run(const std::string& input) {
  const scantet::OpenedDomain opened = scantet::bench::open_input(input);
  const scantet::Domain& domain = *opened.domain;
  const Questions questions = questions_about(domain, opened.default_size_mm);
  using benchmark::RegisterBenchmark;
  RegisterBenchmark("region_at", ask_regions, std::cref(domain), std::cref(questions.points));
  RegisterBenchmark("crossings/edges", ask_crossings, std::cref(domain), std::cref(questions.edges));
  RegisterBenchmark("crossings/edges_that_cross", ask_crossings, std::cref(domain),
                    std::cref(questions.crossing_edges));
  RegisterBenchmark("crossings/lines", ask_crossings, std::cref(domain), std::cref(questions.lines));
  benchmark::RunSpecifiedBenchmarks();
}

}  // namespace

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);  // takes its own flags out
  if (argc != 2) {
    std::fprintf(stderr, "usage: plugin_speed INPUT [--benchmark_... flags]\n");
    return 2;
  }
  try {
    run(argv[1]);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "plugin_speed: %s\n", error.what());
    return 1;
  }
  return 0;
}
