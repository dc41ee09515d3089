// Insertions one by one, in the whole and in parts, against every cell looked at.
#include <cmath>

#include "scantet/delaunay/inserter_impl.h"
#include "unit/delaunay/triangulations.h"

namespace scantet::engine {
namespace {

PointId insert(const Point& p, Triangulation& t, Inserter& inserter, const ConflictZone& zone) {
  const PointId v = inserter.take_vertex();
  t.vertex(v) = {.point = p};
  inserter.insert(v, zone);
  t.find_lasting_spheres(inserter.new_cells());
  return v;
}

class InserterTest : public testing::Test {
 protected:
  InserterTest() : points_(random_points(3000, 10, 1)), t_(bounds_of(points_)) { insert_in_bulk(points_, t_, silent); }
  Point random_place() { return {coordinate_(random_), coordinate_(random_), coordinate_(random_)}; }

  /// Expects the zone to be all cells in conflict with p, and its facets to be those around them.
  void expect_zone(const ConflictZone& zone, const Point& p) const {
    std::vector<CellId> expected;
    for (CellId c = 0; c < t_.cell_slots(); ++c) {
      if (t_.is_cell(c) && t_.in_conflict(c, p)) expected.push_back(c);
    }
    std::vector<CellId> cells = zone.cells;
    std::sort(cells.begin(), cells.end());
    EXPECT_EQ(cells, expected);
    std::vector<FacetCode> around;
    for (const CellId c : expected) {
      for (std::uint32_t i = 0; i < 4; ++i) {
        const FacetCode across = t_.cell(c).neighbor[i];
        if (across == kNone || !t_.in_conflict(across / 4, p)) around.push_back(4 * c + i);
      }
    }
    std::vector<FacetCode> facets = zone.facets;
    std::sort(facets.begin(), facets.end());
    EXPECT_EQ(facets, around);
  }

