// Three passes over the tets, one over the edges: never more than six doubles a tet in memory. Values are measured, and
// then described, side by side on several threads; what is summed or compared is so in the order of the tets.
#include "scantet/quality/quality.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <string>

#include "scantet/base/error.h"
#include "scantet/base/options.h"
#include "scantet/base/parallel.h"
#include "scantet/domain/sizing_field.h"
#include "scantet/quality/distributions_impl.h"
#include "scantet/quality/measures.h"
#include "scantet/quality/mesh_edges.h"

namespace scantet {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

std::array<Point, 4> corners(const TetMesh& mesh, const Tet& t) {
  return {mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]], mesh.vertices[t[3]]};
}

TetMeasures measures_of(const TetMesh& mesh, std::size_t tet) {
  const auto p = corners(mesh, mesh.tets[tet]);
  return measure_tet(p[0], p[1], p[2], p[3]);
}

Point centroid(const std::array<Point, 4>& p) {
  return 0.25 * (p[0] + p[1] + p[2] + p[3]);
}

// Keeps the kWorstTets elements of smallest key, in order; earlier tets win ties.
class WorstList {
 public:
  bool wants(double key) const { return kept_.size() < kWorstTets || key < kept_.back().key; }

  // Of the offers with one `name` the first is kept.
  void offer(double key, std::size_t tet, std::uint64_t name) {
    if (!wants(key)) return;
    for (const Entry& entry : kept_) {
      if (entry.name == name) return;
    }
    const auto after =
        std::upper_bound(kept_.begin(), kept_.end(), key, [](double k, const Entry& entry) { return k < entry.key; });
    kept_.insert(after, {key, tet, name});
    if (kept_.size() > kWorstTets) kept_.pop_back();
  }

  // sign: what makes a value of a key.
  std::vector<WorstTet> take(const TetMesh& mesh, double sign) const {
    std::vector<WorstTet> tets;
    for (const Entry& entry : kept_) {
      const Point place = centroid(corners(mesh, mesh.tets[entry.tet]));
      tets.push_back({static_cast<std::uint32_t>(entry.tet), place, sign * entry.key});
    }
    return tets;
  }

 private:
  struct Entry {
    double key;
    std::size_t tet;
    std::uint64_t name;
  };
  std::vector<Entry> kept_;
};

// The tets of the smallest values (sign 1) or of the largest (sign -1).
std::vector<WorstTet> worst_of(const TetMesh& mesh, const std::vector<double>& values, double sign) {
  WorstList worst;
  for (std::size_t i = 0; i < values.size(); ++i) worst.offer(sign * values[i], i, i);
  return worst.take(mesh, sign);
}

// An edge is named by its vertices; every tet around it has its length to the last bit.
std::vector<WorstTet> shortest_edges(const TetMesh& mesh, const std::vector<double>& shortest) {
  WorstList worst;
  for (std::size_t i = 0; i < shortest.size(); ++i) {
    if (!worst.wants(shortest[i])) continue;
    const TetMeasures m = measures_of(mesh, i);
    for (std::size_t e = 0; e < 6; ++e) {
      const std::uint64_t a = mesh.tets[i][static_cast<std::size_t>(kTetEdges[e][0])];
      const std::uint64_t b = mesh.tets[i][static_cast<std::size_t>(kTetEdges[e][1])];
      worst.offer(m.edge_mm[e], i, std::min(a, b) << 32 | std::max(a, b));
    }
  }
  return worst.take(mesh, 1);
}

// One column a measure: measure(tet's measures) returns the row of a tet.
template <std::size_t N, class Measure>
std::array<std::vector<double>, N> measured(const TetMesh& mesh, const Measure& measure) {
  constexpr std::size_t kGrain = 8192;
  std::array<std::vector<double>, N> columns;
  for (std::vector<double>& column : columns) column.resize(mesh.tets.size());
  parallel_for(mesh.tets.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const std::array<double, N> row = measure(measures_of(mesh, i));
      for (std::size_t k = 0; k < N; ++k) columns[k][i] = row[k];
    }
  });
  return columns;
}

