// The paper's loop (section 3): the first rule that is broken gives the next point; its worst element goes first. Each
// step looks only at what the last insertion changed. A step is: choose a point for a violation and find its conflict
// zone, insert it, collect the violations among the new elements.
#include <algorithm>
#include <cassert>

#include "scantet/base/stopwatch.h"
#include "scantet/refine/refinement_impl.h"

namespace scantet::engine {
namespace {

bool less_urgent(const Violation& a, const Violation& b) {
  return a.rank != b.rank ? a.rank < b.rank : a.tie < b.tie;
}

/// The squared distance from p to the nearest vertex, which is one of the zone's.
double squared_distance_to_zone(const Triangulation& t, const ConflictZone& zone, const Point& p) {
  double squared = std::numeric_limits<double>::infinity();
  for (const CellId c : zone.cells) {
    for (const PointId v : t.cell(c).vertex) squared = std::min(squared, squared_distance(p, t.point(v)));
  }
  return squared;
}

/// The balls of its conflict zone in which a circumcentre may not lie.
struct Encroached {
  std::uint32_t ball = kNone;      ///< the one that contains it most deeply
  bool waits_for_a_facet = false;  ///< a facet of the zone breaks R1 or R2
};

/// A ball that contains p belongs to a facet of p's conflict zone: p captures its centre from the facet's dual edge,
/// and with it at least one end of that edge.
Encroached encroached_ball(const RestrictedTriangulation& t, const BrokenFacets& broken, const ConflictZone& zone,
                           const Point& p) {
  Encroached result;
  double depth = 0;
  for (const CellId c : zone.cells) {
    for (const std::uint32_t head : t.triangulation().info(c).balls) {
      if (head == kNone) continue;
      result.waits_for_a_facet = result.waits_for_a_facet || broken[head] != 0;
      for (std::uint32_t id = head; id != kNone; id = t.balls()[id].next) {
        const SurfaceBall& ball = t.balls()[id];
        const double inside = ball.radius - distance(p, ball.center);
        const bool earlier = inside == depth && result.ball != kNone &&
                             lexicographically_less(ball.center, t.balls()[result.ball].center);
        if (inside <= depth && !earlier) continue;
        depth = inside;
        result.ball = id;
      }
    }
  }
  return result;
}

}  // namespace

void ViolationQueue::push(const Violation& violation) {
  std::vector<Violation>& heap = heaps_[static_cast<std::size_t>(violation.rule)];
  heap.push_back(violation);
  std::push_heap(heap.begin(), heap.end(), less_urgent);
}

std::optional<Violation> ViolationQueue::take(Rule last) {
  for (std::size_t rule = 0; rule <= static_cast<std::size_t>(last); ++rule) {
    std::vector<Violation>& heap = heaps_[rule];
    while (!heap.empty()) {
      std::pop_heap(heap.begin(), heap.end(), less_urgent);
      const Violation worst = heap.back();
      heap.pop_back();
      if (worst.alive(t_)) return worst;
    }
  }
  return std::nullopt;
}

void ViolationQueue::drain(std::vector<Violation>& list) {
  for (std::vector<Violation>& heap : heaps_) {
    list.insert(list.end(), heap.begin(), heap.end());
    heap.clear();
  }
}

void Refiner::run(Rule last, const std::function<bool()>& stop) {
  constexpr std::uint64_t kAskEvery = 256;
  Stopwatch watch;
  while (inserted_ < most_) {
    const std::optional<Violation> violation = queue_.take(last);
    if (!violation) return;
    const Choice choice = choose(*violation);
    if (choice.found == Inserter::Found::vertex) {  // the very same coordinates: nothing can be done here
      given_up_.push_back(*violation);
      continue;
    }
    if (choice.found == Inserter::Found::beyond) {
      waiting_.push_back(*violation);
      continue;
    }
    if (!editor_.has_room()) {
      queue_.push(*violation);
      return;
    }
    last_vertex_ = editor_.insert(choice.point);
    if (violation->alive(t_)) queue_.push(*violation);  // R3.2 may have left the tet as it was
    collect();
    const auto by = static_cast<std::size_t>(choice.by);
    ++work_.points[by];
    work_.close_points += violation->is_close ? 1 : 0;
    work_.seconds[by] += watch.seconds();
    watch = Stopwatch();
    recent_[inserted_++ % recent_.size()] = choice.by;
    if (inserted_ % kAskEvery == 0 && stop()) return;
  }
}

/// The point that the violated rule inserts; its conflict zone is left in the editor.
Refiner::Choice Refiner::choose(const Violation& violation) {
  if (violation.rule == Rule::r3) return choose_for_tet(violation.element);
  return choose_ball(violation.element, violation.rule == Rule::r1 ? Insertion::r1 : Insertion::r2);
}

Refiner::Choice Refiner::choose_ball(std::uint32_t id, Insertion by) {
  const SurfaceBall& ball = t_.balls()[id];
  assert(ball.generation % 2 == 1);
  return {editor_.find_zone(ball.center, ball.facet / 4), {ball.center, 2, ball.patch}, by};
}

Refiner::Choice Refiner::choose_for_tet(CellId tet) {
  assert(t_.triangulation().is_cell(tet) && t_.triangulation().info(tet).region != kOutside);
  const Point center = t_.triangulation().cell(tet).circumcentre;
  const Choice choice{editor_.find_zone(center, tet), {center, 3}, Insertion::r3_1};
  if (choice.found != Inserter::Found::zone) return choice;
  const Encroached encroached = encroached_ball(t_, broken_, editor_.zone(), center);
  // In a part, a facet that breaks R1 or R2 may have to wait, and what depends on it must wait, too. In the whole none
  // waits.
  if (encroached.waits_for_a_facet && !editor_.is_whole()) return {Inserter::Found::beyond, choice.point, choice.by};
  return encroached.ball == kNone ? choice : choose_ball(encroached.ball, Insertion::r3_2);
}

void Refiner::collect_facets() {
  for (const std::uint32_t ball : editor_.new_balls()) {
    const auto violation = rules_.facet(t_, ball);
    if (ball >= broken_.size()) broken_.resize(t_.balls().slots());  // not while parts are refined side by side
    broken_[ball] = violation ? 1 : 0;
    if (violation) queue_.push(*violation);
  }
}

void Refiner::collect() {
  collect_facets();
  for (const CellId c : editor_.new_cells()) {
    if (const auto violation = rules_.tet(t_, c)) queue_.push(*violation);
  }
}

Inserter::Found Refiner::add(const ExtraPoint& p) {
  using Found = Inserter::Found;
  // A cell that no part owns stays as it is while parts are worked on, but the way from it may lead through others.
  const bool is_known = p.near != kNone && t_.triangulation().is_cell(p.near);
  if (is_known && !editor_.owns(p.near)) return Found::beyond;
  const Found found = editor_.find_zone(p.point, p.near);
  if (found != Found::zone) return found;
  const double clear = p.clear_mm * p.clear_mm;
  if (squared_distance_to_zone(t_.triangulation(), editor_.zone(), p.point) < clear) return Found::vertex;
  if (!editor_.has_room()) return Found::beyond;
  last_vertex_ = editor_.insert({p.point, 2});
  collect();
  return Found::zone;
}

void Refiner::retire(std::vector<Violation>& left, std::vector<Violation>& given_up) {
  editor_.retire();
  collect_facets();
  queue_.drain(left);
  left.insert(left.end(), waiting_.begin(), waiting_.end());
  given_up.insert(given_up.end(), given_up_.begin(), given_up_.end());
}

Insertion Refiner::busiest_rule() const {
  std::array<int, 4> counts{};
  const std::size_t known = std::min<std::uint64_t>(inserted_, recent_.size());
  for (std::size_t i = 0; i < known; ++i) ++counts[static_cast<std::size_t>(recent_[i])];
  return static_cast<Insertion>(std::max_element(counts.begin(), counts.end()) - counts.begin());
}

}  // namespace scantet::engine
