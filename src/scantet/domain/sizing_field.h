// How large elements may be (the paper's σ).
#pragma once

#include "scantet/base/geometry.h"

namespace scantet {

/// Upper bound on the circumradius of a tet whose circumcentre is at p. Positive everywhere; 1-Lipschitz for the proofs
/// (paper, section 3). Const methods may be called from many threads.
class SizingField {
 public:
  virtual ~SizingField() = default;
  /// The bound at p, mm.
  virtual double size_at(const Point& p) const = 0;
  /// A positive lower bound of size_at over the domain, mm.
  virtual double min_size() const = 0;
};

/// The same size everywhere.
class UniformSize final : public SizingField {
 public:
  /// size_mm: positive and finite.
  explicit UniformSize(double size_mm) : size_mm_(size_mm) {}
  double size_at(const Point&) const override { return size_mm_; }
  double min_size() const override { return size_mm_; }

 private:
  double size_mm_;
};

}  // namespace scantet