void run_all(const std::vector<std::function<void()>>& tasks) {
  parallel_for(tasks.size(), 1, [&](std::size_t begin, std::size_t) { tasks[begin](); });
}

void check_consistent(const TetMesh& mesh) {
  const auto refuse = [](const std::string& what) {
    throw Error(Fault::internal, "mesh.inconsistent", "cannot measure the mesh: " + what, "audit the mesh first");
  };
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    for (int axis = 0; axis < 3; ++axis) {
      const double x = mesh.vertices[i][axis];
      if (!(std::abs(x) <= kLargestCoordinateMm)) {
        refuse("vertex " + std::to_string(i) + " has the coordinate " + number_text(x));
      }
    }
  }
  const auto too_large = [&](VertexId v) { return v >= mesh.vertices.size(); };
  for (std::size_t i = 0; i < mesh.tets.size(); ++i) {
    if (std::any_of(mesh.tets[i].begin(), mesh.tets[i].end(), too_large)) {
      refuse("tet " + std::to_string(i) + " names a vertex that does not exist");
    }
  }
  for (std::size_t i = 0; i < mesh.boundary_facets.size(); ++i) {
    if (std::any_of(mesh.boundary_facets[i].begin(), mesh.boundary_facets[i].end(), too_large)) {
      refuse("boundary facet " + std::to_string(i) + " names a vertex that does not exist");
    }
  }
  if (!mesh.tet_regions.empty() && mesh.tet_regions.size() != mesh.tets.size()) {
    refuse(std::to_string(mesh.tet_regions.size()) + " regions for " + std::to_string(mesh.tets.size()) + " tets");
  }
}

void measure_dihedrals(const TetMesh& mesh, QualitySummary& summary) {
  constexpr std::size_t kGrain = 8192;
  std::vector<double> values(6 * mesh.tets.size());
  parallel_for(mesh.tets.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const auto angles = measures_of(mesh, i).dihedral_deg;
      std::copy(angles.begin(), angles.end(), values.begin() + static_cast<std::ptrdiff_t>(6 * i));
    }
  });
  WorstList smallest;
  WorstList largest;
  for (std::size_t i = 0; i < mesh.tets.size(); ++i) {
    const auto first = values.begin() + static_cast<std::ptrdiff_t>(6 * i);
    const auto [low, high] = std::minmax_element(first, first + 6);
    for (std::size_t k = 0; k < kSliverDeg.size(); ++k) summary.tets_under_deg[k] += *low < kSliverDeg[k] ? 1 : 0;
    smallest.offer(*low, i, i);
    largest.offer(-*high, i, i);
  }
  summary.smallest_dihedral = smallest.take(mesh, 1);
  summary.largest_dihedral = largest.take(mesh, -1);
  constexpr std::size_t kDihedralBins = 36;
  summary.dihedral_deg = over_range(values, 0, 180, kDihedralBins);
}

void add_up_regions(const TetMesh& mesh, const std::vector<double>& volume, QualitySummary& summary) {
  std::map<Region, RegionVolume> regions;
  for (std::size_t i = 0; i < mesh.tets.size(); ++i) {
    const Region region = mesh.tet_regions.empty() ? Region{1} : mesh.tet_regions[i];
    RegionVolume& entry = regions.try_emplace(region, RegionVolume{region, 0, 0}).first->second;
    ++entry.tets;
    entry.volume_mm3 += volume[i];
    summary.total_volume_mm3 += volume[i];
  }
  for (const auto& entry : regions) summary.regions.push_back(entry.second);
}

