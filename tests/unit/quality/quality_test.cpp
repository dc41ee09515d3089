#include "scantet/quality/quality.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <random>
#include <set>

#include "scantet/base/error.h"
#include "scantet/base/parallel.h"
#include "scantet/domain/sizing_field.h"
#include "scantet/quality/measures.h"
#include "unit/quality/grid_mesh.h"

namespace scantet {
namespace {

using test::grid_mesh;

// A grid whose inner vertices are moved about, so that all measures take many values.
TetMesh shaken_grid(int n) {
  TetMesh mesh = grid_mesh(n);
  std::mt19937 random(3);
  std::uniform_real_distribution<double> shift(-0.25, 0.25);
  for (Point& p : mesh.vertices) p = p + Vec{shift(random), shift(random), shift(random)};
  return mesh;
}

// Grows with x, so that the place at which it is asked matters.
class Ramp final : public SizingField {
 public:
  double size_at(const Point& p) const override { return 1 + 0.5 * p.x; }
  double min_size() const override { return 1; }
};

void expect_consistent(const Distribution& d) {
  ASSERT_EQ(d.histogram.edges.size(), d.histogram.counts.size() + 1);
  EXPECT_TRUE(std::is_sorted(d.histogram.edges.begin(), d.histogram.edges.end()));
  EXPECT_EQ(std::accumulate(d.histogram.counts.begin(), d.histogram.counts.end(), std::uint64_t{0}), d.count);
  EXPECT_TRUE(std::is_sorted(d.percentiles.begin(), d.percentiles.end()));
  EXPECT_LE(d.min, d.percentiles.front());
  EXPECT_GE(d.max, d.percentiles.back());
  EXPECT_LE(d.min, d.mean);
  EXPECT_GE(d.max, d.mean);
}

TEST(Quality, GridHasTheNumbersOfItsShape) {
  constexpr int kN = 4;
  const QualitySummary q = measure_quality(grid_mesh(kN));
  for (const Distribution* d :
       {&q.dihedral_deg, &q.inverse_aspect, &q.radius_edge, &q.edge_length_mm, &q.circumradius_mm, &q.volume_mm3,
        &q.largest_dihedral_deg, &q.scaled_jacobian, &q.min_height_mm, &q.stable_time_step_us}) {
    expect_consistent(*d);
  }
  EXPECT_NEAR(q.largest_dihedral_deg.min, 90, 1e-12);
  EXPECT_NEAR(q.scaled_jacobian.mean, std::sqrt(1 / 3.0), 1e-12);
  EXPECT_NEAR(q.min_height_mm.min, std::sqrt(0.5), 1e-12);
  EXPECT_NEAR(q.stable_time_step_us.max, std::sqrt(0.5) / 1.5, 1e-12) << "0.7 mm at 1.5 mm/µs";
  EXPECT_NEAR(q.min_dihedral_deg(), 45, 1e-12);
  EXPECT_NEAR(q.max_dihedral_deg(), 90, 1e-12);
  EXPECT_NEAR(q.dihedral_deg.mean, (45 + 45 + 60 + 90 + 90 + 90) / 6.0, 1e-12);
  EXPECT_NEAR(q.max_circumradius_mm(), std::sqrt(3.0) / 2, 1e-12);
  EXPECT_NEAR(q.max_radius_edge(), std::sqrt(3.0) / 2, 1e-12);
  EXPECT_NEAR(q.total_volume_mm3, kN * kN * kN, 1e-9);
  EXPECT_NEAR(q.min_facet_angle_deg, 45, 1e-12);
  EXPECT_EQ(q.edge_length_mm.count, 3u * kN * (kN + 1) * (kN + 1) + 3u * kN * kN * (kN + 1) + kN * kN * kN);
  EXPECT_NEAR(q.edge_length_mm.min, 1, 1e-15);
  EXPECT_NEAR(q.edge_length_mm.max, std::sqrt(3.0), 1e-15);
  EXPECT_EQ(q.tets_under_deg, (std::array<std::uint64_t, 4>{0, 0, 0, 0}));
}

TEST(Quality, BinsAreTheDocumentedOnes) {
  const QualitySummary q = measure_quality(shaken_grid(3));
  EXPECT_EQ(q.dihedral_deg.histogram.counts.size(), 36u);
  EXPECT_EQ(q.dihedral_deg.histogram.edges[1], 5);
  EXPECT_EQ(q.dihedral_deg.histogram.edges.back(), 180);
  EXPECT_EQ(q.inverse_aspect.histogram.counts.size(), 40u);
  EXPECT_EQ(q.inverse_aspect.histogram.edges.back(), 1.0 / 3);
  EXPECT_EQ(q.radius_edge.histogram.counts.size(), 41u);
  EXPECT_EQ(q.radius_edge.histogram.edges.front(), std::sqrt(6.0) / 4);
  EXPECT_NEAR(q.radius_edge.histogram.edges[40], 2, 1e-15);
  EXPECT_EQ(q.largest_dihedral_deg.histogram.counts.size(), 24u);
  EXPECT_EQ(q.largest_dihedral_deg.histogram.edges.front(), 60);
  EXPECT_EQ(q.scaled_jacobian.histogram.counts.size(), 40u);
  EXPECT_EQ(q.scaled_jacobian.histogram.edges.back(), 1);
  EXPECT_EQ(q.edge_length_mm.histogram.edges.front(), q.edge_length_mm.min);
  EXPECT_EQ(q.edge_length_mm.histogram.edges.back(), q.edge_length_mm.max);
}

// Everything again, the slow and simple way.
TEST(Quality, AgreesWithSortedValues) {
  const TetMesh mesh = shaken_grid(6);
  const QualitySummary q = measure_quality(mesh);
  std::vector<double> angles;
  std::vector<double> volumes;
  std::uint64_t under_20 = 0;
  for (const Tet& t : mesh.tets) {
    const TetMeasures m =
        measure_tet(mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]], mesh.vertices[t[3]]);
    angles.insert(angles.end(), m.dihedral_deg.begin(), m.dihedral_deg.end());
    volumes.push_back(m.volume_mm3);
    under_20 += *std::min_element(m.dihedral_deg.begin(), m.dihedral_deg.end()) < 20 ? 1 : 0;
  }
  EXPECT_GT(under_20, 0u);
  EXPECT_EQ(q.tets_under_deg[3], under_20);
  for (auto [values, d] : {std::pair{&angles, &q.dihedral_deg}, std::pair{&volumes, &q.volume_mm3}}) {
    std::sort(values->begin(), values->end());
    EXPECT_EQ(d->min, values->front());
    EXPECT_EQ(d->max, values->back());
    for (std::size_t i = 0; i < kPercentiles.size(); ++i) {
      const auto at_most = std::upper_bound(values->begin(), values->end(), d->percentiles[i]) - values->begin();
      const auto below = std::lower_bound(values->begin(), values->end(), d->percentiles[i]) - values->begin();
      const double wanted = 0.01 * kPercentiles[i] * static_cast<double>(values->size());
      EXPECT_GE(static_cast<double>(at_most), wanted - 1e-9);
      EXPECT_LT(static_cast<double>(below), wanted);
    }
    const Histogram& h = d->histogram;
    for (std::size_t i = 0; i < h.counts.size(); ++i) {
      const auto from = i == 0 ? values->begin() : std::lower_bound(values->begin(), values->end(), h.edges[i]);
      const auto to =
          i + 1 == h.counts.size() ? values->end() : std::lower_bound(values->begin(), values->end(), h.edges[i + 1]);
      EXPECT_EQ(h.counts[i], static_cast<std::uint64_t>(to - from)) << i;
    }
  }
}

