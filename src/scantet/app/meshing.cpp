// An element stays out of bounds, a vertex pinched, or an island or a handle lost where the boundary is more crooked
// than elements of that size can follow: at a saddle, or at an island of one voxel. Only smaller elements help there.
#include "scantet/app/meshing.h"

#include <algorithm>
#include <limits>
#include <type_traits>

#include "scantet/app/best_of_both.h"
#include "scantet/app/keep_best.h"
#include "scantet/app/level_ground.h"
#include "scantet/app/mesh_faults.h"
#include "scantet/app/meshing_steps.h"
#include "scantet/app/narrow_necks.h"
#include "scantet/app/nearer_points.h"
#include "scantet/app/spent_time.h"
#include "scantet/app/thin_ways.h"
#include "scantet/app/trouble_spots.h"
#include "scantet/base/phase_clock.h"
#include "scantet/base/stopwatch.h"
#include "scantet/check/facet_crossings.h"
#include "scantet/check/losses.h"
#include "scantet/check/lost_parts.h"

namespace scantet {
namespace {

constexpr int kFinerRounds = 8;
constexpr int kFinerRoundsOfCurves = 16;  // where regions meet in curves
constexpr int kSearchRounds = 24;
constexpr int kRoundsInVain = 3;         // in a row
constexpr int kSearchesInVain = 8;       // where the search looks, others come up before the last ones are mended
constexpr std::size_t kManySpots = 100;  // an attempt must leave a twentieth less of them, or it was the last
constexpr int kDistanceRounds = 8;
constexpr double kWorthARound = 0.9;     // of the parts that are too far, left by it at the most; of what is lost, too
constexpr std::size_t kManyLosses = 20;  // that many take several attempts
constexpr double kNearWays = 0.5;        // of the limit: so near ways come to what is too far
constexpr double kFiner = 0.5;
constexpr double kLeastShare = 0.0625;          // of a cell, between points on parts that are lost;
constexpr double kMostOnParts = 0.1;            // of the points that there are, or
constexpr double kFewOnParts = 10000;           // points: no more at once
constexpr double kLeastOwnWithDistance = 0.05;  // thin parts have points all over
constexpr int kHandleRoundsAgain = 8;           // after the first mesh: what all of its rounds left broken stays so
constexpr int kHandleRoundsUntangled = 4;

/// Whether there are so many spots that attempts take long, and the last one hardly mended any.
bool is_hopeless(const TroubleSpots::Outlook& before, const TroubleSpots::Outlook& now) {
  return before.spots > kManySpots && 20 * now.spots > 19 * before.spots;
}

/// One attempt after the other, with more and more places where the size is finer.
class Attempts {
 public:
  Attempts(const Domain& domain, std::shared_ptr<const SizingField> size_asked, const MesherOptions& mesher,
           const OptimizerOptions& optimizer, std::optional<double> max_distance_mm, const FaultSearch& search,
           const LossSearch& losses, Progress& progress)
      : domain_(domain),
        size_asked_(std::move(size_asked)),
        mesher_(mesher),
        optimizer_(optimizer),
        max_distance_mm_(max_distance_mm),
        search_(search),
        losses_(losses),
        progress_(progress),
        has_curves_(!domain.curves().empty()),
        spots_(size_asked_),
        necks_(domain, *size_asked_),
        level_ground_(domain, mesher.handle_rounds),
        size_(size_asked_, {}) {
    if (optimizer.optimize == Optimize::full) mesher_.handle_rounds_untangled = kHandleRoundsUntangled;
    if (max_distance_mm) meter_.emplace(domain, *max_distance_mm);
  }

