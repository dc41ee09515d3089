// The Voronoi cell of a point has the circumcentres of the tets around it as vertices. Which side of the surface they
// are on is told from the farthest one, with no query: the cell of a dense sample is long and thin along the normal.
#include "scantet/sampling/poles.h"

#include <array>
#include <cassert>

#include "scantet/base/parallel.h"
#include "scantet/delaunay/bulk_insertion_impl.h"
#include "scantet/delaunay/triangulation_impl.h"

namespace scantet {
namespace {

using engine::CellId;
using engine::PointId;
using engine::Triangulation;

constexpr std::size_t kGrain = 1024;

/// The cells of the star whose circumcentres are the vertex's poles. A cell with a corner stands for a Voronoi vertex
/// at infinity: it can be the farthest, but it is no pole.
void add_poles(const Triangulation& t, PointId v, std::vector<CellId>& star, std::vector<CellId>& poles) {
  t.star_of(v, star);
  const Point& p = t.point(v);
  const auto away = [&](CellId c) { return t.cell(c).circumcentre - p; };
  CellId first = star.front();
  for (const CellId c : star) {
    if (squared_length(away(c)) > squared_length(away(first))) first = c;
  }
  CellId second = engine::kNone;
  for (const CellId c : star) {
    if (!(dot(away(c), away(first)) < 0)) continue;
    if (second == engine::kNone || squared_length(away(c)) > squared_length(away(second))) second = c;
  }
  for (const CellId c : {first, second}) {
    if (c != engine::kNone && !t.has_corner(c)) poles.push_back(c);
  }
}

Pole pole_of(const Triangulation& t, CellId c) {
  const Point& center = t.cell(c).circumcentre;
  const std::array<Point, 4> p = t.points_of(c);
  double longest = 0;  // squared, of the edges
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t j = 0; j < i; ++j) longest = std::max(longest, squared_distance(p[i], p[j]));
  }
  const double radius = distance(center, p[0]);
  assert(radius > 0);
  return {center, radius, 2 * std::asin(std::min(1.0, 0.5 * std::sqrt(longest) / radius))};
}

}  // namespace

std::vector<Pole> poles_of(const std::vector<Point>& sample, const Box& bounds, Progress& progress) {
  std::vector<engine::SamplePoint> points;
  points.reserve(sample.size());
  for (const Point& p : sample) points.push_back({p, 2});
  Triangulation t(bounds);
  engine::insert_in_bulk(std::move(points), t, progress);
  if (progress.cancelled()) return {};
  parallel_for(t.cell_slots(), kGrain, [&](std::size_t begin, std::size_t end) {
    std::vector<CellId> cells;
    for (std::size_t c = begin; c < end; ++c) {
      if (t.is_cell(static_cast<CellId>(c))) cells.push_back(static_cast<CellId>(c));
    }
    t.find_lasting_spheres(cells);
  });
  std::vector<CellId> cells = parallel_collect<CellId>(
      t.vertex_slots(), kGrain, [&](std::size_t begin, std::size_t end, std::vector<CellId>& found) {
        std::vector<CellId> star;
        for (std::size_t v = begin; v < end; ++v) {
          if (t.is_vertex(static_cast<PointId>(v))) add_poles(t, static_cast<PointId>(v), star, found);
        }
      });
  parallel_sort(cells, std::less<>());
  cells.erase(std::unique(cells.begin(), cells.end()), cells.end());
  std::vector<Pole> poles;
  poles.reserve(cells.size());
  for (const CellId c : cells) poles.push_back(pole_of(t, c));
  return poles;
}

}  // namespace scantet