TEST(Quality, WorstTetsAreNamedInOrder) {
  TetMesh mesh = grid_mesh(3);
  const std::size_t spoiled = test::tet_in_cube(3, 1, 1, 1);
  const Tet t = mesh.tets[spoiled];
  const Point foot = 1.0 / 3 * (mesh.vertices[t[0]] + mesh.vertices[t[1]] + mesh.vertices[t[2]]);
  mesh.vertices[t[3]] = lerp(foot, mesh.vertices[t[3]], 0.01);
  const QualitySummary q = measure_quality(mesh);
  ASSERT_EQ(q.smallest_dihedral.size(), kWorstTets);
  ASSERT_EQ(q.largest_radius_edge.size(), kWorstTets);
  EXPECT_EQ(q.smallest_dihedral.front().value, q.min_dihedral_deg());
  EXPECT_EQ(q.largest_radius_edge.front().value, q.max_radius_edge());
  EXPECT_EQ(q.shortest_edge.front().value, q.edge_length_mm.min);
  EXPECT_EQ(q.least_height.front().value, q.min_height_mm.min);
  EXPECT_EQ(q.smallest_scaled_jacobian.front().value, q.scaled_jacobian.min);
  EXPECT_EQ(q.largest_dihedral.front().value, q.max_dihedral_deg());
  EXPECT_EQ(q.least_height.front().tet, spoiled);
  for (std::size_t i = 1; i < kWorstTets; ++i) {
    EXPECT_LE(q.least_height[i - 1].value, q.least_height[i].value);
    EXPECT_LE(q.smallest_scaled_jacobian[i - 1].value, q.smallest_scaled_jacobian[i].value);
    EXPECT_GE(q.largest_dihedral[i - 1].value, q.largest_dihedral[i].value);
    EXPECT_LE(q.smallest_dihedral[i - 1].value, q.smallest_dihedral[i].value);
    EXPECT_GE(q.largest_radius_edge[i - 1].value, q.largest_radius_edge[i].value);
  }
  const WorstTet& worst = q.smallest_dihedral.front();
  const Tet& named = mesh.tets[worst.tet];
  Point center;
  for (VertexId v : named) center = center + 0.25 * mesh.vertices[v];
  EXPECT_LT(distance(worst.place, center), 1e-12);
}

