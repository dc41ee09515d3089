// The function is applied to the voxels, and the result is interpolated, as Bonemat's third version does.
#include "scantet/materials/tet_means.h"

#include <array>

#include "scantet/base/parallel.h"
#include "scantet/field/scan_from_memory.h"

namespace scantet {
namespace {

using Weights = std::array<double, 4>;

Weights middle(const Weights& a, const Weights& b) {
  return {(a[0] + b[0]) / 2, (a[1] + b[1]) / 2, (a[2] + b[2]) / 2, (a[3] + b[3]) / 2};
}

/// Points of the rule in a tet that is cut into eight, so many times over; in barycentric coordinates, of equal weight.
void add_points(const std::array<Weights, 4>& tet, int times, std::vector<Weights>& points) {
  const auto& [a, b, c, d] = tet;
  if (times == 0) {
    constexpr double kNear = 0.5854101966249685;
    constexpr double kFar = 0.1381966011250105;
    for (std::size_t k = 0; k < 4; ++k) {
      Weights point{};
      for (std::size_t i = 0; i < 4; ++i) {
        for (std::size_t j = 0; j < 4; ++j) point[i] += (j == k ? kNear : kFar) * tet[j][i];
      }
      points.push_back(point);
    }
    return;
  }
  const Weights ab = middle(a, b);
  const Weights ac = middle(a, c);
  const Weights ad = middle(a, d);
  const Weights bc = middle(b, c);
  const Weights bd = middle(b, d);
  const Weights cd = middle(c, d);
  const std::array<std::array<Weights, 4>, 8> parts{{{a, ab, ac, ad},
                                                     {ab, b, bc, bd},
                                                     {ac, bc, c, cd},
                                                     {ad, bd, cd, d},
                                                     {ab, ac, ad, bd},
                                                     {ab, ac, bc, bd},
                                                     {ac, ad, bd, cd},
                                                     {ac, bc, bd, cd}}};
  for (const auto& part : parts) add_points(part, times - 1, points);
}

Scan mapped(const Scan& scan, const std::function<double(double)>& of_value) {
  std::vector<double> values(static_cast<std::size_t>(scan.voxel_count()));
  std::visit(
      [&](const auto* voxels) {
        parallel_for(values.size(), 1 << 16, [&](std::size_t begin, std::size_t end) {
          for (std::size_t i = begin; i < end; ++i) values[i] = of_value(static_cast<double>(voxels[i]));
        });
      },
      scan.voxels);
  Scan result = scan;
  const auto kept = std::make_shared<const std::vector<double>>(std::move(values));
  result.voxels = VoxelPointer{kept->data()};
  result.owner = kept;
  return result;
}

}  // namespace

std::vector<double> tet_means(const TetMesh& mesh, const ScanValues& scan,
                              const std::function<double(double)>& of_value) {
  const ScanValues values(mapped(scan.scan(), of_value));
  constexpr int kTimes = 2;
  std::vector<Weights> points;
  add_points({{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}}}, kTimes, points);
  std::vector<double> means(mesh.tets.size());
  parallel_for(means.size(), 256, [&](std::size_t begin, std::size_t end) {
    for (std::size_t t = begin; t < end; ++t) {
      double sum = 0;
      for (const Weights& w : points) {
        Point p;
        for (std::size_t i = 0; i < 4; ++i) p = p + w[i] * mesh.vertices[mesh.tets[t][i]];
        sum += values.at(p);
      }
      means[t] = sum / static_cast<double>(points.size());
    }
  });
  return means;
}

}  // namespace scantet
