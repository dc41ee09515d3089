// As the default candidates of a domain, these come from lines parallel to the axes, but from short ones: in each cube
// that holds one of the points, or is next to one that does, on the scale that the cube asks for. So a few fine places
// do not make the whole boundary fine.
#include <array>
#include <atomic>
#include <cassert>
#include <cmath>
#include <cstdint>

#include "scantet/base/neighbors.h"
#include "scantet/base/parallel.h"
#include "scantet/domain/crossing_points.h"
#include "scantet/sampling/closer_candidates_impl.h"

namespace scantet::engine {
namespace {

constexpr double kNotWorth = 0.8;    // of seen_mm: places that ask for a larger spacing are not looked at again
constexpr double kMostChange = 0.4;  // of the spacing, within a box of one spacing

using Cube = std::array<std::int32_t, 3>;

/// The cubes of the points and those around, sorted.
std::vector<Cube> cubes_around(std::span<const Point> points, const Point& corner, double cube_mm) {
  std::vector<Cube> own;
  own.reserve(points.size());
  for (const Point& p : points) {
    Cube cube;
    for (int axis = 0; axis < 3; ++axis) {
      cube[static_cast<std::size_t>(axis)] = static_cast<std::int32_t>(std::floor((p[axis] - corner[axis]) / cube_mm));
    }
    own.push_back(cube);
  }
  const auto tidy = [](std::vector<Cube>& cubes) {
    parallel_sort(cubes, std::less<>());
    cubes.erase(std::unique(cubes.begin(), cubes.end()), cubes.end());
  };
  tidy(own);
  std::vector<Cube> all;
  all.reserve(kNeighborhood.size() * own.size());
  for (const Cube& cube : own) {
    for (const auto& [x, y, z] : kNeighborhood) all.push_back({cube[0] + x, cube[1] + y, cube[2] + z});
  }
  tidy(all);
  return all;
}

/// Counts the lines of all threads.
class LineBudget {
 public:
  explicit LineBudget(double most) : most_(most) {}
  bool is_spent() const { return spent_.load(std::memory_order_relaxed) > most_; }
  /// Whether so many more may be looked along.
  bool spend(double lines) { return spent_.fetch_add(lines, std::memory_order_relaxed) + lines <= most_; }

 private:
  double most_;
  std::atomic<double> spent_ = 0;
};

/// Looks at a box on the scale that it asks for, in smaller boxes where that varies much within.
class BoxVisitor {
 public:
  BoxVisitor(const Domain& domain, const CandidateScale& scale, LineBudget& budget, std::vector<Point>& out)
      : scale_(scale), budget_(budget), found_(domain, out) {}

  void visit(const Box& box) {
    const double spacing = scale_.spacing_at(box.center());
    const double change = 0.5 * scale_.steepness * box.diagonal();
    if (spacing - change >= kNotWorth * scale_.seen_mm || budget_.is_spent()) return;
    if (change <= kMostChange * spacing || box.extent().x <= scale_.finest_mm) {
      const double closer = std::max(spacing - change, scale_.finest_mm);
      if (closer < kNotWorth * scale_.seen_mm) cross(box, closer);
      return;
    }
    const Vec half = 0.5 * box.extent();
    for (int n = 0; n < 8; ++n) {
      const Point low = box.min + Vec{half.x * (n % 2), half.y * (n / 2 % 2), half.z * (n / 4)};
      visit({low, low + half});
    }
  }

 private:
  /// The crossings of a grid of lines through the box along each axis.
  void cross(const Box& box, double spacing_mm) {
    const double side = box.extent().x;
    const double lines = std::ceil(side / spacing_mm);
    assert(lines > 0);
    if (!budget_.spend(3 * lines * lines)) return;
    const double step = side / lines;
    for (int axis = 0; axis < 3; ++axis) {
      for (double row = 0; row < lines; ++row) {
        for (double line = 0; line < lines; ++line) {
          Point from = box.min;
          from[(axis + 1) % 3] += step * line;
          from[(axis + 2) % 3] += step * row;
          Point to = from;
          to[axis] += side;
          found_.add({from, to});
        }
      }
    }
    found_.finish();
  }

  const CandidateScale& scale_;
  LineBudget& budget_;
  CrossingPoints found_;
};

}  // namespace

std::optional<std::vector<Point>> closer_candidates(const Domain& domain, std::span<const Point> points,
                                                    const CandidateScale& scale, double most_lines) {
  const Point corner = domain.bounds().min;
  const double side = scale.seen_mm;
  const std::vector<Cube> cubes = cubes_around(points, corner, side);
  LineBudget budget(most_lines);
  constexpr std::size_t kGrain = 64;
  auto found =
      parallel_collect<Point>(cubes.size(), kGrain, [&](std::size_t begin, std::size_t end, std::vector<Point>& out) {
        BoxVisitor visitor(domain, scale, budget, out);
        for (std::size_t i = begin; i < end; ++i) {
          const Cube& cube = cubes[i];
          const Point low = corner + side * Vec{double(cube[0]), double(cube[1]), double(cube[2])};
          visitor.visit({low, low + Vec{side, side, side}});
        }
      });
  if (budget.is_spent()) return std::nullopt;
  return found;
}

}  // namespace scantet::engine
