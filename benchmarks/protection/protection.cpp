// Curves and corners protected with weights and without, side by side; and what weights cost a triangulation that needs
// none.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <random>

#include "measure.h"

namespace scantet::bench {
namespace {

struct Options {
  std::vector<double> sizes{4, 2, 1};
  int seeds = 5;
  std::vector<std::string> methods{"W", "U", "S", "C"};
  std::vector<std::string> cases;
  bool speed = false;
  RefinementBounds bounds;
};

/// Over all rotations of a case at one size.
struct Summary {
  int runs = 0, capped = 0, loose = 0;
  int segments = 0, held = 0, stray = 0, off_patch = 0, bad_facets = 0, bad_tets = 0, refused = 0, splits = 0;
  long long sharp = 0, sharp_away = 0, vertices = 0, tets = 0;
  double off_mm = 0, least = 180, largest = 0, facet_angle = 180, shortest = 1e9, seconds = 0;

  void add(const Refined& mesh, const Figures& f) {
    ++runs;
    capped += mesh.capped;
    loose += mesh.loose;
    segments += f.segments;
    held += f.held;
    stray += f.stray_edges;
    off_patch += mesh.off_patch;
    bad_facets += mesh.bad_facets;
    bad_tets += mesh.bad_tets;
    refused += mesh.refused;
    splits += mesh.splits;
    sharp += f.sharp;
    sharp_away += f.sharp_away;
    vertices += static_cast<long long>(mesh.vertices.size()) - 8;
    tets += static_cast<long long>(mesh.tets.size());
    off_mm = std::max({off_mm, f.to_curve, f.from_curve});
    least = std::min(least, f.least_dihedral);
    largest = std::max(largest, f.largest_dihedral);
    facet_angle = std::min(facet_angle, f.least_facet_angle);
    shortest = std::min(shortest, f.shortest);
    seconds += mesh.seconds;
  }

  void print(const std::string& name, double size, const std::string& method) const {
    std::printf(
        "| %s | %g | %s | %d of %d | %d of %d | %d | %d | %.3f | %d | %d | %d | %d | %.2f to %.1f | %lld | %lld | %.1f "
        "| %.3f | %lld | %lld | %.2f |\n",
        name.c_str(), size, method.c_str(), runs - capped, runs, held, segments, stray, off_patch, off_mm, refused,
        splits, bad_facets, bad_tets, least, largest, sharp, sharp_away, facet_angle, shortest, vertices / runs,
        tets / runs, seconds / runs);
    if (loose > 0) {
      std::printf("(%s, %g, %s: %d pairs of balls overlap that should not, or the other way round)\n", name.c_str(),
                  size, method.c_str(), loose);
    }
    std::fflush(stdout);
  }
};

void print_heading() {
  std::printf(
      "| domain | size, mm | method | ended | segments held | stray edges | facets off their patch | curve off, mm | "
      "refused | "
      "split | bad facets | bad tets | dihedral angles, deg | under 10 deg | of them off curves | least facet angle, "
      "deg | "
      "shortest edge / size | vertices | tets | s |\n|");
  for (int i = 0; i < 20; ++i) std::printf(" --- |");
  std::printf("\n");
}

Refined refine(const Arrangement& domain, const std::string& method, const RefinementBounds& bounds, unsigned seed) {
  if (method == "W") return refine_regular(domain, bounds, seed);
  return refine_delaunay(domain,
                         method == "U"   ? Method::kRefuse
                         : method == "S" ? Method::kSplit
                                         : Method::kCollar,
                         bounds, seed);
}

void compare(const Options& options) {
  print_heading();
  for (const NamedCase& named : all_cases()) {
    if (!options.cases.empty() &&
        std::none_of(options.cases.begin(), options.cases.end(), [&](const std::string& c) { return c == named.name; }))
      continue;
    for (const double size : options.sizes) {
      for (const std::string& method : options.methods) {
        Summary summary;
        for (int seed = 1; seed <= options.seeds; ++seed) {
          const Arrangement domain = named.make(static_cast<unsigned>(seed));
          RefinementBounds bounds = options.bounds;
          bounds.size_mm = size;
          const Refined mesh = refine(domain, method, bounds, static_cast<unsigned>(seed));
          summary.add(mesh, measure(domain, mesh, size));
        }
        summary.print(named.name, size, method);
      }
    }
  }
}

/// A body-centred cubic lattice in a ball, slightly moved as the last bits of a rotation do, and as many points of the
/// ball's surface as lie at that spacing: about what refinement starts from.
std::vector<Point> typical_points(int count) {
  std::vector<Point> points;
  std::mt19937 random(7);
  std::normal_distribution<double> normal;
  const double radius = std::cbrt(count * 0.9 * 3 / (8 * 3.141592653589793));
  const int reach = static_cast<int>(radius) + 1;
  const Vec x = unit({1, 0.4, 0.2}), y = unit(cross(x, {0.1, 0.3, 1})), z = cross(x, y);
  for (int i = -reach; i <= reach; ++i) {
    for (int j = -reach; j <= reach; ++j) {
      for (int k = -reach; k <= reach; ++k) {
        for (const double half : {0.0, 0.5}) {
          const Point p = (i + half) * x + (j + half) * y + (k + half) * z;
          if (length(p) < radius - 0.4) points.push_back(p);
        }
      }
    }
  }
  while (static_cast<int>(points.size()) < count) {
    const double a = normal(random), b = normal(random), c = normal(random);
    points.push_back(radius * unit(Vec{a, b, c}));
  }
  points.resize(count);
  return points;
}

void measure_speed() {
  std::printf("\nBytes of a cell: Delaunay %zu, regular %zu.\n\n", delaunay_cell_bytes(), regular_cell_bytes());
  std::printf(
      "| points | round | Delaunay, s | regular with weights 0, s | ratio |\n| --- | --- | --- | --- | --- |\n");
  for (const int count : {100000, 500000}) {
    const std::vector<Point> points = typical_points(count);
    for (int round = 1; round <= 3; ++round) {
      const double plain = delaunay_seconds(points), weighted = regular_seconds(points);
      std::printf("| %d | %d | %.2f | %.2f | %.2f |\n", count, round, plain, weighted, weighted / plain);
      std::fflush(stdout);
    }
  }
}

}  // namespace
}  // namespace scantet::bench

int main(int argc, char** argv) {
  scantet::bench::Options options;
  CLI::App app{"Protects curves and corners with weights (W) and without (U, S, C), and measures what comes of it."};
  app.add_option("--size", options.sizes, "sizes, mm");
  app.add_option("--seeds", options.seeds, "rotations of every domain");
  app.add_option("--method", options.methods,
                 "W: weights; U: refusals; S: refusals and splits; C: refusals and collars");
  app.add_option("--case", options.cases, "names of domains (default: all)");
  app.add_option("--split-floor", options.bounds.split_floor, "S: segments longer than this many sizes may be split");
  app.add_option("--most-vertices", options.bounds.most_vertices, "where a run is given up");
  app.add_flag("--speed", options.speed, "only time the kernels: Delaunay and regular with weights of zero");
  CLI11_PARSE(app, argc, argv);
  if (options.speed) {
    scantet::bench::measure_speed();
  } else {
    scantet::bench::compare(options);
  }
}
