// Grids for tests, and the files they are written to.
#pragma once

#include <openvdb/openvdb.h>
#include <openvdb/tools/LevelSetSphere.h>

#include <cmath>
#include <string>

#include "temporary_file.h"

namespace scantet::test {

inline void write_grids(const std::string& file, const openvdb::GridPtrVec& grids) {
  openvdb::io::File(file).write(grids);
}

/// A level set of a sphere of radius 11.3 voxels around (2.5, -30.25, 7), 0.8 mm each.
inline openvdb::FloatGrid::Ptr sphere_grid() {
  openvdb::initialize();
  auto grid =
      openvdb::tools::createLevelSetSphere<openvdb::FloatGrid>(9.04F, openvdb::Vec3f(2.0F, -24.2F, 5.6F), 0.8F, 3.0F);
  grid->setName("sphere");
  return grid;
}

inline openvdb::math::Transform::Ptr oblique_transform() {
  openvdb::Mat4d m = openvdb::Mat4d::identity();
  const double rows[4][3] = {{0.7, 0.4, 0}, {-0.5, 1.1, 0.1}, {0.3, -0.2, -2.1}, {-310, 420, -150}};
  for (int i = 0; i < 4; ++i) {
    for (int j = 0; j < 3; ++j) m(i, j) = rows[i][j];
  }
  return openvdb::math::Transform::Ptr(
      new openvdb::math::Transform(openvdb::math::MapBase::Ptr(new openvdb::math::AffineMap(m))));
}

/// A fog volume: a lattice of blobs that are 1 in the middle and 0 from 9 voxels on, in an oblique, sheared, mirrored
/// frame; with an active tile of 8³ voxels that are 0.7, and one of 128³ beside it.
template <class GridType = openvdb::FloatGrid>
typename GridType::Ptr fog_grid(double scale = 1) {
  openvdb::initialize();
  using Value = typename GridType::ValueType;
  auto grid = GridType::create(Value(0));
  auto to = grid->getAccessor();
  for (const openvdb::Coord& centre :
       {openvdb::Coord(-20, 4, 3), openvdb::Coord(-9, 5, -2), openvdb::Coord(3, 30, 11)}) {
    for (int i = -9; i <= 9; ++i) {
      for (int j = -9; j <= 9; ++j) {
        for (int k = -9; k <= 9; ++k) {
          const auto value = static_cast<Value>(scale * (1 - std::sqrt(i * i + j * j + k * k) / 9));
          const openvdb::Coord at = centre.offsetBy(i, j, k);
          if (value > to.getValue(at)) to.setValueOn(at, value);
        }
      }
    }
  }
  const auto tile = static_cast<Value>(0.7 * scale);
  grid->tree().addTile(1, openvdb::Coord(-8, 64, 16), tile, true);
  grid->tree().addTile(2, openvdb::Coord(128, 0, 0), tile, true);
  grid->setGridClass(openvdb::GRID_FOG_VOLUME);
  grid->setTransform(oblique_transform());
  grid->setName("fog");
  return grid;
}

}  // namespace scantet::test
