// After an insertion only the star of the new vertex is new. Its cells are classified by a region query at their
// circumcentre, its facets by a crossing query along their dual edge, both in one call for all of them. Both queries
// see the same end points from either side of a facet, so the two restrictions agree with each other, as region_at and
// crossings do.
#include <algorithm>
#include <cassert>

#include "scantet/base/parallel.h"
#include "scantet/delaunay/orthosphere.h"
#include "scantet/surface/restricted_triangulation_impl.h"

namespace scantet::engine {
namespace {

constexpr std::size_t kGrain = 4096;  // slots in a piece of a parallel loop
constexpr CellId kAhead = 4;          // cells whose neighbours are fetched before they are needed

}  // namespace

RestrictedTriangulation::RestrictedTriangulation(const Domain& domain)
    : domain_(domain),
      bounds_(domain.bounds()),
      center_(bounds_.center()),
      squared_reach_(4 * squared_length(bounds_.extent())),
      t_(bounds_) {}

std::uint64_t RestrictedTriangulation::vertex_count() const {
  return t_.vertex_count();
}

std::uint32_t RestrictedTriangulation::largest_ball(FacetCode facet, std::uint32_t ball) const {
  std::uint32_t largest = ball;
  for (std::uint32_t b = t_.info(facet / 4).balls[facet % 4]; b != kNone; b = balls_[b].next) {
    if (largest == kNone || balls_[b].radius > balls_[largest].radius) largest = b;
  }
  return largest;
}

bool RestrictedTriangulation::build(std::vector<SamplePoint> points, Progress& progress) {
  insert_points(std::move(points), progress);
  return classify();
}

bool RestrictedTriangulation::classify() {
  std::vector<char> spans((t_.cell_slots() + kGrain - 1) / kGrain, 0);
  parallel_for(t_.cell_slots(), kGrain, [&](std::size_t begin, std::size_t end) {
    std::vector<CellId> cells;
    for (auto c = static_cast<CellId>(begin); c < end; ++c) {
      if (!t_.is_cell(c)) continue;
      if (!t_.has_corner(c)) spans[begin / kGrain] = 1;
      cells.push_back(c);
    }
    std::vector<Point> centres;
    std::vector<Region> regions;
    classify_cells(cells, centres, regions);
  });
  if (std::find(spans.begin(), spans.end(), 1) == spans.end()) return false;
  parallel_for(t_.vertex_slots(), kGrain, [&](std::size_t begin, std::size_t end) {
    for (auto v = static_cast<PointId>(begin); v < end; ++v) {
      if (t_.is_vertex(v)) classify_vertex(v);
    }
  });
  disks_.grow(t_.vertex_slots());
  for (PointId v = 0; v < t_.vertex_slots(); ++v) {
    if (t_.is_vertex(v)) question(v);
  }
  std::vector<std::vector<SurfaceBall>> found(spans.size());
  parallel_for(t_.cell_slots(), kGrain, [&](std::size_t begin, std::size_t end) {
    DualEdges duals;
    for (auto c = static_cast<CellId>(begin); c < end; ++c) {
      if (c + kAhead < end) t_.prefetch_neighbors(c + kAhead);
      if (!t_.is_cell(c)) continue;
      for (FacetCode facet = 4 * c; facet < 4 * c + 4; ++facet) {
        if (facet < t_.cell(c).neighbor[facet % 4]) add_dual(facet, duals);
      }
    }
    domain_.crossings_of(duals.edges, duals.crossings);
    for (std::size_t i = 0; i < duals.facets.size(); ++i) find_balls(duals, i, found[begin / kGrain]);
  });
  link_balls(found);
  return true;
}

/// Puts the balls into the pool and joins those of a facet, which follow each other, to a chain.
void RestrictedTriangulation::link_balls(const std::vector<std::vector<SurfaceBall>>& found) {
  std::size_t count = 0;
  for (const auto& balls : found) count += balls.size();
  balls_.reserve(count);
  std::vector<std::uint32_t> starts;
  starts.reserve(found.size());
  for (const auto& balls : found) starts.push_back(balls_.append(balls.size()));
  parallel_for(found.size(), 1, [&](std::size_t piece, std::size_t) {
    for (std::size_t i = 0; i < found[piece].size(); ++i) {
      const std::uint32_t id = starts[piece] + static_cast<std::uint32_t>(i);
      SurfaceBall& ball = balls_[id] = found[piece][i];
      ball.generation = 1;
      const bool is_last = i + 1 == found[piece].size() || found[piece][i + 1].facet != ball.facet;
      ball.next = is_last ? kNone : id + 1;
      if (i > 0 && found[piece][i - 1].facet == ball.facet) continue;
      const FacetCode across = t_.cell(ball.facet / 4).neighbor[ball.facet % 4];
      t_.info(ball.facet / 4).balls[ball.facet % 4] = id;
      t_.info(across / 4).balls[across % 4] = id;
    }
  });
}

void RestrictedTriangulation::change_side(CellId c, Region region) {
  t_.info(c).region = region;
  ++changes_of_sides_;
  for (const PointId v : t_.cell(c).vertex) {
    if (v >= Triangulation::kCorners) question(v);
  }
}

std::vector<PointId> RestrictedTriangulation::take_questions() {
  std::vector<PointId> taken = std::move(questions_);
  questions_.clear();
  for (const PointId v : taken) {
    disks_.take(v);
    if (disks_.set_changed(v, true)) changed_.push_back(v);
  }
  std::erase_if(taken, [&](PointId v) { return !t_.vertex_info(v).on_boundary() || disks_.has_disk(v); });
  std::sort(taken.begin(), taken.end());
  return taken;
}

std::vector<PointId> RestrictedTriangulation::take_changed() {
  std::vector<PointId> changed = std::move(changed_);
  changed_.clear();
  for (const PointId v : changed) disks_.set_changed(v, false);
  changed.insert(changed.end(), questions_.begin(), questions_.end());
  std::sort(changed.begin(), changed.end());
  changed.erase(std::unique(changed.begin(), changed.end()), changed.end());
  return changed;
}

void RestrictedTriangulation::classify_cells(const std::vector<CellId>& cells, std::vector<Point>& centres,
                                             std::vector<Region>& regions) {
  centres.clear();
  for (const CellId c : cells) {
    if (!t_.has_corner(c)) centres.push_back(t_.cell(c).circumcentre);
  }
  regions.resize(centres.size());
  domain_.regions_at(centres, regions);
  auto region = regions.begin();
  for (const CellId c : cells) t_.info(c).region = t_.has_corner(c) ? kOutside : *region++;
}

void RestrictedTriangulation::classify_vertex(PointId v) {
  VertexInfo& info = t_.vertex_info(v);
  if (info.dimension == 2 && !info.patch.is_known()) info.patch = domain_.patch_at(t_.point(v));
}

/// The dual edge of a facet: the same bits from either side. It lies on the line through the facet's orthocentre along
/// its normal. The circumcentre of a nearly flat tet may be 1e16 mm away, so an end beyond the domain is cut off on
/// that line, just outside of the bounds: a longer segment would have no digits left for the domain.
Segment RestrictedTriangulation::dual(CellId c, int i) const {
  const Cell& cell = t_.cell(c);
  const Point& here = cell.circumcentre;
  const Point& there = t_.cell(cell.neighbor[static_cast<std::size_t>(i)] / 4).circumcentre;
  const auto canonical = [](const Point& a, const Point& b) {
    return lexicographically_less(a, b) ? Segment{a, b} : Segment{b, a};
  };
  if (is_near(here) && is_near(there)) return canonical(here, there);

  const auto v = facet_vertices(cell, i);
  std::array<WeightedPoint, 3> p{t_.weighted_point(v[0]), t_.weighted_point(v[1]), t_.weighted_point(v[2])};
  std::sort(p.begin(), p.end(),
            [](const WeightedPoint& a, const WeightedPoint& b) { return lexicographically_less(a.point, b.point); });
  const Point base = orthocentre(p[0], p[1], p[2]);
  const Vec normal = cross(p[1].point - p[0].point, p[2].point - p[0].point);
  const double reach = (distance(base, bounds_.center()) + bounds_.diagonal()) / length(normal);
  const auto end_at = [&](const Point& end) {
    if (is_near(end)) return end;
    return base + (dot(normal, end - base) > 0 ? reach : -reach) * normal;
  };
  return canonical(end_at(here), end_at(there));
}

void RestrictedTriangulation::add_dual(FacetCode facet, DualEdges& duals) const {
  const int i = static_cast<int>(facet % 4);
  const auto v = facet_vertices(t_.cell(facet / 4), i);
  if (std::min({v[0], v[1], v[2]}) < Triangulation::kCorners) return;
  duals.facets.push_back(facet);
  duals.edges.push_back(dual(facet / 4, i));
}

void RestrictedTriangulation::find_balls(const DualEdges& duals, std::size_t i, std::vector<SurfaceBall>& out) const {
  const FacetCode facet = duals.facets[i];
  const auto v = facet_vertices(t_.cell(facet / 4), static_cast<int>(facet % 4));
  for (const Crossing& crossing : duals.crossings[i]) {
    double squared_radius = std::numeric_limits<double>::infinity();
    for (const PointId corner : v) {
      squared_radius = std::min(squared_radius, squared_distance(crossing.point, t_.point(corner)) - t_.weight(corner));
    }
    out.push_back({crossing.point, std::sqrt(std::max(squared_radius, 0.0)), crossing.patch(), facet, kNone, 0});
  }
}

Editor::Editor(RestrictedTriangulation& t, VertexParts& parts, PartId part, std::size_t vertices)
    // As many cells as these insertions add, and those of one in passing.
    : t_(t), inserter_(t.t_, parts, part, 7 * vertices + 512, vertices), balls_(t.balls_, 4 * vertices + 512) {
  t.disks_.grow(t.t_.vertex_slots());
}

void Editor::retire() {
  inserter_.retire();
  balls_.retire();
  t_.questions_.insert(t_.questions_.end(), questions_.begin(), questions_.end());
  questions_.clear();
  exhausted_ = false;
  new_balls_.clear();
  duals_.clear();
  for (const FacetCode facet : late_facets_) t_.add_dual(facet, duals_);
  late_facets_.clear();
  classify_facets();
}

PointId Editor::insert(const SamplePoint& p) {
  Triangulation& t = t_.t_;
  for (const CellId c : zone_.cells) {
    for (int i = 0; i < 4; ++i) remove_balls(c, i);
    ++t.info(c).generation;
  }
  const PointId v = inserter_.take_vertex();
  t_.disks_.grow(t.vertex_slots());
  t.vertex(v).point = p.point;
  t.vertex_info(v) = {.patch = p.patch, .dimension = p.dimension};
  t_.classify_vertex(v);
  inserter_.insert(v, zone_);
  t.find_lasting_spheres(new_cells());
  t_.classify_cells(new_cells(), centres_, regions_);
  for (const CellId c : new_cells()) {
    for (const PointId corner : t.cell(c).vertex) {
      if (corner >= Triangulation::kCorners) t_.question(corner, questions_);
    }
  }
  new_balls_.clear();
  duals_.clear();
  for (const CellId c : new_cells()) {
    const auto outer = static_cast<FacetCode>(t.index_of(c, v));
    for (FacetCode i = 0; i < 4; ++i) {
      if (i == outer || 4 * c + i < t.cell(c).neighbor[i]) t_.add_dual(4 * c + i, duals_);
    }
  }
  classify_facets();
  return v;
}

void Editor::remove_balls(CellId c, int i) {
  std::uint32_t& head = t_.t_.info(c).balls[static_cast<std::size_t>(i)];
  std::uint32_t ball = head;
  if (ball == kNone) return;
  const FacetCode across = t_.t_.cell(c).neighbor[static_cast<std::size_t>(i)];
  head = kNone;
  t_.t_.info(across / 4).balls[across % 4] = kNone;
  while (ball != kNone) {
    const std::uint32_t next = t_.balls_[ball].next;
    balls_.remove(ball);
    ball = next;
  }
}

void Editor::classify_facets() {
  t_.domain_.crossings_of(duals_.edges, duals_.crossings);
  for (std::size_t i = 0; i < duals_.facets.size(); ++i) {
    found_.clear();
    t_.find_balls(duals_, i, found_);
    if (!found_.empty()) add_balls(duals_.facets[i]);
  }
}

void Editor::add_balls(FacetCode facet) {
  const FacetCode across = t_.t_.cell(facet / 4).neighbor[facet % 4];
  assert(t_.t_.info(facet / 4).balls[facet % 4] == kNone && t_.t_.info(across / 4).balls[across % 4] == kNone);
  if (!balls_.has_room_for(found_.size())) {
    late_facets_.push_back(facet);
    exhausted_ = true;
    return;
  }
  std::uint32_t head = kNone;
  for (auto ball = found_.rbegin(); ball != found_.rend(); ++ball) {
    ball->next = head;
    head = balls_.add(*ball);
  }
  t_.t_.info(facet / 4).balls[facet % 4] = head;
  t_.t_.info(across / 4).balls[across % 4] = head;
  new_balls_.push_back(head);
}

}  // namespace scantet::engine
