#include <gtest/gtest.h>

#include "scantet/base/parallel.h"
#include "scantet/check/audit.h"
#include "scantet/optimize/edge_removal_impl.h"
#include "scantet/optimize/shaking_impl.h"
#include "scantet/optimize/smoothing_impl.h"
#include "unit/optimize/test_meshes.h"

namespace scantet::optimize {
namespace {

constexpr double kToleranceMm = 0.2;
constexpr double kAskedDeg = 36;

/// Takes inner edges away and moves vertices: enough to mend something, too little to mend all.
class SomeRemedy final : public Remedy {
 public:
  SomeRemedy(const TetComplex& complex, const Domain& domain, const std::function<bool(const Change&)>& allows)
      : complex_(complex),
        guard_(complex, domain, kToleranceMm),
        removal_(complex, guard_),
        smoothing_(complex, guard_),
        allows_(allows) {}

  void find(TetId t, Change& best) override {
    const double before = best.sharpest;
    const Tet& tet = complex_.tet(t);
    for (std::size_t i = 0; i < 4; ++i) {
      for (std::size_t j = 0; j < i; ++j) removal_.try_edge(tet[i], tet[j], EdgeKind::inner, best);
      smoothing_.try_vertex(tet[i], best);
    }
    if (best.found() && !allows_(best)) best.reset(before);
  }

 private:
  const TetComplex& complex_;
  SurfaceGuard guard_;
  EdgeRemoval removal_;
  Smoothing smoothing_;
  const std::function<bool(const Change&)>& allows_;
};

std::vector<TetId> mend(TetComplex& complex, const Domain& domain, const std::vector<TetId>& bad,
                        const std::function<bool(const Change&)>& allows) {
  const ElementCheck check(complex, nullptr);
  Progress progress;
  const Treatment treatment{"test", [&] { return std::make_unique<SomeRemedy>(complex, domain, allows); }};
  return change_worst_first(complex, check, bad, treatment, progress).left;
}

Mending mending_for(const Domain& domain) {
  return {domain, nullptr, kToleranceMm,
          [&](TetComplex& part, const std::vector<TetId>& bad, const std::function<bool(const Change&)>& allows) {
            mend(part, domain, bad, allows);
          }};
}

/// An onion whose tets are mended as far as single changes go, and what they leave.
class Shaking : public testing::Test {
 protected:
  TetComplex mended() {
    TetComplex complex(mesh_, TetJudge({.min_dihedral_deg = kAskedDeg}));
    left_ = mend(complex, domain_, sharp_tets(complex), [](const Change&) { return true; });
    return complex;
  }
  TetMesh shaken() {
    TetComplex complex = mended();
    Progress progress;
    better_ = shake(complex, mending_for(domain_), left_, progress);
    return complex.release();
  }
  static std::size_t count_sharp(const TetMesh& mesh) {
    return sharp_tets(TetComplex(mesh, TetJudge({.min_dihedral_deg = kAskedDeg}))).size();
  }

  Onion domain_;
  TetMesh mesh_ = refined(domain_, 0.8);
  std::vector<TetId> left_;
  std::uint64_t better_ = 0;
};

TEST_F(Shaking, MendsWhatSingleChangesLeave) {
  const TetMesh before = mended().release();
  ASSERT_GT(left_.size(), 4U);
  const TetMesh after = shaken();
  EXPECT_GT(better_, 0U);
  EXPECT_LT(count_sharp(after), count_sharp(before) / 2);
  expect_sound(before, after, 2e-3);
  AuditOptions options;
  options.restricted_delaunay = false;
  const AuditReport report = audit(after, &domain_, options);
  EXPECT_TRUE(report.passed()) << report.findings.front().message;
}

TEST_F(Shaking, DoesNotDependOnTheNumberOfThreads) {
  std::vector<TetMesh> meshes;
  for (const std::size_t threads : {1, 2}) with_threads(threads, [&] { meshes.push_back(shaken()); });
  EXPECT_EQ(meshes[0].vertices, meshes[1].vertices);
  EXPECT_EQ(meshes[0].tets, meshes[1].tets);
}

TEST_F(Shaking, LeavesAllAsItIsWhereNothingIsBad) {
  TetComplex complex(mesh_, TetJudge({.min_dihedral_deg = 0.001}));
  Progress progress;
  EXPECT_EQ(shake(complex, mending_for(domain_), {0, 1, 2}, progress), 0U);
  EXPECT_EQ(complex.release().tets, mesh_.tets);
}

class Cancelled final : public Progress {
  bool cancelled() const override { return true; }
};

TEST_F(Shaking, EndsWhenCancelled) {
  TetComplex complex = mended();
  const TetMesh before = mended().release();
  Cancelled progress;
  EXPECT_EQ(shake(complex, mending_for(domain_), left_, progress), 0U);
  EXPECT_EQ(complex.release().tets, before.tets);
}

}  // namespace
}  // namespace scantet::optimize
