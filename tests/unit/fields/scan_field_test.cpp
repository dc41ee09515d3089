// Fields of scans against formulas that are known, and against themselves when tets are cut.
#include "scantet/fields/scan_field.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>

#include "scantet/base/parallel.h"
#include "scantet/field/scan_from_memory.h"

namespace scantet {
namespace {

Frame oblique() {
  return Frame({Vec{0.8, 0.1, 0.05}, Vec{-0.12, 1.1, 0.2}, Vec{0.03, -0.25, 1.5}}, {-3, 4, 11});
}

template <class Voxel>
Scan scan_of(const std::function<double(int, int, int)>& value, std::array<int, 3> size, const Frame& frame) {
  std::vector<Voxel> values;
  for (int k = 0; k < size[2]; ++k) {
    for (int j = 0; j < size[1]; ++j) {
      for (int i = 0; i < size[0]; ++i) values.push_back(static_cast<Voxel>(value(i, j, k)));
    }
  }
  return make_scan(std::move(values), size, frame);
}

/// Tets between random points of the index box [low, high], positively oriented.
TetMesh random_tets(const Frame& frame, double low, double high, std::size_t count, unsigned seed = 1) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> at(low, high);
  TetMesh mesh;
  for (std::size_t t = 0; t < count; ++t) {
    Tet tet{};
    for (VertexId& v : tet) {
      v = static_cast<VertexId>(mesh.vertices.size());
      const double x = at(random), y = at(random), z = at(random);
      mesh.vertices.push_back(frame.to_world({x, y, z}));
    }
    const auto& p = mesh.vertices;
    if (orientation_mm3(p[tet[0]], p[tet[1]], p[tet[2]], p[tet[3]]) < 0) std::swap(tet[2], tet[3]);
    mesh.tets.push_back(tet);
  }
  return mesh;
}

double volume_mm3(const TetMesh& mesh, std::size_t t) {
  const Tet& tet = mesh.tets[t];
  return orientation_mm3(mesh.vertices[tet[0]], mesh.vertices[tet[1]], mesh.vertices[tet[2]], mesh.vertices[tet[3]]) /
         6;
}

/// Each tet as the four around a point in it, or the eight that halved edges make.
TetMesh cut_up(const TetMesh& mesh) {
  TetMesh fine;
  fine.vertices = mesh.vertices;
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    const Tet& tet = mesh.tets[t];
    const auto middle = static_cast<VertexId>(fine.vertices.size());
    Point p{};
    const double weights[] = {0.1, 0.2, 0.3, 0.4};
    for (std::size_t i = 0; i < 4; ++i) p = p + weights[i] * mesh.vertices[tet[i]];
    fine.vertices.push_back(p);
    for (std::size_t i = 0; i < 4; ++i) {
      Tet part = tet;
      part[i] = middle;
      fine.tets.push_back(part);
    }
  }
  return fine;
}

double noise(int i, int j, int k) {
  return static_cast<double>((i * 7919 + j * 104729 + k * 1299709) % 1000) - 300;
}

TEST(ScanField, MeanOfAnAffineFunctionIsItsValueAtTheCentroid) {
  const Frame frame = oblique();
  const auto f = [](double x, double y, double z) { return 5 + 2 * x - 3 * y + 0.5 * z; };
  const Scan scan = scan_of<double>([&](int i, int j, int k) { return f(i, j, k); }, {12, 11, 10}, frame);
  const TetMesh mesh = random_tets(frame, 0, 9, 200);
  const ScanField field = scan_field(mesh, scan);
  ASSERT_EQ(field.values.size(), mesh.tets.size());
  EXPECT_EQ(field.tets_outside, 0u);
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    Point middle{};
    for (const VertexId v : mesh.tets[t]) middle = middle + 0.25 * mesh.vertices[v];
    const Vec at = frame.to_index(middle);
    EXPECT_NEAR(field.values[t], f(at.x, at.y, at.z), 1e-10);
  }
}

