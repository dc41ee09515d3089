// The paper's loop (section 3): the first rule that is broken anywhere gives the next point; its worst element goes
// first. Each step looks only at what the last insertion changed. A step is: choose a point for a violation and find
// its conflict zone (both read-only), insert it, collect the violations among the new elements.
#include <algorithm>

#include "scantet/refine/refinement_impl.h"

namespace scantet::refine {
namespace {

bool less_urgent(const Violation& a, const Violation& b) {
  return a.rank != b.rank ? a.rank < b.rank : a.tie < b.tie;
}

}  // namespace

bool ViolationQueue::alive(const Violation& violation) const {
  return violation.rule == Rule::r3 ? triangulation_.cell_alive(violation.element, violation.serial)
                                    : triangulation_.balls().alive(violation.element, violation.serial);
}

void ViolationQueue::compact(std::vector<Violation>& heap) {
  std::erase_if(heap, [&](const Violation& violation) { return !alive(violation); });
  std::make_heap(heap.begin(), heap.end(), less_urgent);
}

void ViolationQueue::push(const Violation& violation) {
  const auto rule = static_cast<std::size_t>(violation.rule);
  std::vector<Violation>& heap = heaps_[rule];
  if (heap.size() >= compact_at_[rule]) {
    compact(heap);
    compact_at_[rule] = std::max(compact_at_[rule], 2 * heap.size());
  }
  heap.push_back(violation);
  std::push_heap(heap.begin(), heap.end(), less_urgent);
}

std::optional<Violation> ViolationQueue::first(Rule last) {
  for (std::size_t rule = 0; rule <= static_cast<std::size_t>(last); ++rule) {
    std::vector<Violation>& heap = heaps_[rule];
    while (!heap.empty()) {
      if (alive(heap.front())) return heap.front();
      std::pop_heap(heap.begin(), heap.end(), less_urgent);
      heap.pop_back();
    }
  }
  return std::nullopt;
}

void ViolationQueue::give_up(Rule rule) {
  std::vector<Violation>& heap = heaps_[static_cast<std::size_t>(rule)];
  given_up_.push_back(heap.front());
  std::pop_heap(heap.begin(), heap.end(), less_urgent);
  heap.pop_back();
}

UnmetRules ViolationQueue::count() const {
  const auto live = [&](Rule rule) {
    std::vector<Violation> heap = heaps_[static_cast<std::size_t>(rule)];
    std::copy_if(given_up_.begin(), given_up_.end(), std::back_inserter(heap),
                 [&](const Violation& violation) { return violation.rule == rule; });
    return static_cast<std::uint64_t>(
        std::count_if(heap.begin(), heap.end(), [&](const Violation& violation) { return alive(violation); }));
  };
  return {live(Rule::r1), live(Rule::r2), live(Rule::r3)};
}

Refinement::Refinement(RestrictedTriangulation& triangulation, const SizingField& size, const MesherOptions& options,
                       Progress& progress)
    : triangulation_(triangulation),
      rules_(size, options),
      options_(options),
      progress_(progress),
      queue_(triangulation) {
  collect();
}

Stop Refinement::run(Rule last) {
  while (const std::optional<Violation> violation = queue_.first(last)) {
    if (triangulation_.vertex_count() >= options_.max_vertices) return Stop::limit;
    const Candidate candidate = choose(*violation);
    if (zone_.cells.empty()) {  // the point is a vertex already, to the last bit: nothing can be done here
      queue_.give_up(violation->rule);
      continue;
    }
    insert(candidate);
    collect();
    if (inserted_total_ % 256 == 0) {
      report(candidate.by);
      if (progress_.cancelled()) return Stop::cancelled;
    }
  }
  return Stop::converged;
}

std::uint64_t Refinement::add(const std::vector<SamplePoint>& points, double closest_mm) {
  std::uint64_t added = 0;
  for (const SamplePoint& point : points) {
    triangulation_.find_zone(point.point, triangulation_.triangulation().infinite_vertex()->cell(), zone_);
    if (zone_.cells.empty() || distance_to_zone(point.point) < closest_mm) continue;
    triangulation_.insert(point, zone_);
    collect();
    ++added;
  }
  return added;
}

/// The point that the violated rule inserts; its conflict zone is left in zone_.
Refinement::Candidate Refinement::choose(const Violation& violation) {
  const auto at_ball = [&](std::uint32_t id, Insertion by) {
    const SurfaceBall& ball = triangulation_.balls()[id];
    triangulation_.find_zone(ball.center, triangulation_.cell(ball.cell), zone_);
    return Candidate{{ball.center, true}, by};
  };
  if (violation.rule == Rule::r1) return at_ball(violation.element, Insertion::r1);
  if (violation.rule == Rule::r2) return at_ball(violation.element, Insertion::r2);
  const CellHandle tet = triangulation_.cell(violation.element);
  const Point center = tet->info().circumcenter;
  triangulation_.find_zone(center, tet, zone_);
  const std::uint32_t encroached = encroached_ball(center);
  return encroached == kNone ? Candidate{{center, false}, Insertion::r3_1} : at_ball(encroached, Insertion::r3_2);
}

/// The surface ball that contains p most deeply, or kNone. Such a ball belongs to a facet of the conflict zone: p
/// captures its centre from the facet's dual edge, and with it at least one end of that edge.
std::uint32_t Refinement::encroached_ball(const Point& p) const {
  std::uint32_t deepest = kNone;
  double depth = 0;
  for (CellHandle cell : zone_.cells) {
    for (std::uint32_t ball : cell->info().balls) {
      for (; ball != kNone; ball = triangulation_.balls()[ball].next) {
        const SurfaceBall& b = triangulation_.balls()[ball];
        const double inside = b.radius - distance(p, b.center);
        if (inside > depth || (inside == depth && deepest != kNone &&
                               lexicographically_less(b.center, triangulation_.balls()[deepest].center))) {
          depth = inside;
          deepest = ball;
        }
      }
    }
  }
  return deepest;
}

/// Insertion radius of a point whose conflict zone is zone_: its nearest vertex is one of the zone's.
double Refinement::distance_to_zone(const Point& p) const {
  double squared = std::numeric_limits<double>::infinity();
  for (CellHandle cell : zone_.cells) {
    for (int i = 0; i < 4; ++i) {
      const VertexHandle v = cell->vertex(i);
      if (!triangulation_.triangulation().is_infinite(v)) squared = std::min(squared, squared_distance(p, position(v)));
    }
  }
  return std::sqrt(squared);
}

void Refinement::insert(const Candidate& candidate) {
  last_radius_mm_ = distance_to_zone(candidate.point.point);
  triangulation_.insert(candidate.point, zone_);
  recent_[inserted_total_++ % recent_.size()] = candidate.by;
  last_point_ = candidate.point.point;
  std::uint64_t* const counts[] = {&inserted_.r1, &inserted_.r2, &inserted_.r3_1, &inserted_.r3_2};
  ++*counts[static_cast<std::size_t>(candidate.by)];
}

void Refinement::collect() {
  for (std::uint32_t ball : triangulation_.new_balls()) {
    if (const auto violation = rules_.facet(triangulation_, ball)) queue_.push(*violation);
  }
  for (std::uint32_t slot : triangulation_.new_cells()) {
    if (const auto violation = rules_.tet(triangulation_, slot)) queue_.push(*violation);
  }
}

namespace {
constexpr const char* kInsertionNames[] = {"R1", "R2", "R3.1", "R3.2"};
}

void Refinement::report(Insertion by) const {
  progress_.report({"refine", kInsertionNames[static_cast<std::size_t>(by)], triangulation_.vertex_count(),
                    std::nullopt, queue_.size()});
}

LimitReport Refinement::limit_report() const {
  std::array<int, 4> counts{};
  const std::size_t known = std::min<std::uint64_t>(inserted_total_, recent_.size());
  for (std::size_t i = 0; i < known; ++i) ++counts[static_cast<std::size_t>(recent_[i])];
  const auto busiest = static_cast<std::size_t>(std::max_element(counts.begin(), counts.end()) - counts.begin());
  return {known == 0 ? "initial sample" : kInsertionNames[busiest], last_point_, last_radius_mm_};
}

}  // namespace scantet::refine
