// Private: the refinement loop.
#pragma once

#include <array>
#include <vector>

#include "scantet/refine/rules_impl.h"

namespace scantet::refine {

/// The violations not yet dealt with, worst first within each rule. Entries whose element is gone are dropped when met.
class ViolationQueue {
 public:
  explicit ViolationQueue(const RestrictedTriangulation& triangulation) : triangulation_(triangulation) {}
  void push(const Violation& violation);
  /// The worst violation of the first rule that has any; it stays in the queue.
  std::optional<Violation> first(Rule last);
  /// Takes the worst violation of the rule out; it still counts as long as its element exists.
  void give_up(Rule rule);
  /// Live violations of each rule.
  UnmetRules count() const;
  std::uint64_t size() const { return heaps_[0].size() + heaps_[1].size() + heaps_[2].size(); }

 private:
  bool alive(const Violation& violation) const;
  void compact(std::vector<Violation>& heap);

  const RestrictedTriangulation& triangulation_;
  std::array<std::vector<Violation>, 3> heaps_;  // one per Rule
  std::vector<Violation> given_up_;
  std::array<std::size_t, 3> compact_at_{1 << 20, 1 << 20, 1 << 20};
};

/// Applies R1, R2 and R3 until none is broken, the vertex limit is reached or the run is cancelled.
class Refinement {
 public:
  /// triangulation: built from the initial sample.
  Refinement(RestrictedTriangulation& triangulation, const SizingField& size, const MesherOptions& options,
             Progress& progress);

  /// Rules up to `last` only.
  Stop run(Rule last);

  /// Inserts points beside the rules, to be followed by run(). Passes over those nearer than closest_mm to a vertex;
  /// returns how many it inserted.
  std::uint64_t add(const std::vector<SamplePoint>& points, double closest_mm);

  const RuleCounts& inserted() const { return inserted_; }
  UnmetRules unmet() const { return queue_.count(); }
  LimitReport limit_report() const;

 private:
  enum class Insertion : std::uint8_t { r1, r2, r3_1, r3_2 };
  struct Candidate {
    SamplePoint point;
    Insertion by;
  };

  Candidate choose(const Violation& violation);
  void insert(const Candidate& candidate);
  std::uint32_t encroached_ball(const Point& p) const;
  double distance_to_zone(const Point& p) const;
  void collect();
  void report(Insertion by) const;

  RestrictedTriangulation& triangulation_;
  Rules rules_;
  MesherOptions options_;
  Progress& progress_;
  ViolationQueue queue_;
  ConflictZone zone_;
  RuleCounts inserted_;
  std::array<Insertion, 1000> recent_{};  // ring of the last insertions
  std::uint64_t inserted_total_ = 0;
  Point last_point_;
  double last_radius_mm_ = 0;
};

}  // namespace scantet::refine
