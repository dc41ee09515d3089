// Private: the star of one vertex while its weight grows.
#pragma once

#include <limits>
#include <span>
#include <vector>

#include "scantet/optimize/change_impl.h"

namespace scantet::optimize {

/// Finds changes that give one vertex a larger weight ("pump" it): no vertex moves, the boundary stays. Keeps its
/// buffers.
class StarPump {
 public:
  /// weights_mm2: one per vertex. Without any no vertex weighs anything, and the changes found say nothing of weights:
  /// these then only decide in which order a star swallows the tets around it, and the order of the Delaunay
  /// triangulation is a good one, whatever the weights were that led to the tets as they are. Both must outlive this.
  explicit StarPump(const TetComplex& complex, std::span<const double> weights_mm2 = {})
      : complex_(complex), weights_(weights_mm2), bound_(complex.judge().bound()) {}

  /// Lets the weight of v grow from what it is, as far as no vertex can be hidden: up to the squared distance of a
  /// neighbour plus its weight. Puts into `best` the first weight for which the face of t opposite to v is gone and no
  /// tet added is sharper than the bound; without such, the one with the least sharp tets. `best` stays if its
  /// `sharpest` is as good already. Pre: v is a vertex of t.
  void try_vertex(VertexId v, TetId t, Change& best);

  /// Tries what can take t away: its vertices and those beyond its faces, until no tet added is sharper than the bound.
  void try_tet(TetId t, Change& best);

 private:
  static constexpr int kNever = std::numeric_limits<int>::max();

  /// An outer face of the star of v, now or at an earlier step. The star grows in steps, each of which swallows a tet.
  struct LinkFace {
    Tet tet;          // the tet that the face makes with v
    TetId inner;      // the tet of the complex that was behind it
    TetId outer;      // the tet beyond it; kNoTet if the face lies on the boundary
    int born;         // the step that made the face; 0 if it belongs to the star as the complex has it
    int died;         // the step that swallowed it; kNever if none has
    double critical;  // the weight of v from which on the star swallows `outer`
    double sharpness;
  };

  double weight(VertexId v) const { return weights_.empty() ? 0 : weights_[v]; }
  void start(TetId t);
  void look_beyond(LinkFace& face) const;
  double critical_weight(TetId t) const;
  const LinkFace* next_face() const;
  bool swallow(TetId t, int step, double too_sharp);
  double sharpest_added() const;
  void record(int step, Change& change) const;

  const TetComplex& complex_;
  std::span<const double> weights_;
  double bound_;
  VertexId vertex_ = 0;
  double limit_ = 0;            // the weight of v stays under this, mm²
  std::vector<LinkFace> link_;  // first the face that has to go
  std::vector<TetId> swallowed_;
};

}  // namespace scantet::optimize
