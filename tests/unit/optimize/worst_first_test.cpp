#include <gtest/gtest.h>

#include <atomic>

#include "scantet/optimize/worst_first_impl.h"
#include "unit/optimize/test_meshes.h"

namespace scantet::optimize {
namespace {

/// Counts how often it is asked; never knows what to do.
class NoRemedy final : public Remedy {
 public:
  explicit NoRemedy(std::atomic<int>& asked) : asked_(asked) {}
  void find(TetId, Change&) override { ++asked_; }

 private:
  std::atomic<int>& asked_;
};

TEST(WorstFirst, AsksOnceForEachBadTetThatHasNoRemedy) {
  const TetMesh mesh = refined(*make_sphere({0, 0, 0}, 4), 0.8);
  TetComplex complex(mesh, TetJudge({.min_dihedral_deg = 30}));
  const ElementCheck check(complex, nullptr);
  int bad = 0;
  for (const Tet& t : mesh.tets) bad += complex.sharpness(t) > check.bound() ? 1 : 0;
  ASSERT_GT(bad, 100);
  std::atomic<int> asked = 0;
  Progress progress;
  const WorstFirstResult result = change_worst_first(
      complex, check, sharp_tets(complex), {"test", [&] { return std::make_unique<NoRemedy>(asked); }}, progress);
  EXPECT_EQ(result.changes, 0U);
  EXPECT_EQ(result.left.size(), static_cast<std::size_t>(bad));
  EXPECT_EQ(asked, bad);
  EXPECT_EQ(complex.release().tets, mesh.tets);
}

/// Takes any tet away that it is asked about: no good remedy, but good enough to see which come first.
class Removal final : public Remedy {
 public:
  void find(TetId t, Change& best) override {
    best.reset(-1);
    best.removed = {t};
    best.read = {t};
  }
};

class Recorded final : public Progress {
 public:
  explicit Recorded(int rounds) : rounds_(rounds) {}
  void report(const ProgressState& state) override {
    EXPECT_EQ(state.stage, "optimize");
    EXPECT_EQ(state.doing, "test");
    done.push_back(state.done);
    pending.push_back(state.pending);
  }
  bool cancelled() const override { return static_cast<int>(done.size()) >= rounds_; }

  std::vector<std::uint64_t> done;
  std::vector<std::uint64_t> pending;

 private:
  int rounds_;
};

TEST(WorstFirst, TakesTheWorstFirstAndStopsWhenCancelled) {
  const TetMesh mesh = refined(*make_sphere({0, 0, 0}, 4), 0.8);
  TetComplex complex(mesh, TetJudge({.min_dihedral_deg = 40}));
  const ElementCheck check(complex, nullptr);
  Recorded progress(2);
  const std::uint64_t changes = change_worst_first(complex, check, sharp_tets(complex),
                                                   {"test", [] { return std::make_unique<Removal>(); }}, progress)
                                    .changes;
  ASSERT_EQ(progress.done.size(), 2U);
  EXPECT_EQ(changes, progress.done.back());
  EXPECT_LT(progress.done[0], progress.done[1]);
  EXPECT_GT(progress.pending[0], progress.pending[1]);
  EXPECT_GT(progress.pending[1], 0U);
  double least_removed = kInverted;
  double most_left = -1;
  for (TetId t = 0; t < mesh.tets.size(); ++t) {
    const double sharpness = complex.sharpness(mesh.tets[t]);
    if (complex.is_tet(t)) {
      most_left = std::max(most_left, sharpness);
    } else {
      least_removed = std::min(least_removed, sharpness);
    }
  }
  EXPECT_GE(least_removed, most_left);
}

/// Takes a tet away and puts it back: what is changed stays bad.
class Treadmill final : public Remedy {
 public:
  explicit Treadmill(const TetComplex& complex) : complex_(complex) {}
  void find(TetId t, Change& best) override {
    best.reset(kInverted);
    best.removed = {t};
    best.added = {{complex_.tet(t), complex_.region(t)}};
    best.read = {t};
  }

