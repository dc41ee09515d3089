// A list of findings with one entry a code.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "scantet/verify/verify.h"

namespace scantet::verify {

/// Adds to a list that it does not own.
class FindingList {
 public:
  explicit FindingList(std::vector<VerifyFinding>& list) : list_(list) {}

  /// What is proved to be wrong. Several of a code are one entry, with the first place and their number.
  void add(const std::string& code, const std::string& what, const Point& place) {
    put({code, what, place, 1, true, false, false});
  }
  /// What could not be decided. bounded: the grade "bounded" does not depend on it.
  void add_undecided(const std::string& code, const std::string& what, const Point& place, bool bounded) {
    put({code, what, place, 1, false, bounded, false});
  }
  /// What is proved, and neither wrong nor an obstacle to the grade "bounded".
  void add_found(const std::string& code, const std::string& what, const Point& place) {
    put({code, what, place, 1, false, true, true});
  }

 private:
  void put(VerifyFinding finding) {
    for (VerifyFinding& old : list_) {
      if (old.code != finding.code) continue;
      ++old.count;
      return;
    }
    list_.push_back(std::move(finding));
  }

  std::vector<VerifyFinding>& list_;
};

}  // namespace scantet::verify