// Six tets or so share an edge: it is in the list once.
TEST(Quality, ShortestEdgesAreListedOnce) {
  TetMesh mesh = shaken_grid(4);
  std::vector<double> lengths;
  std::set<std::pair<VertexId, VertexId>> edges;
  for (const Tet& t : mesh.tets) {
    for (const auto& e : kTetEdges) {
      const auto edge = std::minmax(t[static_cast<std::size_t>(e[0])], t[static_cast<std::size_t>(e[1])]);
      if (edges.insert(edge).second) lengths.push_back(distance(mesh.vertices[edge.first], mesh.vertices[edge.second]));
    }
  }
  std::sort(lengths.begin(), lengths.end());
  const QualitySummary q = measure_quality(mesh);
  ASSERT_EQ(q.shortest_edge.size(), kWorstTets);
  for (std::size_t i = 0; i < kWorstTets; ++i) EXPECT_EQ(q.shortest_edge[i].value, lengths[i]) << i;
}

TEST(Quality, StableTimeStepIsHeightOverWaveSpeed) {
  QualitySummary q = measure_quality(shaken_grid(3));
  EXPECT_EQ(q.wave_speed_m_per_s, 1500);
  q.set_wave_speed(4000);  // bone: 4 mm/µs
  EXPECT_EQ(q.wave_speed_m_per_s, 4000);
  EXPECT_DOUBLE_EQ(q.stable_time_step_us.min, q.min_height_mm.min / 4);
  EXPECT_DOUBLE_EQ(q.stable_time_step_us.percentiles[3], q.min_height_mm.percentiles[3] / 4);
  EXPECT_EQ(q.stable_time_step_us.histogram.counts, q.min_height_mm.histogram.counts);
  expect_consistent(q.stable_time_step_us);
}

TEST(Quality, NumberOfThreadsDoesNotMatter) {
  const TetMesh mesh = shaken_grid(14);  // more tets than one thread takes at once
  const Ramp size;
  std::vector<QualitySummary> all;
  for (const std::size_t threads : {1, 2, 5}) {
    with_threads(threads, [&] { all.push_back(measure_quality(mesh, &size, &size)); });
  }
  for (const QualitySummary& q : all) {
    EXPECT_EQ(q.total_volume_mm3, all[0].total_volume_mm3);
    for (const auto d :
         {&QualitySummary::dihedral_deg, &QualitySummary::scaled_jacobian, &QualitySummary::radius_edge,
          &QualitySummary::min_height_mm, &QualitySummary::largest_dihedral_deg, &QualitySummary::stiffness_ratio}) {
      EXPECT_EQ((q.*d).mean, (all[0].*d).mean);
      EXPECT_EQ((q.*d).percentiles, (all[0].*d).percentiles);
      EXPECT_EQ((q.*d).histogram.counts, (all[0].*d).histogram.counts);
    }
    EXPECT_EQ(q.size_ratio->mean, all[0].size_ratio->mean);
    for (std::size_t i = 0; i < kWorstTets; ++i) {
      EXPECT_EQ(q.shortest_edge[i].tet, all[0].shortest_edge[i].tet);
      EXPECT_EQ(q.smallest_scaled_jacobian[i].tet, all[0].smallest_scaled_jacobian[i].tet);
    }
  }
}

