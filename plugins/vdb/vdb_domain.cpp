// The queries and the topology are scantet's own, those of images; only where heights come from differs.
#include "vdb_domain.h"

#include <bit>
#include <cstdint>

#include "scantet/base/error.h"
#include "scantet/base/options.h"
#include "scantet/field/at_level_count.h"
#include "scantet/image/trilinear_domain.h"

namespace vdb {
namespace {

using scantet::number_text;

/// The field for the sweeps of the topology; it belongs to the domain, as they do.
template <class Value>
class SparseHeights final : public scantet::HeightGrid {
 public:
  explicit SparseHeights(const SparseField<Value>& field) : HeightGrid(field.size()), field_(field) {}
  double height(int i, int j, int k) const override { return field_.height(i, j, k); }
  scantet::CellHeights corners(int i, int j, int k) const override { return field_.corners(i, j, k); }
  bool row_signs(int j, int k, std::uint64_t* words) const override { return field_.row_signs(j, k, words); }
  bool row_zeros(int j, int k, std::uint64_t* words) const override { return field_.row_zeros(j, k, words); }
  Extreme extreme(int begin, int end, int j, int k, bool highest) const override {
    return field_.extreme(begin, end, j, k, highest);
  }

 private:
  const SparseField<Value>& field_;
};

/// That the level parts the grid's values, and the background is outside.
void check(const Grid& grid, const scantet::LevelSetSettings& settings) {
  scantet::check_level(grid.min_value, grid.max_value, settings);
  const bool above = settings.inside == scantet::InsideSide::above;
  if (above ? grid.background < settings.level : grid.background > settings.level) return;
  throw scantet::Error(scantet::Fault::input, "input.background",
                       "level " + number_text(settings.level) + ": the background of grid " + grid.head.name + ", " +
                           number_text(grid.background) + ", is not outside (inside is " + (above ? "above" : "below") +
                           " the level), so the surface would not close",
                       std::string("choose a level ") + (above ? "above" : "below") + " the background or --inside " +
                           (above ? "below" : "above") + "; scantet convert --outside sets the background");
}

/// Adds the nodes of the tree: leaves and tiles.
template <class Value>
void add_values(const SparseValues<Value>& values, double level, double sign, scantet::AtLevelCount& count) {
  const auto add = [&](Value value, std::int64_t nodes) {
    count.add_value(sign * (static_cast<double>(value) - level), nodes);
  };
  constexpr std::int64_t kNodes = std::int64_t{kBlockSide} * kBlockSide * kBlockSide;
  for (const Tile<Value>& tile : values.tiles) add(tile.value, kNodes * tile.side * tile.side * tile.side);
  for (const Leaf<Value>& leaf : values.leaves) {
    for (std::int64_t n = 0; n < kNodes; ++n) add(leaf.values[n], 1);
  }
}

/// visit(cell) of each cell of the small blocks that have nodes on both sides of the level.
template <class Field, class Visit>
void for_each_mixed_cell(const Field& field, const Visit& visit) {
  field.for_each_mixed_block([&](const Index& block, std::uint64_t mixed) {
    for (; mixed != 0; mixed &= mixed - 1) {
      const int small = std::countr_zero(mixed);
      const Index in_block{small & 3, small >> 2 & 3, small >> 4};
      for (int c = 0; c < 8; ++c) {
        Index cell;
        for (int axis = 0; axis < 3; ++axis) {
          cell[axis] = (block[axis] << kBlockShift) + (in_block[axis] << scantet::kSmallShift) + (c >> axis & 1) - 1;
        }
        visit(cell);
      }
    }
  });
}

}  // namespace

scantet::ValuesAtLevel values_at_level(const Grid& grid, double level, scantet::InsideSide side,
                                       const scantet::Progress& progress) {
  const scantet::LevelSetSettings settings{.level = level, .inside = side};
  check(grid, settings);
  scantet::AtLevelCount count;
  std::visit(
      [&]<class Value>(const SparseValues<Value>& values) {
        add_values(values, level, side == scantet::InsideSide::above ? 1 : -1, count);
        const SparseField<Value> field(values, settings, progress);
        if (progress.cancelled()) return;
        for_each_mixed_cell(field, [&](const Index& at) {
          for (std::size_t axis = 0; axis < 3; ++axis) {
            if (at[axis] < grid.first[axis] || at[axis] >= field.size()[axis]) return;
          }
          count.add_node(at, grid.first, field.size(),
                         [&](int x, int y, int z) { return field.height(at[0] + x, at[1] + y, at[2] + z); });
        });
      },
      grid.values);
  return count.values_at(level, side);
}

std::unique_ptr<scantet::Domain> make_domain(const Grid& grid, const scantet::LevelSetSettings& settings,
                                             const scantet::Progress& progress) {
  check(grid, settings);
  auto domain = std::visit(
      [&]<class Value>(const SparseValues<Value>& values) -> std::unique_ptr<scantet::Domain> {
        using Field = SparseField<Value>;
        return std::make_unique<scantet::TrilinearDomain<Field>>(
            grid.frame, grid.max_value - grid.min_value, Field(values, settings, progress), [&](const Field& field) {
              return scantet::LevelTopology(std::make_unique<SparseHeights<Value>>(field), grid.frame, progress);
            });
      },
      grid.values);
  if (progress.cancelled()) domain.reset();
  return domain;
}

}  // namespace vdb
