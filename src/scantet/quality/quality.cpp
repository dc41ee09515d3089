// One pass over the tets for the dihedral angles, one for the other measures, one over the edges: never more than six
// doubles a tet in memory. Percentiles are selected, not sorted: the median first, then on either side of it.
#include "scantet/quality/quality.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <span>
#include <string>

#include "scantet/base/error.h"
#include "scantet/base/options.h"
#include "scantet/domain/sizing_field.h"
#include "scantet/quality/measures.h"
#include "scantet/quality/mesh_edges.h"

namespace scantet {
namespace {

constexpr std::size_t kBins = 40;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

std::vector<double> even_edges(double low, double high, std::size_t bins) {
  std::vector<double> edges(bins + 1);
  for (std::size_t i = 0; i <= bins; ++i) {
    edges[i] = low + (high - low) * static_cast<double>(i) / static_cast<double>(bins);
  }
  edges.back() = high;
  return edges;
}

// Even bins over the data; bins over a range of 1 if the values are equal up to rounding.
std::vector<double> data_edges(const Distribution& d, double finite_max) {
  if (d.count == d.infinite) return even_edges(0, 1, kBins);
  constexpr double kRounding = 1e-9;
  const bool spread = finite_max - d.min > kRounding * std::max(std::abs(d.min), std::abs(finite_max));
  const double high = spread ? finite_max : d.min + std::max(1.0, kRounding * std::abs(d.min));
  return even_edges(d.min, high, kBins);
}

// `even`: how many of the bins, from the first, have the same width.
Histogram count_in_bins(const std::vector<double>& values, std::vector<double> edges, std::size_t even) {
  Histogram histogram{std::move(edges), {}};
  const std::vector<double>& e = histogram.edges;
  const std::size_t bins = e.size() - 1;
  histogram.counts.assign(bins, 0);
  const double scale = static_cast<double>(even) / (e[even] - e[0]);
  for (const double value : values) {
    const double position = std::clamp((value - e[0]) * scale, 0.0, static_cast<double>(bins - 1));
    auto bin = static_cast<std::size_t>(position);
    // The product may round across an edge.
    if (bin > 0 && value < e[bin]) --bin;
    if (bin + 1 < bins && value >= e[bin + 1]) ++bin;
    ++histogram.counts[bin];
  }
  return histogram;
}

// Puts the values of these ascending ranks where they would be if `values` were sorted.
void select(std::vector<double>& values, std::size_t begin, std::size_t end, std::span<const std::size_t> ranks) {
  if (ranks.empty()) return;
  const std::size_t middle = ranks.size() / 2;
  const std::size_t rank = ranks[middle];
  const auto at = [&](std::size_t i) { return values.begin() + static_cast<std::ptrdiff_t>(i); };
  if (rank >= begin && rank < end) std::nth_element(at(begin), at(rank), at(end));
  select(values, begin, std::min(rank, end), ranks.first(middle));
  select(values, std::max(begin, rank + 1), end, ranks.subspan(middle + 1));
}

// All but the histogram; values are reordered. Returns the largest finite value.
double describe(std::vector<double>& values, Distribution& d) {
  d.count = values.size();
  if (values.empty()) return 0;
  const auto finite_end = std::partition(values.begin(), values.end(), [](double v) { return std::isfinite(v); });
  const auto finite = static_cast<std::size_t>(finite_end - values.begin());
  d.infinite = values.size() - finite;
  double sum = 0;
  double finite_max = -kInfinity;
  d.min = kInfinity;
  for (std::size_t i = 0; i < finite; ++i) {
    sum += values[i];
    d.min = std::min(d.min, values[i]);
    finite_max = std::max(finite_max, values[i]);
  }
  d.max = d.infinite > 0 ? kInfinity : finite_max;
  if (finite > 0) d.mean = std::clamp(sum / static_cast<double>(finite), d.min, finite_max);  // rounding
  std::array<std::size_t, kPercentiles.size()> ranks{};
  for (std::size_t i = 0; i < ranks.size(); ++i) {
    ranks[i] = (values.size() * static_cast<std::size_t>(kPercentiles[i]) + 99) / 100 - 1;
  }
  select(values, 0, finite, ranks);
  for (std::size_t i = 0; i < ranks.size(); ++i) {
    d.percentiles[i] = ranks[i] < finite ? values[ranks[i]] : kInfinity;
  }
  return finite_max;
}

Distribution over_range(std::vector<double>& values, double low, double high, std::size_t bins) {
  Distribution d;
  describe(values, d);
  d.histogram = count_in_bins(values, even_edges(low, high, bins), bins);
  return d;
}

Distribution over_data(std::vector<double>& values) {
  Distribution d;
  const double finite_max = describe(values, d);
  d.histogram = count_in_bins(values, data_edges(d, finite_max), kBins);
  return d;
}

// With one bin more for all above `high`, as wide as the others at least.
Distribution over_range_and_above(std::vector<double>& values, double low, double high) {
  Distribution d;
  const double finite_max = describe(values, d);
  std::vector<double> edges = even_edges(low, high, kBins);
  edges.push_back(std::max(finite_max, high + (high - low) / static_cast<double>(kBins)));
  d.histogram = count_in_bins(values, std::move(edges), kBins);
  return d;
}

// Keeps the kWorstTets elements of smallest key, in order; earlier tets win ties.
class WorstList {
 public:
  void offer(double key, const WorstTet& tet) {
    if (kept_.size() == kWorstTets && !(key < kept_.back().first)) return;
    const auto after =
        std::upper_bound(kept_.begin(), kept_.end(), key, [](double k, const auto& entry) { return k < entry.first; });
    kept_.insert(after, {key, tet});
    if (kept_.size() > kWorstTets) kept_.pop_back();
  }
  std::vector<WorstTet> take() const {
    std::vector<WorstTet> tets;
    for (const auto& entry : kept_) tets.push_back(entry.second);
    return tets;
  }

