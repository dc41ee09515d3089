// Points that mend the topology come in rounds. Each round lets the rules finish before it looks again, as they change
// what is to be mended.
#include <array>
#include <cassert>
#include <numeric>

#include "scantet/base/stopwatch.h"
#include "scantet/refine/rules_and_topology_impl.h"
#include "scantet/surface/untangle_impl.h"

namespace scantet::engine {
namespace {

constexpr int kUntangleRounds = 10;  // in each it is asked anew where a denser sample would help
constexpr int kRepairRounds = 300;   // several times what any scan has needed; each adds points or ends the repair
// Tets that change sides, for each surface ball. An atlas with hundreds of torn parts has 0.008, white noise 0.002, a
// checkerboard of voxels 0.3: there each round of points triples them, and tangles more than it mends. A few change
// sides in small meshes, too, where all rounds are quick.
constexpr double kMostAbsorbed = 0.1;
constexpr std::uint64_t kFewAbsorbed = 1000;

}  // namespace

RulesAndTopology::RulesAndTopology(const Domain& domain, RestrictedTriangulation& triangulation,
                                   const SizingField& size, const MesherOptions& options, Progress& progress)
    : domain_(domain),
      triangulation_(triangulation),
      size_(size),
      alpha_(options.bounds.alpha),
      handle_rounds_untangled_(options.handle_rounds_untangled),
      seeks_exchanged_handles_(options.seeks_exchanged_handles),
      progress_(progress),
      refinement_(triangulation, size, options, progress),
      boundary_(triangulation),
      repair_(domain, triangulation, boundary_, size, options.bounds.alpha),
      handles_(domain, triangulation, boundary_, size, options.bounds.alpha,
               {options.most_at_handles, options.keeps_few_handles, options.handle_rounds, options.level_ground,
                options.ways}),
      curves_(domain, triangulation) {}

void RulesAndTopology::refine() {
  for (const Rule last : {Rule::r2, Rule::r3}) {
    run(last);
    mend(last);
  }
}

void RulesAndTopology::untangle() {
  const bool is_right =
      repair_.is_whole() && !handles_.has_other_euler_number() && !is_left_out_ && !seeks_exchanged_handles_;
  if (stop_ == Stop::cancelled || (stop_ == Stop::converged && is_right)) return;
  bool denser = stop_ == Stop::converged;
  Untangler untangler(domain_, triangulation_, boundary_, size_, alpha_);
  handles_.begin_again(handle_rounds_untangled_, seeks_exchanged_handles_);
  missing_ = {};
  asked_ = {};
  for (int round = 0; try_to_untangle(untangler, denser && round < kUntangleRounds); ++round) {
    run(Rule::r3);
    mend(Rule::r3);
    if (stop_ == Stop::cancelled) return;
  }
  turned_ = untangler.changed_places();
}

void RulesAndTopology::look_for_wrong_handles() {
  if (stop_ != Stop::converged) return;
  const Stopwatch watch;
  exchanged_handles_ = handles_.exchanged_places();
  wrong_handles_ = handles_.wrong_places();
  wrong_handle_count_ = handles_.wrong_count();
  topology_s_ += watch.seconds();
}

void RulesAndTopology::account(MeshResult& result) const {
  constexpr std::array<const char*, 4> kRules{"R1", "R2", "R3.1", "R3.2"};
  const RuleWork& work = refinement_.work();
  const double threads_s = std::accumulate(work.seconds.begin(), work.seconds.end(), 0.0);
  for (std::size_t i = 0; i < kRules.size(); ++i) {
    const double share = threads_s > 0 ? work.seconds[i] / threads_s : 0.25;
    result.stages.push_back({kRules[i], share * rules_s_, work.points[i]});
  }
  result.stages.push_back({"topology", topology_s_, repair_points_});
  result.stages.push_back({"untangle", untangle_s_, 0});
  result.counts.inserted = {work.points[0], work.points[1], work.points[2], work.points[3]};
  result.counts.repair_points = repair_points_;
  result.counts.absorbed_tets = absorbed_tets_;
  result.tangled = tangled_;
  result.exchanged_handles = exchanged_handles_;
  result.wrong_handles = wrong_handles_;
  result.wrong_handle_count = wrong_handle_count_;
  result.turned = turned_;
  result.thin_sheets = repair_.sheets();
  result.handles_left_out = handles_.are_too_many();
  result.is_beyond_mending = is_beyond_mending();
}

/// Applies the rules up to `last`, if they have converged so far.
void RulesAndTopology::run(Rule last) {
  if (stop_ != Stop::converged) return;
  const Stopwatch watch;
  stop_ = progress_.cancelled() && !progress_.out_of_budget() ? Stop::cancelled : refinement_.run(last);
  rules_s_ += watch.seconds();
}

/// What costs only what has changed comes first; all of the boundary is looked at when that finds nothing more.
void RulesAndTopology::mend(Rule last) {
  for (int round = 0; round < kRepairRounds && stop_ == Stop::converged && !is_left_out_; ++round) {
    const bool has_added = add_found([&] { return repair_.points_at_pinches(); }) ||
                           add_found([&] { return handles_.points_on_ways(); }) ||
                           add_unless_growing(timed([&] { return handles_.points_on_asked_ways(); }), asked_) ||
                           add_found([&] { return repair_.points_on_pieces(); }) ||
                           add_found([&] { return curves_.points_beside(); }) ||
                           add_found([&] { return handles_.missing_points(); });
    if (!has_added) return;
    run(last);
  }
}

/// Returns whether there was room for one of the points that `find` gives.
bool RulesAndTopology::add_found(const std::function<std::vector<ExtraPoint>()>& find) {
  return add(timed(find));
}

std::vector<ExtraPoint> RulesAndTopology::timed(const std::function<std::vector<ExtraPoint>()>& find) {
  const Stopwatch watch;
  std::vector<ExtraPoint> points = find();
  topology_s_ += watch.seconds();
  return points;
}

/// Returns whether the sample has become denser.
bool RulesAndTopology::try_to_untangle(Untangler& untangler, bool may_add_points) {
  const Stopwatch watch;
  const double topology_s = topology_s_;
  const bool is_denser = untangle_or_add(untangler, may_add_points);
  untangle_s_ += watch.seconds() - (topology_s_ - topology_s);
  return is_denser;
}

/// Tets change sides; where that does not help, the first source of points that has room for one gives them.
bool RulesAndTopology::untangle_or_add(Untangler& untangler, bool may_add_points) {
  absorbed_tets_ = untangler.run();
  Tangles tangles = untangler.tangles();
  may_add_points = may_add_points && !is_beyond_mending();
  const auto add_missing = [&] { return add_unless_growing(handles_.missing_points(), missing_); };
  const auto add_asked = [&] { return add_unless_growing(handles_.points_on_asked_ways(), asked_); };
  if (may_add_points && (add(repair_.points_at(tangles)) || add_asked() || add_missing())) return true;
  const bool has_turned = !is_beyond_mending() && turn_over(untangler);
  if (has_turned) tangles = untangler.tangles();
  if (may_add_points && has_turned && add_missing()) return true;
  if (may_add_points && (add(handles_.points_on_false_handles()) || add(handles_.points_on_chains()))) return true;
  tangled_ = repair_.places_of(tangles);
  return false;
}

/// What a neck that no point widens cuts off changes sides as a whole, and then points on its ways ask for ever more:
/// none are added where the last ones were no fewer than those before, and these are no fewer again; where ways are
/// asked for, which go through all of it, as soon as they are no fewer.
bool RulesAndTopology::add_unless_growing(const std::vector<ExtraPoint>& points, Trend& trend) {
  const bool grows = points.size() >= trend.last;
  if ((grows && (trend.has_grown || handles_.are_ways_asked_for())) || !add(points)) return false;
  trend = {points.size(), grows};
  return true;
}

/// Returns whether tets have changed sides for the handles' sake.
bool RulesAndTopology::turn_over(Untangler& untangler) {
  const std::int64_t missing = handles_.missing_euler() / 2;  // of the inside's Euler number
  if (missing == 0) return false;
  if (!untangler.turn_over(misplaced_groups(domain_, triangulation_.triangulation()), missing)) return false;
  absorbed_tets_ = untangler.run();
  return true;
}

/// Whether it is left out, or so many tets had to change sides that more points would tangle the boundary more.
bool RulesAndTopology::is_beyond_mending() const {
  const double many = kMostAbsorbed * static_cast<double>(triangulation_.balls().slots());
  return is_left_out_ || (absorbed_tets_ > kFewAbsorbed && static_cast<double>(absorbed_tets_) > many);
}

/// Returns whether there was room for one of the points.
bool RulesAndTopology::add(const std::vector<ExtraPoint>& points) {
  const Stopwatch watch;
  const std::uint64_t added = refinement_.add(points);
  assert(added <= points.size());
  repair_points_ += added;
  topology_s_ += watch.seconds();
  return added > 0;
}

}  // namespace scantet::engine
