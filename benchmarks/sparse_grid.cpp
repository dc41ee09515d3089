// Writes a .vdb file that is huge and nearly empty: a cube of EXTENT voxels of 1 mm with a ball in the middle, of a
// tenth of its edge in radius, and a small one in each corner; level sets in a narrow band of three voxels.
//
//   sparse_grid EXTENT FILE       e.g. sparse_grid 4096 balls.vdb
#include <openvdb/openvdb.h>
#include <openvdb/tools/Composite.h>
#include <openvdb/tools/LevelSetSphere.h>

#include <cstdio>
#include <cstdlib>
#include <exception>

int main(int argc, char** argv) {
  const double extent = argc == 3 ? std::atof(argv[1]) : 0;
  if (!(extent >= 256)) {
    std::fputs("usage: sparse_grid EXTENT FILE, with an extent of at least 256 voxels\n", stderr);
    return 2;
  }
  try {
    openvdb::initialize();
    const auto ball = [](double radius, const openvdb::Vec3d& centre) {
      return openvdb::tools::createLevelSetSphere<openvdb::FloatGrid>(static_cast<float>(radius),
                                                                      openvdb::Vec3f(centre), 1.0F, 3.0F);
    };
    const double small = 48;
    auto grid = ball(extent / 10, openvdb::Vec3d(extent / 2));
    for (int corner = 0; corner < 8; ++corner) {
      openvdb::Vec3d centre;
      for (int axis = 0; axis < 3; ++axis) centre[axis] = corner >> axis & 1 ? extent - small - 4 : small + 4;
      openvdb::tools::csgUnion(*grid, *ball(small, centre));
    }
    grid->setName("balls");
    openvdb::io::File(argv[2]).write({grid});
    const openvdb::Coord size = grid->evalActiveVoxelDim();
    std::printf("%s: %d x %d x %d voxels, %lld active, tree of %.1f MB\n", argv[2], size.x(), size.y(), size.z(),
                static_cast<long long>(grid->activeVoxelCount()), static_cast<double>(grid->memUsage()) / 1e6);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "sparse_grid: %s\n", error.what());
    return 1;
  }
}