void measure_shapes(const TetMesh& mesh, QualitySummary& q) {
  auto columns = measured<6>(mesh, [](const TetMeasures& m) {
    return std::array<double, 6>{m.inverse_aspect, m.radius_edge,     m.circumradius_mm,
                                 m.volume_mm3,     m.scaled_jacobian, m.min_height_mm};
  });
  auto& aspect = columns[0];
  auto& ratio = columns[1];
  auto& radius = columns[2];
  auto& volume = columns[3];
  auto& jacobian = columns[4];
  auto& height = columns[5];
  add_up_regions(mesh, volume, q);
  constexpr double kDefaultBound = 2;
  run_all({[&] { q.inverse_aspect = over_range(aspect, 0, 1.0 / 3.0, kBins); },
           [&] {
             q.largest_radius_edge = worst_of(mesh, ratio, -1);
             q.radius_edge = over_range_and_above(ratio, std::sqrt(6.0) / 4, kDefaultBound);
           },
           [&] { q.circumradius_mm = over_data(radius); }, [&] { q.volume_mm3 = over_data(volume); },
           [&] {
             q.smallest_scaled_jacobian = worst_of(mesh, jacobian, 1);
             q.scaled_jacobian = over_range(jacobian, 0, 1, kBins);
           },
           [&] {
             q.least_height = worst_of(mesh, height, 1);
             q.min_height_mm = over_data(height);
           }});
}

// Circumradius over the size asked for at the circumcentre; a flat tet has no circumcentre.
double size_ratio(const TetMeasures& m, const SizingField* size) {
  if (size == nullptr) return 0;
  return std::isfinite(m.circumradius_mm) ? m.circumradius_mm / size->size_at(m.circumcentre) : kInfinity;
}

void measure_sizes(const TetMesh& mesh, const SizingField* size, QualitySummary& q) {
  auto columns = measured<3>(mesh, [&](const TetMeasures& m) {
    return std::array<double, 3>{*std::max_element(m.dihedral_deg.begin(), m.dihedral_deg.end()),
                                 *std::min_element(m.edge_mm.begin(), m.edge_mm.end()), size_ratio(m, size)};
  });
  auto& largest = columns[0];
  auto& shortest = columns[1];
  auto& relative = columns[2];
  constexpr double kLeastDeg = 60;  // no tet has a largest angle under acos(1/3), 70.5 degrees
  constexpr std::size_t kLargestBins = 24;
  run_all({[&] { q.largest_dihedral_deg = over_range(largest, kLeastDeg, 180, kLargestBins); },
           [&] { q.shortest_edge = shortest_edges(mesh, shortest); },
           [&] {
             if (size != nullptr) q.size_ratio = over_range_and_above(relative, 0, 1);
           }});
}

void measure_edges(const TetMesh& mesh, QualitySummary& summary) {
  std::vector<double> lengths;
  for_each_edge_star(mesh, [&](VertexId v, const std::vector<VertexId>& neighbours) {
    for (const VertexId w : neighbours) lengths.push_back(distance(mesh.vertices[v], mesh.vertices[w]));
  });
  summary.edge_length_mm = over_data(lengths);
}

double smallest_facet_angle(const TetMesh& mesh) {
  double smallest = kInfinity;
  for (const Triangle& f : mesh.boundary_facets) {
    const auto angles = triangle_angles_deg(mesh.vertices[f[0]], mesh.vertices[f[1]], mesh.vertices[f[2]]);
    smallest = std::min({smallest, angles[0], angles[1], angles[2]});
  }
  return smallest;
}

}  // namespace

void QualitySummary::set_wave_speed(double m_per_s) {
  constexpr double kMicrosecondsAMillisecond = 1000;  // mm / (m/s) = ms
  wave_speed_m_per_s = m_per_s;
  stable_time_step_us = scaled(min_height_mm, kMicrosecondsAMillisecond / m_per_s);
}

QualitySummary measure_quality(const TetMesh& mesh, const SizingField* size) {
  check_consistent(mesh);
  QualitySummary summary;
  measure_dihedrals(mesh, summary);
  measure_shapes(mesh, summary);
  measure_sizes(mesh, size, summary);
  measure_edges(mesh, summary);
  if (!mesh.boundary_facets.empty()) summary.min_facet_angle_deg = smallest_facet_angle(mesh);
  summary.set_wave_speed(kWaveSpeedMPerS);
  return summary;
}

}  // namespace scantet
