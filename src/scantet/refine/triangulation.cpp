// A cell keeps its circumcentre c and two squared distances from it, so that nearly all conflict tests are one
// subtraction, one product and two comparisons. They are sure in spite of rounding: q is inside the sphere through the
// vertices p_i if and only if |q-c|² < Σ λ_i(q) |p_i-c|², λ being barycentric coordinates, for any c whatever. If all
// |p_i-c|² are within δ of R², the sum is within δ·Σ|λ_i(q)| of R²; and Σ|λ_i(q)| ≤ (|q-c| + R)·S, S the sum of the
// inverse heights, as the plane of each facet meets the ball. Hence q is outside if |q-c| > R + δS, inside if
// |q-c| < R - δS.
#include <limits>

#include "scantet/base/parallel.h"
#include "scantet/refine/circumcenter.h"
#include "scantet/refine/predicates_impl.h"
#include "scantet/refine/triangulation_impl.h"

namespace scantet::refine {

Triangulation::Triangulation(const Box& bounds) {
  // A regular tet whose insphere has eight times the radius of the bounds.
  const double reach = 8 * std::max(0.5 * bounds.diagonal(), 1e-3);
  const Point center = bounds.center();
  const std::array<Vec, 4> directions{{{1, 1, 1}, {-1, 1, -1}, {1, -1, -1}, {-1, -1, 1}}};
  constexpr double kInradius = 0.577350269189625731;  // of the tet with those vertices: 1 / √3
  vertices_.resize(kCorners);
  for (PointId v = 0; v < kCorners; ++v) vertices_[v].point = center + (reach / kInradius) * directions[v];
  add_cell();
  cells_[0].vertex = {0, 1, 2, 3};
  cells_[0].neighbor = {kNone, kNone, kNone, kNone};
  if (orientation(point(0), point(1), point(2), point(3)) < 0) std::swap(cells_[0].vertex[2], cells_[0].vertex[3]);
  find_sphere(0);
}

/// A free slot at the end.
CellId Triangulation::add_cell() {
  cells_.emplace_back();
  cells_.back().vertex[0] = kNone;
  if (!infos_.empty()) infos_.push_back({});
  marks_.push_back(0);
  return cell_slots() - 1;
}

void Triangulation::star_of(PointId v, std::vector<CellId>& star) const {
  star.assign(1, vertices_[v].cell);
  for (std::size_t done = 0; done < star.size(); ++done) {
    const Cell& cell = cells_[star[done]];
    for (std::size_t i = 0; i < 4; ++i) {
      if (cell.vertex[i] == v) continue;
      const CellId next = cell.neighbor[i] / 4;
      if (std::find(star.begin(), star.end(), next) == star.end()) star.push_back(next);
    }
  }
}

void Triangulation::reserve(std::size_t vertices) {
  constexpr double kCellsPerVertex = 7.0;  // a little over what Delaunay triangulations of such points have
  const std::size_t cells = static_cast<std::size_t>(kCellsPerVertex * static_cast<double>(vertices)) + 1024;
  vertices_.reserve(vertices + kCorners);
  cells_.reserve(cells);
  infos_.reserve(cells);
  marks_.reserve(cells);
}

PointId Triangulation::add_vertex(const Point& p, bool on_boundary) {
  vertices_.push_back({p, 0, kNone, 0, on_boundary, false});
  return vertex_slots() - 1;
}

/// A new number for each cell, by its last vertex; kNone for free slots.
std::vector<CellId> Triangulation::numbers_by_place(CellId& count) const {
  const auto last_vertex = [&](CellId c) {
    const auto& v = cells_[c].vertex;
    return std::max({v[0], v[1], v[2], v[3]});
  };
  std::vector<CellId> next(vertices_.size() + 1, 0);
  for (CellId c = 0; c < cells_.size(); ++c) {
    if (is_cell(c)) ++next[last_vertex(c) + 1];
  }
  for (std::size_t v = 1; v < next.size(); ++v) next[v] += next[v - 1];
  count = next.back();
  std::vector<CellId> number(cells_.size(), kNone);
  for (CellId c = 0; c < cells_.size(); ++c) {
    if (is_cell(c)) number[c] = next[last_vertex(c)]++;
  }
  return number;
}

void Triangulation::renumber_cells() {
  constexpr std::size_t kGrain = 8192;
  CellId count = 0;
  const std::vector<CellId> number = numbers_by_place(count);
  // In two halves, so that never more than half of each cell is there twice.
  const auto move_all = [&](auto half, const auto& take, const auto& put) {
    LargeVector<decltype(half)> moved;
    moved.resize(count);
    parallel_for(cells_.size(), kGrain, [&](std::size_t begin, std::size_t end) {
      for (std::size_t c = begin; c < end; ++c) {
        if (number[c] != kNone) moved[number[c]] = take(cells_[c]);
      }
    });
    parallel_for(count, kGrain, [&](std::size_t begin, std::size_t end) {
      for (std::size_t c = begin; c < end; ++c) put(cells_[c], moved[c]);
    });
  };
  struct Links {
    std::array<PointId, 4> vertex;
    std::array<FacetCode, 4> neighbor;
  };
  const auto links_of = [&](const Cell& cell) {
    Links links{cell.vertex, cell.neighbor};
    for (FacetCode& across : links.neighbor) {
      if (across != kNone) across = 4 * number[across / 4] + across % 4;
    }
    return links;
  };
  move_all(Links{}, links_of, [](Cell& cell, const Links& links) {
    cell.vertex = links.vertex;
    cell.neighbor = links.neighbor;
  });
  struct Sphere {
    Point circumcenter;
    float surely_inside;
    float surely_outside;
  };
  const auto sphere_of = [](const Cell& cell) {
    return Sphere{cell.circumcenter, cell.surely_inside, cell.surely_outside};
  };
  move_all(Sphere{}, sphere_of, [](Cell& cell, const Sphere& sphere) {
    cell.circumcenter = sphere.circumcenter;
    cell.surely_inside = sphere.surely_inside;
    cell.surely_outside = sphere.surely_outside;
  });
  cells_.resize(count);
  infos_.assign(count, {});
  marks_.assign(count, 0);
  last_mark_ = 0;
  free_cells_.clear();
  parallel_for(vertices_.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = std::max<std::size_t>(begin, kCorners); v < end; ++v) {
      if (vertices_[v].cell != kNone) vertices_[v].cell = number[vertices_[v].cell];
    }
  });
}

