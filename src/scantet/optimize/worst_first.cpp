// Every change leaves only tets that are less sharp than the one that it was made for, by some least step where
// vertices move. So the sorted list of what is sharper than the bound always gets smaller, and the work ends; but where
// a place is beyond help, with thousands of tets around a vertex, that can take very many steps, so it also ends when
// many sweeps have not made the list shorter. What has been touched is known by counting changes: each tet keeps the
// number of the last one that made it, or that moved one of its vertices or gave it a weight.
#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <utility>

#include "scantet/base/parallel.h"
#include "scantet/optimize/worst_first_impl.h"

namespace scantet::optimize {
namespace {

struct BadTet {
  double sharpness;
  TetId tet;
  Tet vertices;         // to know it again: slots are reused
  std::uint32_t tried;  // changes made before it was last tried in vain
};

/// A sharpness less by the least step, which is a share of sin²θ, so that it is felt at all angles.
double less_by_a_step(double sharpness) {
  constexpr double kShare = 0.01;
  constexpr double kLeast = 1e-6;  // also for flat and inverted ones
  const double of_angle = std::min(sharpness, 1.0);
  return of_angle - std::max(kShare * (1 - of_angle), kLeast);
}

class WorstFirst {
 public:
  WorstFirst(TetComplex& complex, const ElementCheck& check, const Treatment& treatment)
      : complex_(complex),
        check_(check),
        bound_(check.bound()),
        treatment_(treatment),
        changed_(complex.tet_slots(), 0) {}

  WorstFirstResult run(const std::vector<TetId>& first, Progress& progress) {
    for (begin(first); !bad_.empty() && is_worth_a_sweep(); next_sweep()) {
      const std::size_t round = std::max(kLeastRound, complex_.tet_slots() / kTetsPerChange);
      for (std::size_t begin = 0; begin < bad_.size(); begin += round) {
        if (progress.cancelled()) return result();
        const std::size_t end = std::min(begin + round, bad_.size());
        propose(begin, end);
        settle(begin, end);
        progress.report({"optimize", treatment_.doing, changes_, std::nullopt, bad_.size() - end + next_.size()});
      }
    }
    return result();
  }

 private:
  static constexpr std::size_t kLeastRound = 32;
  static constexpr std::size_t kTetsPerChange = 512;  // in the mesh, for each change of a round: most will be made
  static constexpr int kSweepsInVain = 100;           // brains take 20 at most
  static constexpr std::size_t kChangesInVain = 20;   // for each tet of a sweep, and
  static constexpr std::size_t kFewTets = 100;        // for no fewer than these

  bool exists(const BadTet& bad) const { return complex_.is_tet(bad.tet) && complex_.tet(bad.tet) == bad.vertices; }
  /// How sharp it is by now; the bound if it is gone.
  double sharpness_now(const BadTet& bad) const { return exists(bad) ? check_.of(bad.tet) : bound_; }
  bool is_bad(const BadTet& bad) const { return sharpness_now(bad) > bound_; }

  void begin(const std::vector<TetId>& first);
  WorstFirstResult result() const;
  bool is_worth_a_sweep();
  void next_sweep();
  void look_again();
  void take_up_again();
  void sort();
  bool has_changed(const BadTet& bad) const;
  double must_beat(double sharpness) const;
  void propose(std::size_t begin, std::size_t end);
  void settle(std::size_t begin, std::size_t end);
  void make(Change& change);
  void touch(TetId t, bool look);