  std::vector<SamplePoint> points_;
  Triangulation t_;
  std::mt19937 random_{2};
  std::uniform_real_distribution<double> coordinate_{0, 10};
};

TEST_F(InserterTest, ZonesAreAllCellsInConflict) {
  Inserter inserter(t_);
  ConflictZone zone;
  for (int i = 0; i < 50; ++i) {
    const Point p = random_place();
    ASSERT_EQ(inserter.find_zone(p, t_.vertex(PointId(100 + i)).cell, zone), Inserter::Found::zone);
    expect_zone(zone, p);
    insert(p, t_, inserter, zone);
    EXPECT_EQ(inserter.new_cells().size(), zone.facets.size());
  }
  inserter.retire();
  expect_valid(t_);
  EXPECT_EQ(t_.vertex_count(), points_.size() + 50);
}

TEST_F(InserterTest, LocateEndsWhereThePointIs) {
  Inserter inserter(t_);
  for (int i = 0; i < 200; ++i) {
    const Point p = random_place();
    ASSERT_EQ(inserter.locate(p, CellId(i)), Inserter::Found::zone);
    const Corners corners = t_.points_of(inserter.last_seen());
    for (std::size_t k = 0; k < 4; ++k) {
      Corners seen = corners;
      seen[k] = p;
      EXPECT_GE(exact_orientation(seen[0], seen[1], seen[2], seen[3]), 0);
    }
  }
}

TEST_F(InserterTest, AVertexIsFoundWhereverTheSearchStarts) {
  Inserter inserter(t_);
  ConflictZone zone;
  for (PointId v = 10; v < 300; ++v) {
    EXPECT_EQ(inserter.find_zone(t_.point(v), t_.vertex(v + 1000).cell, zone), Inserter::Found::vertex);
    EXPECT_EQ(inserter.find_zone(t_.point(v), t_.vertex(v).cell, zone), Inserter::Found::vertex);
    EXPECT_EQ(inserter.locate(t_.point(v), t_.vertex(v + 1000).cell), Inserter::Found::vertex);
  }
}

TEST(Inserter, AZoneOfManyVerticesIsLinked) {
  // The middle of a sphere with hundreds of points: more vertices than the table of edges holds.
  std::vector<SamplePoint> points;
  for (int i = 0; i < 400; ++i) {
    const double z = 2 * (i + 0.5) / 400 - 1;
    const double angle = i * M_PI * (3 - std::sqrt(5.0));
    const double r = std::sqrt(1 - z * z);
    points.push_back({{r * std::cos(angle), r * std::sin(angle), z}, 2});
  }
  Triangulation t(bounds_of(points));
  insert_in_bulk(points, t, silent);
  Inserter inserter(t);
  ConflictZone zone;
  ASSERT_EQ(inserter.find_zone({0.01, 0.02, 0.03}, kNone, zone), Inserter::Found::zone);
  const PointId v = insert({0.01, 0.02, 0.03}, t, inserter, zone);
  inserter.retire();
  EXPECT_GT(zone.facets.size(), 200U);
  expect_valid(t);
  std::vector<CellId> star;
  t.star_of(v, star);
  EXPECT_EQ(star.size(), zone.facets.size());
}

class InserterOfAPart : public InserterTest {
 protected:
  /// Two halves of space, with their common plane at x = 5.
  VertexParts halves() const {
    VertexParts parts(t_.vertex_slots() + 5000, 0);
    for (PointId v = Triangulation::kCorners; v < t_.vertex_slots(); ++v) parts[v] = t_.point(v).x < 5 ? 0 : 1;
    return parts;
  }
  /// A cell in the middle of the first half.
  CellId start() const {
    PointId nearest = Triangulation::kCorners;
    for (PointId v = nearest; v < t_.vertex_slots(); ++v) {
      if (distance(t_.point(v), {2, 5, 5}) < distance(t_.point(nearest), {2, 5, 5})) nearest = v;
    }
    return t_.vertex(nearest).cell;
  }
};

TEST_F(InserterOfAPart, ChangesOnlyWhatThePartOwns) {
  VertexParts parts = halves();
  Inserter(t_, parts, 0, 20'000, 0).retire();  // leaves slots that are clear, so that one can look at all of them
  const CellId slots = t_.cell_slots();
  std::vector<Cell> before;
  for (CellId c = 0; c < slots; ++c) before.push_back(t_.cell(c));
  Inserter left(t_, parts, 0, 20'000, 1000);
  Inserter right(t_, parts, 1, 0, 0);
  left.start_at(start());
  ConflictZone zone;
  int beyond = 0;
  int inserted = 0;
  for (int i = 0; i < 1000; ++i) {
    Point p = random_place();
    p.x *= 0.5;
    const Inserter::Found found = left.find_zone(p, kNone, zone);
    if (found == Inserter::Found::beyond) {
      ++beyond;
      continue;
    }
    ASSERT_EQ(found, Inserter::Found::zone);
    expect_zone(zone, p);
    ASSERT_TRUE(left.has_vertex() && left.has_room_for(zone));
    for (const CellId c : zone.cells) EXPECT_TRUE(left.owns(c) && !right.owns(c));
    insert(p, t_, left, zone);
    ++inserted;
    if (HasFailure()) return;
  }
  EXPECT_GT(inserted, 100);
  EXPECT_GT(beyond, 10);
  for (CellId c = 0; c < slots; ++c) {
    const auto& vertex = before[c].vertex;
    if (vertex[0] == kNone ||
        std::none_of(vertex.begin(), vertex.end(), [&](PointId v) { return v >= 4 && parts[v] == 1; }))
      continue;
    EXPECT_EQ(t_.cell(c).vertex, vertex);  // cells with a vertex of the other part
  }
  left.retire();
  right.retire();
  expect_valid(t_);
  EXPECT_EQ(t_.vertex_count(), points_.size() + static_cast<std::size_t>(inserted));
}

TEST_F(InserterOfAPart, StopsAtItsSlotsAndGivesThemBack) {
  VertexParts parts = halves();
  const std::uint64_t vertices = t_.vertex_count();
  Inserter few(t_, parts, 0, 30, 3);
  few.start_at(start());
  const CellId slots = t_.cell_slots();
  ConflictZone zone;
  int inserted = 0;
  for (int i = 0; i < 100 && few.has_vertex(); ++i) {
    const Point p{2 + 0.01 * i, 5, 5};
    if (few.find_zone(p, kNone, zone) != Inserter::Found::zone || !few.has_room_for(zone)) continue;
    insert(p, t_, few, zone);
    ++inserted;
  }
  EXPECT_EQ(t_.cell_slots(), slots) << "no slots but its own";
  few.retire();
  EXPECT_EQ(t_.vertex_count(), vertices + static_cast<std::uint64_t>(inserted));
  EXPECT_FALSE(few.has_vertex());
  expect_valid(t_);
  Inserter next(t_, parts, 1, 10, 0);  // takes up what is free before it adds slots
  EXPECT_EQ(t_.cell_slots(), slots);
  next.retire();
}

}  // namespace
}  // namespace scantet::engine