TEST(Quality, RegionsAddUp) {
  const QualitySummary q = measure_quality(grid_mesh(4, [](int i, int, int) { return i == 0 ? 7 : 2; }));
  ASSERT_EQ(q.regions.size(), 2u);
  EXPECT_EQ(q.regions[0].region, 2);
  EXPECT_EQ(q.regions[0].tets, 6u * 48);
  EXPECT_NEAR(q.regions[0].volume_mm3, 48, 1e-9);
  EXPECT_EQ(q.regions[1].region, 7);
  EXPECT_NEAR(q.regions[1].volume_mm3, 16, 1e-9);
}

TEST(Quality, SizesAreComparedWithTheFieldAtTheCircumcentre) {
  EXPECT_FALSE(measure_quality(grid_mesh(2)).size_ratio);
  // All six tets of a cube have its centre as their circumcentre.
  const Ramp ramp;
  const QualitySummary q = measure_quality(grid_mesh(4), &ramp);
  ASSERT_TRUE(q.size_ratio);
  expect_consistent(*q.size_ratio);
  EXPECT_EQ(q.size_ratio->count, q.volume_mm3.count);
  const double radius = std::sqrt(3.0) / 2;
  EXPECT_NEAR(q.size_ratio->max, radius / 1.25, 1e-12);
  EXPECT_NEAR(q.size_ratio->min, radius / 2.75, 1e-12);
  EXPECT_NEAR(q.size_ratio->mean, radius * (1 / 1.25 + 1 / 1.75 + 1 / 2.25 + 1 / 2.75) / 4, 1e-12);
  const Histogram& h = q.size_ratio->histogram;
  ASSERT_EQ(h.counts.size(), 41u);
  EXPECT_EQ(h.edges[0], 0);
  EXPECT_EQ(h.edges[40], 1);
  EXPECT_EQ(h.counts[40], 0u);
  const UniformSize small(0.5);
  const QualitySummary coarse = measure_quality(grid_mesh(2), &small);
  EXPECT_EQ(coarse.size_ratio->histogram.counts[40], coarse.size_ratio->count) << "all are above 1";
  EXPECT_NEAR(coarse.size_ratio->histogram.edges[41], radius / 0.5, 1e-12);
}

TEST(Quality, EdgesAreComparedWithTheFieldAtTheirMiddle) {
  EXPECT_FALSE(measure_quality(grid_mesh(2)).edge_size_ratio);
  EXPECT_TRUE(measure_quality(grid_mesh(2)).least_edge_size_ratio.empty());
  const Ramp ramp;
  const QualitySummary q = measure_quality(grid_mesh(4), nullptr, &ramp);
  EXPECT_FALSE(q.size_ratio);
  ASSERT_TRUE(q.edge_size_ratio);
  expect_consistent(*q.edge_size_ratio);
  EXPECT_EQ(q.edge_size_ratio->count, q.edge_length_mm.count);
  EXPECT_NEAR(q.edge_size_ratio->min, 1.0 / 3, 1e-12) << "edges of length 1 at x = 4, where the size is 3";
  ASSERT_EQ(q.least_edge_size_ratio.size(), kWorstTets);
  std::set<std::pair<double, double>> places;
  for (const WorstTet& worst : q.least_edge_size_ratio) {
    EXPECT_EQ(worst.value, q.edge_size_ratio->min);
    EXPECT_EQ(worst.place.x, 4);
    places.insert({worst.place.y, worst.place.z});
  }
  EXPECT_EQ(places.size(), kWorstTets) << "each edge once";
}

