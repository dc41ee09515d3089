// Private: the rules and the topology, until both hold.
#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <vector>

#include "scantet/refine/mesh_result.h"
#include "scantet/refine/mesher_options.h"
#include "scantet/refine/refinement_impl.h"
#include "scantet/surface/curve_repair_impl.h"
#include "scantet/surface/handle_repair_impl.h"
#include "scantet/surface/topology_repair_impl.h"

namespace scantet::engine {

/// Refines a triangulation by the rules, adds the points that its topology lacks, and keeps account of both.
class RulesAndTopology {
 public:
  RulesAndTopology(const Domain& domain, RestrictedTriangulation& triangulation, const SizingField& size,
                   const MesherOptions& options, Progress& progress);

  /// Works until the rules hold and the repair has nothing to add.
  void refine();

  /// Lets tets change sides where sampling did not help. Where that does not help either, the sample gets denser and
  /// everything is tried again.
  void untangle();

  /// The last look at the boundary, once it is as it will be: for handles that it may have for others.
  void look_for_wrong_handles();

  /// Does without the search for handles.
  void leave_handles_out() { handles_.leave_out(); }
  /// Asks for no points for the topology's sake; tets change sides all the same.
  void leave_topology_out() {
    handles_.leave_out();
    is_left_out_ = true;
  }

  Stop stop() const { return stop_; }
  const Refinement& refinement() const { return refinement_; }

  /// Adds the stages, and the points that each rule inserted, to the result.
  void account(MeshResult& result) const;

 private:
  /// How many points were added last for the same reason, and whether that was no fewer than the time before.
  struct Trend {
    std::size_t last = std::numeric_limits<std::size_t>::max();
    bool has_grown = false;
  };
  void run(Rule last);
  void mend(Rule last);
  bool is_beyond_mending() const;
  bool try_to_untangle(Untangler& untangler, bool may_add_points);
  bool untangle_or_add(Untangler& untangler, bool may_add_points);
  bool turn_over(Untangler& untangler);
  bool add_found(const std::function<std::vector<ExtraPoint>()>& find);
  std::vector<ExtraPoint> timed(const std::function<std::vector<ExtraPoint>()>& find);
  bool add(const std::vector<ExtraPoint>& points);
  bool add_unless_growing(const std::vector<ExtraPoint>& points, Trend& trend);

  const Domain& domain_;
  RestrictedTriangulation& triangulation_;
  const SizingField& size_;
  double alpha_;
  int handle_rounds_untangled_;
  bool seeks_exchanged_handles_;
  Progress& progress_;
  Refinement refinement_;
  KnownBoundary boundary_;
  TopologyRepair repair_;
  HandleRepair handles_;
  CurveRepair curves_;
  Stop stop_ = Stop::converged;
  bool is_left_out_ = false;
  double rules_s_ = 0;
  double topology_s_ = 0;
  double untangle_s_ = 0;
  std::uint64_t repair_points_ = 0;
  std::uint64_t absorbed_tets_ = 0;
  Trend missing_;  // of points for handles, while untangling
  Trend asked_;    // of those on ways that are asked for
  std::vector<Point> tangled_;
  std::vector<Point> exchanged_handles_;
  std::vector<Point> turned_;
  std::vector<Point> wrong_handles_;
  std::uint64_t wrong_handle_count_ = 0;
};

}  // namespace scantet::engine
