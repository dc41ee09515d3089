// Sizes by a formula.
#pragma once

#include <string>

#include "scantet/sizing/size_source.h"

namespace scantet {

/// A formula in x, y, z (world mm), d (distance to the boundary, mm) and region (its number).
class SizeFormula final : public SizeSource {
 public:
  /// text: as muParser reads it: numbers, the variables, pi, + - * / ^, comparisons, && and ||, "c ? a : b", and
  /// functions such as min, max, abs, sqrt, exp, ln, sin.
  /// place: opens the messages, "--size". Throws Error: usage.formula, with the character at which the mistake is.
  SizeFormula(std::string text, const std::string& place);
  void sizes_at(std::span<const SizePlace> places, std::span<double> sizes) const override;
  bool needs_depth() const override { return needs_depth_; }

 private:
  std::string text_;
  bool needs_depth_ = false;
};

}  // namespace scantet