TEST(ScanField, MeanOfTheProductOfCoordinatesIsTheClosedForm) {
  const Frame frame = oblique();
  const Scan scan =
      scan_of<double>([](int i, int j, int k) { return double(i) * double(j) * double(k); }, {12, 11, 10}, frame);
  const TetMesh mesh = random_tets(frame, 0, 9, 200, 2);
  const ScanField field = scan_field(mesh, scan);
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    // By Dunavant-free means: the mean of xyz over a tet, from corner values.
    std::array<Vec, 4> p;
    for (std::size_t i = 0; i < 4; ++i) p[i] = frame.to_index(mesh.vertices[mesh.tets[t][i]]);
    double mean = 0;
    for (std::size_t a = 0; a < 4; ++a) {
      for (std::size_t b = 0; b < 4; ++b) {
        for (std::size_t c = 0; c < 4; ++c) {
          const int same = (a == b) + (b == c) + (a == c);
          mean += p[a].x * p[b].y * p[c].z * (same == 3 ? 6 : same == 1 ? 2 : 1) / 120;
        }
      }
    }
    EXPECT_NEAR(field.values[t], mean, 1e-10 * (1 + std::abs(mean)));
  }
}

TEST(ScanField, StandardDeviationIsTheClosedFormOfALinearFunctionAndNoneOfAConstant) {
  const Frame frame;
  const Scan scan = scan_of<float>([](int i, int, int) { return i; }, {8, 8, 8}, frame);
  const TetMesh mesh = random_tets(frame, 0, 7, 100, 3);
  const ScanField field = scan_field(mesh, scan, {FieldMeasure::std});
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    double sum = 0, squares = 0;
    for (const VertexId v : mesh.tets[t]) {
      sum += mesh.vertices[v].x;
      squares += mesh.vertices[v].x * mesh.vertices[v].x;
    }
    const double variance = (sum * sum + squares) / 20 - sum * sum / 16;
    EXPECT_NEAR(field.values[t], std::sqrt(variance), 1e-9);
  }
}

TEST(ScanField, TheTotalIsTheIntegralHoweverTheMeshIsCut) {
  const Frame frame = oblique();
  const Scan scan = scan_of<std::int16_t>(noise, {12, 11, 10}, frame);
  const TetMesh mesh = random_tets(frame, -3, 13, 300, 4);
  const TetMesh fine = cut_up(mesh);
  for (const FieldChoice choice : {FieldChoice{FieldMeasure::mean}, FieldChoice{FieldMeasure::fraction, -300 + 19}}) {
    const ScanField coarse_field = scan_field(mesh, scan, choice);
    const ScanField fine_field = scan_field(fine, scan, choice);
    double scale = 0;
    for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
      double parts = 0, volume = 0;
      for (std::size_t i = 4 * t; i < 4 * t + 4; ++i) {
        parts += volume_mm3(fine, i) * fine_field.values[i];
        volume += volume_mm3(fine, i);
      }
      EXPECT_NEAR(coarse_field.values[t] * volume_mm3(mesh, t), parts, 1e-10 * 1000 * volume) << t;
      scale += volume_mm3(mesh, t) * std::abs(coarse_field.values[t]);
    }
    EXPECT_NEAR(coarse_field.total, fine_field.total, 1e-10 * scale);
  }
}

TEST(ScanField, TheTotalOverTheBoxOfVoxelCentresIsTheSumOfTheTrapezoidRule) {
  const Frame frame = oblique();
  const std::array<int, 3> size{6, 5, 4};
  const Scan scan =
      scan_of<std::uint8_t>([](int i, int j, int k) { return std::abs(noise(i, j, k)) / 4; }, size, frame);
  TetMesh mesh;  // Kuhn's six tets of the box
  for (int corner = 0; corner < 8; ++corner) {
    mesh.vertices.push_back(frame.to_world({5.0 * (corner & 1), 4.0 * (corner >> 1 & 1), 3.0 * (corner >> 2)}));
  }
  for (const std::array<int, 3>& way : {std::array{1, 2, 4}, {2, 4, 1}, {4, 1, 2}, {2, 1, 4}, {1, 4, 2}, {4, 2, 1}}) {
    Tet tet{0, VertexId(way[0]), VertexId(way[0] + way[1]), 7};
    const auto& p = mesh.vertices;
    if (orientation_mm3(p[tet[0]], p[tet[1]], p[tet[2]], p[tet[3]]) < 0) std::swap(tet[1], tet[2]);
    mesh.tets.push_back(tet);
  }
  double sum = 0;
  const auto* voxels = std::get<const std::uint8_t*>(scan.voxels);
  for (int k = 0; k < size[2]; ++k) {
    for (int j = 0; j < size[1]; ++j) {
      for (int i = 0; i < size[0]; ++i) {
        const double weight = (i % 5 == 0 ? 0.5 : 1) * (j % 4 == 0 ? 0.5 : 1) * (k % 3 == 0 ? 0.5 : 1);
        sum += weight * voxels[(k * size[1] + j) * size[0] + i];
      }
    }
  }
  sum *= std::abs(frame.determinant_mm3());
  EXPECT_NEAR(scan_field(mesh, scan).total, sum, 1e-11 * sum);
}

