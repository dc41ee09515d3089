// Leaves are made one by one, a layer of them at a time; those of one value become tiles. OpenVDB does not tell when
// the disk is full: what it wrote is looked at before it gets its name.
#include "vdb_writer.h"

#include <openvdb/tools/Prune.h>

#include <algorithm>
#include <cmath>
#include <sstream>
#include <type_traits>

#include "scantet/base/error.h"
#include "scantet/base/options.h"
#include "scantet/base/version.h"
#include "scantet/io/atomic_file.h"
#include "vdb_file.h"

namespace vdb {
namespace {

using openvdb::Coord;

constexpr const char* kName = "density";

/// The voxels of one leaf; null if all are background and none is the first or the last of the scan.
template <class Leaf, class Voxel>
std::unique_ptr<Leaf> make_leaf(const scantet::Scan& scan, const Voxel* voxels, const Coord& first,
                                typename Leaf::ValueType background) {
  const std::array<int, 3>& size = scan.size;
  const Coord last(size[0] - 1, size[1] - 1, size[2] - 1);
  auto leaf = std::make_unique<Leaf>(first, background, false);
  const openvdb::CoordBBox box(first, Coord::minComponent(first.offsetBy(Leaf::DIM - 1), last));
  for (int k = box.min().z(); k <= box.max().z(); ++k) {
    for (int j = box.min().y(); j <= box.max().y(); ++j) {
      const Voxel* row = voxels + (std::int64_t{k} * size[1] + j) * size[0];
      for (int i = box.min().x(); i <= box.max().x(); ++i) {
        const auto value = static_cast<typename Leaf::ValueType>(row[i]);
        if (value != background) leaf->setValueOn(Coord(i, j, k), value);
      }
    }
  }
  if (box.isInside(Coord(0, 0, 0))) leaf->setActiveState(Coord(0, 0, 0), true);
  if (box.isInside(last)) leaf->setActiveState(last, true);
  return leaf->isEmpty() ? nullptr : std::move(leaf);
}

/// The constructors of Transform turn a matrix into the simplest map near it, whose steps differ in the last digits.
/// One that is read stays as it is.
openvdb::math::Transform::Ptr transform_of(const scantet::Frame& frame) {
  openvdb::Mat4d m = openvdb::Mat4d::identity();
  for (int axis = 0; axis < 3; ++axis) {
    for (int n = 0; n < 3; ++n) m(axis, n) = frame.column(axis)[n];
    m(3, axis) = frame.origin()[axis];
  }
  std::stringstream bytes;
  openvdb::io::setCurrentVersion(bytes);
  openvdb::writeString(bytes, openvdb::math::AffineMap::mapType());
  openvdb::math::AffineMap(m).write(bytes);
  auto transform = std::make_shared<openvdb::math::Transform>();
  transform->read(bytes);
  return transform;
}

/// Null if cancelled.
template <class GridType, class Voxel>
openvdb::GridBase::Ptr make_grid(const scantet::Scan& scan, const Voxel* voxels, double background,
                                 scantet::Progress& progress) {
  using Tree = typename GridType::TreeType;
  using Leaf = typename Tree::LeafNodeType;
  const auto value = static_cast<typename Tree::ValueType>(background);
  auto grid = GridType::create(value);
  constexpr int kSide = Leaf::DIM;
  for (int k = 0; k < scan.size[2]; k += kSide) {
    if (progress.cancelled()) return nullptr;
    for (int j = 0; j < scan.size[1]; j += kSide) {
      for (int i = 0; i < scan.size[0]; i += kSide) {
        if (auto leaf = make_leaf<Leaf>(scan, voxels, Coord(i, j, k), value)) grid->tree().addLeaf(leaf.release());
      }
    }
  }
  openvdb::tools::prune(grid->tree());
  grid->setName(kName);
  grid->setTransform(transform_of(scan.frame));
  grid->setCreator(std::string("scantet ") + scantet::kVersion);
  return grid;
}

/// Throws usage.outside.
double background_of(const scantet::Scan& scan, const std::optional<double>& outside, bool as_float) {
  const double value = outside.value_or(scan.min_value);
  if (!as_float || std::isfinite(static_cast<float>(value))) return value;
  throw scantet::Error(scantet::Fault::usage, "usage.outside",
                       "--outside: " + scantet::number_text(value) + " is too large for the grid, which holds floats",
                       "choose a value near those of the scan, from " + scantet::number_text(scan.min_value) + " to " +
                           scantet::number_text(scan.max_value));
}

void write_grid(const openvdb::GridBase::Ptr& grid, const std::string& file) {
  scantet::AtomicFile out(file);
  try {
    openvdb::io::File(out.part_path()).write({grid});
    check_complete(out.part_path());
  } catch (const std::exception& error) {
    if (const int reason = out.append_error(); reason != 0) scantet::throw_output_error(file, reason);
    throw scantet::Error(scantet::Fault::output, "output.cannot_write", file + ": " + error.what(),
                         "write to another folder");
  }
  out.commit();
}

}  // namespace

bool write_scan(const scantet::Scan& scan, const std::optional<double>& outside, const std::string& file,
                scantet::Progress& progress) {
  openvdb::initialize();
  const auto grid = std::visit(
      [&]<class Voxel>(const Voxel* voxels) {
        constexpr bool kAsFloat = std::is_same_v<Voxel, float> || sizeof(Voxel) <= 2;
        using GridType = std::conditional_t<kAsFloat, openvdb::FloatGrid, openvdb::DoubleGrid>;
        return make_grid<GridType>(scan, voxels, background_of(scan, outside, kAsFloat), progress);
      },
      scan.voxels);
  if (grid == nullptr) return false;
  progress.report({"write", {}, 0, std::nullopt, 0});
  write_grid(grid, file);
  return true;
}

}  // namespace vdb
