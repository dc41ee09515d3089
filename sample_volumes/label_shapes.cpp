// Segmentations of shapes that are known exactly: each voxel has the label that its centre has in truth. Made with +,
// -,
// *, / and square roots only, as the scans of shapes.cpp.
#include <algorithm>
#include <cmath>
#include <functional>
#include <sstream>

#include "sample.h"

namespace samples {
namespace {

using Label = std::function<int(const Vec3&)>;

Vec3 minus(const Vec3& a, const Vec3& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

double dot(const Vec3& a, const Vec3& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

std::string text(const Vec3& p) {
  std::ostringstream out;
  out << "(" << p[0] << ", " << p[1] << ", " << p[2] << ")";
  return out.str();
}

// The parts of a voxel, of 1 mm³, that have each label. By the midpoint rule, but where all voxels around have the
// same.
void add_volumes(const Label& label_at, const Vec3& center, std::vector<LabelMap::Row>& rows) {
  constexpr int kSteps = 10;
  for (int n = 0; n < kSteps * kSteps * kSteps; ++n) {
    const auto off = [](int step) { return (step + 0.5) / kSteps - 0.5; };
    const int label = label_at(
        {center[0] + off(n % kSteps), center[1] + off(n / kSteps % kSteps), center[2] + off(n / (kSteps * kSteps))});
    for (LabelMap::Row& row : rows) row.volume_mm3 += row.label == label ? 1.0 / (kSteps * kSteps * kSteps) : 0;
  }
}

// names: of the labels 1, 2 … Voxels are 1 mm cubes; the origin of world space is off the middle of the grid by what is
// given, so that nothing sits on a symmetry plane of it.
LabelMap label_map(const std::string& file, int side, const Vec3& off_middle, const Label& label_at,
                   const std::vector<std::string>& names) {
  LabelMap map;
  map.scan.files = {file};
  map.scan.pixel = Pixel::uint8;
  map.scan.grid.size = {side, side, side};
  map.scan.grid.columns = {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}};
  for (int axis = 0; axis < 3; ++axis) map.scan.grid.origin[axis] = off_middle[axis] - (side - 1) / 2.0;
  for (std::size_t n = 0; n < names.size(); ++n) map.rows.push_back({static_cast<int>(n) + 1, 0, 0, names[n]});
  const auto voxel = [&](int i, int j, int k) { return label_at(map.scan.grid.to_world(i, j, k)); };
  for (int k = 0; k < side; ++k) {
    for (int j = 0; j < side; ++j) {
      for (int i = 0; i < side; ++i) {
        const int label = voxel(i, j, k);
        map.scan.voxels.push_back(label);
        bool alone = true;
        for (int n = 0; n < 27 && alone; ++n) alone = voxel(i + n % 3 - 1, j + n / 3 % 3 - 1, k + n / 9 - 1) == label;
        for (LabelMap::Row& row : map.rows) {
          if (row.label != label) continue;
          ++row.voxels;
          if (alone) row.volume_mm3 += 1;
        }
        if (!alone) add_volumes(label_at, map.scan.grid.to_world(i, j, k), map.rows);
      }
    }
  }
  return map;
}

// The cells of seeds, within a ball.
LabelMap voronoi() {
  constexpr double kRadius = 17.3;
  const std::vector<Vec3> seeds{{-9.5, -6.25, -4},   {-2.25, -10.5, 3.75}, {8.75, -7, -5.5},  {-8, 7.5, -6.75},
                                {1.5, 0.75, -9.25},  {10.25, 5.5, -2.5},   {-10.75, -1.5, 7}, {1, 2.25, 1.5},
                                {-3.5, 10.25, 5.25}, {9, -4.75, 7.5},      {6.25, 9.75, 6.5}, {-0.5, -1.75, 11.75}};
  std::vector<std::string> names;
  names.reserve(seeds.size());
  for (const Vec3& seed : seeds) names.push_back("cell of " + text(seed) + " in a ball of radius 17.3 mm around 0");
  const auto label_at = [=](const Vec3& p) {
    if (!(dot(p, p) < kRadius * kRadius)) return 0;
    std::size_t nearest = 0;
    for (std::size_t n = 1; n < seeds.size(); ++n) {
      const Vec3 a = minus(p, seeds[n]);
      const Vec3 b = minus(p, seeds[nearest]);
      if (dot(a, a) < dot(b, b)) nearest = n;
    }
    return static_cast<int>(nearest) + 1;
  };
  return label_map("labels_voronoi.nrrd", 40, {0.31, -0.17, 0.23}, label_at, names);
}

// No step to one of a voxel's six neighbours leads through the shell.
LabelMap thin_shell() {
  const auto label_at = [](const Vec3& p) {
    const double radius = std::sqrt(dot(p, p));
    return radius < 12 ? 1 : radius < 13 ? 2 : 0;
  };
  return label_map("labels_shell.nrrd", 32, {0.13, 0.29, -0.22}, label_at,
                   {"ball of radius 12 mm", "shell around it, 1 mm thick"});
}

// Three tubes with one wall; the tubes part in half planes that meet in a line through the middle.
LabelMap tubes() {
  const std::vector<Vec3> ends{{-13.5, -1.5, -2}, {9, 10.5, 1.5}, {8, -9.5, 5}};
  const auto label_at = [=](const Vec3& p) {
    double nearest = 1e300;
    double most_along = -1e300;
    int tube = 0;
    for (std::size_t n = 0; n < ends.size(); ++n) {
      const double length = std::sqrt(dot(ends[n], ends[n]));
      const double along = dot(p, ends[n]) / length;
      const double place = std::clamp(along, 0.0, length) / length;
      const Vec3 off = minus(p, {place * ends[n][0], place * ends[n][1], place * ends[n][2]});
      nearest = std::min(nearest, dot(off, off));
      if (along > most_along) tube = static_cast<int>(n) + 1;
      most_along = std::max(most_along, along);
    }
    return nearest < 4 * 4 ? tube : nearest < 5.4 * 5.4 ? 4 : 0;
  };
  std::vector<std::string> names;
  names.reserve(ends.size() + 1);
  for (const Vec3& end : ends) names.push_back("round-ended tube of radius 4 mm from 0 to " + text(end));
  names.emplace_back("wall of the tubes, 1.4 mm thick");
  return label_map("labels_tubes.nrrd", 44, {-0.21, 0.27, 0.12}, label_at, names);
}

// The eight parts of a cube, whose labels alternate. labels: 2 or 8.
LabelMap checkerboard(const std::string& file, int labels) {
  const auto label_at = [=](const Vec3& p) {
    if (std::max({std::abs(p[0]), std::abs(p[1]), std::abs(p[2])}) > 8) return 0;
    const int part = (p[0] > 0 ? 1 : 0) + (p[1] > 0 ? 2 : 0) + (p[2] > 0 ? 4 : 0);
    const int odd = ((p[0] > 0 ? 1 : 0) + (p[1] > 0 ? 1 : 0) + (p[2] > 0 ? 1 : 0)) % 2;
    return 1 + (labels == 2 ? odd : part);
  };
  std::vector<std::string> names;
  for (int n = 0; n < labels; ++n) {
    const auto side = [&](int axis) { return (n >> axis & 1) != 0 ? 4 : -4; };
    std::ostringstream cube;
    cube << "cube of 8 mm around (" << side(0) << ", " << side(1) << ", " << side(2) << ")";
    names.push_back(labels == 8 ? cube.str()
                    : n == 0    ? "four cubes of 8 mm around (-4, -4, -4), (4, 4, -4), …"
                                : "four around (4, -4, -4), (-4, 4, -4), …; the others' edges are its own");
  }
  return label_map(file, 20, {0, 0, 0}, label_at, names);
}

}  // namespace

std::vector<LabelMap> all_label_maps() {
  return {voronoi(), thin_shell(), tubes(), checkerboard("labels_octants.nrrd", 8),
          checkerboard("labels_checkerboard.nrrd", 2)};
}

}  // namespace samples
