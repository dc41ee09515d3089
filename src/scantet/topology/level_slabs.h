// A level set's components found in slabs of layers, side by side, and the slabs sewn together.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "scantet/base/progress.h"
#include "scantet/field/run_sweep.h"
#include "scantet/topology/component_measure.h"
#include "scantet/topology/level_joins.h"
#include "scantet/topology/surface_list.h"

namespace scantet {

/// Calls visit(begin, end, j, k, side, label) for every run of nodes of the image, begin ≤ i < end, in the last layer
/// of a sweep. side: as in RunLayer.
template <class Visit>
void visit_layer(const HeightGrid& heights, const RunSweep& sweep, const Visit& visit) {
  if (sweep.k() < 0 || sweep.k() == heights.size()[2]) return;
  const RunLayer& layer = sweep.layer();
  for (int row = 1; row <= heights.size()[1]; ++row) {
    for (std::uint32_t run = layer.row_begin[row]; run < layer.row_begin[row + 1]; ++run) {
      const int begin = std::max(layer.start[run] - 1, 0);
      const int end = std::min(layer.end_of(row, run) - 1, heights.size()[0]);
      if (begin < end) visit(begin, end, row - 1, sweep.k(), layer.side[run], layer.label[run]);
    }
  }
}

/// The same in the layers from `first` up to, but not including, `last`, until cancelled.
template <class Visit>
void visit_runs(const HeightGrid& heights, int first, int last, const Progress& progress, const Visit& visit) {
  RunSweep sweep(heights, first, last - 1);
  while (!progress.cancelled() && sweep.advance(nullptr)) visit_layer(heights, sweep, visit);
}

/// The layers first … last of nodes by themselves. The last is the first of the slab above: there the two are sewn.
struct LevelSlab {
  int first = 0;
  int last = 0;
  std::vector<std::uint32_t> number_of;    // of each label of a sweep: its part, a component within the slab
  std::vector<std::uint32_t> first_parts;  // of each run of the first layer
  std::vector<std::uint32_t> last_parts;
  std::vector<LevelContact> contacts;  // in the first and the last layer, with parts for labels
  std::vector<Measure> measures;  // of each part without the last layer; part 0 is joined to the padding: not measured

  SurfaceList surfaces;    // of each surface in the slab, the parts on its two sides
  bool has_zeros = false;  // nodes at the level

  /// Numbers the parts and finds the contacts.
  void join(const HeightGrid& heights, const Progress& progress);
  /// Measures the parts and lists the surfaces. Pre: joined.
  void measure(const HeightGrid& heights, const Progress& progress);
};

/// Slabs of fixed height, joined and measured side by side; of no use once progress.cancelled() became true.
std::vector<LevelSlab> make_level_slabs(const HeightGrid& heights, const Progress& progress);

/// Sews the slabs together: the parts in their number_of and surfaces become components, of which 0 is the unbounded
/// outside. Return: the measure of each component.
std::vector<Measure> sew(std::vector<LevelSlab>& slabs);

}  // namespace scantet
