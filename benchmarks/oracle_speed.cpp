// How fast the trilinear oracle answers what a mesher asks: region queries at the circumcentres of a real Delaunay
// mesh, segment queries along its dual edges, and the questions about the whole that come before.
//
//   oracle_speed SCAN LEVEL SIZE_MM [--benchmark_… flags]
#include <CGAL/Delaunay_triangulation_3.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <benchmark/benchmark.h>

#include <cstdio>
#include <cstdlib>
#include <exception>
#include <functional>
#include <vector>

#include "queries.h"
#include "scantet/base/parallel.h"
#include "scantet/image/level_set.h"
#include "scantet/reading/scan_reader.h"
#include "scantet/refine/mesher.h"

namespace {

using scantet::Point;
using scantet::Segment;
using scantet::bench::ask_crossings;
using scantet::bench::ask_regions;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Delaunay = CGAL::Delaunay_triangulation_3<Kernel>;

/// What is asked: in the order of CGAL's cells and facets, so with the locality that a mesher has.
struct Questions {
  std::vector<Point> circumcentres;
  std::vector<Segment> dual_edges;
  std::vector<Segment> crossing_edges;  // the dual edges that meet the boundary
};

/// The oracle's three queries without what it knows of its topology: noise asks for a far finer mesh than the size
/// does.
class WithoutTopology final : public scantet::Domain {
 public:
  explicit WithoutTopology(const scantet::Domain& domain) : domain_(domain) {}
  scantet::Box bounds() const override { return domain_.bounds(); }
  scantet::Region region_at(const Point& p) const override { return domain_.region_at(p); }
  void crossings(const Segment& segment, scantet::Crossings& out) const override { domain_.crossings(segment, out); }
  void surface_candidates(double spacing_mm, const scantet::PointSink& sink) const override {
    domain_.surface_candidates(spacing_mm, sink);
  }

 private:
  const scantet::Domain& domain_;
};

Questions questions_of_mesh(const scantet::Domain& domain, double size_mm) {
  scantet::Progress progress;
  scantet::MesherOptions options;
  options.max_vertices = 200'000;  // questions enough, and a short run
  const scantet::MeshResult mesh =
      scantet::mesh_domain(WithoutTopology(domain), scantet::UniformSize(size_mm), options, progress);
  std::vector<Kernel::Point_3> points;
  for (const Point& p : mesh.sample) points.emplace_back(p.x, p.y, p.z);
  const Delaunay delaunay(points.begin(), points.end());

  const scantet::Box bounds = domain.bounds();
  const auto centre = [&](Delaunay::Cell_handle cell) {
    const Kernel::Point_3 p = delaunay.dual(cell);
    return Point{p.x(), p.y(), p.z()};
  };
  Questions questions;
  for (const auto cell : delaunay.finite_cell_handles()) {
    const Point p = centre(cell);
    if (bounds.contains(p)) questions.circumcentres.push_back(p);
  }
  scantet::Crossings crossings;
  for (const auto& [cell, i] : delaunay.finite_facets()) {
    const auto neighbor = cell->neighbor(i);
    if (delaunay.is_infinite(cell) || delaunay.is_infinite(neighbor)) continue;
    const Segment edge{centre(cell), centre(neighbor)};
    if (!bounds.contains(edge.source) || !bounds.contains(edge.target)) continue;
    questions.dual_edges.push_back(edge);
    domain.crossings(edge, crossings);
    if (!crossings.empty()) questions.crossing_edges.push_back(edge);
  }
  std::printf("%zu points, %zu circumcentres, %zu dual edges, %zu of them cross\n", mesh.sample.size(),
              questions.circumcentres.size(), questions.dual_edges.size(), questions.crossing_edges.size());
  return questions;
}

void ask_candidates(benchmark::State& state, const scantet::Domain& domain, double spacing_mm) {
  std::int64_t points = 0;
  scantet::with_threads(state.range(0), [&] {
    for (auto _ : state) {
      domain.surface_candidates(spacing_mm, [&points](const Point&) { ++points; });
    }
  });
  state.SetItemsProcessed(points);
}

/// A new domain each time, as its answers about the whole are kept.
void set_up(benchmark::State& state, const scantet::Scan& scan, const scantet::LevelSetSettings& settings) {
  std::int64_t features = 0;
  scantet::with_threads(state.range(0), [&] {
    for (auto _ : state) {
      const auto domain = scantet::make_level_set(scan, settings);
      domain->size_hints([&features](const scantet::SizeHint&) { ++features; });
    }
  });
  state.SetItemsProcessed(state.iterations() * scan.voxel_count());
  state.counters["features"] = static_cast<double>(features) / static_cast<double>(state.iterations());
}

void run(const char* path, double level, double size_mm) {
  scantet::Progress progress;
  const scantet::Scan scan = scantet::read_scan(path, progress);
  const scantet::LevelSetSettings settings{level, scantet::InsideSide::above, std::nullopt};
  const auto domain = scantet::make_level_set(scan, settings);
  const Questions questions = questions_of_mesh(*domain, size_mm);
  using benchmark::RegisterBenchmark;
  RegisterBenchmark("region_at/circumcentres", ask_regions, std::cref(*domain), std::cref(questions.circumcentres));
  RegisterBenchmark("crossings/dual_edges", ask_crossings, std::cref(*domain), std::cref(questions.dual_edges));
  RegisterBenchmark("crossings/dual_edges_that_cross", ask_crossings, std::cref(*domain),
                    std::cref(questions.crossing_edges));
  for (const int threads : {1, 2}) {
    const auto on_wall = [threads](benchmark::internal::Benchmark* b) {
      b->ArgName("threads")->Arg(threads)->Unit(benchmark::kMillisecond)->UseRealTime();
    };
    on_wall(RegisterBenchmark("surface_candidates", ask_candidates, std::cref(*domain), size_mm / 2));
    on_wall(RegisterBenchmark("make_level_set+features", set_up, std::cref(scan), settings));
  }
  benchmark::RunSpecifiedBenchmarks();
}

}  // namespace

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);  // takes its own flags out
  if (argc != 4) {
    std::fprintf(stderr, "usage: oracle_speed SCAN LEVEL SIZE_MM [--benchmark_... flags]\n");
    return 2;
  }
  try {
    run(argv[1], std::atof(argv[2]), std::atof(argv[3]));
  } catch (const std::exception& error) {
    std::fprintf(stderr, "oracle_speed: %s\n", error.what());
    return 1;
  }
  return 0;
}
