// How large elements may be (the paper's σ).
#pragma once

#include <array>
#include <cstdint>
#include <utility>
#include <vector>

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

/// A place where elements must be smaller.
struct FinerPlace {
  Point point;     ///< world mm
  double size_mm;  ///< there; > 0
};

/// The same size everywhere but around some places: the least of it and, for each place, the size there plus the
/// distance from it. So it is 1-Lipschitz.
class FinerSize final : public SizingField {
 public:
  /// size_mm: elsewhere; positive and finite. Places with a larger size make no difference.
  FinerSize(double size_mm, std::vector<FinerPlace> places);
  double size_at(const Point& p) const override;
  double min_size() const override { return least_mm_; }

 private:
  using CellKey = std::array<std::int64_t, 3>;
  CellKey cell_of(const Point& p) const;

  double size_mm_;
  double least_mm_;
  double cell_mm_ = 1;  // no place matters further away than that
  std::vector<FinerPlace> places_;
  std::vector<std::pair<CellKey, std::uint32_t>> near_;  // cells with the places that matter in them, sorted
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
