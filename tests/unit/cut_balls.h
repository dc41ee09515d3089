// A ball cut into cells, with the curves and corners where these meet.
#pragma once

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>
#include <vector>

#include "scantet/domain/domain.h"

namespace scantet::test {

/// An arc of a great circle around the origin, from one direction to another, or the whole circle.
class Arc final : public Curve {
 public:
  Arc(double radius_mm, const Vec& from, const Vec& towards, double angle, std::vector<Region> regions,
      std::optional<std::array<std::size_t, 2>> corners)
      : radius_mm_(radius_mm), u_(unit(from)), angle_(angle), regions_(std::move(regions)), corners_(corners) {
    v_ = unit(towards - dot(towards, u_) * u_);
  }
  double length_mm() const override { return radius_mm_ * angle_; }
  Point at(double along_mm) const override {
    const double t = std::clamp(along_mm / radius_mm_, 0.0, angle_);
    return Point{} + radius_mm_ * (std::cos(t) * u_ + std::sin(t) * v_);
  }
  Nearest nearest(const Point& p) const override {
    double t = std::atan2(dot(p - Point{}, v_), dot(p - Point{}, u_));
    if (t < 0) t += 2 * M_PI;
    if (t > angle_) t = t - angle_ < 2 * M_PI - t ? angle_ : 0;
    const Point q = at(radius_mm_ * t);
    return {q, radius_mm_ * t, distance(p, q)};
  }
  std::vector<Region> regions() const override { return regions_; }
  std::optional<std::array<std::size_t, 2>> corners() const override { return corners_; }

 private:
  static Vec unit(const Vec& a) { return (1 / length(a)) * a; }

  double radius_mm_;
  Vec u_;
  Vec v_;
  double angle_;
  std::vector<Region> regions_;
  std::optional<std::array<std::size_t, 2>> corners_;
};

/// A ball around the origin cut by planes through it into two halves, three wedges or four cells, each the points that
/// are nearest to one of as many seeds: regions 1, 2 …
class CutBall final : public Domain {
 public:
  CutBall(double radius_mm, int cells) : radius_mm_(radius_mm) {
    if (cells == 2) cut_in_two();
    if (cells == 3) cut_in_three();
    if (cells == 4) cut_in_four();
  }

  Box bounds() const override {
    const double r = 1.1 * radius_mm_;
    return {{-r, -r, -r}, {r, r, r}};
  }
  Region region_at(const Point& p) const override {
    if (squared_length(p - Point{}) >= radius_mm_ * radius_mm_) return kOutside;
    std::size_t best = 0;
    for (std::size_t i = 1; i < seeds_.size(); ++i) {
      if (dot(p - Point{}, seeds_[i]) > dot(p - Point{}, seeds_[best])) best = i;
    }
    return static_cast<Region>(best + 1);
  }
  void crossings(const Segment& segment, Crossings& out) const override {
    out.clear();
    const Vec from = segment.source - Point{};
    const Vec way = segment.target - segment.source;
    std::vector<double> places;
    const auto note = [&](double t) {
      if (t > 0 && t < 1) places.push_back(t);
    };
    const double a = dot(way, way), b = dot(from, way), c = dot(from, from) - radius_mm_ * radius_mm_;
    if (b * b > a * c) {
      note((-b - std::sqrt(b * b - a * c)) / a);
      note((-b + std::sqrt(b * b - a * c)) / a);
    }
    for (std::size_t i = 0; i < seeds_.size(); ++i) {
      for (std::size_t j = 0; j < i; ++j) note(-dot(from, seeds_[i] - seeds_[j]) / dot(way, seeds_[i] - seeds_[j]));
    }
    std::sort(places.begin(), places.end());
    Region region = region_at(segment.source);
    for (std::size_t i = 0; i < places.size(); ++i) {
      const bool last = i + 1 == places.size();
      const double middle = 0.5 * (places[i] + (last ? 1 : places[i + 1]));
      const Region next = last ? region_at(segment.target) : region_at(segment.source + middle * way);
      if (next != region) out.push_back({segment.source + places[i] * way, region, next});
      region = next;
    }
  }
  std::vector<std::shared_ptr<const Curve>> curves() const override { return curves_; }
  std::vector<Corner> corners() const override { return corners_; }

 private:
  void add_arc(const Vec& from, const Vec& towards, double angle, std::vector<Region> regions,
               std::optional<std::array<std::size_t, 2>> corners) {
    curves_.push_back(std::make_shared<Arc>(radius_mm_, from, towards, angle, std::move(regions), corners));
  }
  void cut_in_two() {
    seeds_ = {{1, 0, 0}, {-1, 0, 0}};
    add_arc({0, 1, 0}, {0, 0, 1}, 2 * M_PI, {0, 1, 2}, std::nullopt);
  }
  void cut_in_three() {
    for (int i = 0; i < 3; ++i) seeds_.push_back({std::cos(2 * M_PI * i / 3), std::sin(2 * M_PI * i / 3), 0});
    corners_ = {{{0, 0, radius_mm_}, {0, 1, 2, 3}, ""}, {{0, 0, -radius_mm_}, {0, 1, 2, 3}, ""}};
    for (int i = 0; i < 3; ++i) {  // opposite to seed i the other two meet
      const auto [a, b] = std::minmax({1 + (i + 1) % 3, 1 + (i + 2) % 3});
      add_arc({0, 0, 1}, -1 * seeds_[static_cast<std::size_t>(i)], M_PI, {0, a, b}, std::array<std::size_t, 2>{0, 1});
    }
    curves_.push_back(std::make_shared<PolylineCurve>(std::vector<Point>{corners_[0].point, corners_[1].point},
                                                      std::vector<Region>{1, 2, 3}, std::array<std::size_t, 2>{0, 1}));
  }
  void cut_in_four() {
    seeds_ = {{1, 1, 1}, {-1, -1, 1}, {-1, 1, -1}, {1, -1, -1}};
    corners_.push_back({{}, {1, 2, 3, 4}, ""});
    for (std::size_t i = 0; i < 4; ++i) {  // opposite to seed i
      std::vector<Region> others;
      for (Region r = 1; r <= 4; ++r) {
        if (r != static_cast<Region>(i + 1)) others.push_back(r);
      }
      const Point end = Point{} + (-radius_mm_ / std::sqrt(3)) * seeds_[i];
      curves_.push_back(
          std::make_shared<PolylineCurve>(std::vector<Point>{{}, end}, others, std::array<std::size_t, 2>{0, i + 1}));
      others.insert(others.begin(), kOutside);
      corners_.push_back({end, others, ""});
    }
    for (std::size_t i = 0; i < 4; ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        std::vector<Region> regions{kOutside};
        for (std::size_t k = 0; k < 4; ++k) {
          if (k != i && k != j) regions.push_back(static_cast<Region>(k + 1));
        }
        add_arc(-1 * seeds_[j], -1 * seeds_[i], std::acos(-1.0 / 3), regions, std::array<std::size_t, 2>{j + 1, i + 1});
      }
    }
  }

  double radius_mm_;
  std::vector<Vec> seeds_;
  std::vector<std::shared_ptr<const Curve>> curves_;
  std::vector<Corner> corners_;
};

}  // namespace scantet::test
