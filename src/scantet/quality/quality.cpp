// One pass over the tets, one over the edges, both on several threads, as is the description of the values. What is
// summed or compared is so within stretches of fixed length, and then stretch by stretch in their order.
#include "scantet/quality/quality.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "scantet/base/large_pages.h"
#include "scantet/base/parallel.h"
#include "scantet/domain/sizing_field.h"
#include "scantet/quality/distributions_impl.h"
#include "scantet/quality/measurable_mesh_impl.h"
#include "scantet/quality/measures.h"
#include "scantet/quality/mesh_edges.h"
#include "scantet/quality/worst_list_impl.h"

namespace scantet {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr std::size_t kStretch = 8192;  // tets, facets or vertices that one thread takes at once

std::array<Point, 4> corners(const TetMesh& mesh, const Tet& t) {
  return {mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]], mesh.vertices[t[3]]};
}

// Side by side.
void run_all(const std::vector<std::function<void()>>& tasks) {
  parallel_for(tasks.size(), 1, [&](std::size_t begin, std::size_t) { tasks[begin](); });
}

// The values whose distributions are described, one a tet.
struct Columns {
  explicit Columns(std::size_t tets, bool has_sizes) {
    dihedral.resize(6 * tets);
    for (auto* column : {&largest, &inverse_aspect, &radius_edge, &circumradius, &volume, &scaled_jacobian, &height,
                         &stiffness_ratio}) {
      column->resize(tets);
    }
    if (has_sizes) size_ratio.resize(tets);
  }

  LargeVector<double> dihedral;  // six a tet
  LargeVector<double> largest;   // dihedral angle
  LargeVector<double> inverse_aspect;
  LargeVector<double> radius_edge;
  LargeVector<double> circumradius;
  LargeVector<double> volume;
  LargeVector<double> scaled_jacobian;
  LargeVector<double> height;
  LargeVector<double> stiffness_ratio;
  LargeVector<double> size_ratio;  // empty without a sizing field
};

// What tets one after the other come to.
class TetSums {
 public:
  void add(const TetMesh& mesh, std::size_t tet, const TetMeasures& m, double smallest_deg, double largest_deg,
           double stiffness_ratio) {
    for (std::size_t k = 0; k < kSliverDeg.size(); ++k) under_deg_[k] += smallest_deg < kSliverDeg[k] ? 1 : 0;
    smallest_dihedral_.offer(smallest_deg, tet, tet);
    largest_dihedral_.offer(-largest_deg, tet, tet);
    largest_radius_edge_.offer(-m.radius_edge, tet, tet);
    smallest_scaled_jacobian_.offer(m.scaled_jacobian, tet, tet);
    least_height_.offer(m.min_height_mm, tet, tet);
    least_volume_.offer(m.volume_mm3, tet, tet);
    largest_stiffness_ratio_.offer(-stiffness_ratio, tet, tet);
    const double root = stiffness_ratio * std::sqrt(stiffness_ratio);
    stiffest_ = std::max(stiffest_, root / std::abs(m.volume_mm3));
    offer_edges(mesh, tet, m);
    add({mesh.tet_regions.empty() ? Region{1} : mesh.tet_regions[tet], 1, m.volume_mm3, smallest_deg, largest_deg});
  }

  void add(const TetSums& later) {
    for (std::size_t k = 0; k < kSliverDeg.size(); ++k) under_deg_[k] += later.under_deg_[k];
    smallest_dihedral_.merge(later.smallest_dihedral_);
    largest_dihedral_.merge(later.largest_dihedral_);
    largest_radius_edge_.merge(later.largest_radius_edge_);
    smallest_scaled_jacobian_.merge(later.smallest_scaled_jacobian_);
    least_height_.merge(later.least_height_);
    least_volume_.merge(later.least_volume_);
    largest_stiffness_ratio_.merge(later.largest_stiffness_ratio_);
    stiffest_ = std::max(stiffest_, later.stiffest_);
    shortest_edge_.merge(later.shortest_edge_);
    for (const RegionVolume& region : later.regions_) add(region);
  }

