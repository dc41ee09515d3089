// Meshes of the engine alone, without files and third parties, by their bytes: on every processor, by every compiler
// and with assertions and sanitizers the same as recorded here. Objects are made of whole numbers and arithmetic
// without the C library's elementary functions, which round as each pleases.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <iomanip>
#include <random>
#include <sstream>
#include <string>
#include <vector>

#include "scantet/domain/analytic.h"
#include "scantet/image/nested_level_sets.h"
#include "scantet/labels/label_object.h"
#include "scantet/optimize/optimizer.h"
#include "scantet/refine/mesher.h"
#include "unit/image/test_scan.h"
#include "unit/labels/label_scan.h"

namespace scantet {
namespace {

/// FNV-1a of 64 bits over the bytes of arrays.
class Hash {
 public:
  template <class Element>
  void add(const std::vector<Element>& elements) {
    const auto* bytes = reinterpret_cast<const unsigned char*>(elements.data());
    for (std::size_t n = 0; n < elements.size() * sizeof(Element); ++n) {
      value_ = (value_ ^ bytes[n]) * 0x100000001b3;
    }
  }
  std::uint64_t value() const { return value_; }

 private:
  std::uint64_t value_ = 0xcbf29ce484222325;
};

/// "vertices, tets, hash" of the mesh as it is refined and improved.
std::string mesh_of(const Domain& domain, const SizingField& size, const ElementBounds& bounds = {}) {
  Progress progress;
  MeshResult result = mesh_domain(domain, size, {}, progress);
  optimize_mesh(result.mesh, domain, {Optimize::full, bounds}, progress);
  const TetMesh& mesh = result.mesh;
  Hash hash;
  hash.add(mesh.vertices);
  hash.add(mesh.tets);
  hash.add(mesh.tet_regions);
  hash.add(mesh.boundary_facets);
  std::ostringstream text;
  text << mesh.vertices.size() << ", " << mesh.tets.size() << ", " << std::hex << std::setfill('0') << std::setw(16)
       << hash.value();
  return text.str();
}

/// Noise of whole numbers, each the sum of its neighbourhood of 3³ voxels: rough, with handles and cavities.
Scan rough_scan(int width) {
  std::mt19937 random(11);
  std::vector<int> noise(static_cast<std::size_t>(width) * width * width);
  for (int& value : noise) value = static_cast<int>(random() % 64);
  const auto inside = [width](int n) { return std::clamp(n, 0, width - 1); };
  return test::scan_of_function<std::int16_t>({width, width, width}, [&](int i, int j, int k) {
    int sum = 0;
    for (int n = 0; n < 27; ++n) {
      sum += noise[inside(i + n % 3 - 1) + width * (inside(j + n / 3 % 3 - 1) + width * inside(k + n / 9 - 1))];
    }
    return sum;
  });
}

/// Four cells around a point off the centre of a ball, in whole numbers.
Scan four_cells(int width) {
  return test::label_scan({width, width, width}, [width](int i, int j, int k) {
    const int x = 2 * i - width, y = 2 * j - width, z = 2 * k - width;
    if (x * x + y * y + z * z > (width - 2) * (width - 2)) return 0;
    if (3 * x - y + 2 * z > 5) return 1;
    if (x + 4 * y - z > 3) return 2;
    return 2 * z - x > 1 ? 3 : 4;
  });
}

TEST(EngineBytes, OfASmoothObject) {
  EXPECT_EQ(mesh_of(*make_torus({0, 0, 0}, 10, 4), UniformSize(1.5)), "912, 3769, e381ab325516fdfe");
}

TEST(EngineBytes, OfAGradedSize) {
  const FinerSize size(std::make_shared<UniformSize>(0.5), {{{1.5, 1.5, 0}, 0.1}});
  EXPECT_EQ(mesh_of(*make_tanglecube(), size), "400, 1204, d4db47c4c02f19dd");
}

TEST(EngineBytes, OfARoughScan) {
  const auto domain = make_level_set(rough_scan(20), {850, InsideSide::above, std::nullopt});
  EXPECT_EQ(mesh_of(*domain, UniformSize(2)), "7408, 23252, 0fd4dfc191885e37");
}

TEST(EngineBytes, OfSeveralLevelsInAnObliqueFrame) {
  const Frame frame({Vec{0.75, 0.5, 0}, Vec{-0.5, 0.75, 0.125}, Vec{0, -0.25, 1.5}}, {-310, 420, -150});
  const Scan scan = test::scan_of_function<std::int16_t>(
      {24, 24, 24},
      [](int i, int j, int k) {
        const int x = i - 12, y = j - 12, z = k - 12;
        return 1000 - 8 * (x * x + y * y) - 5 * z * z;
      },
      frame);
  const auto domain = make_nested_level_sets(scan, {{300, 700}, InsideSide::above, std::nullopt});
  ElementBounds bounds;
  bounds.min_dihedral_deg = 15;
  EXPECT_EQ(mesh_of(*domain, UniformSize(1.25), bounds), "2126, 10832, 35a2f1670da88e0d");
}

TEST(EngineBytes, OfASegmentation) {
  Progress progress;
  const LabelObject object = make_label_object(four_cells(22), {}, progress);
  EXPECT_EQ(mesh_of(*object.domain, UniformSize(2)), "546, 2482, cb6ec456f6322782");
}

}  // namespace
}  // namespace scantet