  /// Begins, or goes on at the sizes chosen: from the first mesh, or with a search from the last one. best: null at
  /// first; what is as good there stays. was_in_vain: whether the last one was no better. Empty if cancelled.
  std::optional<Meshing> next(const Meshing* best, bool was_in_vain) {
    std::optional<MeshResult> mesh = refined();
    if (losses_before_ >= kManyLosses) keep_parts(mesh);
    if (!mesh) return std::nullopt;
    // What is proved of a facet holds only of that one: a search goes on from where it was.
    if (!start_ || search_ || level_ground_.is_next()) start_ = points_of(*mesh);
    mesher_.handle_rounds = kHandleRoundsAgain;
    Meshing meshing;
    meshing.refined = std::move(*mesh);
    meshing.finer = places();
    if (meshing.refined.mesh.tets.empty()) return meshing;
    // To improve what is near the places alone may lead to the same again.
    const bool is_grafted = best != nullptr && !was_in_vain && keep_most_of(*best, meshing);
    // A mesh that a limit ended is far from done: to improve all of it takes longer than to refine it.
    const bool may_improve = meshing.refined.stop == Stop::converged;
    if (may_improve && !improve(domain_, size_asked_, mesher_, optimizer_, is_grafted, progress_, meshing)) {
      return std::nullopt;
    }
    if (best != nullptr && was_in_vain) keep_most_of(*best, meshing);
    check(meshing);
    if (best != nullptr) take_both(*best, meshing);
    return meshing;
  }

  /// How much is wrong with the mesh of the last attempt. Where no other one would follow, as refinement was ended or
  /// left faults all over, each counts as a spot: there may be millions.
  Faults judge(const Meshing& last) {
    losses_before_ = last.lost ? last.lost->places.size() : 0;
    MeshFaults faults = mesh_faults(last, has_curves_);
    const std::size_t handles_wrong = has_only_wrong_handles(last, faults) ? last.loss_count->count : 0;
    // None of the places that seemed wrong was it, or none seems so.
    if (handles_wrong > 0 && (handles_wrong == handles_wrong_before_ || faults.handles.empty())) {
      faults.handles.insert(faults.handles.end(), last.refined.turned.begin(), last.refined.turned.end());
    }
    handles_wrong_before_ = handles_wrong;
    if (has_exchanged_handles(last, faults)) mesher_.seeks_exchanged_handles = true;
    doubtful_ = handles_wrong > 0 ? faults.handles : std::vector<Point>();
    if (mesher_.bounds.facet_distance_mm || max_distance_mm_) faults.least_own = kLeastOwnWithDistance;
    const bool may_go_on = finer_may_help(last, near_);
    const std::size_t spots = may_go_on ? spots_.judge(faults) : faults.losses.size() + faults.elements.size();
    const Faults found = faults_of(last, faults, spots);
    level_ground_.judge(last, faults, found.losses, mesher_, start_);
    // Of what the first mesh leaves most is mended by smaller elements, which takes less.
    optimizer_.persistence = Persistence::shaking;
    return found;
  }
  /// What the next one leaves at the least, as far as is known.
  TroubleSpots::Outlook outlook() const { return spots_.outlook(); }

  /// Chooses where the size is finer in the next attempt, after judge() of the last one. is_last: there will be no
  /// more. Return: whether that is elsewhere than in the last one.
  bool choose(const Meshing& last, bool is_last) {
    const bool is_other = spots_.choose(is_last);
    if (last.lost && !is_last) ask_for(last.lost->ways);
    const bool has_necks = !is_last && necks_.add_near(doubtful_);
    kept_ = kept_next_;
    for (const Point& p : last.searched) searched_.push_back({p, kFiner * size_.size_at(p)});
    size_ = FinerSize(size_asked_, places());
    return add_points_on(last.lost_parts, is_last) || is_other || has_necks || !last.searched.empty();
  }

  /// Whether the last mesh kept the distance before it was improved.
  bool was_near() const { return near_; }
  /// That measures distances; null if there is no limit.
  DistanceMeter* meter() { return meter_ ? &*meter_ : nullptr; }
  /// What meshes took that came before the last one.
  const SpentTime& spent_before() const { return spent_before_; }

 private:
  /// Meshes, with facets no farther from the surface than the limit; as long as boundaries are too far from each other,
  /// goes on with points there: what is too far now would be so when the mesh is improved, too. Gives up when that does
  /// not help.
  std::optional<MeshResult> refined() {
    const MeshResult* const before = start_ ? &*start_ : nullptr;
    MesherOptions closer = near_mesher();
    std::optional<MeshResult> mesh = mesh_or_cancel(domain_, size_, closer, before, progress_);
    if (mesh && before == nullptr && optimizer_.optimize == Optimize::full) keep_handles(closer, *mesh);
    const bool search = max_distance_mm_ && (before == nullptr || near_);  // once in vain is enough
    if (search && mesh) come_nearer(closer, mesh);
    mesher_.ways = std::move(closer.ways);
    return mesh;
  }