TEST(Quality, ConditionFactorIsThatOfTheWorstTetByShapeAndSize) {
  // All tets of the grid are alike, so only their shape counts.
  const QualitySummary q = measure_quality(grid_mesh(3));
  expect_consistent(q.stiffness_ratio);
  EXPECT_EQ(q.stiffness_ratio.histogram.edges[0], 1);
  EXPECT_EQ(q.stiffness_ratio.histogram.edges[40], 5);
  EXPECT_NEAR(q.condition_factor, q.stiffness_ratio.max, 1e-12);
  EXPECT_EQ(q.largest_stiffness_ratio.front().value, q.stiffness_ratio.max);
  EXPECT_NEAR(q.median_volume_mm3(), 1.0 / 6, 1e-12);
  // One tet of half the edge length among others of that shape.
  TetMesh mesh;
  for (const double edge : {1.0, 1.0, 0.5}) {
    const auto first = static_cast<VertexId>(mesh.vertices.size());
    for (const Point& p : {Point{1, 1, 1}, Point{-1, 1, -1}, Point{-1, -1, 1}, Point{1, -1, -1}}) {
      mesh.vertices.push_back(edge * p);
    }
    mesh.tets.push_back({first, first + 1, first + 2, first + 3});
  }
  EXPECT_NEAR(measure_quality(mesh).condition_factor, 4, 1e-12);
  EXPECT_TRUE(std::isnan(measure_quality(TetMesh{}).condition_factor));
}

TEST(Quality, FlatTetsAreCountedAsInfinite) {
  TetMesh mesh;
  mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 0}};
  mesh.tets = {{0, 1, 2, 3}, {0, 1, 2, 4}};
  const QualitySummary q = measure_quality(mesh);
  EXPECT_EQ(q.radius_edge.infinite, 1u);
  EXPECT_TRUE(std::isinf(q.max_radius_edge()));
  EXPECT_TRUE(std::isinf(q.radius_edge.percentiles.back()));
  EXPECT_TRUE(std::isfinite(q.radius_edge.mean));
  EXPECT_EQ(q.radius_edge.histogram.counts.back(), 1u);
  EXPECT_EQ(q.inverse_aspect.min, 0);
  EXPECT_EQ(q.scaled_jacobian.min, 0);
  EXPECT_EQ(q.stable_time_step_us.min, 0);
  const UniformSize size(1);
  EXPECT_EQ(measure_quality(mesh, &size).size_ratio->infinite, 1u);
  EXPECT_EQ(q.stiffness_ratio.infinite, 1u);
  EXPECT_TRUE(std::isinf(q.condition_factor));
  EXPECT_EQ(q.min_dihedral_deg(), 0);
  EXPECT_EQ(q.max_dihedral_deg(), 180);
}

TEST(Quality, EmptyMeshHasNoNumbers) {
  const QualitySummary q = measure_quality({});
  EXPECT_EQ(q.dihedral_deg.count, 0u);
  EXPECT_TRUE(std::isnan(q.min_dihedral_deg()));
  EXPECT_TRUE(std::isnan(q.min_facet_angle_deg));
  EXPECT_EQ(q.total_volume_mm3, 0);
  EXPECT_EQ(q.edge_length_mm.histogram.counts.size() + 1, q.edge_length_mm.histogram.edges.size());
}

TEST(Quality, RefusesWhatIsNoMesh) {
  const auto code_of = [](const TetMesh& mesh) -> std::string {
    try {
      measure_quality(mesh);
    } catch (const Error& e) {
      return e.code();
    }
    return "no error";
  };
  TetMesh bad_tet = grid_mesh(1);
  bad_tet.tets[2][1] = 8;
  EXPECT_EQ(code_of(bad_tet), "mesh.inconsistent");
  TetMesh bad_facet = grid_mesh(1);
  bad_facet.boundary_facets[2][1] = 8;
  EXPECT_EQ(code_of(bad_facet), "mesh.inconsistent");
  TetMesh bad_region = grid_mesh(1);
  bad_region.tet_regions.pop_back();
  EXPECT_EQ(code_of(bad_region), "mesh.inconsistent");
  TetMesh bad_point = grid_mesh(1);
  bad_point.vertices[3].y = std::nan("");
  EXPECT_EQ(code_of(bad_point), "mesh.inconsistent");
}

}  // namespace
}  // namespace scantet
