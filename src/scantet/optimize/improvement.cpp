// For each bad tet: other tets between the same vertices are tried before a vertex is moved, and that before the
// boundary is changed or vertices go or come. The first that reaches the bound is made; if none does, the best.
#include "scantet/optimize/contraction_impl.h"
#include "scantet/optimize/edge_removal_impl.h"
#include "scantet/optimize/edge_split_impl.h"
#include "scantet/optimize/improvement_impl.h"
#include "scantet/optimize/smoothing_impl.h"
#include "scantet/optimize/star_growth_impl.h"
#include "scantet/optimize/worst_first_impl.h"

namespace scantet::optimize {
namespace {

/// What all remedies of one improvement share.
struct Setting {
  const TetComplex& complex;
  const Domain& domain;
  double bound;         // sharpness
  double tolerance_mm;  // of the boundary
  VertexId first_new;   // vertices from here on are new
};

class Improvement : public Remedy {
 public:
  explicit Improvement(const Setting& s)
      : setting_(s),
        guard_(s.complex, s.domain, s.tolerance_mm),
        edge_removal_(s.complex, guard_, s.bound),
        star_growth_(s.complex, s.bound),
        smoothing_(s.complex, guard_, s.bound),
        contraction_(s.complex, guard_, s.bound),
        edge_split_(s.complex, s.first_new, s.bound) {}

  void find(TetId t, Change& best) override {
    const Tet& tet = setting_.complex.tet(t);
    remove_edges(tet, EdgeKind::inner, best);
    if (is_bad(best)) star_growth_.try_tet(t, best);
    if (is_bad(best)) move_vertices(tet, best);
    if (is_bad(best)) remove_edges(tet, EdgeKind::boundary, best);
    if (is_bad(best)) contract_edges(tet, best);
    if (is_bad(best)) split_edges(tet, best);
  }

 private:
  bool is_bad(const Change& best) const { return best.sharpest > setting_.bound; }

  template <class Try>
  void for_each_edge(const Tet& tet, const Change& best, const Try& try_edge) const {
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t j = i + 1; j < 4 && is_bad(best); ++j) try_edge(tet[i], tet[j]);
    }
  }
  void remove_edges(const Tet& tet, EdgeKind kind, Change& best) {
    for_each_edge(tet, best, [&](VertexId a, VertexId b) { edge_removal_.try_edge(a, b, kind, best); });
  }
  void move_vertices(const Tet& tet, Change& best) {
    for (std::size_t i = 0; i < 4 && is_bad(best); ++i) smoothing_.try_vertex(tet[i], best);
  }
  void contract_edges(const Tet& tet, Change& best) {
    for_each_edge(tet, best, [&](VertexId a, VertexId b) {
      contraction_.try_edge(a, b, best);
      if (is_bad(best)) contraction_.try_edge(b, a, best);
    });
  }
  void split_edges(const Tet& tet, Change& best) {
    for_each_edge(tet, best, [&](VertexId a, VertexId b) { edge_split_.try_edge(a, b, best); });
  }

  const Setting& setting_;
  SurfaceGuard guard_;
  EdgeRemoval edge_removal_;
  StarGrowth star_growth_;
  Smoothing smoothing_;
  Contraction contraction_;
  EdgeSplit edge_split_;
};

}  // namespace

std::uint64_t improve(TetComplex& complex, const Domain& domain, double min_dihedral_deg, Progress& progress) {
  constexpr double kRounding = 1e-9;  // so that the angle is reached, whichever way it is computed
  const Setting setting{complex, domain, sharpness_of_angle(min_dihedral_deg) - kRounding,
                        typical_distance_mm(complex, domain), static_cast<VertexId>(complex.vertex_slots())};
  const MakeRemedy make_remedy = [&] { return std::make_unique<Improvement>(setting); };
  return change_worst_first(complex, setting.bound, make_remedy, "improve", progress);
}

}  // namespace scantet::optimize
