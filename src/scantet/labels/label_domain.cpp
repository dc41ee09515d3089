// A query goes to index space, where the cells are unit cubes. region_at looks up whether the block of 2³ cells holds
// one label only, and evaluates the cell's fields only where it does not. crossings walks the segment's cells and skips
// blocks of one label; in a cell each field along the segment is a cubic (region_changes.h).
//
// Agreement with region_at does not hang on rounding, in the same way as in image/trilinear_domain.h: the walk carries
// the region along, from region_at(source), and ends with region_at(target). Where two evaluations of one point in
// neighbouring cells differ, the change is put at that point, where the fields tie to rounding.
#include "scantet/labels/label_domain.h"

#include <algorithm>
#include <cmath>
#include <mutex>

#include "scantet/base/error.h"
#include "scantet/base/options.h"
#include "scantet/base/parallel.h"
#include "scantet/labels/label_grid.h"
#include "scantet/labels/region_changes.h"

namespace scantet {
namespace {

/// Turns the cells of a walk, one by one, into crossings; carries the region along.
class Writer {
 public:
  Writer(const LabelField& field, Crossings& out) : field_(field), out_(out) {}

  /// Begins the walk at a point of a cell.
  void begin(const CellIndex& cell, const Vec& at) { region_ = region_at(cell, at); }

  /// Passes the cells between two points of them, all of one region.
  void pass_uniform(const Vec& entry, Region region) { go_on(entry, region); }

  /// Passes the part of a cell from entry to exit.
  void pass_cell(const CellIndex& cell, const Vec& entry, const Vec& exit) {
    load(cell);
    if (fields_.count == 1) return go_on(entry, fields_.regions[0]);
    const Vec a = local_in(cell, entry);
    const Vec b = local_in(cell, exit);
    find_region_changes(fields_, a, b, region_, along_);
    const Vec corner{double(cell[0]), double(cell[1]), double(cell[2])};
    for (const RegionChange& change : along_.changes) go_on(corner + lerp(a, b, change.t), change.region);
  }

  /// Ends the walk at a point of a cell.
  void end(const CellIndex& cell, const Vec& at) { go_on(at, region_at(cell, at)); }

 private:
  /// As LabelField::region_at(), with the fields at hand.
  Region region_at(const CellIndex& cell, const Vec& index) {
    if (!in_padded_box(index, field_.size())) return kOutside;
    if (!field_.nodes().small_is_mixed(cell)) return field_.region_of_node(cell[0], cell[1], cell[2]);
    load(cell);
    return fields_.region_at(local_in(cell, index));
  }

  void load(const CellIndex& cell) {
    if (is_loaded_ && cell == loaded_) return;
    field_.cell(cell[0], cell[1], cell[2], fields_);
    loaded_ = cell;
    is_loaded_ = true;
  }

  void go_on(const Vec& index, Region region) {
    if (region == region_) return;
    out_.push_back({field_.frame().to_world(index), region_, region});
    region_ = region;
  }

  const LabelField& field_;
  Region region_ = kOutside;
  Crossings& out_;
  LabelCell fields_;
  CellIndex loaded_{};  // whose fields these are
  bool is_loaded_ = false;
  RegionsAlong along_;
};

/// Points where lines parallel to the axes cross interfaces: the lines that cut each cell into divisions[0] ×
/// divisions[1] × divisions[2] boxes. A line on faces belongs to the cell that has it on its lower faces, so no point
/// comes twice.
class InterfaceScan {
 public:
  InterfaceScan(const LabelField& field, const std::array<int, 3>& divisions) : field_(field), divisions_(divisions) {}

  /// Scans rows of blocks side by side, a batch at a time, and feeds the sink in order.
  void run(const PointSink& sink) const {
    constexpr std::size_t kBatch = 32;
    const std::array<int, 3>& blocks = field_.nodes().block_counts();
    const auto rows = static_cast<std::size_t>(blocks[1]) * static_cast<std::size_t>(blocks[2]);
    std::array<std::vector<Point>, kBatch> found;
    for (std::size_t begin = 0; begin < rows; begin += kBatch) {
      const std::size_t count = std::min(kBatch, rows - begin);
      parallel_for(count, 1, [&](std::size_t job, std::size_t) {
        const auto row = static_cast<int>(begin + job);
        found[job].clear();
        scan_row(row % blocks[1], row / blocks[1], found[job]);
      });
      for (std::size_t job = 0; job < count; ++job) {
        for (const Point& point : found[job]) sink(point);
      }
    }
  }

