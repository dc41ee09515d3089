// How large elements may be (the paper's σ).
#pragma once

#include <algorithm>
#include <limits>
#include <memory>
#include <vector>

#include "scantet/base/api.h"
#include "scantet/domain/cone_tree.h"

namespace SCANTET_API scantet {

/// Upper bound on the circumradius of a tet whose circumcentre is at p. Positive everywhere; 1-Lipschitz for the proofs
/// (paper, section 3). Const methods may be called from many threads.
class SizingField {
 public:
  virtual ~SizingField() = default;
  /// The bound at p, world mm, in the domain or beyond it; mm.
  virtual double size_at(const Point& p) const = 0;
  /// The lesser of size_at(p) and most_mm: takes less time than size_at() where that has much to look through. most_mm:
  /// any number, or infinite.
  virtual double size_up_to(const Point& p, double most_mm) const { return std::min(size_at(p), most_mm); }
  /// The greater of size_at(p) and least_mm: takes less time than size_at() where one of several fields shows that it
  /// is least_mm. least_mm: any number.
  virtual double size_down_to(const Point& p, double least_mm) const { return std::max(size_at(p), least_mm); }
  /// A positive lower bound of size_at over the domain, mm.
  virtual double min_size() const = 0;
  /// A size, mm, at least min_size(), that size_at falls short of on a part of the boundary only: the boundary is
  /// looked at on that scale first, and closer where the size is less. Default: min_size().
  virtual double usual_size() const { return min_size(); }
  /// Whether R3 tests the size of tets. If not, the field only bounds the surface balls and grades the seeds (paper,
  /// section 7.1: no sizing requirements). Default: yes.
  virtual bool bounds_tets() const { return true; }
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

/// A place where elements must be smaller.
struct FinerPlace {
  Point point;     ///< world mm
  double size_mm;  ///< there; > 0
};

/// Another field, made finer around some places: the least of it and, for each place, the size there plus the distance
/// from it. So it is 1-Lipschitz if the other one is.
class FinerSize final : public SizingField {
 public:
  /// elsewhere: not null. places: any number of them; those with a larger size make no difference.
  FinerSize(std::shared_ptr<const SizingField> elsewhere, const std::vector<FinerPlace>& places);
  double size_at(const Point& p) const override { return size_up_to(p, std::numeric_limits<double>::infinity()); }
  double size_up_to(const Point& p, double most_mm) const override {
    return places_.lowest_at(p, elsewhere_->size_up_to(p, most_mm)).value_mm;
  }
  double size_down_to(const Point& p, double least_mm) const override;
  double min_size() const override { return least_mm_; }
  double usual_size() const override { return usual_mm_; }
  bool bounds_tets() const override { return elsewhere_->bounds_tets(); }

 private:
  std::shared_ptr<const SizingField> elsewhere_;
  double least_mm_;
  double usual_mm_;
  ConeTree places_;
};

/// The least of several fields: 1-Lipschitz if they are.
class LeastSize final : public SizingField {
 public:
  /// fields: at least one, none null.
  explicit LeastSize(std::vector<std::shared_ptr<const SizingField>> fields) : fields_(std::move(fields)) {}
  double size_at(const Point& p) const override { return size_up_to(p, std::numeric_limits<double>::infinity()); }
  double size_up_to(const Point& p, double most_mm) const override;
  double size_down_to(const Point& p, double least_mm) const override;
  double min_size() const override;
  double usual_size() const override;
  /// Whether one of them does.
  bool bounds_tets() const override;

 private:
  std::vector<std::shared_ptr<const SizingField>> fields_;
};

}  // namespace scantet
