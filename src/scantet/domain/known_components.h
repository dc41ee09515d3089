// Components of a domain that does not know all of its components.
#pragma once

#include <utility>
#include <vector>

#include "scantet/domain/domain.h"

namespace scantet {

/// What a Domain is beside, if it knows some of its components and cavities where Domain::components() is empty, as of
/// an object whose others a plane cuts.
class KnownComponents {
 public:
  virtual ~KnownComponents() = default;

  /// Whole components and cavities, which the patches of crossings tell apart. Those that it lacks may be any.
  virtual std::vector<Component> known_components() const = 0;
};

/// Components and cavities of a domain, and whether it has no others.
struct ComponentList {
  std::vector<Component> components;
  bool are_all = false;
};

/// All of them; of a domain that does not know all, those that it knows.
inline ComponentList known_components(const Domain& domain) {
  std::vector<Component> all = domain.components();
  if (!all.empty()) return {std::move(all), true};
  const auto* const some = dynamic_cast<const KnownComponents*>(&domain);
  return {some == nullptr ? std::vector<Component>() : some->known_components(), false};
}

}  // namespace scantet
