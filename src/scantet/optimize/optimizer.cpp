// The mesh is measured before anything is built of it: most of the time there is little to do, or nothing. Improvement
// has exudation's way of reconnecting among its own, so that exuding first would gain it nothing.
#include "scantet/optimize/optimizer.h"

#include <algorithm>
#include <string>
#include <utility>

#include "scantet/base/error.h"
#include "scantet/base/parallel.h"
#include "scantet/base/stopwatch.h"
#include "scantet/optimize/exudation_impl.h"
#include "scantet/optimize/improvement_impl.h"

namespace scantet {
namespace {

struct Measure {
  double sharpest = -1;     // sharpness of the sharpest tet
  std::uint64_t below = 0;  // tets that are sharper than the bound
};

Measure measure(const TetMesh& mesh, double bound) {
  constexpr std::size_t kGrain = 8192;
  const auto& p = mesh.vertices;
  std::vector<Measure> pieces((mesh.tets.size() + kGrain - 1) / kGrain);
  parallel_for(mesh.tets.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    Measure piece;
    for (std::size_t i = begin; i < end; ++i) {
      const Tet& t = mesh.tets[i];
      const double sharpness = optimize::tet_sharpness(p[t[0]], p[t[1]], p[t[2]], p[t[3]]);
      piece.sharpest = std::max(piece.sharpest, sharpness);
      if (sharpness > bound) ++piece.below;
    }
    pieces[begin / kGrain] = piece;
  });
  Measure whole;
  for (const Measure& piece : pieces) {
    whole.sharpest = std::max(whole.sharpest, piece.sharpest);
    whole.below += piece.below;
  }
  return whole;
}

void check(const OptimizerOptions& options) {
  constexpr double kLargest = 60;
  if (options.min_dihedral_deg >= 0 && options.min_dihedral_deg <= kLargest) return;
  throw Error(Fault::usage, "usage.option",
              "min-dihedral is " + std::to_string(options.min_dihedral_deg) + " degrees, it must be in 0 … 60",
              "ask for 10 to 30");
}

/// Does the work; returns how many changes it made.
std::uint64_t change(TetMesh& mesh, const Domain& domain, const OptimizerOptions& options, Progress& progress) {
  optimize::TetComplex complex(std::move(mesh));
  const std::uint64_t changes = options.optimize == Optimize::full
                                    ? optimize::improve(complex, domain, options.min_dihedral_deg, progress)
                                    : optimize::exude(complex, options.min_dihedral_deg, progress);
  mesh = complex.release();
  return changes;
}

}  // namespace

OptimizerResult optimize_mesh(TetMesh& mesh, const Domain& domain, const OptimizerOptions& options,
                              Progress& progress) {
  check(options);
  const Stopwatch watch;
  const double bound = optimize::sharpness_of_angle(options.min_dihedral_deg);
  Measure quality = measure(mesh, bound);
  OptimizerResult result;
  if (options.optimize != Optimize::none && quality.below > 0) {
    OptimizerStage stage;
    stage.stage = options.optimize == Optimize::full ? "improve" : "exude";
    stage.min_dihedral_before_deg = optimize::angle_of_sharpness(quality.sharpest);
    stage.changes = change(mesh, domain, options, progress);
    quality = measure(mesh, bound);
    stage.min_dihedral_after_deg = optimize::angle_of_sharpness(quality.sharpest);
    stage.seconds = watch.seconds();
    result.stages.push_back(stage);
  }
  result.tets_below = quality.below;
  result.min_dihedral_deg = optimize::angle_of_sharpness(quality.sharpest);
  result.cancelled = progress.cancelled();
  return result;
}

}  // namespace scantet
