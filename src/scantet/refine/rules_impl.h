// Private: the paper's rules as predicates on one element.
#pragma once

#include <optional>

#include "scantet/domain/sizing_field.h"
#include "scantet/refine/mesher_options.h"
#include "scantet/surface/restricted_triangulation_impl.h"

namespace scantet::engine {

enum class Rule : std::uint8_t { r1, r2, r3 };

/// An element that breaks a rule. The worst has the highest rank; rank and tie depend on geometry only.
struct Violation {
  Rule rule;
  double rank;
  std::uint64_t tie;
  std::uint32_t element;     ///< R1, R2: the ball whose centre the rule inserts; R3: the tet
  std::uint32_t generation;  ///< of that element, to tell whether it still exists
  bool is_close = false;     ///< R1 is broken by nothing but components that are close beside the size, or touch

  bool alive(const RestrictedTriangulation& t) const {
    return rule == Rule::r3 ? t.cell_alive(element, generation) : t.balls().alive(element, generation);
  }
  /// The tet; of a facet, a tet that has it.
  CellId cell(const RestrictedTriangulation& t) const {
    return rule == Rule::r3 ? element : t.balls()[element].facet / 4;
  }
};

/// The criteria of rules R1, R2 and R3 (paper, section 3).
class Rules {
 public:
  Rules(const SizingField& size, const MesherOptions& options) : size_(size), options_(options) {}

  /// The first rule that a restricted facet breaks, given the first ball of its chain.
  std::optional<Violation> facet(const RestrictedTriangulation& t, std::uint32_t ball) const;

  /// From now on components that are so close to each other break no rule.
  void leave_close() { leaves_close_ = true; }
  bool leaves_close() const { return leaves_close_; }

  /// Whether a cell that is in the mesh breaks R3.
  std::optional<Violation> tet(const RestrictedTriangulation& t, CellId c) const;

 private:
  double slack_of(const Triangulation& t, const std::array<PointId, 3>& facet) const;

  enum class Fault : std::uint8_t { none, plain, close };
  Fault r1_fault(const RestrictedTriangulation& t, const std::array<PointId, 3>& facet, std::uint32_t ball,
                 const SurfaceBall& largest) const;

  const SizingField& size_;
  MesherOptions options_;
  bool leaves_close_ = false;
};

}  // namespace scantet::engine
