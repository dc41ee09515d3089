// The mesh is measured before anything is built of it: most of the time there is little to do, or nothing. Improvement
// has exudation's way of reconnecting among its own, so that exuding first would gain it nothing.
#include "scantet/optimize/optimizer.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <utility>

#include "scantet/base/error.h"
#include "scantet/base/options.h"
#include "scantet/base/parallel.h"
#include "scantet/base/stopwatch.h"
#include "scantet/optimize/exudation_impl.h"
#include "scantet/optimize/improvement_impl.h"

namespace scantet {
namespace {

struct Measure {
  double squared_sine = 1;                                       // of the smallest dihedral angle
  double least_share = std::numeric_limits<double>::infinity();  // of what is asked of a tet

  void add(double sine, double share) {
    squared_sine = std::min(squared_sine, sine);
    least_share = std::min(least_share, share);
  }
  double min_dihedral_deg() const { return std::asin(std::sqrt(squared_sine)) * 180 / std::numbers::pi; }
};

Measure measure(const TetMesh& mesh, const optimize::TetJudge& judge) {
  constexpr std::size_t kGrain = 8192;
  const auto& p = mesh.vertices;
  std::vector<Measure> pieces((mesh.tets.size() + kGrain - 1) / kGrain);
  parallel_for(mesh.tets.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    Measure piece;
    for (std::size_t i = begin; i < end; ++i) {
      const Tet& t = mesh.tets[i];
      const optimize::TetShares shares = judge.shares(p[t[0]], p[t[1]], p[t[2]], p[t[3]]);
      piece.add(shares.squared_sine, shares.least());
    }
    pieces[begin / kGrain] = piece;
  });
  Measure whole;
  for (const Measure& piece : pieces) whole.add(piece.squared_sine, piece.least_share);
  return whole;
}

/// Whether a boundary facet breaks R1 or R2, if these are asked for.
bool has_bad_facets(const TetMesh& mesh, const Domain& domain, const ElementBounds& bounds) {
  if (!bounds.rules) return false;
  constexpr std::size_t kGrain = 4096;
  const optimize::FacetJudge judge(domain, *bounds.rules);
  std::atomic<bool> found = false;
  parallel_for(mesh.boundary_facets.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    Crossings crossings;
    for (std::size_t i = begin; i < end; ++i) {
      const Triangle& f = mesh.boundary_facets[i];
      if (judge.shares({mesh.vertices[f[0]], mesh.vertices[f[1]], mesh.vertices[f[2]]}, crossings).least() < 1) {
        found = true;
      }
    }
  });
  return found;
}

void check(const ElementBounds& bounds) {
  const auto refuse_outside = [](const char* name, double value, double least, double most) {
    if (value >= least && value <= most) return;
    throw Error(Fault::usage, "usage.option",
                std::string(name) + " is " + std::to_string(value) + ", it must be in " + number_text(least) + " … " +
                    number_text(most),
                "look at the range in --help");
  };
  refuse_outside("min-dihedral", bounds.min_dihedral_deg, 0, kMostMinDihedralDeg);
  refuse_outside("max-dihedral", bounds.max_dihedral_deg, kLeastMaxDihedralDeg, 180);
  refuse_outside("min-scaled-jacobian", bounds.min_scaled_jacobian, 0, kMostScaledJacobian);
}

/// Does the work; returns how many changes it made.
std::uint64_t change(TetMesh& mesh, const Domain& domain, const OptimizerOptions& options,
                     const optimize::TetJudge& judge, Progress& progress) {
  optimize::TetComplex complex(std::move(mesh), judge);
  std::optional<optimize::FacetJudge> facets;
  if (options.bounds.rules) facets.emplace(domain, *options.bounds.rules);
  const std::uint64_t changes = options.optimize == Optimize::full
                                    ? optimize::improve(complex, domain, facets ? &*facets : nullptr, progress)
                                    : optimize::exude(complex, progress);
  mesh = complex.release();
  return changes;
}

}  // namespace

OptimizerResult optimize_mesh(TetMesh& mesh, const Domain& domain, const OptimizerOptions& options,
                              Progress& progress) {
  check(options.bounds);
  const Stopwatch watch;
  const optimize::TetJudge judge(options.bounds);
  Measure quality = measure(mesh, judge);
  OptimizerResult result;
  const bool may_help =
      quality.least_share < 1 || (options.optimize == Optimize::full && has_bad_facets(mesh, domain, options.bounds));
  if (options.optimize != Optimize::none && may_help) {
    OptimizerStage stage;
    stage.stage = options.optimize == Optimize::full ? "improve" : "exude";
    stage.min_dihedral_before_deg = quality.min_dihedral_deg();
    stage.changes = change(mesh, domain, options, judge, progress);
    quality = measure(mesh, judge);
    stage.min_dihedral_after_deg = quality.min_dihedral_deg();
    stage.seconds = watch.seconds();
    result.stages.push_back(stage);
  }
  result.min_dihedral_deg = quality.min_dihedral_deg();
  result.cancelled = progress.cancelled();
  return result;
}

}  // namespace scantet
