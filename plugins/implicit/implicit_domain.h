// The points of a box where a formula is negative.
#pragma once

#include <memory>
#include <string>

#include "creases.h"
#include "formula_grid.h"
#include "scantet/base/progress.h"
#include "scantet/domain/domain.h"

namespace implicit {

/// Inside (region 1) is where the formula is negative.
class ImplicitDomain final : public scantet::Domain {
 public:
  /// box: not empty, finite, mm. Samples the formula at 33 x 33 x 33 points of the box, and proves by interval
  /// arithmetic that it is positive on the faces.
  /// Throws scantet::Error: input.formula (not finite at one of the points), input.bounds (the object meets a face, or
  /// comes so near that the proof fails), input.empty (none of the points is inside). Nothing may be asked of it once
  /// progress.cancelled() became true.
  ImplicitDomain(Formula formula, const scantet::Box& box, const scantet::Progress& progress = scantet::Progress());

  scantet::Box bounds() const override { return box_; }
  scantet::Region region_at(const scantet::Point& p) const override;
  void crossings(const scantet::Segment& segment, scantet::Crossings& out) const override;
  /// The creases that it is to have.
  void set_creases(Creases creases) { creases_ = std::move(creases); }
  std::vector<std::shared_ptr<const scantet::Curve>> curves() const override { return creases_.curves; }
  std::vector<scantet::Corner> corners() const override { return creases_.corners; }
  /// There is but one.
  scantet::Patch patch_at(const scantet::Point&) const override { return {{scantet::kOutside, 1}, {}}; }
  std::optional<double> residual_at(const scantet::Point& p) const override;

  /// The least and the greatest value at the points sampled.
  const Interval& sampled_values() const { return sampled_; }

 private:
  void sample(const scantet::Progress& progress);
  void prove_closed(const scantet::Progress& progress) const;

  Formula formula_;
  scantet::Box box_;
  Interval sampled_;
  FormulaGrid grid_;
  Creases creases_;
};

}  // namespace implicit