  /// Return: whether the best mesh is kept but for some places. It is where losses are looked for in the mesh itself:
  /// handles are known of a mesh as it was refined. What is sought or held to a distance is meshed anew.
  bool keep_most_of(const Meshing& best, Meshing& meshing) const {
    const bool may_keep = losses_ && !search_ && !max_distance_mm_ && meshing.refined.stop == Stop::converged;
    return may_keep && keep_best(best, domain_, *size_asked_, meshing);
  }

  /// Looks for all that may be wrong with a mesh.
  void check(Meshing& meshing) {
    PhaseClock phase(meshing.phases, progress_);
    phase.begin("audit", "bounds");
    const FinerSize size(size_asked_, meshing.finer);
    meshing.conformance =
        check_conformance(meshing.refined.mesh, domain_, with_rules(optimizer_, domain_, mesher_, size).bounds);
    if (!meshing.optimized.stages.empty()) meshing.crossings = crossing_facets(meshing.refined.mesh);
    if (meter_) meshing.distance = meter_->measure(meshing.refined.mesh, &size);
    const bool converged = meshing.refined.stop == Stop::converged;
    if (search_ && converged) meshing.searched = search_(meshing.refined.mesh, progress_);
    if (converged && optimizer_.optimize == Optimize::full) {
      if (losses_) meshing.lost = losses_(meshing.refined.mesh);
      meshing.lost_parts = find_lost_parts(meshing.refined.mesh, domain_, *size_asked_);
      if (!losses_) meshing.loss_count = count_losses(meshing.refined.mesh, domain_, *size_asked_);
      if (meshing.loss_count && meshing.loss_count->count == 0) {
        meshing.refined.wrong_handles.clear();
        meshing.refined.exchanged_handles.clear();
      }
    }
    phase.end();
  }

  /// Takes the best mesh where that one is right and this one is not, or the other way round, if that mends more than
  /// it breaks. What is sought or held to a distance is meshed anew; with a search for losses the best mesh is kept.
  void take_both(const Meshing& best, Meshing& meshing) {
    const bool may_take =
        !losses_ && !search_ && !max_distance_mm_ && finer_may_help(best, false) && finer_may_help(meshing, false);
    if (!may_take) return;
    std::optional<Meshing> both = best_of_both(best, meshing, domain_, *size_asked_);
    if (!both) return;
    if (!improve(domain_, size_asked_, mesher_, optimizer_, true, progress_, *both)) return;
    check(*both);
    meshing.phases.insert(meshing.phases.end(), both->phases.begin(), both->phases.end());
    if (!(faults_in(*both) < std::min(faults_in(best), faults_in(meshing)))) return;
    both->phases = std::move(meshing.phases);
    meshing = std::move(*both);
  }

  /// Where handles were left out, as keeping them takes many points: goes on with these, if nearly all are kept then.
  void keep_handles(const MesherOptions& mesher, MeshResult& mesh) {
    if (!mesh.handles_left_out || mesh.is_noise || mesh.stop != Stop::converged) return;
    MeshResult from = points_of(mesh);
    from.handles_left_out = false;
    std::optional<MeshResult> keeping = mesh_or_cancel(domain_, size_, with_handles(mesher), &from, progress_);
    if (!keeping) return;
    const bool is_kept = keeps_most_handles(*keeping);
    spent_before_.add(is_kept ? mesh : *keeping, false);
    if (!is_kept) return;
    mesher_ = with_handles(mesher_);
    mesh = std::move(*keeping);
  }

  void ask_for(const std::vector<NarrowWay>& ways) {
    mesher_.ways.insert(mesher_.ways.end(), ways.begin(), ways.end());
  }

