// A formula as smooth functions under min and max: which of them is the object's surface where.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "formula.h"
#include "scantet/base/geometry.h"

namespace implicit {

/// A smooth part of a formula with its slope.
struct SurfaceValue {
  double value;
  scantet::Vec slope;
};

/// A formula whose min, max and abs have been brought to the outside, over sums of smooth terms: "max(abs(x), y) - 1"
/// becomes the largest of x - 1, -x - 1 and y - 1. Kinks within other operations stay in the parts.
class SignTree {
 public:
  /// Throws scantet::Error (input.formula): more than 32 parts, or one too long to be computed.
  explicit SignTree(const std::string& text);

  /// How many smooth parts there are; parts that differ in sign alone are one.
  std::size_t parts() const { return parts_.size(); }
  double value(std::size_t part, const scantet::Point& p) const { return parts_[part](p.x, p.y, p.z); }
  SurfaceValue at(std::size_t part, const scantet::Point& p) const;

  /// Whether the formula is negative where the parts' signs are these: negative[n] of part n.
  bool is_inside(const std::vector<char>& negative) const { return is_inside(nodes_.size() - 1, negative); }
  /// Whether that depends on both of two parts, the others' signs being as they are.
  bool depends_on(std::size_t a, std::size_t b, std::vector<char> negative) const;
  /// 1 if being inside comes with a negative value of part a, where it depends on it and on b; else -1.
  int side_of(std::size_t a, std::size_t b, std::vector<char> negative) const;

 private:
  struct Node {
    bool is_part = false;
    bool is_max = false;    ///< else the smaller of first and second
    std::size_t first = 0;  ///< a node, or a part
    std::size_t second = 0;
    bool flipped = false;  ///< the part's sign is the other one
  };
  struct Summand {
    double factor;
    std::size_t term;
    friend bool operator==(const Summand&, const Summand&) = default;
  };
  using Sum = std::vector<Summand>;

  std::size_t build(const Terms& terms, Sum sum);
  /// Replaces a summand by what it is made of; nullopt if it is smooth.
  std::optional<std::size_t> take_apart(const Terms& terms, Sum& sum, std::size_t at);
  std::size_t part_of(const Terms& terms, Sum sum);
  bool is_inside(std::size_t node, const std::vector<char>& negative) const;

  std::vector<Node> nodes_;  // the root is the last
  std::size_t depth_ = 0;    // of build() in itself
  std::vector<Sum> sums_;    // of each part
  std::vector<Formula> parts_;
};

}  // namespace implicit
