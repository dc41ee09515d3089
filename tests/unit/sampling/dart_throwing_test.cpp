#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "scantet/base/parallel.h"
#include "scantet/sampling/dart_throwing_impl.h"

namespace scantet::engine {
namespace {

/// Random darts in a flat box, some of them twice, many with the same turn.
std::vector<Dart> random_darts(std::size_t count, double radius_spread) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> unit(0, 1);
  std::vector<Dart> darts;
  for (std::size_t i = 0; i < count; ++i) {
    const Point p{20 * unit(random), 20 * unit(random), 2 * unit(random)};
    darts.push_back({p, 0.7 * (1 + radius_spread * unit(random)), random() % 1000});
    if (i % 10 == 0) darts.push_back(darts.back());
  }
  return darts;
}

std::vector<Point> one_after_the_other(std::vector<Dart> darts, double share) {
  std::sort(darts.begin(), darts.end(), [](const Dart& a, const Dart& b) {
    return a.turn != b.turn ? a.turn < b.turn : lexicographically_less(a.point, b.point);
  });
  std::vector<Point> kept;
  for (const Dart& dart : darts) {
    const bool hit = std::any_of(kept.begin(), kept.end(),
                                 [&](const Point& p) { return distance(p, dart.point) < share * dart.radius_mm; });
    if (!hit) kept.push_back(dart.point);
  }
  return kept;
}

std::vector<Point> thrown(const std::vector<Dart>& darts, double share) {
  std::vector<Point> points;
  for (const Dart& dart : throw_darts(darts, share)) points.push_back(dart.point);
  return points;
}

TEST(DartThrowing, KeepsWhatOneAfterTheOtherWouldKeep) {
  for (const std::size_t count : {0, 1, 2, 100, 5000}) {
    for (const double radius_spread : {0.0, 3.0}) {
      const auto darts = random_darts(count, radius_spread);
      for (const double share : {0.5, 1.0}) EXPECT_EQ(thrown(darts, share), one_after_the_other(darts, share));
    }
  }
}

TEST(DartThrowing, KeepsTheSameOfACrowdAroundEachDart) {
  std::vector<Dart> darts = random_darts(20000, 1);
  for (Dart& dart : darts) dart.radius_mm *= 8;  // thousands within the reach of each
  EXPECT_EQ(thrown(darts, 1), one_after_the_other(darts, 1));
  darts.resize(3000);
  for (Dart& dart : darts) dart.turn = 7;
  EXPECT_EQ(thrown(darts, 1), one_after_the_other(darts, 1)) << "all in the order of their coordinates";
}

TEST(DartThrowing, DoesNotDependOnThreadsOrOrder) {
  auto darts = random_darts(20000, 1);
  const auto kept = thrown(darts, 1);
  std::reverse(darts.begin(), darts.end());
  for (const std::size_t threads : {1, 2, 8}) {
    with_threads(threads, [&] { EXPECT_EQ(thrown(darts, 1), kept); });
  }
}

}  // namespace
}  // namespace scantet::engine
