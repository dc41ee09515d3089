// What a size means, as typed, as far as that can be told without the input.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "scantet/base/api.h"
#include "scantet/sizing/size_source.h"

namespace SCANTET_PROGRAM_API scantet {

/// One size as typed, read as far as that goes without the input.
struct SizeRequest {
  enum class Kind { unset, number, automatic, source } kind = Kind::unset;
  std::string option;                        ///< "--size"
  std::string text;                          ///< as typed
  double size_mm = 0;                        ///< of a number
  std::shared_ptr<const SizeSource> source;  ///< a formula; none yet for an image
  std::string image;                         ///< the file, for an image
};

/// The number that a text is, whole; none if it is not one.
std::optional<double> number_in(const std::string& text);

/// Throws Error: usage.size (not a size of any kind), usage.formula. place: opens the messages, "--size".
SizeRequest read_size(const std::string& place, const std::string& text);

}  // namespace scantet
