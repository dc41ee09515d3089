// As the default candidates of a domain, these come from lines parallel to the axes, but from short ones: in each cube
// that holds one of the points, or is next to one that does, on the scale that the cube asks for. So a few fine places
// do not make the whole boundary fine.
#include <array>
#include <cassert>
#include <cmath>
#include <cstdint>

#include "scantet/base/neighbors.h"
#include "scantet/base/parallel.h"
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

/// The crossings of a grid of lines through the box along each axis.
void cross_box(const Domain& domain, const Box& box, double spacing_mm, std::vector<Segment>& segments,
               CrossingLists& crossings, std::vector<Point>& out) {
  const double side = box.extent().x;
  const int lines = static_cast<int>(std::ceil(side / spacing_mm));
  assert(lines > 0);
  const double step = side / lines;
  segments.clear();
  for (int axis = 0; axis < 3; ++axis) {
    for (int line = 0; line < lines * lines; ++line) {
      Point from = box.min;
      from[(axis + 1) % 3] += step * (line % lines);
      from[(axis + 2) % 3] += step * (line / lines);
      Point to = from;
      to[axis] += side;
      segments.push_back({from, to});
    }
  }
  domain.crossings_of(segments, crossings);
  for (std::size_t i = 0; i < segments.size(); ++i) {
    for (const Crossing& crossing : crossings[i]) out.push_back(crossing.point);
  }
}

/// Looks at a box on the scale that it asks for, in smaller boxes where that varies much within.
class BoxVisitor {
 public:
  BoxVisitor(const Domain& domain, const CandidateScale& scale, std::vector<Point>& out)
      : domain_(domain), scale_(scale), out_(out) {}

  void visit(const Box& box) {
    const double spacing = scale_.spacing_at(box.center());
    const double change = 0.5 * scale_.steepness * box.diagonal();
    if (spacing - change >= kNotWorth * scale_.seen_mm) return;
    if (change <= kMostChange * spacing || box.extent().x <= scale_.finest_mm) {
      const double closer = std::max(spacing - change, scale_.finest_mm);
      if (closer < kNotWorth * scale_.seen_mm) cross_box(domain_, box, closer, segments_, crossings_, out_);
      return;
    }
    const Vec half = 0.5 * box.extent();
    for (int n = 0; n < 8; ++n) {
      const Point low = box.min + Vec{half.x * (n % 2), half.y * (n / 2 % 2), half.z * (n / 4)};
      visit({low, low + half});
    }
  }

 private:
  const Domain& domain_;
  const CandidateScale& scale_;
  std::vector<Point>& out_;
  std::vector<Segment> segments_;
  CrossingLists crossings_;
};

}  // namespace

std::vector<Point> closer_candidates(const Domain& domain, std::span<const Point> points, const CandidateScale& scale) {
  const Point corner = domain.bounds().min;
  const double side = scale.seen_mm;
  const std::vector<Cube> cubes = cubes_around(points, corner, side);
  constexpr std::size_t kGrain = 64;
  return parallel_collect<Point>(
      cubes.size(), kGrain, [&](std::size_t begin, std::size_t end, std::vector<Point>& out) {
        BoxVisitor visitor(domain, scale, out);
        for (std::size_t i = begin; i < end; ++i) {
          const Cube& cube = cubes[i];
          const Point low = corner + side * Vec{double(cube[0]), double(cube[1]), double(cube[2])};
          visitor.visit({low, low + Vec{side, side, side}});
        }
      });
}

}  // namespace scantet::engine
