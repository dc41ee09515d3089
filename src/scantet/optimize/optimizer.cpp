// The mesh is measured before anything is built of it: most of the time there is little to do, or nothing. Improvement
// has exudation's way of reconnecting among its own, so that exuding first would gain it nothing.
#include "scantet/optimize/optimizer.h"

#include <algorithm>
#include <optional>
#include <string>
#include <utility>

#include "scantet/base/error.h"
#include "scantet/base/mesh_topology.h"
#include "scantet/base/options.h"
#include "scantet/base/parallel.h"
#include "scantet/base/stopwatch.h"
#include "scantet/domain/patch_pieces.h"
#include "scantet/optimize/coarsening_impl.h"
#include "scantet/optimize/exudation_impl.h"
#include "scantet/optimize/improvement_impl.h"
#include "scantet/optimize/short_edges_impl.h"

namespace scantet {
namespace {

constexpr std::size_t kGrain = 8192;

/// The smallest dihedral angle of the mesh.
double min_dihedral_deg(const TetMesh& mesh) {
  const auto& p = mesh.vertices;
  std::vector<double> pieces((mesh.tets.size() + kGrain - 1) / kGrain, -1);
  parallel_for(mesh.tets.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    double sharpest = -1;
    for (std::size_t i = begin; i < end; ++i) {
      const Tet& t = mesh.tets[i];
      sharpest = std::max(sharpest, optimize::tet_sharpness(p[t[0]], p[t[1]], p[t[2]], p[t[3]]));
    }
    pieces[begin / kGrain] = sharpest;
  });
  return pieces.empty() ? 0 : optimize::angle_of_sharpness(*std::max_element(pieces.begin(), pieces.end()));
}

/// Lists the tets that break a bound.
std::vector<optimize::TetId> bad_tets(const TetMesh& mesh, const optimize::TetJudge& judge) {
  const auto& p = mesh.vertices;
  const optimize::TetJudge curve_judge = judge.without_rules();
  const auto find = [&](std::size_t begin, std::size_t end, std::vector<optimize::TetId>& found) {
    for (std::size_t i = begin; i < end; ++i) {
      const Tet& t = mesh.tets[i];
      const optimize::TetJudge& its_judge = touches_curve(mesh, t) ? curve_judge : judge;
      if (!its_judge.keeps_all(p[t[0]], p[t[1]], p[t[2]], p[t[3]])) found.push_back(static_cast<optimize::TetId>(i));
    }
  };
  return parallel_collect<optimize::TetId>(mesh.tets.size(), kGrain, find);
}

/// Lists the tets behind boundary facets that break R1 or R2; a tet behind several of them several times.
std::vector<optimize::TetId> behind_bad_facets(const TetMesh& mesh, const optimize::FacetJudge& judge) {
  const auto find = [&](std::size_t begin, std::size_t end, std::vector<Triangle>& found) {
    Crossings crossings;
    for (std::size_t i = begin; i < end; ++i) {
      const Triangle& f = mesh.boundary_facets[i];
      if (touches_curve(mesh, f)) continue;
      const optimize::Corners corners{mesh.vertices[f[0]], mesh.vertices[f[1]], mesh.vertices[f[2]]};
      if (judge.shares(corners, crossings).least() < 1) found.push_back(f);
    }
  };
  std::vector<Triangle> facets = parallel_collect<Triangle>(mesh.boundary_facets.size(), kGrain, find);
  if (facets.empty()) return {};
  for (Triangle& f : facets) std::sort(f.begin(), f.end());
  std::sort(facets.begin(), facets.end());
  std::vector<optimize::TetId> behind;
  for (std::size_t i = 0; i < mesh.tets.size(); ++i) {
    for (int k = 0; k < 4; ++k) {
      Triangle face = face_of(mesh.tets[i], k);
      std::sort(face.begin(), face.end());
      if (std::binary_search(facets.begin(), facets.end(), face)) behind.push_back(static_cast<optimize::TetId>(i));
    }
  }
  return behind;
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
  if (!bounds.min_edge) return;
  refuse_outside("min-edge", bounds.min_edge->mm, 0, std::numeric_limits<double>::max());
  refuse_outside("min-edge", bounds.min_edge->share, 0, kMostMinEdgeShare);
}

/// Adds a stage to the result, which has the mesh's least dihedral angle. watch: started with the stage. work(complex):
/// changes the mesh, and returns how often.
template <class Work>
void run_stage(const char* name, TetMesh& mesh, const Domain& domain, const optimize::TetJudge& judge,
               const Stopwatch& watch, OptimizerResult& result, const Work& work) {
  OptimizerStage stage;
  stage.stage = name;
  stage.min_dihedral_before_deg = result.min_dihedral_deg;
  optimize::TetComplex complex(std::move(mesh), judge);
  stage.changes = work(complex);
  mesh = complex.release();
  part_patches(mesh, domain);
  result.min_dihedral_deg = min_dihedral_deg(mesh);
  stage.min_dihedral_after_deg = result.min_dihedral_deg;
  stage.seconds = watch.seconds();
  result.stages.push_back(stage);
}

}  // namespace

