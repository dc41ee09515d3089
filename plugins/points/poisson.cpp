// CGAL pulls the function to zero at the points by a weight that stands beside lengths, so the outcome depends on the
// unit: the shorter the points' spacing, the closer the surface keeps to them and the more it follows their noise. The
// points are scaled to one spacing.
//
// CGAL's triangulation reaches beyond the points' hull only if circumcentres happen to lie there: those of points on a
// ball do not, and no outside is left. Eight points far out, without normals, see to it; they take part in the solution
// as what they are, points where the function is that of the outside.
//
// Elsewhere it adds points only where tets are badly shaped. Between two surfaces a few spacings apart none are, and
// the function cannot tell the gap; so each point gets one on either side. That is for the surface itself worth more
// than any finer grid (docs/plugins.md).
//
// Cells of equal quality are refined in an order that depends on their addresses. Regular points have many such cells,
// so all points are moved by next to nothing, which leaves none equal.
//
// CGAL's own evaluation starts each search for a tet at the one found last, by whatever thread. On a face between two
// tets the value is the same but for rounding, and rounding may decide the sign; so each layer of the grid has its own
// searches, from a fixed start.
#include "poisson.h"

#include <CGAL/Poisson_reconstruction_function.h>
#include <CGAL/compute_average_spacing.h>

#include <algorithm>
#include <array>
#include <random>

#include "scantet/base/parallel.h"

namespace points {
namespace {

constexpr double kSpacing = 0.02;  // of the scaled points; measured on CGAL's sample sets: docs/plugins.md
constexpr double kFar = 1;         // diagonals of the points' box from its centre, along each axis
constexpr double kBeside = 0.5;    // spacings off each point, along its normal
constexpr double kJitter = 1e-3;   // spacings
constexpr unsigned kNearest = 6;

using Function = CGAL::Poisson_reconstruction_function<Kernel>;
using Cell = Function::Cell_handle;

/// Adds vertices on both sides of the surface.
void insert_beside(const PointSet& points, Function::Triangulation& triangulation) {
  std::vector<Kernel::Point_3> beside;
  beside.reserve(2 * points.size());
  for (const Oriented& point : points) {
    const Kernel::Vector_3 offset = kBeside * kSpacing * point.second;
    beside.push_back(point.first + offset);
    beside.push_back(point.first - offset);
  }
  CGAL::spatial_sort(beside.begin(), beside.end());
  CGAL::Poisson_visitor visitor;
  Cell hint;
  for (const Kernel::Point_3& p : beside) {
    hint = triangulation.insert(p, Function::Triangulation::STEINER, hint, visitor)->cell();
  }
}

/// The function in a tet, between the values at its corners whatever rounding does; beyond the hull that of one of its
/// vertices nearby.
double value_in(const Function::Triangulation& triangulation, const Cell& cell, const Kernel::Point_3& p) {
  if (triangulation.is_infinite(cell)) {
    return cell->vertex((cell->index(triangulation.infinite_vertex()) + 1) % 4)->f();
  }
  std::array<Kernel::Point_3, 4> corners;
  std::array<double, 4> values;
  for (int i = 0; i < 4; ++i) {
    corners[i] = cell->vertex(i)->point();
    values[i] = cell->vertex(i)->f();
  }
  double sum = 0;
  double weights = 0;
  for (int i = 0; i < 4; ++i) {
    std::array<Kernel::Point_3, 4> part = corners;
    part[i] = p;
    const double weight = CGAL::volume(part[0], part[1], part[2], part[3]);
    sum += weight * values[i];
    weights += weight;
  }
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  return weights == 0 ? 0.5 * (*low + *high) : std::clamp(sum / weights, *low, *high);
}

}  // namespace

struct Poisson::Impl {
  scantet::Point centre;
  double scale = 1;
  std::unique_ptr<Function> function;

  double scaled(int axis, double mm) const { return scale * (mm - centre[axis]); }

  void sample_layer(int k, LevelGrid& grid) const {
    const Function::Triangulation& triangulation = function->tr();
    Cell start = triangulation.infinite_cell();  // of the row
    const double z = scaled(2, grid.origin.z + k * grid.step_mm);
    for (int j = 0; j < grid.size[1]; ++j) {
      const double y = scaled(1, grid.origin.y + j * grid.step_mm);
      Cell cell = start;
      for (int i = 0; i < grid.size[0]; ++i) {
        const Kernel::Point_3 p(scaled(0, grid.origin.x + i * grid.step_mm), y, z);
        cell = triangulation.locate(p, cell);
        if (i == 0) start = cell;
        (*grid.values)[grid.index(i, j, k)] = static_cast<float>(value_in(triangulation, cell, p));
      }
    }
  }
};

double average_spacing_mm(const PointSet& points) {
  return CGAL::compute_average_spacing<CGAL::Sequential_tag>(points, kNearest, CGAL::parameters::point_map(PointMap()));
}

Poisson::Poisson(const std::string& file, const PointSet& points, double spacing_mm) : impl_(new Impl) {
  scantet::Box box;
  for (const Oriented& point : points) box.extend(place_of(point));
  impl_->centre = box.center();
  impl_->scale = kSpacing / spacing_mm;
  std::mt19937 random;
  const auto up_to = [&](double most) { return most * (2.0 * random() / std::mt19937::max() - 1); };
  PointSet scaled = points;
  for (Oriented& point : scaled) {
    const scantet::Point p = place_of(point);
    const auto at = [&](int axis) { return impl_->scaled(axis, p[axis]) + up_to(kJitter * kSpacing); };
    point.first = {at(0), at(1), at(2)};
  }
  PointSet all = scaled;
  for (int corner = 0; corner < 8; ++corner) {
    const double far = kFar * impl_->scale * box.diagonal();
    const auto at = [&](int axis) { return ((corner >> axis & 1) == 0 ? -far : far) + up_to(kJitter * far); };
    all.push_back({{at(0), at(1), at(2)}, CGAL::NULL_VECTOR});
  }
  bool solved = false;
  try {
    impl_->function = std::make_unique<Function>(all.begin(), all.end(), PointMap(), NormalMap());
    // The object is ours, and not const; CGAL just offers no other way to its triangulation.
    insert_beside(scaled, const_cast<Function::Triangulation&>(impl_->function->tr()));
    solved = impl_->function->compute_implicit_function();
  } catch (const CGAL::Failure_exception&) {  // degenerate beyond what the checks before catch
  }
  if (!solved) {
    refuse(file, "Poisson reconstruction found no function for the points",
           "check that they lie on a closed surface, with normals that point outwards");
  }
}

Poisson::~Poisson() = default;

void Poisson::sample(LevelGrid& grid, scantet::Progress& progress) const {
  constexpr int kBatch = 16;  // layers between two looks at the progress
  grid.values->resize(grid.nodes());
  for (int begin = 0; begin < grid.size[2] && !progress.cancelled(); begin += kBatch) {
    progress.report({"read", "sampling", grid.index(0, 0, begin), grid.nodes(), 0});
    const int layers = std::min(kBatch, grid.size[2] - begin);
    scantet::parallel_for(static_cast<std::size_t>(layers), 1, [&](std::size_t layer, std::size_t) {
      impl_->sample_layer(begin + static_cast<int>(layer), grid);
    });
  }
}

}  // namespace points
