// A sizing field on a grid, made 1-Lipschitz.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "scantet/base/progress.h"
#include "scantet/domain/domain.h"
#include "scantet/domain/sizing_field.h"
#include "scantet/sizing/size_source.h"

namespace scantet {

/// The nodes of a grid with cubic cells along the world axes.
struct GridShape {
  Point corner;                       ///< node (0, 0, 0), world mm
  double step_mm = 1;                 ///< between neighbours
  std::array<int, 3> nodes{2, 2, 2};  ///< along each axis, from 2 to 32767

  std::size_t count() const {
    return static_cast<std::size_t>(nodes[0]) * static_cast<std::size_t>(nodes[1]) * static_cast<std::size_t>(nodes[2]);
  }
  std::size_t index(int i, int j, int k) const {
    return (static_cast<std::size_t>(k) * static_cast<std::size_t>(nodes[1]) + static_cast<std::size_t>(j)) *
               static_cast<std::size_t>(nodes[0]) +
           static_cast<std::size_t>(i);
  }
  Point at(int i, int j, int k) const { return corner + step_mm * Vec{double(i), double(j), double(k)}; }
};

/// The grid that covers the box with steps of step_mm, or with the least steps for which most_nodes will do.
GridShape grid_over(const Box& box, double step_mm, std::size_t most_nodes);

/// Makes the sizes at the nodes 1-Lipschitz: σ'(x) = min over the nodes y of σ(y) + |x - y|, the largest 1-Lipschitz
/// function that is nowhere above σ (paper, section 7.1). sizes: one per node, > 0; infinity: none. Several threads;
/// the outcome does not depend on how many. Guarantees, unless progress.cancelled() became true: at no node is the
/// result below that minimum by more than float rounding, nor above it by more than a tenth of a step.
void make_lipschitz(const GridShape& shape, std::vector<float>& sizes, const Progress& progress = Progress());

/// Trilinear between the nodes of a grid; beyond the grid, the size is that at the nearest point of it.
class SizeGrid final : public SizingField {
 public:
  /// sizes: one per node, finite, > 0, as make_lipschitz leaves them. usual_mm: see SizingField.
  SizeGrid(const GridShape& shape, std::vector<float> sizes, double usual_mm);
  double size_at(const Point& p) const override;
  double min_size() const override { return least_mm_; }
  double usual_size() const override { return std::max(usual_mm_, least_mm_); }

  double step_mm() const { return shape_.step_mm; }
  /// How far size_at is from what was sampled, at most: over the way from a point to the nodes of its cell, in the
  /// weighted mean, a 1-Lipschitz function changes by no more than that.
  double error_mm() const;

 private:
  GridShape shape_;
  std::vector<float> sizes_;
  double usual_mm_;
  double least_mm_;
};

/// How make_size_grid samples.
struct SizeGridOptions {
  double least_mm = 0;    ///< smaller sizes are raised to that
  double longest_mm = 0;  ///< > 0: larger sizes count as that
  std::string place;      ///< opens the messages: "--size"
  std::string text;       ///< what was given there
};

/// The source's sizes on a grid over the domain, made 1-Lipschitz. Outside of the domain a node takes the size of the
/// nearest point of the boundary. A step is about a hundredth of the domain (a million nodes), or less if the source is
/// finer (up to sixteen million nodes). Throws Error: usage.size (a size is not greater than 0, or not a number: says
/// where). Null if cancelled. The same for any number of threads.
std::shared_ptr<const SizeGrid> make_size_grid(const Domain& domain, const SizeSource& source,
                                               const SizeGridOptions& options, Progress& progress);

}  // namespace scantet
