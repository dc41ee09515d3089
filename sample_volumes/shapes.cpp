// Every field is made with +, -, *, / and square roots only, and the scattered islands with a congruential generator
// written out here, so that the voxels are the same whatever the compiler and its libraries.
#include <algorithm>
#include <cmath>
#include <functional>
#include <stdexcept>
#include <utility>

#include "sample.h"

namespace samples {
namespace {

using Field = std::function<double(const Vec3&)>;

// A grid of cubes of 1 mm with `origin` at the first voxel centre.
Grid unit_grid(const std::array<int, 3>& size, const Vec3& origin) {
  return {size, {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}}, origin};
}

Sample described(std::vector<std::string> files, Pixel pixel, double level, std::string what) {
  Sample sample;
  sample.files = std::move(files);
  sample.pixel = pixel;
  sample.level = level;
  sample.what = std::move(what);
  return sample;
}

double radius(double x, double y, double z) {
  return std::sqrt(x * x + y * y + z * z);
}

// Samples the field on the sample's grid: rounds to multiples of `step`, clamps to [lowest, highest].
void fill(Sample& sample, const Field& field, double lowest, double highest, double step = 1) {
  const Grid& grid = sample.grid;
  sample.voxels.reserve(grid.voxel_count());
  for (int k = 0; k < grid.size[2]; ++k) {
    for (int j = 0; j < grid.size[1]; ++j) {
      for (int i = 0; i < grid.size[0]; ++i) {
        const double value = std::floor(field(grid.to_world(i, j, k)) / step + 0.5) * step;
        sample.voxels.push_back(std::clamp(value, lowest, highest));
        if (sample.voxels.back() == sample.level) throw std::logic_error(sample.files[0] + ": a voxel is at the level");
      }
    }
  }
}

Sample sphere() {
  Sample s = described({"sphere.nrrd"}, Pixel::uint8, 127.5, "ball of radius 14.3 mm");
  s.grid = unit_grid({36, 36, 36}, {-17.5, -17.5, -17.5});
  fill(
      s, [](const Vec3& p) { return 127.5 + 16 * (14.3 - radius(p[0], p[1], p[2])); }, 0, 255);
  return s;
}

Sample torus() {
  Sample s = described({"torus.nrrd"}, Pixel::int16, 300.5, "torus, ring 14 mm, tube 5 mm");
  s.euler = 0;
  s.grid = unit_grid({44, 44, 16}, {-21.5, -21.5, -7.5});
  const auto field = [](const Vec3& p) { return 300.5 + 80 * (5 - radius(radius(p[0], p[1], 0) - 14, p[2], 0)); };
  fill(s, field, -100, 700);
  return s;
}

Sample tanglecube() {
  constexpr double kMmPerUnit = 10;
  Sample s = described({"tanglecube.nrrd"}, Pixel::float32, 0.1, "quartic of genus five, 10 mm a unit");
  s.euler = -8;
  s.grid = unit_grid({52, 52, 52}, {-25.4, -25.6, -25.3});
  const auto field = [](const Vec3& p) {
    double height = -11.8;
    for (const double mm : p) {
      const double square = (mm / kMmPerUnit) * (mm / kMmPerUnit);
      height += 5 * square - square * square;
    }
    return 0.1 + 100 * height;
  };
  fill(s, field, -300, 300, 0.25);
  return s;
}

Sample shell() {
  Sample s = described({"shell.mha"}, Pixel::uint16, 1000.5, "hollow sphere, radius 15 mm, wall 1.6 mm");
  s.inside_above = false;
  s.cavities = 1;
  s.euler = 4;
  s.grid = unit_grid({40, 40, 40}, {-19.5, -19.5, -19.5});
  const auto field = [](const Vec3& p) { return 1000.5 + 400 * (std::abs(radius(p[0], p[1], p[2]) - 15) - 0.8); };
  fill(s, field, 0, 2000);
  return s;
}

// Knuth's MMIX generator; the upper bits are the good ones.
class Lcg {
 public:
  int below(int limit) {
    state_ = state_ * 6364136223846793005ULL + 1442695040888963407ULL;
    return static_cast<int>((state_ >> 33) % static_cast<std::uint64_t>(limit));
  }

