#include <gtest/gtest.h>

#include <algorithm>

#include "scantet/base/union_find.h"
#include "scantet/domain/analytic.h"
#include "scantet/surface/pieces_impl.h"
#include "unit/surface/samples.h"

namespace scantet::engine {
namespace {

/// What Pieces says, by looking at every cell.
class Expected {
 public:
  Expected(const RestrictedTriangulation& t, const std::vector<FacetCode>& facets) : t_(t.triangulation()) {
    sets_ = UnionFind(t_.cell_slots());
    for (CellId c = 0; c < t_.cell_slots(); ++c) {
      if (!t_.is_cell(c)) continue;
      for (const FacetCode across : t_.cell(c).neighbor) {
        if (across != kNone && t_.info(across / 4).region == t_.info(c).region) sets_.unite(c, across / 4);
      }
    }
    std::map<std::uint32_t, std::size_t> size;
    for (CellId c = 0; c < t_.cell_slots(); ++c) size[sets_.find(c)] += t_.is_cell(c) ? 1 : 0;
    std::map<std::pair<std::optional<Patch>, Region>, std::uint32_t> main;
    each_side(facets, [&](FacetCode facet, FacetCode side) {
      const std::uint32_t piece = of(side / 4);
      auto& largest = main.try_emplace({patch_of(t, facet), t_.info(side / 4).region}, piece).first->second;
      if (size[piece] > size[largest]) largest = piece;
    });
    each_side(facets, [&](FacetCode facet, FacetCode side) {
      const auto boundary = patch_of(t, facet);
      if (boundary && main.at({boundary, t_.info(side / 4).region}) != of(side / 4)) side_facets_.push_back(side);
    });
  }
  std::uint32_t of(CellId c) { return sets_.find(c); }
  const std::vector<FacetCode>& side_facets() const { return side_facets_; }

 private:
  template <class Visit>
  void each_side(const std::vector<FacetCode>& facets, Visit visit) {
    for (const FacetCode facet : facets) {
      visit(facet, facet);
      visit(facet, t_.cell(facet / 4).neighbor[facet % 4]);
    }
  }

  const Triangulation& t_;
  UnionFind sets_;
  std::vector<FacetCode> side_facets_;
};

void check(const Domain& domain, std::vector<SamplePoint> sample, bool knows_disks, std::size_t& side_pieces) {
  RestrictedTriangulation t = triangulated(domain, std::move(sample));
  std::vector<FacetCode> facets = boundary_facets(t.triangulation());
  if (knows_disks) check_all_disks(t.triangulation(), t.disks(), [&] { return facets; });
  Pieces pieces(t, BoundarySurfaces(t, BoundaryFacets(t, facets)));
  Expected expected(t, facets);
  ASSERT_EQ(pieces.side_facets(), expected.side_facets());
  std::map<std::uint32_t, std::uint32_t> number;  // of each side piece
  for (const FacetCode side : pieces.side_facets()) number[expected.of(side / 4)] = pieces.of(side / 4);
  side_pieces += number.size();
  std::vector<CellId> cells;
  for (CellId c = 0; c < t.triangulation().cell_slots(); ++c) {
    if (!t.triangulation().is_cell(c)) continue;
    const auto found = number.find(expected.of(c));
    if (found != number.end()) cells.push_back(c);
    for (const auto& [piece, by_pieces] : number) {
      ASSERT_EQ(expected.of(c) == piece, pieces.of(c) == by_pieces) << "cell " << c;
    }
  }
  EXPECT_EQ(pieces.side_cells(), cells);
}

TEST(Pieces, AreThoseThatEveryCellTells) {
  for (const bool knows_disks : {false, true}) {
    std::size_t side_pieces = 0;
    for (std::size_t one_in = 1; one_in < 12; ++one_in) {
      const auto tanglecube = make_tanglecube();
      check(*tanglecube, sparse_sample(*tanglecube, 0.4, one_in), knows_disks, side_pieces);
      const auto torus = make_torus({}, 5, 0.7);
      check(*torus, sparse_sample(*torus, 0.6, one_in), knows_disks, side_pieces);
      const auto shell = make_shell({}, 4.5, 5);
      check(*shell, sparse_sample(*shell, 1, one_in), knows_disks, side_pieces);
    }
    EXPECT_GT(side_pieces, 30U);  // else nothing was seen
  }
}

TEST(Pieces, OfASurfaceWellSampledHaveNoSides) {
  std::size_t side_pieces = 0;
  const auto balls = make_two_spheres(5, 2);
  check(*balls, sparse_sample(*balls, 0.5, 1), true, side_pieces);
  EXPECT_EQ(side_pieces, 0U);
}

}  // namespace
}  // namespace scantet::engine