  void put_into(const TetMesh& mesh, QualitySummary& summary) const {
    summary.tets_under_deg = under_deg_;
    summary.smallest_dihedral = smallest_dihedral_.take(mesh, 1);
    summary.largest_dihedral = largest_dihedral_.take(mesh, -1);
    summary.largest_radius_edge = largest_radius_edge_.take(mesh, -1);
    summary.smallest_scaled_jacobian = smallest_scaled_jacobian_.take(mesh, 1);
    summary.least_height = least_height_.take(mesh, 1);
    summary.least_volume = least_volume_.take(mesh, 1);
    summary.largest_stiffness_ratio = largest_stiffness_ratio_.take(mesh, -1);
    summary.shortest_edge = shortest_edge_.take(mesh, 1);
    summary.regions = regions_;
    for (const RegionVolume& region : regions_) summary.total_volume_mm3 += region.volume_mm3;
  }

  // The largest stiffness ratio over the square of the cube root of the volume, 1/mm².
  double stiffest() const { return std::cbrt(stiffest_) * std::cbrt(stiffest_); }

 private:
  // An edge is named by its vertices; every tet around it has its length to the last bit.
  void offer_edges(const TetMesh& mesh, std::size_t tet, const TetMeasures& m) {
    for (std::size_t e = 0; e < 6; ++e) {
      if (!shortest_edge_.wants(m.edge_mm[e])) continue;
      const std::uint64_t a = mesh.tets[tet][static_cast<std::size_t>(kTetEdges[e][0])];
      const std::uint64_t b = mesh.tets[tet][static_cast<std::size_t>(kTetEdges[e][1])];
      shortest_edge_.offer(m.edge_mm[e], tet, std::min(a, b) << 32 | std::max(a, b));
    }
  }

  void add(const RegionVolume& part) {
    const auto at = std::lower_bound(regions_.begin(), regions_.end(), part.region,
                                     [](const RegionVolume& entry, Region region) { return entry.region < region; });
    if (at == regions_.end() || at->region != part.region) {
      regions_.insert(at, part);
      return;
    }
    at->add(part);
  }

  std::array<std::uint64_t, kSliverDeg.size()> under_deg_{};
  WorstList smallest_dihedral_;
  WorstList largest_dihedral_;
  WorstList largest_radius_edge_;
  WorstList smallest_scaled_jacobian_;
  WorstList least_height_;
  WorstList least_volume_;
  WorstList largest_stiffness_ratio_;
  WorstList shortest_edge_;
  double stiffest_ = 0;                // that to the power of 3/2: no roots of each tet's volume
  std::vector<RegionVolume> regions_;  // ascending by region
};

// Circumradius over the size asked for at the circumcentre; a flat tet has no circumcentre.
double size_ratio(const TetMeasures& m, const SizingField& size) {
  return std::isfinite(m.circumradius_mm) ? m.circumradius_mm / size.size_at(m.circumcentre) : kInfinity;
}

TetSums measure_stretch(const TetMesh& mesh, const SizingField* size, std::size_t begin, std::size_t end,
                        Columns& columns) {
  TetSums sums;
  for (std::size_t i = begin; i < end; ++i) {
    const auto p = corners(mesh, mesh.tets[i]);
    const TetMeasures m = measure_tet(p[0], p[1], p[2], p[3]);
    const auto [smallest, largest] = std::minmax_element(m.dihedral_deg.begin(), m.dihedral_deg.end());
    std::copy(m.dihedral_deg.begin(), m.dihedral_deg.end(),
              columns.dihedral.begin() + static_cast<std::ptrdiff_t>(6 * i));
    columns.largest[i] = *largest;
    columns.inverse_aspect[i] = m.inverse_aspect;
    columns.radius_edge[i] = m.radius_edge;
    columns.circumradius[i] = m.circumradius_mm;
    columns.volume[i] = m.volume_mm3;
    columns.scaled_jacobian[i] = m.scaled_jacobian;
    columns.height[i] = m.min_height_mm;
    if (size != nullptr) columns.size_ratio[i] = size_ratio(m, *size);
    columns.stiffness_ratio[i] = stiffness_ratio(p[0], p[1], p[2], p[3]);
    sums.add(mesh, i, m, *smallest, *largest, columns.stiffness_ratio[i]);
  }
  return sums;
}

