// While many elements break a rule, space is cut into parts that are refined side by side; an element whose zone
// reaches over a cut waits for the next round, whose cuts lie elsewhere. The parts depend on the geometry only, and so
// does what is done in each: the mesh is the same for any number of threads. The rest is refined as a whole, one point
// after the other.
#include <algorithm>

#include "scantet/base/parallel.h"
#include "scantet/delaunay/partition_impl.h"
#include "scantet/refine/refinement_impl.h"

namespace scantet::engine {
namespace {

constexpr std::array<const char*, 4> kInsertionNames{"R1", "R2", "R3.1", "R3.2"};
constexpr std::size_t kGrain = 4096;
constexpr std::size_t kLeastInPart = 1500;       // violations: fewer are not worth a part
constexpr std::size_t kLeastPointsInPart = 500;  // that are added: each costs as much as some violations
// Where there are so many violations for each vertex at first, the boundary is rough: more tets meet at each point, and
// a part is worth its while with so many times fewer of both.
constexpr double kManyViolations = 0.1;
constexpr std::size_t kFewerInPart = 3;
constexpr std::size_t kVerticesPerPart = 12'000;  // at least: smaller parts have too much surface for their volume
constexpr std::uint64_t kMostInPart = 16'384;     // points in a round, so that progress is seen

/// A vertex of the violation's element: while its part is refined, no other part changes the element.
PointId vertex_of(const Violation& violation, const RestrictedTriangulation& t) {
  const FacetCode code = violation.rule == Rule::r3 ? 4 * violation.element : t.balls()[violation.element].facet;
  return facet_vertices(t.triangulation().cell(code / 4), static_cast<int>(code % 4))[0];
}

/// A vertex of the cell that belongs to a part, as corners do not: no other part than that one changes the cell.
PointId vertex_of(const Cell& cell) {
  return *std::find_if(cell.vertex.begin(), cell.vertex.end(), [](PointId v) { return v >= Triangulation::kCorners; });
}

}  // namespace

Refinement::Refinement(RestrictedTriangulation& triangulation, const SizingField& size, const MesherOptions& options,
                       Progress& progress)
    : triangulation_(triangulation),
      rules_(size, options),
      options_(options),
      progress_(progress),
      sampled_(triangulation.vertex_count()) {
  collect_all();
  const std::size_t violations = pending_[0].size() + pending_[1].size() + pending_[2].size();
  if (static_cast<double>(violations) > kManyViolations * static_cast<double>(sampled_)) fewer_in_part_ = kFewerInPart;
}

/// Finds all violations anew.
void Refinement::collect_all() {
  const Triangulation& t = triangulation_.triangulation();
  for (std::vector<Violation>& list : pending_) list.clear();
  broken_.assign(triangulation_.balls().slots(), 0);
  std::vector<std::vector<Violation>> found((t.cell_slots() + kGrain - 1) / kGrain);
  parallel_for(t.cell_slots(), kGrain, [&](std::size_t begin, std::size_t end) {
    for (auto c = static_cast<CellId>(begin); c < end; ++c) {
      if (!t.is_cell(c)) continue;
      std::vector<Violation>& list = found[begin / kGrain];
      for (FacetCode facet = 4 * c; facet < 4 * c + 4; ++facet) {
        const std::uint32_t ball = t.info(c).balls[facet % 4];
        if (ball == kNone || triangulation_.balls()[ball].facet != facet) continue;
        const auto violation = rules_.facet(triangulation_, ball);
        if (!violation) continue;
        broken_[ball] = 1;
        list.push_back(*violation);
      }
      if (const auto violation = rules_.tet(triangulation_, c)) list.push_back(*violation);
    }
  });
  for (const auto& list : found) put_off(list);
}

void Refinement::put_off(const std::vector<Violation>& violations) {
  for (const Violation& violation : violations) pending_[static_cast<std::size_t>(violation.rule)].push_back(violation);
}

/// Drops the violations of rules up to `last` whose element is gone. Returns how many of them are left.
std::size_t Refinement::forget_dead(Rule last) {
  std::size_t left = 0;
  for (std::size_t rule = 0; rule <= static_cast<std::size_t>(last); ++rule) {
    std::erase_if(pending_[rule], [&](const Violation& violation) { return !violation.alive(triangulation_); });
    left += pending_[rule].size();
  }
  return left;
}

/// Where components touch along lines, R1 would go on down to the smallest balls. It may add as many points as it was
/// given, which no scan that is not full of such lines takes by far.
void Refinement::leave_close_to_untangling() {
  if (rules_.leaves_close() || work_.close_points <= sampled_) return;
  rules_.leave_close();
  collect_all();
}

Stop Refinement::run(Rule last) {
  bool parts_help = true;
  while (const std::size_t broken = forget_dead(last)) {
    const std::uint64_t vertices = triangulation_.vertex_count();
    if (vertices >= options_.max_vertices) return Stop::limit;
    if (progress_.cancelled()) return progress_.out_of_budget() ? Stop::limit : Stop::cancelled;
    const int depth =
        std::min({partition_depth(broken, kLeastInPart / fewer_in_part_), partition_depth(vertices, kVerticesPerPart),
                  partition_depth(options_.max_vertices - vertices, kMostInPart)});
    if (depth > 0 && parts_help) {
      parts_help = run_by_parts(last, depth);
    } else {
      run_whole(last);
      parts_help = true;
    }
    leave_close_to_untangling();
    report();
  }
  return Stop::converged;
}

/// Takes the violations of rules up to `last` out of those that are pending.
std::vector<Violation> Refinement::take_pending(Rule last) {
  std::vector<Violation> taken;
  for (std::size_t rule = 0; rule <= static_cast<std::size_t>(last); ++rule) {
    taken.insert(taken.end(), pending_[rule].begin(), pending_[rule].end());
    pending_[rule].clear();
  }
  return taken;
}

void Refinement::run_whole(Rule last) {
  const std::uint64_t allowed = options_.max_vertices - triangulation_.vertex_count();
  Refiner refiner(triangulation_, rules_, Editor(triangulation_), broken_, std::min(allowed, kMostInPart));
  for (const Violation& violation : take_pending(last)) refiner.push(violation);
  refiner.run(last, [&] {
    report();
    return progress_.cancelled();
  });
  take_back(refiner);
}

/// Cuts space into parts with about as many of the vertices in each, and calls work(refiner, which) for each part, side
/// by side, with the places of its vertices in the list. room: for how many points, of a list of so many. Returns
/// whether any was inserted.
bool Refinement::work_by_parts(const std::vector<PointId>& at, int depth, const Room& room, const Work& work) {
  Triangulation& t = triangulation_.triangulation();
  std::vector<Point> places;
  places.reserve(at.size());
  Box box;
  for (const PointId v : at) {
    places.push_back(t.point(v));
    box.extend(places.back());
  }
  const Vec extent = box.extent();
  const double volume_mm3 = extent.x * extent.y * extent.z;
  const double near_mm = 2 * std::cbrt(volume_mm3 / static_cast<double>(triangulation_.vertex_count()));
  const Partition partition(places, depth, near_mm);
  VertexParts parts = partition.parts_of(t);
  std::vector<std::vector<std::uint32_t>> lists(static_cast<std::size_t>(partition.count()));
  for (std::uint32_t n = 0; n < at.size(); ++n) lists[parts[at[n]]].push_back(n);
  std::vector<Refiner> refiners;
  for (std::size_t part = 0; part < lists.size(); ++part) {
    const std::uint64_t most = room(lists[part].size());
    Editor editor(triangulation_, parts, static_cast<PartId>(part), most);
    refiners.emplace_back(triangulation_, rules_, std::move(editor), broken_, most);
  }
  parts.resize(t.vertex_slots());
  broken_.resize(triangulation_.balls().slots());
  parallel_for(lists.size(), 1, [&](std::size_t part, std::size_t) { work(refiners[part], lists[part]); });
  bool any = false;
  for (Refiner& refiner : refiners) any = take_back(refiner) || any;
  return any;
}

/// Refines by parts, one round. Returns whether it inserted a point.
bool Refinement::run_by_parts(Rule last, int depth) {
  const std::vector<Violation> violations = take_pending(last);
  std::vector<PointId> at;
  at.reserve(violations.size());
  for (const Violation& violation : violations) at.push_back(vertex_of(violation, triangulation_));
  const auto room = [](std::size_t count) { return std::min<std::uint64_t>(count / 2 + 64, kMostInPart); };
  return work_by_parts(at, depth, room, [&](Refiner& refiner, const std::vector<std::uint32_t>& which) {
    for (const std::uint32_t n : which) refiner.push(violations[n]);
    refiner.run(last, [] { return false; });
  });
}

/// Adds points by parts. found: by point, set for those that lie in parts; the others stay `beyond`.
void Refinement::add_by_parts(const std::vector<ExtraPoint>& points, std::vector<Inserter::Found>& found) {
  const Triangulation& t = triangulation_.triangulation();
  std::vector<std::uint32_t> known;  // those with a cell near by
  std::vector<PointId> at;           // a vertex of that cell
  for (std::uint32_t n = 0; n < points.size(); ++n) {
    if (points[n].near == kNone || !t.is_cell(points[n].near)) continue;
    known.push_back(n);
    at.push_back(vertex_of(t.cell(points[n].near)));
  }
  const int depth = std::min(partition_depth(known.size(), kLeastPointsInPart / fewer_in_part_),
                             partition_depth(triangulation_.vertex_count(), kVerticesPerPart));
  if (depth == 0) return;
  const auto room = [](std::size_t count) { return static_cast<std::uint64_t>(count); };
  work_by_parts(at, depth, room, [&](Refiner& refiner, const std::vector<std::uint32_t>& which) {
    for (const std::uint32_t k : which) found[known[k]] = refiner.add(points[known[k]]);
  });
}

/// Takes back what a refiner has left, and adds up its work. Returns whether it inserted a point.
bool Refinement::take_back(Refiner& refiner) {
  std::vector<Violation> left;
  refiner.retire(left, given_up_);
  put_off(left);
  for (std::size_t rule = 0; rule < 4; ++rule) {
    work_.points[rule] += refiner.work().points[rule];
    work_.seconds[rule] += refiner.work().seconds[rule];
  }
  work_.close_points += refiner.work().close_points;
  if (refiner.last_vertex() == kNone) return false;
  busiest_ = refiner.busiest_rule();
  last_vertex_ = refiner.last_vertex();
  return true;
}

std::uint64_t Refinement::add(const std::vector<ExtraPoint>& points) {
  if (points.empty()) return 0;
  using Found = Inserter::Found;
  std::vector<Found> found(points.size(), Found::beyond);
  add_by_parts(points, found);
  Refiner refiner(triangulation_, rules_, Editor(triangulation_), broken_, points.size());
  for (std::size_t n = 0; n < points.size(); ++n) {
    if (found[n] == Found::beyond) found[n] = refiner.add(points[n]);
  }
  take_back(refiner);
  return static_cast<std::uint64_t>(std::count(found.begin(), found.end(), Found::zone));
}

UnmetRules Refinement::unmet() const {
  UnmetRules unmet;
  for (const auto* list : {&pending_[0], &pending_[1], &pending_[2], &given_up_}) {
    for (const Violation& violation : *list) {
      if (!violation.alive(triangulation_)) continue;
      ++(violation.rule == Rule::r1 ? unmet.r1 : violation.rule == Rule::r2 ? unmet.r2 : unmet.r3);
    }
  }
  return unmet;
}

void Refinement::report() const {
  progress_.report({"refine", kInsertionNames[static_cast<std::size_t>(busiest_)], triangulation_.vertex_count(),
                    std::nullopt, pending_[0].size() + pending_[1].size() + pending_[2].size()});
}

LimitReport Refinement::limit_report() const {
  if (last_vertex_ == kNone) return {"initial sample", {}, 0};
  const Triangulation& t = triangulation_.triangulation();
  const Point& place = t.point(last_vertex_);
  std::vector<CellId> star;
  t.star_of(last_vertex_, star);
  double squared = std::numeric_limits<double>::infinity();
  for (const CellId c : star) {
    for (const PointId v : t.cell(c).vertex) {
      if (v != last_vertex_) squared = std::min(squared, squared_distance(place, t.point(v)));
    }
  }
  return {kInsertionNames[static_cast<std::size_t>(busiest_)], place, std::sqrt(squared)};
}

}  // namespace scantet::engine