 private:
  std::vector<std::pair<double, WorstTet>> kept_;
};

std::array<Point, 4> corners(const TetMesh& mesh, const Tet& t) {
  return {mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]], mesh.vertices[t[3]]};
}

Point centroid(const std::array<Point, 4>& p) {
  return 0.25 * (p[0] + p[1] + p[2] + p[3]);
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
  std::vector<double> values;
  values.reserve(6 * mesh.tets.size());
  WorstList worst;
  for (std::size_t i = 0; i < mesh.tets.size(); ++i) {
    const auto p = corners(mesh, mesh.tets[i]);
    const auto angles = measure_tet(p[0], p[1], p[2], p[3]).dihedral_deg;
    values.insert(values.end(), angles.begin(), angles.end());
    const double smallest = *std::min_element(angles.begin(), angles.end());
    for (std::size_t k = 0; k < kSliverDeg.size(); ++k) summary.tets_under_deg[k] += smallest < kSliverDeg[k] ? 1 : 0;
    worst.offer(smallest, {static_cast<std::uint32_t>(i), centroid(p), smallest});
  }
  summary.smallest_dihedral = worst.take();
  constexpr std::size_t kDihedralBins = 36;
  summary.dihedral_deg = over_range(values, 0, 180, kDihedralBins);
}

// Circumradius over the size asked for at the circumcentre; a flat tet has no circumcentre.
double size_ratio(const TetMeasures& m, const SizingField& size) {
  return std::isfinite(m.circumradius_mm) ? m.circumradius_mm / size.size_at(m.circumcentre) : kInfinity;
}

void measure_shapes(const TetMesh& mesh, const SizingField* size, QualitySummary& summary) {
  std::vector<double> aspect;
  std::vector<double> ratio;
  std::vector<double> radius;
  std::vector<double> volume;
  std::vector<double> relative;
  for (auto* values : {&aspect, &ratio, &radius, &volume}) values->reserve(mesh.tets.size());
  if (size != nullptr) relative.reserve(mesh.tets.size());
  WorstList worst;
  std::map<Region, RegionVolume> regions;
  for (std::size_t i = 0; i < mesh.tets.size(); ++i) {
    const auto p = corners(mesh, mesh.tets[i]);
    const TetMeasures m = measure_tet(p[0], p[1], p[2], p[3]);
    aspect.push_back(m.inverse_aspect);
    ratio.push_back(m.radius_edge);
    radius.push_back(m.circumradius_mm);
    volume.push_back(m.volume_mm3);
    if (size != nullptr) relative.push_back(size_ratio(m, *size));
    worst.offer(-m.radius_edge, {static_cast<std::uint32_t>(i), centroid(p), m.radius_edge});
    const Region region = mesh.tet_regions.empty() ? Region{1} : mesh.tet_regions[i];
    RegionVolume& entry = regions.try_emplace(region, RegionVolume{region, 0, 0}).first->second;
    ++entry.tets;
    entry.volume_mm3 += m.volume_mm3;
    summary.total_volume_mm3 += m.volume_mm3;
  }
  for (const auto& entry : regions) summary.regions.push_back(entry.second);
  summary.largest_radius_edge = worst.take();
  summary.inverse_aspect = over_range(aspect, 0, 1.0 / 3.0, kBins);
  constexpr double kDefaultBound = 2;
  summary.radius_edge = over_range_and_above(ratio, std::sqrt(6.0) / 4, kDefaultBound);
  if (size != nullptr) summary.size_ratio = over_range_and_above(relative, 0, 1);
  summary.circumradius_mm = over_data(radius);
  summary.volume_mm3 = over_data(volume);
}

}  // namespace

QualitySummary measure_quality(const TetMesh& mesh, const SizingField* size) {
  check_consistent(mesh);
  QualitySummary summary;
  measure_dihedrals(mesh, summary);
  measure_shapes(mesh, size, summary);

  std::vector<double> lengths;
  for_each_edge_star(mesh, [&](VertexId v, const std::vector<VertexId>& neighbours) {
    for (const VertexId w : neighbours) lengths.push_back(distance(mesh.vertices[v], mesh.vertices[w]));
  });
  summary.edge_length_mm = over_data(lengths);

  double smallest = kInfinity;
  for (const Triangle& f : mesh.boundary_facets) {
    const auto angles = triangle_angles_deg(mesh.vertices[f[0]], mesh.vertices[f[1]], mesh.vertices[f[2]]);
    smallest = std::min({smallest, angles[0], angles[1], angles[2]});
  }
  if (!mesh.boundary_facets.empty()) summary.min_facet_angle_deg = smallest;
  return summary;
}

}  // namespace scantet
