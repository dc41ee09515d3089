// The contract of domain.h, promise by promise.
#include "contract/domain_contract.h"

#include <thread>

namespace scantet {

TEST_P(DomainContract, BoundsAreFiniteAndEncloseTheInside) {
  ASSERT_FALSE(box_.empty());
  ASSERT_TRUE(is_finite(box_.min) && is_finite(box_.max));
  int inside = 0;
  for (int i = 0; i < 20000; ++i) {
    const Point p = random_point(0.3);
    if (domain_->region_at(p) == kOutside) continue;
    ++inside;
    EXPECT_TRUE(box_.contains(p));
  }
  EXPECT_GT(inside, 0);
}

TEST_P(DomainContract, CrossingsAlternateAndAgreeWithRegionsAtTheEnds) {
  Crossings crossings;
  std::size_t found = 0;
  for (int i = 0; i < 3000; ++i) {
    const Segment s = random_segment();
    domain_->crossings(s, crossings);
    Region region = domain_->region_at(s.source);
    for (const Crossing& c : crossings) {
      EXPECT_EQ(c.from, region);
      EXPECT_NE(c.from, c.to);
      region = c.to;
    }
    EXPECT_EQ(region, domain_->region_at(s.target));
    found += crossings.size();
  }
  EXPECT_GT(found, 0U);
}

TEST_P(DomainContract, ManyQuestionsAreAnsweredAsOneByOne) {
  std::vector<Point> points;
  std::vector<Segment> segments;
  for (int i = 0; i < 300; ++i) {
    points.push_back(random_point());
    segments.push_back(random_segment());
  }
  std::vector<Region> regions(points.size());
  CrossingLists lists;
  lists.append(Crossings(3));
  domain_->regions_at(points, regions);
  domain_->crossings_of(segments, lists);
  ASSERT_EQ(lists.size(), segments.size());
  Crossings one;
  for (std::size_t i = 0; i < points.size(); ++i) {
    EXPECT_EQ(regions[i], domain_->region_at(points[i]));
    domain_->crossings(segments[i], one);
    ASSERT_EQ(lists[i].size(), one.size());
    for (std::size_t k = 0; k < one.size(); ++k) {
      EXPECT_EQ(lists[i][k].point, one[k].point);
      EXPECT_EQ(lists[i][k].from, one[k].from);
      EXPECT_EQ(lists[i][k].patch(), one[k].patch());
    }
  }
}

TEST_P(DomainContract, APointOfACrossingIsOnItsPatch) {
  Crossings crossings;
  for (int i = 0; i < 1000; ++i) {
    domain_->crossings(random_segment(), crossings);
    for (const Crossing& c : crossings) {
      EXPECT_TRUE(c.patch().is_known());
      EXPECT_EQ(domain_->patch_at(c.point), c.patch());
    }
  }
}

TEST_P(DomainContract, CrossingsAreOrderedOnTheSegmentAndOnTheLevel) {
  Crossings crossings;
  const double tolerance = 1e-9 * box_.diagonal();
  for (int i = 0; i < 2000; ++i) {
    const Segment s = random_segment();
    domain_->crossings(s, crossings);
    const double whole = distance(s.source, s.target);
    double last = 0;
    for (const Crossing& c : crossings) {
      const double along = distance(s.source, c.point);
      EXPECT_GE(along, last - tolerance);
      EXPECT_NEAR(along + distance(c.point, s.target), whole, tolerance);
      last = along;
      if (const auto residual = domain_->residual_at(c.point)) {
        EXPECT_LE(*residual, GetParam().max_residual);
      }
    }
  }
}

TEST_P(DomainContract, NoCrossingIsMissed) {
  Crossings crossings;
  for (int i = 0; i < 300; ++i) {
    const Segment s = random_segment();
    domain_->crossings(s, crossings);
    std::size_t next = 0;
    Region expected = domain_->region_at(s.source);
    const double tolerance = 1e-7 * box_.diagonal();
    for (int k = 0; k <= 500; ++k) {
      const Point p = lerp(s.source, s.target, k / 500.0);
      const double along = distance(s.source, p);
      while (next < crossings.size() && distance(s.source, crossings[next].point) < along)
        expected = crossings[next++].to;
      const bool at_a_crossing = (next > 0 && distance(crossings[next - 1].point, p) < tolerance) ||
                                 (next < crossings.size() && distance(crossings[next].point, p) < tolerance);
      if (at_a_crossing) continue;
      EXPECT_EQ(domain_->region_at(p), expected) << "sample " << k << " of segment " << i;
    }
  }
}

TEST_P(DomainContract, AnswersAreRepeatableAndThreadSafe) {
  std::vector<Segment> segments;
  for (int i = 0; i < 500; ++i) segments.push_back(random_segment());
  const auto ask = [&] {
    std::vector<Point> answers;
    Crossings crossings;
    for (const Segment& s : segments) {
      domain_->crossings(s, crossings);
      for (const Crossing& c : crossings) answers.push_back(c.point);
      answers.push_back({static_cast<double>(domain_->region_at(s.source)), 0, 0});
    }
    return answers;
  };
  const std::vector<Point> first = ask();
  std::vector<std::vector<Point>> others(4);
  std::vector<std::thread> threads;
  for (auto& answers : others) threads.emplace_back([&] { answers = ask(); });
  for (auto& thread : threads) thread.join();
  for (const auto& answers : others) EXPECT_TRUE(answers == first);
}

TEST_P(DomainContract, DegenerateSegmentsAreAnswered) {
  Crossings crossings{{Point{}, 1, 0}};
  const Point p = random_point();
  domain_->crossings({p, p}, crossings);
  EXPECT_TRUE(crossings.empty()) << "a segment of no length crosses nothing";
  const Vec far = 1e4 * box_.extent();
  domain_->crossings({box_.center() - far, box_.center() + far}, crossings);
  if (crossings.empty()) return;
  EXPECT_EQ(crossings.front().from, kOutside);
  EXPECT_EQ(crossings.back().to, kOutside);
}

TEST_P(DomainContract, FacesOfTheBoxAreOutside) {
  Crossings crossings;
  for (int i = 0; i < 600; ++i) {
    const int axis = i % 3;
    Segment line{random_point(0), random_point(0)};
    line.source[axis] = line.target[axis] = (i % 2 == 0 ? box_.min : box_.max)[axis];
    EXPECT_EQ(domain_->region_at(line.source), kOutside);
    domain_->crossings(line, crossings);
    EXPECT_TRUE(crossings.empty()) << "segment " << i;
  }
}

TEST_P(DomainContract, CandidatesLieOnTheBoundary) {
  const double spacing = box_.diagonal() / 40;
  std::vector<Point> candidates;
  domain_->surface_candidates(spacing, [&](const Point& p) { candidates.push_back(p); });
  ASSERT_FALSE(candidates.empty());
  for (const Point& p : candidates) {
    if (const auto residual = domain_->residual_at(p)) {
      EXPECT_LE(*residual, GetParam().max_residual);
    }
  }
  std::vector<Point> again;
  domain_->surface_candidates(spacing, [&](const Point& p) { again.push_back(p); });
  EXPECT_TRUE(again == candidates);
}

TEST_P(DomainContract, CornersLieOnTheBoundary) {
  for (const Corner& corner : domain_->corners()) {
    EXPECT_LE(domain_->residual_at(corner.point).value_or(0), 1e-9)
        << corner.point.x << " " << corner.point.y << " " << corner.point.z;
  }
}

TEST_P(DomainContract, WitnessesAreInTheirComponents) {
  for (const Component& component : domain_->components()) {
    EXPECT_EQ(domain_->region_at(component.witness), component.region);
  }
}

}  // namespace scantet
