// The contract of domain.h as a test suite. A domain joins by compiling domain_contract.cpp and
// INSTANTIATE_TEST_SUITE_P(Name, DomainContract, Values(case...)); that of a plugin with plugin_case.h. Installed with
// scantet (docs/plugins.md).
#pragma once

#include <gtest/gtest.h>

#include <functional>
#include <memory>
#include <random>
#include <string>

#include "scantet/domain/domain.h"

namespace scantet {

struct DomainCase {
  std::string name;
  std::function<std::unique_ptr<Domain>()> make;
  double max_residual = 1e-9;  ///< bound on residual_at of crossings and candidates
};

inline std::ostream& operator<<(std::ostream& out, const DomainCase& c) {
  return out << c.name;
}

class DomainContract : public ::testing::TestWithParam<DomainCase> {
 protected:
  void SetUp() override {
    domain_ = GetParam().make();
    box_ = domain_->bounds();
  }
  Point random_point(double share_outside = 0.1) {
    std::uniform_real_distribution<double> unit(-share_outside, 1 + share_outside);
    return {box_.min.x + unit(random_) * box_.extent().x, box_.min.y + unit(random_) * box_.extent().y,
            box_.min.z + unit(random_) * box_.extent().z};
  }
  Segment random_segment() { return {random_point(), random_point()}; }

  std::unique_ptr<Domain> domain_;
  Box box_;
  std::mt19937 random_{12345};
};

}  // namespace scantet
