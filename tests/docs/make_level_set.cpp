// Writes the level set that an example meshes: a ball of 10 mm, in voxels of 1 mm.
#include "plugins/vdb_files.h"

int main(int count, char** words) {
  if (count != 2) return 2;
  openvdb::initialize();
  const auto ball = openvdb::tools::createLevelSetSphere<openvdb::FloatGrid>(10.0F, openvdb::Vec3f(0.0F), 1.0F, 3.0F);
  scantet::test::write_grids(words[1], {ball});
  return 0;
}
