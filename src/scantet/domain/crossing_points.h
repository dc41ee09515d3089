// Where a domain's boundary crosses many lines.
#pragma once

#include <vector>

#include "scantet/domain/domain.h"

namespace scantet {

/// Collects the crossings of lines, in the order of the lines; asks for those of a few thousand lines in one call.
class CrossingPoints {
 public:
  /// out: they are added to it. Both must outlive the object.
  CrossingPoints(const Domain& domain, std::vector<Point>& out) : domain_(domain), out_(out) {}

  void add(const Segment& line) {
    constexpr std::size_t kMostAtOnce = 4096;
    lines_.push_back(line);
    if (lines_.size() == kMostAtOnce) finish();
  }
  /// Asks for those of the lines that were added last.
  void finish() {
    domain_.crossings_of(lines_, crossings_);
    for (std::size_t i = 0; i < lines_.size(); ++i) {
      for (const Crossing& crossing : crossings_[i]) out_.push_back(crossing.point);
    }
    lines_.clear();
  }

 private:
  const Domain& domain_;
  std::vector<Point>& out_;
  std::vector<Segment> lines_;
  CrossingLists crossings_;
};

}  // namespace scantet