 private:
  void scan_row(int y, int z, std::vector<Point>& out) const {
    const auto first_cell = [](int block) { return (block << kFineShift) - 1; };
    for (int x = 0; x < field_.nodes().block_counts()[0]; ++x) {
      const CellIndex first{first_cell(x), first_cell(y), first_cell(z)};
      if (field_.nodes().fine_is_mixed(first)) scan_block(first, out);
    }
  }

  void scan_block(const CellIndex& first, std::vector<Point>& out) const {
    CellIndex end;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      end[axis] = std::min(first[axis] + (1 << kFineShift), field_.size()[axis]);
    }
    LabelCell cell;
    RegionsAlong along;
    for (int k = first[2]; k < end[2]; ++k) {
      for (int j = first[1]; j < end[1]; ++j) {
        for (int i = first[0]; i < end[0]; ++i) {
          if (!field_.is_mixed(i, j, k)) continue;
          field_.cell(i, j, k, cell);
          for (int axis = 0; axis < 3; ++axis) scan_cell({i, j, k}, cell, axis, along, out);
        }
      }
    }
  }

  void scan_cell(const CellIndex& at, const LabelCell& cell, int axis, RegionsAlong& along,
                 std::vector<Point>& out) const {
    const int u = (axis + 1) % 3;
    const int v = (axis + 2) % 3;
    const auto divisions = [&](int n) { return divisions_[static_cast<std::size_t>(n)]; };
    const Vec corner{double(at[0]), double(at[1]), double(at[2])};
    for (int m = 0; m < divisions(v); ++m) {
      for (int n = 0; n < divisions(u); ++n) {
        Vec low;
        low[u] = static_cast<double>(n) / divisions(u);
        low[v] = static_cast<double>(m) / divisions(v);
        Vec high = low;
        high[axis] = 1;
        find_region_changes(cell, low, high, cell.region_at(low), along);
        for (const RegionChange& change : along.changes) {
          out.push_back(field_.frame().to_world(corner + lerp(low, high, change.t)));
        }
      }
    }
  }

  const LabelField& field_;
  std::array<int, 3> divisions_;
};

class LabelDomain final : public Domain {
 public:
  LabelDomain(std::shared_ptr<const LabelField> field, LabelDomainParts parts)
      : field_(std::move(field)), parts_(std::move(parts)) {
    for (const GridPart& part : small_parts(*field_, kSmallPart)) hints_.push_back(hint_of(part));
  }

  Box bounds() const override {
    const auto& size = field_->size();
    return field_->frame().world_box({-1, -1, -1}, {double(size[0]), double(size[1]), double(size[2])});
  }

  Region region_at(const Point& p) const override { return field_->region_at(field_->frame().to_index(p)); }

  void crossings(const Segment& segment, Crossings& out) const override {
    out.clear();
    const auto& size = field_->size();
    Vec from = field_->frame().to_index(segment.source);
    Vec to = field_->frame().to_index(segment.target);
    // An end that is cut off lies on the box, where all is outside, as the end itself is.
    const bool whole = in_padded_box(from, size) && in_padded_box(to, size);
    if (!whole && !clip_to_padded_box(from, to, size)) return;
    const CellIndex first = cell_of(from, size);
    const CellIndex last = cell_of(to, size);
    const LabelNodes& nodes = field_->nodes();
    if (first == last ? !nodes.small_is_mixed(last) : !nodes.mixed_between(first, last)) return;
    Writer writer(*field_, out);
    writer.begin(first, from);
    if (first == last) {
      writer.pass_cell(last, from, to);
    } else {
      for (CellWalk walk(from, to, size);; walk.advance()) {
        pass(walk, writer);
        if (walk.last()) break;
      }
    }
    writer.end(last, to);
  }

  void surface_candidates(double spacing_mm, const PointSink& sink) const override {
    std::array<int, 3> divisions;
    for (int axis = 0; axis < 3; ++axis) {
      const double lines = std::ceil(field_->frame().spacing_mm(axis) / spacing_mm);
      if (!(spacing_mm > 0 && lines <= kMostDivisions)) {
        throw Error(Fault::usage, "usage.spacing",
                    "a spacing of " + number_text(spacing_mm) + " mm between surface points",
                    "ask for more than " + number_text(field_->frame().spacing_mm(axis) / kMostDivisions) + " mm");
      }
      divisions[static_cast<std::size_t>(axis)] = std::max(1, static_cast<int>(lines));
    }
    InterfaceScan(*field_, divisions).run(sink);
  }

  void size_hints(const SizeHintSink& sink) const override {
    for (const SizeHint& hint : hints_) sink(hint);
  }

