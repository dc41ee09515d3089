// What the size options of a job mean, as far as that can be told without the input.
#pragma once

#include <map>
#include <memory>
#include <string>

#include "scantet/app/size_options.h"
#include "scantet/sizing/size_source.h"

namespace scantet {

/// One size as typed, read as far as that goes without the input.
struct SizeRequest {
  enum class Kind { unset, number, automatic, source } kind = Kind::unset;
  std::string option;                        ///< "--size"
  std::string text;                          ///< as typed
  double size_mm = 0;                        ///< of a number
  std::shared_ptr<const SizeSource> source;  ///< a formula; none yet for an image
  std::string image;                         ///< the file, for an image
};

/// Throws Error: usage.size (not a size of any kind), usage.formula. place: opens the messages, "--size".
SizeRequest read_size(const std::string& place, const std::string& text);

/// All of them.
struct SizePlan {
  SizeRequest inside;
  SizeRequest boundary;
  std::map<Region, double> regions;

  /// Whether auto gives the sizes on the boundary: what is asked for there goes before what is asked for inside.
  bool goes_by_shape() const {
    return (boundary.kind == SizeRequest::Kind::unset ? inside : boundary).kind == SizeRequest::Kind::automatic;
  }
  /// Whether a formula or an image gives sizes.
  bool has_source() const {
    return inside.kind == SizeRequest::Kind::source || boundary.kind == SizeRequest::Kind::source;
  }
};

/// Throws Error: as read_size, and usage.region_size.
SizePlan plan_sizes(const SizeOptions& options);

}  // namespace scantet