 private:
  std::uint64_t state_ = 20230417;
};

// Islands of one to three voxels. A voxel's neighbour in its island is across a face or an edge of it: the level (60)
// is below the face saddle of the faintest pair (150·150/300 = 75), so the trilinear level set joins them. Voxels of
// two islands are at least two steps apart and share no cell, so nothing joins those.
Sample islands() {
  constexpr int kCount = 200;
  constexpr int kSide = 36;
  using Index = std::array<int, 3>;
  Sample s = described({"islands.nii.gz"}, Pixel::uint8, 60, "two hundred islands of 1 to 3 voxels");
  s.components = kCount;
  s.euler = 2 * kCount;
  s.grid = unit_grid({kSide, kSide, kSide}, {-40, 25, 10});
  s.voxels.assign(s.grid.voxel_count(), 0);
  const auto voxel = [&](int i, int j, int k) -> double& { return s.voxels[(k * kSide + j) * kSide + i]; };
  const auto is_free = [&](const Index& at) {
    if (std::any_of(at.begin(), at.end(), [](int a) { return a < 2 || a > kSide - 3; })) return false;
    for (int n = 0; n < 27; ++n) {
      if (voxel(at[0] + n % 3 - 1, at[1] + n / 3 % 3 - 1, at[2] + n / 9 - 1) > 0) return false;
    }
    return true;
  };
  Lcg random;
  for (int made = 0; made < kCount;) {
    Index at{random.below(kSide), random.below(kSide), random.below(kSide)};
    const int flat_axis = random.below(3);  // steps leave this coordinate alone, so an island has no body diagonal
    const int first = (flat_axis + 1) % 3;
    const int second = (flat_axis + 2) % 3;
    std::vector<Index> island{at};
    for (int voxels = 1 + random.below(3); static_cast<int>(island.size()) < voxels;) {
      at[first] += 1;
      at[second] += random.below(2);
      island.push_back(at);
    }
    if (!std::all_of(island.begin(), island.end(), is_free)) continue;
    for (const Index& cell : island) voxel(cell[0], cell[1], cell[2]) = 150 + random.below(101);
    ++made;
  }
  return s;
}

Sample bar() {
  Sample s =
      described({"bar.mha"}, Pixel::int8, 0.5, "round-ended bar of radius 6 mm that leaves through the low x face");
  s.grid = unit_grid({32, 22, 22}, {-18.2, -10.3, -10.6});
  const auto field = [](const Vec3& p) { return 0.5 + 15 * (6 - radius(std::max(p[0], 0.0), p[1], p[2])); };
  fill(s, field, -100, 100);
  return s;
}

// One ellipsoid, q(x) = 1 - sum of (x_i / a_i)² > 0, on any grid. The voxels hold the least-squares fit of q by
// trilinear functions: q plus a constant, sum of Q_ii / 6, where Q is the quadratic form in voxel units. Plain samples
// of q would make the level set of each grid smaller by another few parts in a thousand.
Sample ellipsoid(const std::vector<std::string>& files, Pixel pixel, const std::array<Vec3, 3>& columns,
                 const std::string& what) {
  constexpr Vec3 kSemiAxes = {20, 15, 12};
  constexpr Vec3 kCenter = {12, -7, 31};
  constexpr Vec3 kOffCenter = {0.3, 0.1, -0.2};  // of the grid, voxels: nothing sits on a symmetry plane
  constexpr double kScale = 50000;               // q = 1e-5 is half a grey value
  constexpr double kBand = 20000;                // flat beyond |q| = 0.4, farther than a cell from the surface
  Sample s = described(files, pixel, 0.5, "ellipsoid 20 × 15 × 12 mm, " + what);
  s.grid.columns = columns;
  const double det = s.grid.determinant();
  double correction = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const Vec3& u = columns[(axis + 1) % 3];
    const Vec3& v = columns[(axis + 2) % 3];
    const Vec3 row = {(u[1] * v[2] - u[2] * v[1]) / det, (u[2] * v[0] - u[0] * v[2]) / det,
                      (u[0] * v[1] - u[1] * v[0]) / det};  // of the inverse: world to index
    double half_extent = 0;
    double form = 0;
    for (int x = 0; x < 3; ++x) {
      half_extent += row[x] * row[x] * kSemiAxes[x] * kSemiAxes[x];
      form += columns[axis][x] * columns[axis][x] / (kSemiAxes[x] * kSemiAxes[x]);
    }
    s.grid.size[axis] = 2 * static_cast<int>(std::ceil(std::sqrt(half_extent) + 3));
    correction += form / 6;
  }
  const Vec3 middle =
      s.grid.to_world((s.grid.size[0] - 1) / 2.0 + kOffCenter[0], (s.grid.size[1] - 1) / 2.0 + kOffCenter[1],
                      (s.grid.size[2] - 1) / 2.0 + kOffCenter[2]);
  for (int x = 0; x < 3; ++x) s.grid.origin[x] = kCenter[x] - middle[x];
  const auto field = [&](const Vec3& p) {
    double q = 1 + correction;
    for (int x = 0; x < 3; ++x) q -= (p[x] - kCenter[x]) * (p[x] - kCenter[x]) / (kSemiAxes[x] * kSemiAxes[x]);
    return 0.5 + kScale * q;
  };
  fill(s, field, -kBand, kBand);
  return s;
}

