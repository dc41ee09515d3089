// For each bad tet: other tets between the same vertices are tried before a vertex is moved, and that before the
// boundary is changed or vertices go or come. The first that reaches the bound is made; if none does, the best.
#include "scantet/base/mesh_topology.h"
#include "scantet/optimize/boundary_split_impl.h"
#include "scantet/optimize/contraction_impl.h"
#include "scantet/optimize/edge_removal_impl.h"
#include "scantet/optimize/edge_split_impl.h"
#include "scantet/optimize/improvement_impl.h"
#include "scantet/optimize/shaking_impl.h"
#include "scantet/optimize/smoothing_impl.h"
#include "scantet/optimize/star_pump_impl.h"
#include "scantet/optimize/worst_first_impl.h"

namespace scantet::optimize {
namespace {

/// The first pass takes on all that is bad. In the later ones splits may split again what earlier ones have split, and
/// searches for places go deep.
constexpr int kPasses = 3;
// With more left passes do not go deep: smaller elements help there. Among curves they help less.
constexpr std::size_t kMany = 100;
constexpr std::size_t kManyAmongCurves = 1000;
constexpr std::size_t kFew = 100;     // tets that the last pass leaves are shaken if they are no more,
constexpr std::size_t kVeryFew = 10;  // and no more than these where that is not asked for

/// What all remedies of one improvement share.
struct Setting {
  const TetComplex& complex;
  const ElementCheck& check;
  const Domain& domain;
  const CurveGuide& curves;
  const FacetJudge* facets;  // null if nothing is asked of facets
  double bound;              // the largest sharpness that is good enough
  double tolerance_mm;       // how far facets may be from the surface wherever they are
  VertexId first_new;        // vertices from this one on are new in this pass
  Depth depth;               // how deep searches for places go
};

class Improvement : public Remedy {
 public:
  explicit Improvement(const Setting& s)
      : setting_(s),
        guard_(s.complex, s.domain, s.tolerance_mm, s.facets),
        edge_removal_(s.complex, guard_),
        star_pump_(s.complex),
        smoothing_(s.complex, guard_, s.depth, &s.curves),
        contraction_(s.complex, guard_),
        edge_split_(s.complex, s.first_new, s.depth),
        boundary_split_(s.complex, guard_, s.first_new, s.depth) {}

  void find(TetId t, Change& best) override {
    const Tet& tet = setting_.complex.tet(t);
    if (setting_.complex.sharpness(tet) > setting_.bound) {
      find_for_tet(t, tet, best);
    } else {
      find_for_faces(t, tet, best);
    }
  }

 private:
  void find_for_tet(TetId t, const Tet& tet, Change& best) {
    remove_edges(tet, EdgeKind::inner, best);
    if (is_bad(best)) star_pump_.try_tet(t, best);
    if (is_bad(best)) move_vertices(tet, best);
    if (is_bad(best)) remove_edges(tet, EdgeKind::boundary, best);
    if (is_bad(best)) contract_edges(tet, best);
    if (is_bad(best)) split_edges(tet, best);
  }

  /// For a tet that is good but has bad boundary faces: tries only what changes one of these.
  void find_for_faces(TetId t, const Tet& tet, Change& best) {
    for (int k = 0; k < 4 && is_bad(best); ++k) {
      if (setting_.check.of_face(t, k) <= setting_.bound) continue;
      const Triangle face = face_of(tet, k);
      for (std::size_t i = 0; i < 3 && is_bad(best); ++i) {
        edge_removal_.try_edge(face[i], face[(i + 1) % 3], EdgeKind::boundary, best);
      }
      for (std::size_t i = 0; i < 3 && is_bad(best); ++i) smoothing_.try_vertex(face[i], best);
      for (std::size_t i = 0; i < 3 && is_bad(best); ++i) {
        contraction_.try_edge(face[i], face[(i + 1) % 3], best);
        if (is_bad(best)) contraction_.try_edge(face[(i + 1) % 3], face[i], best);
      }
      for (std::size_t i = 0; i < 3 && is_bad(best); ++i) {
        boundary_split_.try_edge(face[i], face[(i + 1) % 3], best);
      }
    }
  }

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
  StarPump star_pump_;
  Smoothing smoothing_;
  Contraction contraction_;
  EdgeSplit edge_split_;
  BoundarySplit boundary_split_;
};

/// Finds only changes that are allowed.
class AllowedRemedy : public Remedy {
 public:
  AllowedRemedy(const Setting& setting, const std::function<bool(const Change&)>& allows)
      : remedy_(setting), allows_(allows) {}

  void find(TetId t, Change& best) override {
    const double before = best.sharpest;
    remedy_.find(t, best);
    if (best.found() && !allows_(best)) best.reset(before);
  }

 private:
  Improvement remedy_;
  const std::function<bool(const Change&)>& allows_;
};

/// Passes on whether to stop, but not where parts that are worked on side by side stand.
class QuietProgress : public Progress {
 public:
  explicit QuietProgress(const Progress& progress) : progress_(progress) {}
  bool cancelled() const override { return progress_.cancelled(); }
  bool out_of_budget() const override { return progress_.out_of_budget(); }

 private:
  const Progress& progress_;
};

/// How what has been shaken is mended: as in the first pass.
Mending mending_as(const Setting& setting, const Progress& progress) {
  return {setting.domain, setting.facets, setting.tolerance_mm,
          [&setting, &progress](TetComplex& part, const std::vector<TetId>& bad,
                                const std::function<bool(const Change&)>& allows) {
            const ElementCheck check(part, setting.facets);
            Setting of_part{
                part,           check,         setting.domain,       setting.curves,
                setting.facets, setting.bound, setting.tolerance_mm, static_cast<VertexId>(part.vertex_slots()),
                Depth::usual};
            const Treatment treatment{"shake", [&] { return std::make_unique<AllowedRemedy>(of_part, allows); }};
            QuietProgress quiet(progress);
            change_worst_first(part, check, bad, treatment, quiet);
          }};
}

}  // namespace

std::uint64_t improve(TetComplex& complex, const Domain& domain, const FacetJudge* facets, std::vector<TetId> bad,
                      Persistence persistence, Progress& progress) {
  const ElementCheck check(complex, facets);
  const CurveGuide curves(domain);
  Setting setting{complex, check,       domain, curves, facets, check.bound(), typical_distance_mm(complex, domain),
                  0,       Depth::usual};
  const Treatment improvement{"improve", [&] { return std::make_unique<Improvement>(setting); }};
  std::uint64_t changes = 0;
  for (int pass = 0; pass < kPasses; ++pass) {
    setting.first_new = static_cast<VertexId>(complex.vertex_slots());
    const WorstFirstResult result = change_worst_first(complex, check, bad, improvement, progress);
    changes += result.changes;
    const bool hopeless = result.left.size() > (complex.has_curves() ? kManyAmongCurves : kMany);
    setting.depth = Depth::deep;  // few are left
    bad = result.left;
    if (persistence == Persistence::once || bad.empty() || (pass > 0 && result.changes == 0) || hopeless ||
        progress.cancelled())
      break;
  }
  const bool may_shake = persistence == Persistence::shaking || complex.has_curves();
  const std::size_t most = persistence == Persistence::once ? 0 : may_shake ? kFew : kVeryFew;
  if (bad.size() <= most) changes += shake(complex, mending_as(setting, progress), bad, progress);
  return changes;
}

}  // namespace scantet::optimize