void Triangulation::find_lasting_sphere(CellId c) {
  std::array<Point, 4> points = points_of(c);
  sort_points(points);
  find_sphere_of(c, points);
  if (std::isnan(cells_[c].circumcenter.x)) cells_[c].circumcenter = circumcenter(points);
}

void Triangulation::find_sphere_of(CellId c, const std::array<Point, 4>& p) {
  Cell& cell = cells_[c];
  double determinant = 0;
  cell.circumcenter = quick_circumcenter(p, determinant);
  double smallest = std::numeric_limits<double>::infinity();
  double largest = 0;
  for (const Point& q : p) {
    const double squared = squared_distance(q, cell.circumcenter);
    smallest = std::min(smallest, squared);
    largest = std::max(largest, squared);
  }
  // No triangle in the sphere has more than 3√3/4 R² of area: the inverse heights sum up to 11 R² / determinant.
  constexpr double kInverseHeights = 22;  // twice that, for the rounding of the determinant
  constexpr double kRounding = 2e-15;     // of a squared distance
  constexpr double kMargin = 4e-7;        // more than a float rounds, and kLittle twice
  const double off = 0.5 * (largest - smallest) + kRounding * largest;
  const double doubt = off * kInverseHeights;  // times R / determinant: δS / R
  constexpr double kLittle = 1e-8;
  double inside = (1 - kMargin) * largest;
  double outside = (1 + kMargin) * largest;
  if (!(doubt * doubt * largest < kLittle * kLittle * determinant * determinant)) {  // also if NaN
    const double share = doubt * std::sqrt(largest) / determinant;
    const bool hopeless = !(share < 0.5) || !(largest < 1e30);
    inside = hopeless ? -1 : inside * (1 - share) * (1 - share);
    outside = hopeless ? std::numeric_limits<double>::infinity() : outside * (1 + share) * (1 + share);
  }
  cell.surely_inside = static_cast<float>(inside);
  cell.surely_outside = static_cast<float>(outside);
}

bool Triangulation::in_conflict_exactly(CellId c, const Point& p) const {
  return exact_in_sphere(points_of(c), p);
}

}  // namespace scantet::refine
