// A curve along which two smooth parts of a formula vanish.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "scantet/domain/curve.h"
#include "sign_tree.h"

namespace implicit {

/// The point nearest to `start`, about, where two or three parts vanish; nullopt if Newton's method does not lead there
/// within reach_mm.
std::optional<scantet::Point> settled(const SignTree& tree, const std::vector<std::size_t>& parts,
                                      const scantet::Point& start, double reach_mm);

/// Its arc lengths and corners are those of a polyline beside it, its points are found by Newton's method from there.
class CreaseCurve final : public scantet::Curve {
 public:
  /// parts: two. course: no farther from the curve than reach_mm, its ends at corners if it has any.
  CreaseCurve(std::shared_ptr<const SignTree> tree, std::vector<std::size_t> parts, scantet::PolylineCurve course,
              double reach_mm)
      : tree_(std::move(tree)), parts_(std::move(parts)), course_(std::move(course)), reach_mm_(reach_mm) {}

  double length_mm() const override { return course_.length_mm(); }
  scantet::Point at(double along_mm) const override;
  Nearest nearest(const scantet::Point& p) const override;
  std::vector<scantet::Region> regions() const override { return course_.regions(); }
  std::optional<std::array<std::size_t, 2>> corners() const override { return course_.corners(); }

 private:
  bool is_end(double along_mm) const { return course_.corners() && (along_mm <= 0 || along_mm >= length_mm()); }

  std::shared_ptr<const SignTree> tree_;
  std::vector<std::size_t> parts_;
  scantet::PolylineCurve course_;
  double reach_mm_;
};

}  // namespace implicit
