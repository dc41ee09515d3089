// Sizes for necks of a domain that are far narrower than the elements around them.
#pragma once

#include <span>
#include <vector>

#include "scantet/domain/domain.h"
#include "scantet/domain/sizing_field.h"

namespace scantet {

/// Halving the size at a handle that is wrong takes one attempt after the other, where a saddle next to the level is
/// hundreds of times narrower than the size. Here it is measured how narrow (Domain::size_hints() tells where).
class NarrowNecks {
 public:
  /// Both must outlive this. size: that was asked for.
  NarrowNecks(const Domain& domain, const SizingField& size) : domain_(domain), size_(size) {}

  /// For each place, world mm, the narrowest neck within one size of it, if there is one under a fiftieth of the size.
  /// Return: whether one of these is new.
  bool add_near(std::span<const Point> places);

  /// Those so far, with sizes at which a few elements go around each.
  const std::vector<FinerPlace>& places() const { return places_; }

 private:
  const Domain& domain_;
  const SizingField& size_;
  std::vector<FinerPlace> places_;
};

}  // namespace scantet
