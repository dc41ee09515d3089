// Private: evens out a sample of the boundary.
#pragma once

#include <span>

#include "scantet/domain/domain.h"
#include "scantet/sampling/dart_throwing_impl.h"

namespace scantet::engine {

/// Lets the points push their neighbours away along the boundary for a few moves. That takes a random sample, whose
/// facets are of all shapes, halfway to a regular one: fewer balls are large, fewer facets have small angles. Points
/// stay on the boundary. Several threads; the same bits for any number of them.
void relax_sample(const Domain& domain, std::span<Dart> sample);

}  // namespace scantet::engine