// Columns of the rotation by the quaternion (7, 2, -3, 1), which has rational entries, times the spacing.
std::array<Vec3, 3> rotated(const Vec3& spacing) {
  constexpr double kNorm = 63;
  constexpr std::array<Vec3, 3> kTimesNorm = {Vec3{43, 2, 46}, Vec3{-26, 53, 22}, Vec3{-38, -34, 37}};
  std::array<Vec3, 3> columns;
  for (int axis = 0; axis < 3; ++axis) {
    for (int x = 0; x < 3; ++x) columns[axis][x] = kTimesNorm[axis][x] / kNorm * spacing[axis];
  }
  return columns;
}

}  // namespace

Vec3 Grid::to_world(double i, double j, double k) const {
  Vec3 p{};
  for (int x = 0; x < 3; ++x) p[x] = origin[x] + i * columns[0][x] + j * columns[1][x] + k * columns[2][x];
  return p;
}

double Grid::determinant() const {
  const auto& [a, b, c] = columns;
  return a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0]) + a[2] * (b[0] * c[1] - b[1] * c[0]);
}

std::vector<Sample> all_samples() {
  const std::string name = "ellipsoid_";
  return {sphere(),
          torus(),
          tanglecube(),
          shell(),
          islands(),
          bar(),
          ellipsoid({name + "axis.nrrd", name + "axis.nii.gz", name + "axis.mha"}, Pixel::int16,
                    {Vec3{0.75, 0, 0}, Vec3{0, 0.75, 0}, Vec3{0, 0, 0.75}}, "cubic voxels of 0.75 mm"),
          ellipsoid({name + "anisotropic.nii.gz"}, Pixel::float32, {Vec3{0.5, 0, 0}, Vec3{0, 0.75, 0}, Vec3{0, 0, 1}},
                    "voxels of 0.5 × 0.75 × 1 mm"),
          ellipsoid({name + "oblique.nrrd", name + "oblique.nii.gz"}, Pixel::int16, rotated({0.7, 0.7, 0.9}),
                    "rotated grid of 0.7 × 0.7 × 0.9 mm"),
          ellipsoid({name + "flipped.nrrd", name + "flipped.nii.gz"}, Pixel::int16,
                    {Vec3{-0.75, 0, 0}, Vec3{0, 0.7, 0}, Vec3{0, 0, 0.8}}, "x axis reversed (left-handed grid)"),
          ellipsoid({name + "sheared.nrrd", name + "sheared.mha"}, Pixel::float32,
                    {Vec3{0.8, 0, 0}, Vec3{0.25, 0.75, 0}, Vec3{-0.1, 0.2, 0.9}}, "sheared grid")};
}

}  // namespace samples
