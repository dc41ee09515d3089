// What the size options of a job mean, as far as that can be told without the input.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "scantet/base/api.h"
#include "scantet/base/tet_mesh.h"
#include "scantet/places/place.h"
#include "scantet/size_options/size_options.h"
#include "scantet/size_options/size_request.h"

namespace SCANTET_PROGRAM_API scantet {

/// How many tets there are to be across parts of regions.
struct LayerRequest {
  int layers = 0;                      ///< 0: not asked for; else at least 2
  std::vector<std::string> regions{};  ///< names or numbers; empty: all
};

/// A size in a place.
struct PlaceSize {
  Place place;  ///< is_of_points()
  double size_mm = 0;
};

/// All sizes that a job asks for.
struct SizePlan {
  SizeRequest inside;
  SizeRequest boundary;
  std::map<Region, double> regions;
  std::map<std::string, double> named_regions{};  ///< of regions that were named
  LayerRequest layers{};
  std::vector<PlaceSize> places{};

  /// Whether one number holds inside, but for regions with a size of their own.
  bool has_one_size_inside() const {
    return inside.kind == SizeRequest::Kind::number || inside.kind == SizeRequest::Kind::unset;
  }
  /// That number, mm; default_mm if none was given.
  double one_size_mm(double default_mm) const {
    return inside.kind == SizeRequest::Kind::number ? inside.size_mm : default_mm;
  }
  /// Whether auto gives the sizes on the boundary: what is asked for there goes before what is asked for inside.
  bool goes_by_shape() const {
    return (boundary.kind == SizeRequest::Kind::unset ? inside : boundary).kind == SizeRequest::Kind::automatic;
  }
  /// Whether regions have sizes of their own.
  bool has_region_sizes() const { return !regions.empty() || !named_regions.empty(); }
  /// Whether a formula or an image gives sizes.
  bool has_source() const {
    return inside.kind == SizeRequest::Kind::source || boundary.kind == SizeRequest::Kind::source;
  }
};

/// Throws Error: as read_size, and usage.region_size, usage.layers, usage.size_where, usage.place.
SizePlan plan_sizes(const SizeOptions& options);

}  // namespace scantet
