// The function is sampled on a grid, for then it is a scan like any other: crossings are found exactly and fast, from
// any number of threads, and the components are known. Half the points' spacing is fine enough: the grid's error is far
// below the reconstruction's own (docs/plugins.md has figures).
#include "reconstruction.h"

#include <CGAL/linear_least_squares_fitting_3.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "level_grid.h"
#include "point_reader.h"
#include "poisson.h"
#include "scantet/base/options.h"

namespace points {
namespace {

using scantet::Box;
using scantet::number_text;

constexpr double kStepsPerSpacing = 2;
constexpr double kFlat = 0.5;                             // spacings
constexpr double kLeastPad = 4;                           // spacings
constexpr std::array<double, 3> kPads{0.05, 0.15, 0.45};  // of the box's diagonal
constexpr double kSpeck = 4;                              // cubes of the spacing: a ball of a dozen points
constexpr int kSpeckRounds = 3;
constexpr double kReach = 2;      // spacings
constexpr double kMissed = 0.25;  // of the points

Box box_around(const PointSet& points) {
  Box box;
  for (const Oriented& point : points) box.extend(place_of(point));
  return box;
}

void check_thickness(const std::string& file, const PointSet& points, double spacing_mm) {
  std::vector<Kernel::Point_3> places;
  for (const Oriented& point : points) places.push_back(point.first);
  Kernel::Plane_3 plane;
  CGAL::linear_least_squares_fitting_3(places.begin(), places.end(), plane, CGAL::Dimension_tag<0>());
  const Kernel::Vector_3 normal = plane.orthogonal_vector();
  const double length = std::sqrt(normal.squared_length());
  double farthest = 0;
  for (const Kernel::Point_3& p : places) {
    farthest = std::max(farthest, std::abs((p - plane.point()) * normal) / length);
  }
  if (farthest >= kFlat * spacing_mm) return;
  refuse(file,
         "the points lie within " + number_text(farthest, 3) + " mm of a plane, and are " + number_text(spacing_mm, 3) +
             " mm apart on average",
         "a set of points all around the object is needed");
}

/// A grid around the points with `pad_mm` on each side, centred.
LevelGrid grid_around(const Box& box, double pad_mm, double step_mm) {
  LevelGrid grid;
  grid.step_mm = step_mm;
  std::array<double, 3> nodes{};
  for (int axis = 0; axis < 3; ++axis) nodes[axis] = std::ceil((box.extent()[axis] + 2 * pad_mm) / step_mm) + 1;
  const double total = nodes[0] * nodes[1] * nodes[2];
  if (total > kMostNodes) {
    // Root by root: the product may be beyond a double.
    const double larger = 1.01 * step_mm * std::cbrt(nodes[0]) * std::cbrt(nodes[1]) * std::cbrt(nodes[2] / kMostNodes);
    throw scantet::Error(
        scantet::Fault::usage, "usage.grid_step",
        "--grid-step: a grid of " + number_text(step_mm, 3) + " mm around the points has " + number_text(total, 2) +
            " nodes, and " + number_text(kMostNodes, 2) + " are allowed",
        "choose --grid-step " + number_text(larger, 3) + " or more, or leave out points far off the object");
  }
  for (int axis = 0; axis < 3; ++axis) {
    grid.size[axis] = static_cast<int>(nodes[axis]);
    grid.origin[axis] = box.center()[axis] - 0.5 * step_mm * (nodes[axis] - 1);
  }
  return grid;
}

/// The function on the smallest of a few grids that holds the surface. Empty if cancelled.
LevelGrid sample_closed(const std::string& file, const Poisson& function, const Box& box, double spacing_mm,
                        double step_mm, scantet::Progress& progress) {
  double pad_mm = 0;
  bool has_inside = false;
  for (const double share : kPads) {
    pad_mm = std::max(kLeastPad * spacing_mm, share * box.diagonal());
    LevelGrid grid = grid_around(box, pad_mm, step_mm);
    function.sample(grid, progress);
    if (progress.cancelled()) return {};
    has_inside = std::any_of(grid.values->begin(), grid.values->end(), [](float v) { return v < 0; });
    if (has_inside && !reaches_border(grid)) return grid;
  }
  if (!has_inside) {
    refuse(file, "the surface through the points encloses no node of a grid of " + number_text(step_mm, 3) + " mm",
           "choose a smaller --grid-step; the points must lie all around the object");
  }
  refuse(file, "the surface through the points does not close within " + number_text(pad_mm, 3) + " mm of their box",
         "the points must lie all around the object and their normals point outwards; try --normals estimate");
}

Fit fit_of(const scantet::Domain& domain, const PointSet& points, double spacing_mm) {
  Fit fit;
  std::vector<double> distances;
  scantet::Crossings crossings;
  for (const Oriented& point : points) {
    const scantet::Point p = place_of(point);
    const scantet::Vec reach = kReach * spacing_mm * normal_of(point);
    domain.crossings({p - reach, p + reach}, crossings);
    if (crossings.empty()) {
      ++fit.missed;
      continue;
    }
    double nearest = distance(p, crossings.front().point);
    for (const scantet::Crossing& crossing : crossings) nearest = std::min(nearest, distance(p, crossing.point));
    distances.push_back(nearest);
  }
  std::sort(distances.begin(), distances.end());
  if (distances.empty()) return fit;
  fit.median_mm = distances[distances.size() / 2];
  fit.most_mm = distances[distances.size() * 95 / 100];
  return fit;
}

void check_fit(const std::string& file, const Reconstruction& made) {
  if (static_cast<double>(made.fit.missed) <= kMissed * static_cast<double>(made.points)) return;
  refuse(file,
         "the surface passes " + std::to_string(made.fit.missed) + " of the " + std::to_string(made.points) +
             " points at more than " + number_text(kReach * made.spacing_mm, 3) + " mm",
         made.estimated ? "the points are too noisy or too sparse for normals to be estimated; give them normals"
                        : "check that the normals point outwards, or try --normals estimate");
}

}  // namespace

Reconstruction reconstruct(const std::string& file, const Settings& settings, scantet::Progress& progress) {
  PointSet points = read_points(file, progress);
  if (progress.cancelled()) return {};
  Reconstruction made;
  made.points = points.size();
  made.spacing_mm = average_spacing_mm(points);
  made.grid_step_mm = settings.grid_step_mm.value_or(made.spacing_mm / kStepsPerSpacing);
  check_thickness(file, points, made.spacing_mm);
  const Box box = box_around(points);
  grid_around(box, kLeastPad * made.spacing_mm, made.grid_step_mm);  // a grid too large is found before the long part
  made.estimated = settle_normals(file, settings.normals, points, progress);
  if (progress.cancelled()) return {};
  progress.report({"read", "Poisson", 0, points.size(), 0});
  const Poisson function(file, points, made.spacing_mm);
  if (progress.cancelled()) return {};
  LevelGrid grid = sample_closed(file, function, box, made.spacing_mm, made.grid_step_mm, progress);
  if (progress.cancelled()) return {};
  made.grid = grid.size;
  made.domain = make_domain(grid);
  const double speck_mm3 = kSpeck * made.spacing_mm * made.spacing_mm * made.spacing_mm;
  for (int round = 0; round < kSpeckRounds; ++round) {
    const std::size_t specks = drop_specks(*made.domain, speck_mm3, grid);
    if (specks == 0) break;
    made.specks += specks;
    made.domain = make_domain(grid);
  }
  made.fit = fit_of(*made.domain, points, made.spacing_mm);
  check_fit(file, made);
  return made;
}

}  // namespace points
