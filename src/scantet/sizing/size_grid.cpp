// The source is asked at the nodes inside; for the nodes just outside it is asked at the nearest points of the
// boundary, so that the sizes are right up to it. Nodes further out are not asked for: nobody needs sizes there, and a
// formula may make no sense there.
#include "scantet/sizing/size_grid.h"

#include <cmath>
#include <optional>

#include "scantet/base/parallel.h"

namespace scantet {
namespace {

constexpr std::size_t kUsualNodes = 1'000'000;
constexpr std::size_t kMostNodes = 16'000'000;
constexpr double kSlack =
    0.02;  // of a depth: far inside, where most of the boundary is nearly as near, more would cost much
constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNear = 2;  // steps: nodes outside that near the boundary have a size of their own

/// Points of the boundary, half a step apart.
std::vector<Point> boundary_points(const Domain& domain, double step_mm) {
  std::vector<Point> points;
  domain.surface_candidates(0.5 * step_mm, [&](const Point& p) { points.push_back(p); });
  return points;
}

/// Cones of height 0: the lowest is that of the nearest point.
ConeTree flat_cones(const std::vector<Point>& points) {
  std::vector<Cone> cones;
  cones.reserve(points.size());
  for (const Point& p : points) cones.push_back({p, 0});
  return ConeTree(std::move(cones));
}

class Sampler {
 public:
  Sampler(const Domain& domain, const SizeSource& source, const SizeGridOptions& options, const GridShape& shape)
      : domain_(domain),
        source_(source),
        options_(options),
        shape_(shape),
        boundary_(boundary_points(domain, shape.step_mm)),
        tree_(flat_cones(boundary_)) {}

  /// The sizes at the nodes of rows begin to end, infinite where nothing was asked.
  void sample_rows(std::size_t begin, std::size_t end, std::vector<float>& sizes) const {
    std::vector<SizePlace> places;
    std::vector<std::size_t> nodes;
    for (std::size_t row = begin; row < end; ++row) {
      const int j = static_cast<int>(row % static_cast<std::size_t>(shape_.nodes[1]));
      const int k = static_cast<int>(row / static_cast<std::size_t>(shape_.nodes[1]));
      for (int i = 0; i < shape_.nodes[0]; ++i) {
        const auto place = place_of(i, j, k);
        if (!place) continue;
        places.push_back(*place);
        nodes.push_back(shape_.index(i, j, k));
      }
    }
    std::vector<double> asked(places.size());
    source_.sizes_at(places, asked);
    for (std::size_t n = 0; n < nodes.size(); ++n) sizes[nodes[n]] = static_cast<float>(asked[n]);
  }

  /// Throws the error for the first node whose size is none, if there is one.
  void check(const std::vector<float>& sizes) const {
    const auto bad = std::find_if(sizes.begin(), sizes.end(), [](float size) { return !(size > 0); });
    if (bad == sizes.end()) return;
    const auto node = static_cast<int>(bad - sizes.begin());
    const auto [nx, ny, nz] = shape_.nodes;
    const auto place = place_of(node % nx, node / nx % ny, node / nx / ny);
    refuse_size(options_.place, options_.text, place.value(), source_.needs_depth(), static_cast<double>(*bad));
  }

  const std::vector<Point>& boundary() const { return boundary_; }

 private:
  /// Where to ask for a node; nothing if it does not matter.
  std::optional<SizePlace> place_of(int i, int j, int k) const {
    const Point p = shape_.at(i, j, k);
    const Region region = domain_.region_at(p);
    if (region != kOutside) {
      const double depth = source_.needs_depth() ? tree_.lowest_at(p, kInfinity, kSlack).value_mm : 0;
      return SizePlace{p, depth, region};
    }
    const ConeTree::Lowest nearest = tree_.lowest_at(p, kNear * shape_.step_mm);
    if (nearest.cone == nullptr) return std::nullopt;
    // The region behind the boundary, seen from the node.
    const Point& foot = nearest.cone->apex;
    const double away = nearest.value_mm;
    const double beyond = 1 + 0.1 * shape_.step_mm / std::max(away, 1e-3 * shape_.step_mm);
    const Region behind = domain_.region_at(lerp(p, foot, beyond));
    if (behind == kOutside) return std::nullopt;
    return SizePlace{foot, 0, behind};
  }

