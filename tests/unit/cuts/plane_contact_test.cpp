#include "scantet/cuts/plane_contact.h"

#include <gtest/gtest.h>

#include "scantet/cuts/cut_text.h"
#include "scantet/domain/analytic.h"
#include "unit/sharp_cube.h"

namespace scantet {
namespace {

bool touches(const Domain& domain, const std::vector<std::string>& cuts) {
  std::vector<CutPlane> planes;
  for (const std::string& text : cuts) read_cut("--cut", text, planes);
  const CutSpace space{domain, planes, domain.bounds(), 0.1};
  return touches_boundary(space, 0, 1e-10);
}

TEST(PlaneContact, OfCornersAndEdges) {
  const test::SharpCube cube(2);
  EXPECT_TRUE(touches(cube, {"x < 1"})) << "a face";
  EXPECT_TRUE(touches(cube, {"x > -1"}));
  EXPECT_TRUE(touches(cube, {"x - y < 0"})) << "two edges";
  EXPECT_TRUE(touches(cube, {"x + y + z < 1"})) << "three corners";
  EXPECT_FALSE(touches(cube, {"x < 0.999"}));
  EXPECT_FALSE(touches(cube, {"x < 0"})) << "the middles of edges";
  EXPECT_FALSE(touches(cube, {"x + y + z < 1.01"}));
}

/// A box whose faces at x = 1 and -1 are its boundary, without edges that it knows of.
class Slab final : public Domain {
 public:
  Box bounds() const override { return {{-2, -2, -2}, {2, 2, 2}}; }
  Region region_at(const Point& p) const override { return std::abs(p.x) < 1 ? 1 : kOutside; }
  void crossings(const Segment&, Crossings& out) const override { out.clear(); }
  std::optional<double> residual_at(const Point& p) const override { return std::abs(std::abs(p.x) - 1); }
};

TEST(PlaneContact, OfTheBoundary) {
  EXPECT_TRUE(touches(Slab(), {"x < 1"}));
  EXPECT_FALSE(touches(Slab(), {"x < 0.5"}));
  EXPECT_FALSE(touches(Slab(), {"x + y < 1.003"})) << "the boundary crosses it";
  EXPECT_FALSE(touches(Slab(), {"x < 1", "y > 3"})) << "another plane leaves nothing of it";
  EXPECT_FALSE(touches(*make_sphere({}, 1), {"x < 0.25"}));
}

}  // namespace
}  // namespace scantet