void measure_tets(const TetMesh& mesh, const SizingField* size, QualitySummary& q) {
  Columns columns(mesh.tets.size(), size != nullptr);
  std::vector<TetSums> stretches((mesh.tets.size() + kStretch - 1) / kStretch);
  parallel_for(mesh.tets.size(), kStretch, [&](std::size_t begin, std::size_t end) {
    stretches[begin / kStretch] = measure_stretch(mesh, size, begin, end, columns);
  });
  TetSums sums;
  for (const TetSums& stretch : stretches) sums.add(stretch);
  sums.put_into(mesh, q);

  constexpr std::size_t kDihedralBins = 36;
  constexpr double kLeastDeg = 60;  // no tet has a largest angle under acos(1/3), 70.5 degrees
  constexpr std::size_t kLargestBins = 24;
  constexpr double kDefaultBound = 2;
  constexpr double kStiff = 5;
  run_all({[&] { q.dihedral_deg = over_range(columns.dihedral, 0, 180, kDihedralBins); },
           [&] { q.largest_dihedral_deg = over_range(columns.largest, kLeastDeg, 180, kLargestBins); },
           [&] { q.inverse_aspect = over_range(columns.inverse_aspect, 0, 1.0 / 3.0, kBins); },
           [&] { q.scaled_jacobian = over_range(columns.scaled_jacobian, 0, 1, kBins); },
           [&] { q.radius_edge = over_range_and_above(columns.radius_edge, std::sqrt(6.0) / 4, kDefaultBound); },
           [&] { q.circumradius_mm = over_data(columns.circumradius); },
           [&] { q.volume_mm3 = over_data(columns.volume); }, [&] { q.min_height_mm = over_data(columns.height); },
           [&] { q.stiffness_ratio = over_range_and_above(columns.stiffness_ratio, 1, kStiff); },
           [&] {
             if (size != nullptr) q.size_ratio = over_range_and_above(columns.size_ratio, 0, 1);
           }});
  if (!mesh.tets.empty()) {
    const double edge = std::cbrt(std::abs(q.median_volume_mm3()));
    q.condition_factor = std::isfinite(sums.stiffest()) ? sums.stiffest() * edge * edge : kInfinity;
  }
}

using Edge = std::array<VertexId, 2>;

// The edges of the smallest values, the worst first, each with the first tet that has it.
std::vector<WorstTet> worst_edges(const TetMesh& mesh, const std::vector<Edge>& edges,
                                  const std::vector<double>& values) {
  WorstList worst;
  for (std::size_t i = 0; i < edges.size(); ++i) worst.offer(values[i], i, i);
  std::vector<WorstTet> found = worst.take();
  std::vector<std::uint8_t> is_end(mesh.vertices.size(), 0);
  for (const WorstTet& w : found) {
    for (const VertexId v : edges[w.tet]) is_end[v] = 1;
  }
  const auto find = [&](std::size_t begin, std::size_t end, std::vector<std::uint32_t>& tets) {
    for (std::size_t i = begin; i < end; ++i) {
      const Tet& t = mesh.tets[i];
      if (is_end[t[0]] + is_end[t[1]] + is_end[t[2]] + is_end[t[3]] > 1) tets.push_back(static_cast<std::uint32_t>(i));
    }
  };
  const auto tets = parallel_collect<std::uint32_t>(mesh.tets.size(), kStretch, find);
  for (WorstTet& w : found) {
    const Edge edge = edges[w.tet];
    const auto has_edge = [&](std::uint32_t i) {
      const Tet& tet = mesh.tets[i];
      return std::all_of(edge.begin(), edge.end(),
                         [&](VertexId v) { return std::find(tet.begin(), tet.end(), v) != tet.end(); });
    };
    const auto first = std::find_if(tets.begin(), tets.end(), has_edge);
    w.tet = first == tets.end() ? 0 : *first;
    w.place = lerp(mesh.vertices[edge[0]], mesh.vertices[edge[1]], 0.5);
  }
  return found;
}

