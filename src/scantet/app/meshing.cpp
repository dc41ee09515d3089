// A tet stays sharp where the boundary is more crooked than elements of that size can follow: a saddle, an island of a
// voxel. There only smaller ones help.
#include "scantet/app/meshing.h"

#include <algorithm>
#include <array>

#include "scantet/base/error.h"
#include "scantet/base/parallel.h"
#include "scantet/base/stopwatch.h"
#include "scantet/quality/measures.h"

namespace scantet {
namespace {

constexpr int kFinerRounds = 3;
constexpr double kFiner = 0.5;
constexpr double kFewSharp = 0.01;  // of all tets: if there are more, it is not for the boundary's sake

/// A cancelled sample may be too poor to triangulate; that is no error of the user's.
std::optional<MeshResult> mesh_or_cancel(const Domain& domain, const SizingField& size, const MesherOptions& options,
                                         Progress& progress) {
  try {
    MeshResult mesh = mesh_domain(domain, size, options, progress);
    if (mesh.stop == Stop::cancelled) return std::nullopt;
    return mesh;
  } catch (const Error&) {
    if (progress.cancelled()) return std::nullopt;
    throw;
  }
}

/// The tets with a dihedral angle under the bound, smallest first.
std::vector<WorstTet> sharp_tets(const TetMesh& mesh, double bound_deg) {
  constexpr std::size_t kGrain = 8192;
  const auto find = [&](std::size_t begin, std::size_t end, std::vector<WorstTet>& found) {
    for (std::size_t t = begin; t < end; ++t) {
      const Tet& v = mesh.tets[t];
      const std::array<Point, 4> p{mesh.vertices[v[0]], mesh.vertices[v[1]], mesh.vertices[v[2]], mesh.vertices[v[3]]};
      const TetMeasures measures = measure_tet(p[0], p[1], p[2], p[3]);
      const double smallest = *std::min_element(measures.dihedral_deg.begin(), measures.dihedral_deg.end());
      if (smallest >= bound_deg) continue;
      found.push_back({static_cast<std::uint32_t>(t), 0.25 * (p[0] + p[1] + p[2] + p[3]), smallest});
    }
  };
  std::vector<WorstTet> sharp = parallel_collect<WorstTet>(mesh.tets.size(), kGrain, find);
  std::stable_sort(sharp.begin(), sharp.end(), [](const WorstTet& a, const WorstTet& b) { return a.value < b.value; });
  return sharp;
}

std::optional<Meshing> attempt(const Domain& domain, const SizingField& size, const MesherOptions& mesher,
                               const OptimizerOptions& optimizer, Progress& progress) {
  std::optional<MeshResult> mesh = mesh_or_cancel(domain, size, mesher, progress);
  if (!mesh) return std::nullopt;
  Meshing meshing;
  meshing.refined = std::move(*mesh);
  if (meshing.refined.mesh.tets.empty()) return meshing;
  const Stopwatch optimizing;
  meshing.optimized = optimize_mesh(meshing.refined.mesh, domain, optimizer, progress);
  meshing.optimize_s = optimizing.seconds();
  if (meshing.optimized.cancelled) return std::nullopt;
  meshing.sharp = sharp_tets(meshing.refined.mesh, optimizer.min_dihedral_deg);
  return meshing;
}

/// The attempt's places, and one at each tet that is too sharp.
std::vector<FinerPlace> finer_places(const Meshing& meshing, const SizingField& size) {
  std::vector<FinerPlace> places = meshing.finer;
  for (const WorstTet& tet : meshing.sharp) places.push_back({tet.place, kFiner * size.size_at(tet.place)});
  return places;
}

}  // namespace

std::optional<Meshing> mesh_and_optimize(const Domain& domain, const std::shared_ptr<const SizingField>& size_asked,
                                         const MesherOptions& mesher, const OptimizerOptions& optimizer,
                                         Progress& progress) {
  const Stopwatch again;
  FinerSize size(size_asked, {});
  std::optional<Meshing> best = attempt(domain, size, mesher, optimizer, progress);
  if (!best) return std::nullopt;
  const double first_s = best->refined.sample_s + best->refined.refine_s;
  const Meshing* last = &*best;
  std::optional<Meshing> next;
  for (int round = 0; round < kFinerRounds && optimizer.optimize == Optimize::full; ++round) {
    const double share = static_cast<double>(last->sharp.size()) / static_cast<double>(last->refined.mesh.tets.size());
    if (share == 0 || share > kFewSharp || last->refined.stop != Stop::converged) break;
    std::vector<FinerPlace> places = finer_places(*last, size);
    size = FinerSize(size_asked, places);
    next = attempt(domain, size, mesher, optimizer, progress);
    if (!next) return std::nullopt;
    next->finer = std::move(places);
    last = &*next;
    if (next->sharp.size() < best->sharp.size() && next->refined.stop == Stop::converged) best = next;
  }
  best->optimize_s = again.seconds() - first_s;
  return best;
}

}  // namespace scantet
