// A sizing field that is known on the boundary and grows inward from it.
#pragma once

#include "scantet/domain/sizing_field.h"

namespace scantet {

/// σ(x) = min over points q of the boundary of σ_b(q) + |x - q|: the largest 1-Lipschitz field with these sizes on the
/// boundary, as σ_0 is with d_M (paper, section 5, Eq. (1)).
class BoundarySize final : public SizingField {
 public:
  /// sizes: at points of the boundary, each > 0; not empty.
  /// spacing_mm: no point of the boundary is further from one of them. The field stays as it is that far around them,
  /// so that on the boundary it is nowhere above the sizes, and below by no more than these change over that distance.
  /// bounds_tets: see SizingField.
  BoundarySize(std::vector<Cone> sizes, double spacing_mm, bool bounds_tets);
  double size_at(const Point& p) const override;
  double size_up_to(const Point& p, double most_mm) const override;
  double min_size() const override { return least_mm_; }
  double usual_size() const override { return usual_mm_; }
  bool bounds_tets() const override { return bounds_tets_; }

 private:
  bool bounds_tets_;
  double least_mm_;
  double usual_mm_;
  ConeTree tree_;
};

}  // namespace scantet