 private:
  const TetComplex& complex_;
};

TEST(WorstFirst, EndsWhereChangesLeadNowhere) {
  TetComplex complex(refined(*make_sphere({0, 0, 0}, 4), 0.8), TetJudge({.min_dihedral_deg = 30}));
  const ElementCheck check(complex, nullptr);
  const std::vector<TetId> sharp = sharp_tets(complex);
  ASSERT_GT(sharp.size(), 100U);
  Progress progress;
  Treatment treatment{"test", [&] { return std::make_unique<Treadmill>(complex); }};
  treatment.moves_vertices = true;
  const WorstFirstResult result = change_worst_first(complex, check, sharp, treatment, progress);
  EXPECT_GT(result.changes, sharp.size()) << "it was tried more than once";
  EXPECT_EQ(result.left.size(), sharp.size());
}

/// Sees how good a change must be; never finds one.
class Demanding final : public Remedy {
 public:
  Demanding(const TetComplex& complex, bool any_gain) : complex_(complex), any_gain_(any_gain) {}
  void find(TetId t, Change& best) override {
    const double sharpness = complex_.sharpness(complex_.tet(t));
    EXPECT_GT(best.sharpest, complex_.judge().bound());
    if (any_gain_) {
      EXPECT_EQ(best.sharpest, sharpness);
    } else {
      EXPECT_LT(best.sharpest, std::max(sharpness, std::nextafter(complex_.judge().bound(), kInverted) + 1e-15));
    }
  }

 private:
  const TetComplex& complex_;
  bool any_gain_;
};

TEST(WorstFirst, AsksForALeastStepWhereVerticesMove) {
  TetComplex complex(refined(*make_sphere({0, 0, 0}, 4), 0.8), TetJudge({.min_dihedral_deg = 40}));
  const ElementCheck check(complex, nullptr);
  Progress progress;
  for (const bool moves : {false, true}) {
    Treatment treatment{"test", [&] { return std::make_unique<Demanding>(complex, !moves); }};
    treatment.moves_vertices = moves;
    EXPECT_EQ(change_worst_first(complex, check, sharp_tets(complex), treatment, progress).changes, 0U);
  }
}

TEST(WorstFirst, TellsOfEachChange) {
  TetComplex complex(refined(*make_sphere({0, 0, 0}, 4), 0.8), TetJudge({.min_dihedral_deg = 40}));
  const ElementCheck check(complex, nullptr);
  const std::vector<TetId> sharp = sharp_tets(complex);
  for (const bool moves : {false, true}) {
    TetComplex copy = complex;
    const ElementCheck check_copy(copy, nullptr);
    std::vector<TetId> removed;
    Treatment treatment{"test", [] { return std::make_unique<Removal>(); }};
    treatment.made = [&](const Change& change) { removed.push_back(change.removed.front()); };
    treatment.moves_vertices = moves;
    Progress progress;
    EXPECT_EQ(change_worst_first(copy, check_copy, sharp, treatment, progress).changes, sharp.size());
    for (std::size_t i = 0; i + 1 < removed.size(); ++i) {
      EXPECT_GE(complex.sharpness(complex.tet(removed[i])), complex.sharpness(complex.tet(removed[i + 1])));
    }
    std::sort(removed.begin(), removed.end());
    EXPECT_EQ(removed, sharp);
  }
}

TEST(MakeChange, AddsAVertexAndMovesOne) {
  TetComplex complex(octahedron_with_sliver(1));
  Change change;
  change.vertex = 4;
  change.position = {0, 0, 1.1};
  change.on_boundary = true;
  make_change(complex, change);
  EXPECT_EQ(complex.point(4), (Point{0, 0, 1.1}));
  EXPECT_TRUE(complex.on_boundary(4));

  change.reset(0);
  change.vertex = kNewVertex;
  change.position = {0.1, 0.1, 0.5};
  change.on_boundary = false;
  change.removed = {1};
  for (std::size_t i = 0; i < 4; ++i) {
    change.added.push_back({complex.tet(1), 1});
    change.added.back().vertex[i] = kNewVertex;
  }
  EXPECT_EQ(make_change(complex, change).size(), 4U);
  EXPECT_EQ(change.vertex, 6U);
  EXPECT_EQ(complex.star(6).size(), 4U);
  EXPECT_EQ(complex.release().vertices.size(), 7U);
}

}  // namespace
}  // namespace scantet::optimize