void measure_edges(const TetMesh& mesh, const TetStars& stars, const SizingField* size, QualitySummary& summary) {
  const auto find = [&](std::size_t begin, std::size_t end, std::vector<Edge>& edges) {
    for_each_edge_star(mesh, stars, begin, end, [&](VertexId v, const std::vector<VertexId>& neighbours) {
      for (const VertexId w : neighbours) edges.push_back({v, w});
    });
  };
  const std::vector<Edge> edges = parallel_collect<Edge>(mesh.vertices.size(), kStretch, find);
  std::vector<double> lengths(edges.size());
  std::vector<double> shares(size == nullptr ? 0 : edges.size());
  parallel_for(edges.size(), kStretch, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const Point& p = mesh.vertices[edges[i][0]];
      const Point& q = mesh.vertices[edges[i][1]];
      lengths[i] = distance(p, q);
      if (size != nullptr) shares[i] = lengths[i] / size->size_at(lerp(p, q, 0.5));
    }
  });
  run_all({[&] { summary.edge_length_mm = over_data(lengths); },
           [&] {
             if (size != nullptr) summary.edge_size_ratio = over_range_and_above(shares, 0, 1);
           },
           [&] {
             if (size != nullptr) summary.least_edge_size_ratio = worst_edges(mesh, edges, shares);
           }});
}

double smallest_facet_angle(const TetMesh& mesh) {
  std::vector<double> smallest((mesh.boundary_facets.size() + kStretch - 1) / kStretch, kInfinity);
  parallel_for(mesh.boundary_facets.size(), kStretch, [&](std::size_t begin, std::size_t end) {
    double& least = smallest[begin / kStretch];
    for (std::size_t i = begin; i < end; ++i) {
      const Triangle& f = mesh.boundary_facets[i];
      const auto angles = triangle_angles_deg(mesh.vertices[f[0]], mesh.vertices[f[1]], mesh.vertices[f[2]]);
      least = std::min({least, angles[0], angles[1], angles[2]});
    }
  });
  return *std::min_element(smallest.begin(), smallest.end());
}

}  // namespace

void QualitySummary::set_wave_speed(double m_per_s) {
  constexpr double kMicrosecondsAMillisecond = 1000;  // mm / (m/s) = ms
  wave_speed_m_per_s = m_per_s;
  stable_time_step_us = scaled(min_height_mm, kMicrosecondsAMillisecond / m_per_s);
}

double QualitySummary::median_volume_mm3() const {
  constexpr std::size_t kMedian = 3;
  static_assert(kPercentiles[kMedian] == 50);
  return volume_mm3.percentiles[kMedian];
}

QualitySummary measure_quality(const TetMesh& mesh, const SizingField* size, const SizingField* edge_size,
                               const TetStars* stars) {
  check_measurable(mesh);
  QualitySummary summary;
  measure_tets(mesh, size, summary);
  measure_edges(mesh, stars == nullptr ? TetStars(mesh) : *stars, edge_size, summary);
  if (!mesh.boundary_facets.empty()) summary.min_facet_angle_deg = smallest_facet_angle(mesh);
  summary.set_wave_speed(kWaveSpeedMPerS);
  return summary;
}

}  // namespace scantet
