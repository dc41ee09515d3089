// Private: the refinement loop.
#pragma once

#include <array>
#include <functional>
#include <vector>

#include "scantet/refine/mesh_result.h"
#include "scantet/refine/rules_impl.h"
#include "scantet/surface/extra_point_impl.h"

namespace scantet::engine {

/// Violations, worst first within each rule. Those whose element is gone are dropped when they are met.
class ViolationQueue {
 public:
  explicit ViolationQueue(const RestrictedTriangulation& t) : t_(t) {}
  void push(const Violation& violation);
  /// Takes the worst violation of the first rule up to `last` that has any.
  std::optional<Violation> take(Rule last);
  std::size_t size() const { return heaps_[0].size() + heaps_[1].size() + heaps_[2].size(); }
  /// Moves what is left to the end of the list, in an order of its own.
  void drain(std::vector<Violation>& list);

 private:
  const RestrictedTriangulation& t_;
  std::array<std::vector<Violation>, 3> heaps_;  // one per Rule
};

enum class Insertion : std::uint8_t { r1, r2, r3_1, r3_2 };

/// What each rule did, by Insertion.
struct RuleWork {
  std::array<std::uint64_t, 4> points{};
  std::uint64_t close_points = 0;   ///< of those of R1, for violations that are close
  std::array<double, 4> seconds{};  ///< of the threads that did it
};

/// Of each ball at the head of a chain: whether its facet breaks R1 or R2. By the ball's index.
using BrokenFacets = std::vector<std::uint8_t>;

/// Applies the rules, one point after the other, in the whole triangulation or in one part of it.
class Refiner {
 public:
  /// most: how many points may be inserted. broken: of the facets there are; kept up to date for new ones. In a part it
  /// must have a place for every ball's slot before run().
  Refiner(RestrictedTriangulation& t, const Rules& rules, Editor editor, BrokenFacets& broken, std::uint64_t most)
      : t_(t), rules_(rules), editor_(std::move(editor)), broken_(broken), queue_(t), most_(most) {}

  /// Takes a violation; if the part does not own its element, it waits.
  void push(const Violation& violation) {
    if (editor_.owns(violation.cell(t_))) {
      queue_.push(violation);
    } else {
      waiting_.push_back(violation);
    }
  }

  /// Inserts points until no rule up to `last` is broken in the part, the points or slots are used up, or `stop` says
  /// so, which is asked from time to time.
  void run(Rule last, const std::function<bool()>& stop);

  /// Inserts a point that no rule asks for. Returns `zone` if it did, `vertex` if one is too near to the point,
  /// `beyond` if its zone reaches beyond the part or there is no room.
  Inserter::Found add(const ExtraPoint& p);

  /// Gives back the slots. The violations that are left go to `left`, those that no point can mend to `given_up`.
  void retire(std::vector<Violation>& left, std::vector<Violation>& given_up);

  const RuleWork& work() const { return work_; }
  /// The rule that inserted most of the last thousand points.
  Insertion busiest_rule() const;
  /// The vertex inserted last; kNone if none was.
  PointId last_vertex() const { return last_vertex_; }

 private:
  struct Choice {
    Inserter::Found found;
    SamplePoint point;
    Insertion by;
  };
  Choice choose(const Violation& violation);
  Choice choose_ball(std::uint32_t id, Insertion by);
  Choice choose_for_tet(CellId tet);
  void collect();
  void collect_facets();

  RestrictedTriangulation& t_;
  const Rules& rules_;
  Editor editor_;
  BrokenFacets& broken_;
  ViolationQueue queue_;
  std::uint64_t most_;
  std::uint64_t inserted_ = 0;
  RuleWork work_;
  std::array<Insertion, 1000> recent_{};  // the last insertions, in a ring
  PointId last_vertex_ = kNone;
  std::vector<Violation> waiting_;  // violations whose zones reach beyond the part
  std::vector<Violation> given_up_;
};

/// Applies R1, R2 and R3 until none is broken, the vertex limit is reached or the run is cancelled.
class Refinement {
 public:
  /// triangulation: built from the initial sample.
  Refinement(RestrictedTriangulation& triangulation, const SizingField& size, const MesherOptions& options,
             Progress& progress);

  /// Applies the rules up to `last` only.
  Stop run(Rule last);

  /// Inserts points that no rule asks for, in this order, to be followed by run(). Returns how many were inserted:
  /// those that no vertex is too near to.
  std::uint64_t add(const std::vector<ExtraPoint>& points);

  const RuleWork& work() const { return work_; }
  UnmetRules unmet() const;
  LimitReport limit_report() const;

 private:
  void collect_all();
  void leave_close_to_untangling();
  void put_off(const std::vector<Violation>& violations);
  std::size_t forget_dead(Rule last);
  std::vector<Violation> take_pending(Rule last);
  void run_whole(Rule last);
  using Room = std::function<std::uint64_t(std::size_t)>;
  using Work = std::function<void(Refiner&, const std::vector<std::uint32_t>&)>;
  bool work_by_parts(const std::vector<PointId>& at, int depth, const Room& room, const Work& work);
  bool run_by_parts(Rule last, int depth);
  void add_by_parts(const std::vector<ExtraPoint>& points, std::vector<Inserter::Found>& found);
  bool take_back(Refiner& refiner);
  void report() const;

  RestrictedTriangulation& triangulation_;
  Rules rules_;
  MesherOptions options_;
  Progress& progress_;
  BrokenFacets broken_;
  std::array<std::vector<Violation>, 3> pending_;  // one list per Rule
  std::vector<Violation> given_up_;
  std::uint64_t sampled_;          // vertices of the initial sample
  std::size_t fewer_in_part_ = 1;  // so many times, where the boundary is rough
  RuleWork work_;
  Insertion busiest_ = Insertion::r1;
  PointId last_vertex_ = kNone;
};

}  // namespace scantet::engine