  TetComplex& complex_;
  const ElementCheck& check_;
  double bound_;
  const Treatment& treatment_;
  std::vector<std::uint32_t> changed_;  // by tet: the last change, from 1, that made it or touched a vertex of it
  std::vector<BadTet> bad_;             // what this sweep goes through, the worst first
  std::vector<BadTet> next_;            // what is left to the next sweep
  std::vector<BadTet> in_vain_;         // what no change was found for
  std::size_t least_ = std::numeric_limits<std::size_t>::max() / 16;  // tets of a sweep, when that last fell by a tenth
  int sweeps_in_vain_ = 0;                                            // since then
  std::uint32_t changes_then_ = 0;
  std::size_t most_in_vain_ = std::numeric_limits<std::size_t>::max();
  std::vector<Change> proposals_;  // one for each tet of this round
  std::uint32_t changes_ = 0;
};

void WorstFirst::begin(const std::vector<TetId>& first) {
  bad_.reserve(first.size());
  for (const TetId t : first) bad_.push_back({check_.of(t), t, complex_.tet(t), 0});
  sort();
}

/// Whether one of the last sweeps has left a tenth less to do, or what was done since is little. If not, what is left
/// counts as tried in vain.
bool WorstFirst::is_worth_a_sweep() {
  if (10 * bad_.size() <= 9 * least_) {
    least_ = bad_.size();
    sweeps_in_vain_ = 0;
    changes_then_ = changes_;
  }
  const bool is_little = changes_ - changes_then_ <= kChangesInVain * std::max(bad_.size(), kFewTets);
  if (sweeps_in_vain_++ < kSweepsInVain && is_little) return true;
  in_vain_.insert(in_vain_.end(), bad_.begin(), bad_.end());
  return false;
}

WorstFirstResult WorstFirst::result() const {
  WorstFirstResult result;
  result.changes = changes_;
  for (const BadTet& bad : in_vain_) {
    if (is_bad(bad)) result.left.push_back(bad.tet);
  }
  return result;
}

/// Puts the worst first, and each tet in the list only once.
void WorstFirst::sort() {
  std::sort(bad_.begin(), bad_.end(), [](const BadTet& a, const BadTet& b) {
    return a.sharpness != b.sharpness ? a.sharpness > b.sharpness : a.tet < b.tet;
  });
  const auto same = [](const BadTet& a, const BadTet& b) { return a.tet == b.tet && a.vertices == b.vertices; };
  bad_.erase(std::unique(bad_.begin(), bad_.end(), same), bad_.end());
}

/// The next sweep goes through what this one left; if it left nothing, through what was tried in vain.
void WorstFirst::next_sweep() {
  bad_.clear();
  std::swap(bad_, next_);
  if (treatment_.moves_vertices) look_again();
  if (bad_.empty()) take_up_again();
  sort();
}

/// Tets have got other angles since they were listed. Where no vertex moves they have not; those that are gone are then
/// passed over when it is their turn.
void WorstFirst::look_again() {
  for (BadTet& bad : bad_) bad.sharpness = sharpness_now(bad);
  std::erase_if(bad_, [&](const BadTet& bad) { return bad.sharpness <= bound_; });
}

/// Lists what was tried in vain but has other tets around it now. Where vertices move this is done as long as there is
/// a tenth less of it each time, for where a place is beyond help its worst tets change for very long.
void WorstFirst::take_up_again() {
  if (in_vain_.size() > most_in_vain_) return;
  if (treatment_.moves_vertices) most_in_vain_ = in_vain_.size() * 9 / 10;
  for (BadTet& bad : in_vain_) {
    bad.sharpness = sharpness_now(bad);
    if (bad.sharpness > bound_) (has_changed(bad) ? bad_ : next_).push_back(bad);
  }
  in_vain_.clear();
  std::swap(in_vain_, next_);
}

bool WorstFirst::has_changed(const BadTet& bad) const {
  for (const VertexId v : bad.vertices) {
    for (const TetId t : complex_.star(v)) {
      if (changed_[t] > bad.tried) return true;
    }
  }
  return false;
}

/// What tets must be less sharp than to take the place of one that is this sharp.
double WorstFirst::must_beat(double sharpness) const {
  return treatment_.moves_vertices ? std::max(less_by_a_step(sharpness), std::nextafter(bound_, kInverted)) : sharpness;
}

void WorstFirst::propose(std::size_t begin, std::size_t end) {
  constexpr std::size_t kGrain = 16;
  proposals_.resize(std::max(proposals_.size(), end - begin));
  parallel_for(end - begin, kGrain, [&](std::size_t first, std::size_t last) {
    const std::unique_ptr<Remedy> remedy = treatment_.make_remedy();
    for (std::size_t i = first; i < last; ++i) {
      const BadTet& bad = bad_[begin + i];
      const double sharpness = sharpness_now(bad);
      proposals_[i].reset(must_beat(sharpness));
      if (sharpness > bound_) remedy->find(bad.tet, proposals_[i]);
    }
  });
}

void WorstFirst::settle(std::size_t begin, std::size_t end) {
  const std::uint32_t before = changes_;
  const auto fresh = [&](TetId t) { return changed_[t] > before; };
  for (std::size_t i = begin; i < end; ++i) {
    BadTet& bad = bad_[i];
    Change& change = proposals_[i - begin];
    if (!is_bad(bad)) continue;
    if (!change.found()) {
      bad.tried = before;
      in_vain_.push_back(bad);
    } else if (std::any_of(change.read.begin(), change.read.end(), fresh)) {
      next_.push_back(bad);
    } else {
      make(change);
      if (is_bad(bad)) next_.push_back(bad);  // one of its faces is, which the change was not for
    }
  }
}

void WorstFirst::make(Change& change) {
  ++changes_;
  for (const TetId t : change.removed) changed_[t] = changes_;
  const auto has_bad_faces = [&](TetId t) { return check_.of_faces(t) > bound_; };
  const bool look =
      change.sharpest > bound_ || std::any_of(change.removed.begin(), change.removed.end(), has_bad_faces);
  const std::span<const TetId> added = make_change(complex_, change);
  changed_.resize(complex_.tet_slots(), 0);
  for (const TetId t : added) touch(t, look);
  if (change.vertex != kNoVertex) {
    for (const TetId t : complex_.star(change.vertex)) touch(t, look);
  }
  if (change.weighted != kNoVertex) {
    for (const TetId t : complex_.star(change.weighted)) touch(t, false);  // they keep their shape
  }
  if (treatment_.made) treatment_.made(change);
}

void WorstFirst::touch(TetId t, bool look) {
  changed_[t] = changes_;
  if (!look) return;
  const double sharpness = check_.of(t);
  if (sharpness > bound_) next_.push_back({sharpness, t, complex_.tet(t), 0});
}

}  // namespace

std::span<const TetId> make_change(TetComplex& complex, Change& change) {
  assert(change.found());
  if (change.vertex == kNewVertex) {
    change.vertex = complex.add_vertex(change.position, change.on_boundary);
    for (NewTet& added : change.added)
      std::replace(added.vertex.begin(), added.vertex.end(), kNewVertex, change.vertex);
  } else if (change.vertex != kNoVertex) {
    complex.move(change.vertex, change.position, change.on_boundary);
  }
  assert(change.added.empty() || complex.is_same_place(change.removed, change.added));
  return complex.replace(change.removed, change.added);
}

WorstFirstResult change_worst_first(TetComplex& complex, const ElementCheck& check, const std::vector<TetId>& first,
                                    const Treatment& treatment, Progress& progress) {
  return WorstFirst(complex, check, treatment).run(first, progress);
}

}  // namespace scantet::optimize