OptimizerResult optimize_mesh(TetMesh& mesh, const Domain& domain, const OptimizerOptions& options,
                              Progress& progress) {
  check(options.bounds);
  const Stopwatch watch;
  const optimize::TetJudge judge(options.bounds);
  OptimizerResult result;
  std::vector<optimize::TetId> bad;
  std::optional<optimize::FacetJudge> facets;
  if (options.optimize != Optimize::none) bad = bad_tets(mesh, judge);
  if (options.optimize == Optimize::full && options.bounds.rules) {
    facets.emplace(domain, *options.bounds.rules);
    if (!options.facets_keep_rules) {
      const std::vector<optimize::TetId> behind = behind_bad_facets(mesh, *facets);
      bad.insert(bad.end(), behind.begin(), behind.end());
    }
  }
  result.min_dihedral_deg = min_dihedral_deg(mesh);
  const optimize::FacetJudge* const facet_judge = facets ? &*facets : nullptr;
  if (!bad.empty()) {
    const bool full = options.optimize == Optimize::full;
    run_stage(full ? "improve" : "exude", mesh, domain, judge, watch, result, [&](optimize::TetComplex& complex) {
      return full ? optimize::improve(complex, domain, facet_judge, std::move(bad), options.persistence, progress)
                  : optimize::exude(complex, progress);
    });
  }
  contract_short_edges(mesh, domain, options, progress, result);
  result.cancelled = progress.cancelled();
  return result;
}

void contract_short_edges(TetMesh& mesh, const Domain& domain, const OptimizerOptions& options, Progress& progress,
                          OptimizerResult& result) {
  check(options.bounds);
  const ElementBounds& bounds = options.bounds;
  if (options.optimize != Optimize::full || !bounds.min_edge || progress.cancelled()) return;
  const Stopwatch watch;
  if (optimize::short_edges(mesh, *bounds.min_edge).empty()) return;
  result.min_dihedral_deg = min_dihedral_deg(mesh);
  std::optional<optimize::FacetJudge> facets;
  if (bounds.rules) facets.emplace(domain, *bounds.rules);
  const optimize::FacetJudge* const judge = facets ? &*facets : nullptr;
  run_stage("contract", mesh, domain, optimize::TetJudge(bounds), watch, result, [&](optimize::TetComplex& complex) {
    const auto coarsen = [&](optimize::Effort effort) {
      return optimize::coarsen(complex, domain, judge, *bounds.min_edge, options.held, effort, progress);
    };
    std::uint64_t changes = coarsen(optimize::Effort::contract);
    if (bounds.min_edge->thorough) changes += coarsen(optimize::Effort::move);
    return changes;
  });
}

}  // namespace scantet
