#include "scantet/labels/label_smoothing.h"

#include <gtest/gtest.h>

#include <numbers>

#include "field_measures.h"
#include "label_scan.h"
#include "scantet/base/parallel.h"
#include "scantet/labels/label_domain.h"
#include "scantet/labels/label_field.h"

namespace scantet {
namespace {

using test::label_scan;
using test::least_margin;
using test::volume_error;

/// What a field makes of a shape.
struct Likeness {
  double normals_deg = 0;  ///< RMS of the angle between the interface's normals and the shape's
  double distance = 0;     ///< RMS of the interface's distance from the shape, voxels
};

/// Casts lines from `from` to `to`, one voxel apart, and looks at the first change of each.
template <class Cast, class Normal, class Distance>
Likeness likeness(const LabelField& field, int lines, const Cast& cast, const Normal& normal,
                  const Distance& distance) {
  const auto domain = make_label_domain(std::shared_ptr<const LabelField>(&field, [](const LabelField*) {}));
  Crossings crossings;
  double angles = 0;
  double distances = 0;
  int count = 0;
  for (int n = 0; n < lines; ++n) {
    domain->crossings(cast(n), crossings);
    if (crossings.empty()) continue;
    const Point p = crossings.front().point;
    const CellIndex at = cell_of(p, field.size());
    LabelCell cell;
    field.cell(at[0], at[1], at[2], cell);
    if (cell.count != 2) continue;
    const CellHeights d = cell.difference();
    const Vec u = local_in(at, p);
    Vec gradient;
    for (int axis = 0; axis < 3; ++axis) {
      Vec low = u;
      Vec high = u;
      low[axis] = 0;
      high[axis] = 1;
      gradient[axis] = trilinear(d, high) - trilinear(d, low);
    }
    const double cosine = std::abs(dot(gradient, normal(p))) / (length(gradient) * length(normal(p)));
    const double angle = std::acos(std::min(1.0, cosine));
    angles += angle * angle;
    distances += distance(p) * distance(p);
    ++count;
  }
  return {std::sqrt(angles / count) * 180 / std::numbers::pi, std::sqrt(distances / count)};
}

std::shared_ptr<const LabelField> field_of(const Scan& scan, LabelSmoothing smoothing) {
  LabelSettings settings;
  settings.smoothing = smoothing;
  return make_label_field(scan, settings);
}

TEST(LabelSmoothing, ABallIsRound) {
  for (const double radius : {6.3, 12.4, 24.7}) {
    const int side = static_cast<int>(2 * radius) + 8;
    const Vec centre{side / 2.0 + 0.13, side / 2.0 - 0.21, side / 2.0 + 0.37};
    const Scan scan = label_scan({side, side, side}, [&](int i, int j, int k) {
      return distance({double(i), double(j), double(k)}, centre) < radius ? 1 : 0;
    });
    for (const LabelSmoothing smoothing : {LabelSmoothing::none, LabelSmoothing::keep}) {
      const auto field = field_of(scan, smoothing);
      std::mt19937 random(4);
      std::normal_distribution<double> gauss;
      const Likeness like = likeness(
          *field, 20000,
          [&](int) {
            const Vec v{gauss(random), gauss(random), gauss(random)};
            return Segment{centre, centre + (1.5 * radius / length(v)) * v};
          },
          [&](const Point& p) { return p - centre; }, [&](const Point& p) { return distance(p, centre) - radius; });
      const double volume = volume_error(*field, 1);
      std::printf("ball %g, %s: normals %.2f deg, distance %.3f voxels, volume %+.3f %%\n", radius,
                  smoothing == LabelSmoothing::keep ? "keep" : "none", like.normals_deg, like.distance, 100 * volume);
      if (smoothing == LabelSmoothing::none) continue;
      EXPECT_LE(like.normals_deg, 5) << radius;
      EXPECT_LE(like.distance, 0.1) << radius;
      EXPECT_LE(std::abs(volume), 0.003) << radius;
    }
  }
}

TEST(LabelSmoothing, ATiltedPlaneIsFlat) {
  for (const Vec normal : {Vec{0.1234, 0.0567, 1}, Vec{0.3, 0.2, 1}, Vec{0.7, 0.5, 1}, Vec{0.02, 0.033, 1}}) {
    const Vec unit = (1 / length(normal)) * normal;
    const Vec centre{20, 20, 20};
    const Scan scan = label_scan({41, 41, 41}, [&](int i, int j, int k) {
      return dot(Vec{double(i), double(j), double(k)} - centre, unit) < 0.217 ? 1 : 2;
    });
    for (const LabelSmoothing smoothing : {LabelSmoothing::none, LabelSmoothing::keep}) {
      const auto field = field_of(scan, smoothing);
      std::mt19937 random(4);
      std::uniform_real_distribution<double> side(-12, 12);
      const Likeness like = likeness(
          *field, 20000,
          [&](int) {
            const Point p = centre + Vec{side(random), side(random), 0};
            return Segment{p - Vec{0, 0, 18}, p + Vec{0, 0, 18}};
          },
          [&](const Point&) { return unit; }, [&](const Point& p) { return dot(p - centre, unit) - 0.217; });
      std::printf("plane (%g, %g, 1), %s: normals %.2f deg, distance %.3f voxels\n", normal.x, normal.y,
                  smoothing == LabelSmoothing::keep ? "keep" : "none", like.normals_deg, like.distance);
      if (smoothing == LabelSmoothing::keep) {
        EXPECT_LE(like.normals_deg, 5);
      }
    }
  }
}

TEST(LabelSmoothing, EveryNodeKeepsItsLabel) {
  EXPECT_GT(least_margin(*field_of(test::label_noise({15, 14, 13}, 6), LabelSmoothing::keep)), 0.1);
  EXPECT_GT(least_margin(*field_of(test::label_cells({40, 35, 30}, 25), LabelSmoothing::keep)), 0.1);
  const Scan specks = label_scan({20, 20, 20}, [](int i, int j, int k) { return i % 5 + j % 5 + k % 5 == 0 ? 1 : 0; });
  EXPECT_GT(least_margin(*field_of(specks, LabelSmoothing::keep)), 0.1);
}

// Cells that share a face must agree on it.
TEST(LabelSmoothing, TheCellsOfAFaceAgree) {
  std::mt19937 random(8);
  std::uniform_real_distribution<double> unit(0, 1);
  for (const Scan& scan : {test::label_noise({15, 14, 13}, 6), test::label_cells({30, 35, 30}, 60)}) {
    const auto field = field_of(scan, LabelSmoothing::keep);
    LabelCell low;
    LabelCell high;
    for (int n = 0; n < 200000; ++n) {
      const int axis = n % 3;
      CellIndex at;
      for (std::size_t a = 0; a < 3; ++a) at[a] = static_cast<int>(random() % static_cast<unsigned>(field->size()[a]));
      CellIndex below = at;
      --below[static_cast<std::size_t>(axis)];
      field->cell(below[0], below[1], below[2], low);
      field->cell(at[0], at[1], at[2], high);
      Vec u{unit(random), unit(random), unit(random)};
      u[axis] = 1;
      const Region from_below = low.region_at(u);
      u[axis] = 0;
      ASSERT_EQ(from_below, high.region_at(u)) << n;
    }
  }
}

/// A shell one voxel thick around a ball, in a box.
Scan shell() {
  return label_scan({30, 30, 30}, [](int i, int j, int k) {
    const double r = distance({double(i), double(j), double(k)}, {14.6, 14.4, 14.5});
    return r < 9 ? 1 : r < 10 ? 2 : 0;
  });
}

TEST(LabelSmoothing, ThinSheetsKeepTheirThickness) {
  const Scan plate = label_scan(
      {25, 25, 12}, [](int i, int j, int k) { return k == 6 && i > 3 && i < 21 && j > 3 && j < 21 ? 1 : 0; });
  const auto flat = field_of(plate, LabelSmoothing::keep);
  const auto domain = make_label_domain(flat);
  Crossings crossings;
  for (int n = 0; n < 100; ++n) {
    const double x = 7.03 + n % 10;
    const double y = 7.04 + n / 10;
    domain->crossings({{x, y, 0}, {x, y, 12}}, crossings);
    ASSERT_EQ(crossings.size(), 2U);
    EXPECT_GT(crossings[1].point.z - crossings[0].point.z, 0.9);
    EXPECT_LT(crossings[1].point.z - crossings[0].point.z, 1.15);  // makes up for the rim, which is rounded
  }
  const double volume = volume_error(*flat, 1, 40);
  std::printf("plate: volume %+.2f %%\n", 100 * volume);
  EXPECT_LE(std::abs(volume), 0.01);
}

TEST(LabelSmoothing, AClosedShellHasNoHole) {
  const auto field = field_of(shell(), LabelSmoothing::keep);
  const auto domain = make_label_domain(field);
  std::mt19937 random(4);
  std::normal_distribution<double> gauss;
  const Point centre{14.6, 14.4, 14.5};
  Crossings crossings;
  int holes = 0;
  for (int n = 0; n < 20000; ++n) {
    const Vec v{gauss(random), gauss(random), gauss(random)};
    domain->crossings({centre, centre + (13 / length(v)) * v}, crossings);
    for (const Crossing& crossing : crossings) {
      holes += std::min(crossing.from, crossing.to) == 0 && std::max(crossing.from, crossing.to) == 1;
    }
  }
  EXPECT_EQ(holes, 0);
  const double volume = volume_error(*field, 2, 16);
  EXPECT_LE(std::abs(volume), 0.25);
  std::printf("shell: rays through holes %d of 20000, volume of the shell %+.2f %%\n", holes, 100 * volume);
}

TEST(LabelSmoothing, ThreadsChangeNothing) {
  const Scan scan = test::label_cells({40, 35, 30}, 25);
  const auto values = [&](std::size_t threads) {
    std::vector<double> all;
    with_threads(threads, [&] {
      const auto field = field_of(scan, LabelSmoothing::keep);
      LabelCell cell;
      for (int k = 0; k < 29; ++k) {
        for (int j = 0; j < 34; ++j) {
          for (int i = 0; i < 39; ++i) {
            field->cell(i, j, k, cell);
            for (std::size_t n = 0; n < cell.count; ++n) {
              all.insert(all.end(), cell.values[n].begin(), cell.values[n].end());
            }
          }
        }
      }
    });
    return all;
  };
  EXPECT_EQ(values(1), values(4));
}

}  // namespace
}  // namespace scantet