  /// With facets no farther from the surface than the limit.
  MesherOptions near_mesher() const {
    MesherOptions closer = mesher_;
    auto& facet_distance_mm = closer.bounds.facet_distance_mm;
    if (max_distance_mm_) {
      facet_distance_mm = std::min(facet_distance_mm.value_or(*max_distance_mm_), *max_distance_mm_);
    }
    return closer;
  }

  /// What is lost does not depend on improvement: as long as finer places where it is leave far less of it, no mesh is
  /// improved. Where it stays lost, other attempts begin as before. mesh: of the last places; empty if cancelled.
  void keep_parts(std::optional<MeshResult>& mesh) {
    TroubleSpots spots(std::make_shared<FinerSize>(size_));
    const std::vector<FinerPlace> before = kept_;
    std::size_t least = losses_before_;
    while (mesh && mesh->stop == Stop::converged) {
      const RegionLosses lost = timed([&] { return losses_(mesh->mesh); });
      spots.judge({lost.places, {}});
      kept_next_ = before;
      for (const FinerPlace& place : spots.places_without_faults()) kept_next_.push_back(place);
      const std::size_t count = lost.places.size();
      if (count == 0 || static_cast<double>(count) > kWorthARound * static_cast<double>(least)) return;
      least = count;
      ask_for(lost.ways);
      spots.choose(false);
      kept_ = before;
      for (const FinerPlace& place : spots.places()) kept_.push_back(place);
      size_ = FinerSize(size_asked_, places());
      spent_before_.add(*mesh, false);
      mesh = mesh_or_cancel(domain_, size_, near_mesher(), &*start_, progress_);
    }
  }

  /// closer: gets the ways that are asked for. mesh: empty if cancelled.
  void come_nearer(MesherOptions& closer, std::optional<MeshResult>& mesh) {
    // With more parts too far than this the last round was in vain.
    double enough = std::numeric_limits<double>::infinity();
    for (int round = 0; round <= kDistanceRounds; ++round) {
      if (!mesh || mesh->stop != Stop::converged || mesh->mesh.tets.empty()) return;
      const BoundaryDistance found = timed([&] { return meter_->measure(mesh->mesh); });
      const std::size_t far = far_parts(found);
      near_ = far == 0;
      if (near_ || static_cast<double>(far) > enough || round == kDistanceRounds) return;
      enough = kWorthARound * static_cast<double>(far);
      const std::vector<Point> places = far_points(found);
      const std::vector<Point> points = nearer_points(places, *max_distance_mm_, *mesh, round);
      std::vector<NarrowWay> ways;  // to what points alone have not brought near
      if (round > 0) ways = ways_to(domain_, places, kNearWays * *max_distance_mm_);
      if (points.empty() && ways.empty()) return;
      closer.ways.insert(closer.ways.end(), ways.begin(), ways.end());
      spent_before_.add(*mesh, false);
      mesh->sample.insert(mesh->sample.end(), points.begin(), points.end());
      mesh->sample_dimensions.resize(mesh->sample.size(), 2);
      mesh = mesh_or_cancel(domain_, size_, closer, &*mesh, progress_);
    }
  }

  /// What look() gives; its time is told with that of the other checks.
  template <class Look>
  std::invoke_result_t<Look> timed(const Look& look) {
    std::vector<PhaseAccount> phases;
    PhaseClock phase(phases, progress_);
    phase.begin("audit", "bounds");
    auto found = look();
    phase.end();
    spent_before_.add(phases);
    return found;
  }

  /// Finer elements do not find a part that no point shows: it is given points, closer ones when it is lost again.
  /// Return: whether there are any more.
  bool add_points_on(const std::vector<FarPlace>& parts, bool is_last) {
    if (parts.empty() || is_last || part_share_ < kLeastShare) return false;
    const std::vector<Point> points = points_on_parts(domain_, parts, start_->sample, part_share_);
    part_share_ /= 2;
    const double most = std::max(kFewOnParts, kMostOnParts * static_cast<double>(start_->sample.size()));
    if (static_cast<double>(points.size()) > most) return false;
    start_->sample.insert(start_->sample.end(), points.begin(), points.end());
    start_->sample_dimensions.resize(start_->sample.size(), 2);
    return !points.empty();
  }

