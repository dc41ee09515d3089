// A colour as files have it.
#pragma once

#include <cstdint>

#include "scantet/base/api.h"

namespace SCANTET_API scantet {

/// sRGB, each from 0 to 255.
struct Color {
  std::uint8_t red = 0;
  std::uint8_t green = 0;
  std::uint8_t blue = 0;
  friend bool operator==(const Color&, const Color&) = default;
};

}  // namespace scantet