TEST(ScanField, FractionsOfAllLabelsAddUpToOne) {
  const Frame frame = oblique();
  const Scan scan =
      scan_of<std::uint16_t>([](int i, int j, int k) { return (i + 2 * j + k * k) % 3; }, {9, 9, 9}, frame);
  const TetMesh mesh = random_tets(frame, 0, 8, 100, 5);
  std::vector<double> sums(mesh.tets.size(), 0);
  for (const double label : {0.0, 1.0, 2.0}) {
    const ScanField field = scan_field(mesh, scan, {FieldMeasure::fraction, label});
    for (std::size_t t = 0; t < sums.size(); ++t) sums[t] += field.values[t];
  }
  for (const double total : sums) EXPECT_NEAR(total, 1, 1e-12);
}

TEST(ScanField, RanksAreOfVoxelsThatShareVolumeWithTheTet) {
  const Frame frame;
  const Scan scan = scan_of<std::int32_t>([](int i, int, int) { return 10 * i; }, {6, 6, 6}, frame);
  TetMesh mesh;  // x from 0.5 to 3.5: the boxes of the voxels 1, 2 and 3, most of it in 1
  mesh.vertices = {{0.5, 1, 1}, {3.5, 1, 1}, {0.5, 4, 1}, {0.5, 1, 4}};
  mesh.tets = {{0, 1, 2, 3}};
  EXPECT_EQ(scan_field(mesh, scan, {FieldMeasure::min}).values[0], 10);
  EXPECT_EQ(scan_field(mesh, scan, {FieldMeasure::max}).values[0], 30);
  EXPECT_EQ(scan_field(mesh, scan, {FieldMeasure::median}).values[0], 10);
  EXPECT_NEAR(scan_field(mesh, scan, {FieldMeasure::fraction, 30}).values[0], 1.0 / 27, 1e-14);
}

TEST(ScanField, ATetWithoutVolumeIsInTheVoxelAtItsCentroid) {
  const Scan scan = scan_of<std::int32_t>([](int i, int, int) { return 10 * i; }, {6, 6, 6}, Frame());
  TetMesh mesh;
  mesh.vertices = {{1, 1, 1}, {3, 1, 1}, {1, 3, 1}, {2, 2, 1}};
  mesh.tets = {{0, 1, 2, 3}};
  EXPECT_EQ(scan_field(mesh, scan, {FieldMeasure::max}).values[0], 20);
  EXPECT_EQ(scan_field(mesh, scan, {FieldMeasure::median}).values[0], 20);
  EXPECT_EQ(scan_field(mesh, scan, {FieldMeasure::fraction, 20}).values[0], 1) << "a share, and not the label";
  EXPECT_EQ(scan_field(mesh, scan, {FieldMeasure::fraction, 10}).values[0], 0);
}

TEST(ScanField, OutsideTheScanIsTheNearestPlaceInItAndCounted) {
  const Frame frame;
  const Scan scan = scan_of<float>([](int i, int, int) { return i; }, {4, 4, 4}, frame);
  TetMesh mesh;
  mesh.vertices = {{10, 1, 1}, {12, 1, 1}, {10, 2, 1}, {10, 1, 2}};
  mesh.tets = {{0, 1, 2, 3}};
  const ScanField field = scan_field(mesh, scan);
  EXPECT_EQ(field.values[0], 3);
  EXPECT_EQ(field.tets_outside, 1u);
  EXPECT_EQ(scan_field(mesh, scan, {FieldMeasure::max}).values[0], 3);
}