  std::vector<FinerPlace> places() const {
    std::vector<FinerPlace> places = spots_.places();
    places.insert(places.end(), necks_.places().begin(), necks_.places().end());
    places.insert(places.end(), kept_.begin(), kept_.end());
    places.insert(places.end(), searched_.begin(), searched_.end());
    return places;
  }

  const Domain& domain_;
  std::shared_ptr<const SizingField> size_asked_;
  MesherOptions mesher_;
  OptimizerOptions optimizer_;
  std::optional<double> max_distance_mm_;
  std::optional<DistanceMeter> meter_;  // if there is such a limit
  const FaultSearch& search_;
  const LossSearch& losses_;
  Progress& progress_;
  bool has_curves_;
  std::optional<MeshResult> start_;  // the points that the next one goes on from
  TroubleSpots spots_;
  NarrowNecks necks_;
  LevelGroundTrial level_ground_;
  std::vector<Point> doubtful_;           // where handles may be wrong, if nothing else is
  std::vector<FinerPlace> kept_;          // where attempts that were not improved were finer
  std::vector<FinerPlace> kept_next_;     // of these, what mended something
  std::size_t losses_before_ = 0;         // as losses_ found them in the last attempt
  std::size_t handles_wrong_before_ = 0;  // in the last attempt, if nothing else was
  std::vector<FinerPlace> searched_;      // where the search found something, in all attempts
  FinerSize size_;
  bool near_ = false;
  double part_share_ = 1;  // of a cell, for the points on parts that are lost next
  SpentTime spent_before_;
};

}  // namespace

std::optional<Meshing> mesh_and_optimize(const Domain& domain, const std::shared_ptr<const SizingField>& size_asked,
                                         const MesherOptions& mesher, const OptimizerOptions& optimizer,
                                         Progress& progress, std::optional<double> max_distance_mm,
                                         const FaultSearch& search, const LossSearch& losses) {
  const Stopwatch all;
  Attempts attempts(domain, size_asked, mesher, optimizer, max_distance_mm, search, losses, progress);
  std::optional<Meshing> best = attempts.next(nullptr, false);
  if (!best) return std::nullopt;
  const std::size_t first_points = best->refined.mesh.vertices.size();
  SpentTime spent;
  spent.add(*best, true);
  Faults least = attempts.judge(*best);
  const Meshing* last = &*best;
  std::optional<Meshing> next;
  int in_vain = 0;
  bool was_better = true;
  bool is_last = false;
  const int finer_rounds = domain.curves().empty() ? kFinerRounds : kFinerRoundsOfCurves;
  const int rounds = search ? kSearchRounds : finer_rounds;
  const int most_in_vain = search ? kSearchesInVain : kRoundsInVain;
  for (int round = 1; optimizer.optimize == Optimize::full && finer_may_help(*last, attempts.was_near()); ++round) {
    if (!attempts.choose(*last, is_last || round == rounds)) break;
    next = attempts.next(&*best, !was_better);
    if (!next && progress.out_of_budget()) break;
    if (!next) return std::nullopt;
    const TroubleSpots::Outlook before = attempts.outlook();
    const Faults left = attempts.judge(*next);
    const TroubleSpots::Outlook now = attempts.outlook();
    const bool better = left < least && next->refined.stop == Stop::converged;
    was_better = better;
    spent.add(*next, better);
    if (is_last || round == rounds || (!losses && has_only_lost(least, left))) {
      if (better) best = std::move(next);
      break;
    }
    in_vain = better || now < before ? 0 : in_vain + 1;
    is_last = in_vain == most_in_vain || is_hopeless(before, now) || is_worse_by_far(least, left);
    if (better) {
      least = left;
      best = std::move(next);
      last = &*best;
    } else {
      last = &*next;
    }
  }
  best->first_points = first_points;
  contract_unless_found(domain, FinerSize(size_asked, best->finer), mesher, optimizer, search, losses, attempts.meter(),
                        progress, *best);
  if (progress.cancelled() && !progress.out_of_budget()) return std::nullopt;
  spent.add(attempts.spent_before());
  spent.put_into(*best, all.seconds());
  return best;
}

}  // namespace scantet
