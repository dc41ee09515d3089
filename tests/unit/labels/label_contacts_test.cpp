#include "scantet/labels/label_contacts.h"

#include <gtest/gtest.h>

#include "label_scan.h"
#include "scantet/labels/label_object.h"

namespace scantet {
namespace {

using Contacts = std::map<Region, std::set<Region>>;

TEST(LabelContacts, AreFacesOfVoxelsAlongEachAxis) {
  // 1 below 2 along x, 3 above both along z, 4 beside 2 at an edge only.
  const Scan scan = test::label_scan({6, 4, 4}, [](int i, int j, int k) {
    if (i == 5) return 0;
    if (k == 3) return 3;
    if (i == 4) return j == 0 && k == 0 ? 4 : 0;
    if (i > 1) return j == 0 && k == 0 && i == 3 ? 0 : 2;
    return 1;
  });
  LabelSettings settings;
  Progress progress;
  const RegionGrid grid = make_label_object(scan, settings, progress).grid();
  EXPECT_EQ(regions_in_contact(grid),
            (Contacts{{0, {2, 3, 4}}, {1, {2, 3}}, {2, {0, 1, 3}}, {3, {0, 1, 2}}, {4, {0}}}));
}

TEST(LabelContacts, OfOneRegionThereAreNone) {
  RegionGrid grid;
  grid.size = {2, 1, 1};
  grid.parts = {{7, 2, {0, 0, 0}}};
  grid.runs = {{0, 0, 0, 2, 0}};
  EXPECT_EQ(regions_in_contact(grid), (Contacts{{7, {}}}));
}

}  // namespace
}  // namespace scantet
