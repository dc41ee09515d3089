// A domain that counts what is asked of it.
#pragma once

#include <atomic>
#include <cstdint>

#include "scantet/domain/domain.h"

namespace scantet::test {

/// Stands for another domain, and counts the lines asked for.
class CountingDomain final : public Domain {
 public:
  explicit CountingDomain(const Domain& domain) : domain_(domain) {}
  Box bounds() const override { return domain_.bounds(); }
  Region region_at(const Point& p) const override { return domain_.region_at(p); }
  void crossings(const Segment& segment, Crossings& out) const override {
    ++lines;
    domain_.crossings(segment, out);
  }
  mutable std::atomic<std::uint64_t> lines{0};

 private:
  const Domain& domain_;
};

}  // namespace scantet::test
