// A vertex whose star is known: a ring of points around it, with a pole above and one below. Twelve tets above, and
// twelve below, all around the axis.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "scantet/delaunay/bulk_insertion_impl.h"

namespace scantet::engine {

class RingStar : public testing::Test {
 protected:
  static constexpr int kRing = 12;

  RingStar() : t_({{-2, -2, -2}, {2, 2, 2}}) {
    std::vector<SamplePoint> points{{{0, 0, 0}, 2}, {{0, 0, 1}, 2}, {{0, 0, -1}, 2}};
    for (int i = 0; i < kRing; ++i) {
      const double angle = 2 * M_PI * i / kRing;
      points.push_back({{std::cos(angle), std::sin(angle), 0.01 * (i % 2)}, 2});
    }
    Progress silent;
    insert_in_bulk(points, t_, silent);
    for (PointId v = Triangulation::kCorners; v < t_.vertex_slots(); ++v) {
      if (t_.is_vertex(v) && length(t_.point(v)) < 0.5) middle_ = v;
    }
    t_.star_of(middle_, star_);
  }

  /// region_of(sector, above): of the tet from 30° · sector on. All other tets are outside.
  void set_regions(const std::function<Region(int, bool)>& region_of) {
    for (CellId c = 0; c < t_.cell_slots(); ++c) t_.info(c).region = kOutside;
    for (const CellId c : star_) {
      Point middle;
      for (const Point& p : t_.points_of(c)) middle = middle + 0.25 * p;
      const double angle = std::atan2(middle.y, middle.x) + 2 * M_PI;
      t_.info(c).region = region_of(static_cast<int>(angle / (2 * M_PI) * kRing) % kRing, middle.z > 0);
    }
  }

  Triangulation t_;
  PointId middle_ = kNone;
  std::vector<CellId> star_;
};

}  // namespace scantet::engine