/// Each tet as the eight that halved edges make, so often.
TetMesh halved(const TetMesh& mesh, int times) {
  if (times == 0) return mesh;
  TetMesh fine;
  for (const Tet& tet : mesh.tets) {
    std::array<VertexId, 4> corner{};
    std::array<std::array<VertexId, 4>, 4> middle{};
    const auto put = [&](const Point& p) {
      fine.vertices.push_back(p);
      return static_cast<VertexId>(fine.vertices.size() - 1);
    };
    for (std::size_t i = 0; i < 4; ++i) {
      corner[i] = put(mesh.vertices[tet[i]]);
      for (std::size_t j = 0; j < i; ++j) {
        middle[i][j] = middle[j][i] = put(0.5 * (mesh.vertices[tet[i]] + mesh.vertices[tet[j]]));
      }
    }
    for (std::size_t i = 0; i < 4; ++i) {
      Tet part = middle[i];
      part[i] = corner[i];
      fine.tets.push_back(part);
    }
    const auto& m = middle;
    for (const auto& [a, b] :
         {std::pair{m[0][1], m[0][2]}, {m[0][2], m[2][3]}, {m[2][3], m[1][3]}, {m[1][3], m[0][1]}}) {
      fine.tets.push_back({m[0][3], m[1][2], a, b});
    }
  }
  return halved(fine, times - 1);
}

/// By volume, over some tets.
double mean_of(const TetMesh& mesh, const ScanField& field, std::size_t begin, std::size_t end) {
  double sum = 0, all = 0;
  for (std::size_t t = begin; t < end; ++t) {
    const double volume = std::abs(volume_mm3(mesh, t));
    sum += volume * field.values[t];
    all += volume;
  }
  return sum / all;
}

TEST(ScanField, FluxesThroughFacetsGiveWhatPiecesOfTetsGive) {
  // Tets of a sixteenth are smaller than voxels: their means come from pieces, those of whole ones from fluxes.
  const Frame frame = oblique();
  const Scan scan = scan_of<std::int16_t>(noise, {12, 11, 10}, frame);
  const TetMesh mesh = random_tets(frame, 0, 9, 20, 7);
  const TetMesh fine = halved(mesh, 4);
  const std::size_t parts = fine.tets.size() / mesh.tets.size();
  const ScanField whole = scan_field(mesh, scan);
  const ScanField small = scan_field(fine, scan);
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    EXPECT_NEAR(whole.values[t], mean_of(fine, small, parts * t, parts * (t + 1)), 1e-12 * 700) << t;
  }
}

TEST(ScanField, TetsThatShareFacetsHaveTheMeansThatTheyHaveAlone) {
  const Frame frame = oblique();
  const Scan scan = scan_of<float>(noise, {40, 12, 11}, frame);
  TetMesh mesh;  // boxes of Kuhn's six tets that share vertices, some of them far from the scan's first plane
  constexpr int kBoxes = 9;
  for (int k = 0; k < 3; ++k) {
    for (int j = 0; j < 3; ++j) {
      for (int i = 0; i <= kBoxes; ++i)
        mesh.vertices.push_back(frame.to_world({0.3 + 4.1 * i, 3.7 * j + 0.1 * i, 4.2 * k}));
    }
  }
  const int step[3] = {1, kBoxes + 1, 3 * (kBoxes + 1)};
  for (int box = 0; box < 4 * kBoxes; ++box) {
    const int first = box % kBoxes + step[1] * (box / kBoxes % 2) + step[2] * (box / kBoxes / 2);
    for (const auto& [a, b] : {std::pair{0, 1}, {0, 2}, {1, 0}, {1, 2}, {2, 0}, {2, 1}}) {
      const int second = first + step[a], third = second + step[b];
      mesh.tets.push_back({VertexId(first), VertexId(second), VertexId(third), VertexId(third + step[3 - a - b])});
    }
  }
  const ScanField together = scan_field(mesh, scan);
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    TetMesh alone;
    for (const VertexId v : mesh.tets[t]) alone.vertices.push_back(mesh.vertices[v]);
    alone.tets = {{0, 1, 2, 3}};
    TetMesh fine = halved(alone, 4);
    const ScanField pieces = scan_field(fine, scan);
    EXPECT_NEAR(together.values[t], mean_of(fine, pieces, 0, fine.tets.size()), 1e-12 * 700) << t;
  }
}

TEST(ScanField, AnyNumberOfThreadsGivesTheSameValues) {
  const Frame frame = oblique();
  const Scan scan = scan_of<std::int16_t>(noise, {12, 11, 10}, frame);
  const TetMesh mesh = random_tets(frame, -1, 11, 3000, 6);
  ScanField one, four;
  with_threads(1, [&] { one = scan_field(mesh, scan); });
  with_threads(4, [&] { four = scan_field(mesh, scan); });
  EXPECT_EQ(one.values, four.values);
  EXPECT_EQ(one.total, four.total);
}

}  // namespace
}  // namespace scantet