  Patch patch_at(const Point& p) const override {
    const auto [first, second] = two_largest(p);
    if (second.region == first.region) return Domain::patch_at(p);
    return {{std::min(first.region, second.region), std::max(first.region, second.region)}, {}};
  }

  std::vector<std::shared_ptr<const Curve>> curves() const override { return with_junctions().curves; }
  std::vector<Corner> corners() const override { return with_junctions().corners; }

  std::string name_of_region(Region region) const override {
    const auto name = parts_.names.find(region);
    return name == parts_.names.end() ? std::string() : name->second;
  }

  std::optional<double> residual_at(const Point& p) const override {
    const auto [first, second] = two_largest(p);
    return second.region == first.region ? 1 : first.value - second.value;
  }

 private:
  const LabelDomainParts& with_junctions() const {
    if (parts_.trace) {
      std::call_once(is_traced_, [&] {
        Junctions traced = parts_.trace();
        parts_.curves = std::move(traced.curves);
        parts_.corners = std::move(traced.corners);
      });
    }
    return parts_;
  }

  /// As large as a ball of its nodes, if the boundary is not nearer: smoothing leaves little more of some parts than
  /// the centres of their voxels.
  SizeHint hint_of(const GridPart& part) const {
    constexpr double kSmallestRadius = 0.05;  // of the smallest spacing
    const Frame& frame = field_->frame();
    const Vec index{double(part.node[0]), double(part.node[1]), double(part.node[2])};
    const Point middle = frame.to_world(index);
    double radius_mm = 0.5 * frame.min_spacing_mm() * std::cbrt(static_cast<double>(part.nodes));
    Crossings along;
    for (int axis = 0; axis < 3; ++axis) {
      for (const double step : {-1.0, 1.0}) {
        crossings({middle, middle + step * frame.column(axis)}, along);
        if (!along.empty()) radius_mm = std::min(radius_mm, distance(middle, along.front().point));
      }
    }
    return {middle, std::max(radius_mm, kSmallestRadius * frame.min_spacing_mm())};
  }

  static constexpr std::uint64_t kSmallPart = 64;  // nodes: a sample made for the size may miss such parts
  static constexpr int kMostDivisions = 1000;      // lines per voxel: far below any feature of a trilinear field

  struct Ranked {
    Region region;
    double value;
  };

  /// The two largest fields at p; twice the same one if there is no other.
  std::array<Ranked, 2> two_largest(const Point& p) const {
    const Vec index = field_->frame().to_index(p);
    if (!in_padded_box(index, field_->size())) return {Ranked{kOutside, 1}, Ranked{kOutside, 1}};
    const CellIndex at = cell_of(index, field_->size());
    LabelCell cell;
    field_->cell(at[0], at[1], at[2], cell);
    const Vec u = local_in(at, index);
    Ranked first{cell.regions[0], trilinear(cell.values[0], u)};
    Ranked second = first;
    for (std::size_t i = 1; i < cell.count; ++i) {
      const Ranked next{cell.regions[i], trilinear(cell.values[i], u)};
      if (next.value > first.value) {
        second = std::exchange(first, next);
      } else if (second.region == first.region || next.value > second.value) {
        second = next;
      }
    }
    return {first, second};
  }

  // The walk's cell, or the largest block of one label around it.
  void pass(CellWalk& walk, Writer& writer) const {
    const CellIndex& cell = walk.cell();
    const LabelNodes& nodes = field_->nodes();
    if (!nodes.fine_is_mixed(cell)) {
      const Region region = field_->region_of_node(cell[0], cell[1], cell[2]);
      walk.find_exit_of_block(nodes.coarse_is_mixed(cell) ? kFineShift : kCoarseShift);
      return writer.pass_uniform(walk.entry(), region);
    }
    walk.find_exit();
    if (!nodes.small_is_mixed(cell)) {
      return writer.pass_uniform(walk.entry(), field_->region_of_node(cell[0], cell[1], cell[2]));
    }
    writer.pass_cell(cell, walk.entry(), walk.exit());
  }

  std::shared_ptr<const LabelField> field_;
  mutable LabelDomainParts parts_;  // its curves and corners, if they are traced here
  mutable std::once_flag is_traced_;
  std::vector<SizeHint> hints_;  // of small parts; asked for again each time that a mesh is made
};

}  // namespace

std::unique_ptr<Domain> make_label_domain(std::shared_ptr<const LabelField> field, LabelDomainParts parts) {
  return std::make_unique<LabelDomain>(std::move(field), std::move(parts));
}

}  // namespace scantet