  const Domain& domain_;
  const SizeSource& source_;
  const SizeGridOptions& options_;
  const GridShape& shape_;
  std::vector<Point> boundary_;
  ConeTree tree_;
};

double middle_size(const SizeGrid& grid, const std::vector<Point>& points) {
  std::vector<double> sizes;
  sizes.reserve(points.size());
  for (const Point& p : points) sizes.push_back(grid.size_at(p));
  if (sizes.empty()) return grid.min_size();
  const auto middle = sizes.begin() + static_cast<std::ptrdiff_t>(sizes.size() / 2);
  std::nth_element(sizes.begin(), middle, sizes.end());
  return *middle;
}

}  // namespace

GridShape grid_over(const Box& box, double step_mm, std::size_t most_nodes) {
  constexpr double kLongest = 32767;  // nodes along an axis
  const Vec extent = box.extent();
  const double longest = std::max({extent.x, extent.y, extent.z});
  GridShape shape;
  shape.corner = box.min;
  shape.step_mm = std::max(step_mm, longest / (kLongest - 2));
  while (true) {
    for (int axis = 0; axis < 3; ++axis) {
      shape.nodes[static_cast<std::size_t>(axis)] = 2 + static_cast<int>(extent[axis] / shape.step_mm);
    }
    if (shape.count() <= most_nodes) return shape;
    constexpr double kLonger = 1.02;
    shape.step_mm *= kLonger;
  }
}

SizeGrid::SizeGrid(const GridShape& shape, std::vector<float> sizes, double usual_mm)
    : shape_(shape),
      sizes_(std::move(sizes)),
      usual_mm_(usual_mm),
      least_mm_(static_cast<double>(*std::min_element(sizes_.begin(), sizes_.end()))) {}

double SizeGrid::size_at(const Point& p) const {
  const Vec place = (1 / shape_.step_mm) * (p - shape_.corner);
  std::array<int, 3> low;
  std::array<double, 3> part;
  for (int axis = 0; axis < 3; ++axis) {
    const auto a = static_cast<std::size_t>(axis);
    const double within = std::clamp(place[axis], 0.0, shape_.nodes[a] - 1.0);
    low[a] = std::min(static_cast<int>(within), shape_.nodes[a] - 2);
    part[a] = within - low[a];
  }
  const std::size_t row = static_cast<std::size_t>(shape_.nodes[0]);
  const std::size_t slice = row * static_cast<std::size_t>(shape_.nodes[1]);
  const float* first = sizes_.data() + shape_.index(low[0], low[1], low[2]);
  const auto along_x = [&](const float* s) {
    return static_cast<double>(s[0]) + part[0] * (static_cast<double>(s[1]) - static_cast<double>(s[0]));
  };
  const auto along_y = [&](const float* s) {
    const double a = along_x(s);
    return a + part[1] * (along_x(s + row) - a);
  };
  const double a = along_y(first);
  return std::max(a + part[2] * (along_y(first + slice) - a), least_mm_);
}

double SizeGrid::error_mm() const {
  return 0.5 * std::sqrt(3.0) * shape_.step_mm;
}

std::shared_ptr<const SizeGrid> make_size_grid(const Domain& domain, const SizeSource& source,
                                               const SizeGridOptions& options, Progress& progress) {
  progress.report({"sizes", {}, 0, std::nullopt, 0});
  const Box bounds = domain.bounds();
  GridShape shape = grid_over(bounds, 0, kUsualNodes);
  if (source.finest_mm() < shape.step_mm) shape = grid_over(bounds, source.finest_mm(), kMostNodes);
  const Sampler sampler(domain, source, options, shape);
  std::vector<float> sizes(shape.count(), std::numeric_limits<float>::infinity());
  const auto rows = static_cast<std::size_t>(shape.nodes[1]) * static_cast<std::size_t>(shape.nodes[2]);
  constexpr std::size_t kGrain = 32;
  parallel_for(rows, kGrain, [&](std::size_t begin, std::size_t end) {
    if (!progress.cancelled()) sampler.sample_rows(begin, end, sizes);
  });
  if (progress.cancelled()) return nullptr;
  sampler.check(sizes);
  const auto least = static_cast<float>(options.least_mm);
  const auto longest = static_cast<float>(options.longest_mm);
  for (float& size : sizes) size = std::min(std::max(size, least), longest);
  make_lipschitz(shape, sizes, progress);
  if (progress.cancelled()) return nullptr;
  SizeGrid grid(shape, sizes, 0);
  const double usual_mm = middle_size(grid, sampler.boundary());
  return std::make_shared<SizeGrid>(shape, std::move(sizes), usual_mm);
}

}  // namespace scantet
