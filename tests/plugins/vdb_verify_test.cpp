// Meshes of grids, held against the grids' own fields.
#include <gtest/gtest.h>

#include "error_code.h"
#include "scantet/certificate/certificate_text.h"
#include "scantet/domain/sizing_field.h"
#include "scantet/refine/mesher.h"
#include "scantet/verify/verify.h"
#include "vdb_plugin_use.h"

namespace scantet {
namespace {

struct Case {
  TetMesh mesh;
  GridField field;
};

/// A mesh of a grid and the field that the plugin reads.
Case meshed(const openvdb::GridBase::Ptr& grid, const std::vector<std::pair<std::string, std::string>>& options,
            double size_mm) {
  return test::use_vdb_plugin(grid, options, [&](InputPlugin& plugin, const std::string& path) -> Case {
    Progress progress;
    const OpenedDomain opened = open_checked(plugin, path, progress);
    const std::optional<GridField> field = plugin.field(path, progress);
    return {mesh_domain(*opened.domain, UniformSize(size_mm), {}, progress).mesh, field.value()};
  });
}

Certificate verified(const Case& c, double level, InsideSide inside) {
  VerifyOptions options;
  options.level.level = level;
  options.level.inside = inside;
  options.level.outside = c.field.outside;
  Progress progress;
  return verify_mesh(c.mesh, c.field.scan, options, progress);
}

TEST(VdbVerify, LevelSetOfASphereIsCertified) {
  const Case sphere = meshed(test::sphere_grid(), {}, 1);
  EXPECT_FLOAT_EQ(static_cast<float>(sphere.field.outside.value()), 2.4F) << "three voxels";
  const Certificate c = verified(sphere, 0, InsideSide::below);
  EXPECT_EQ(c.grade, CertificateGrade::certified);
  EXPECT_EQ(c.facets, c.facets_certified);
  EXPECT_LT(c.mesh_to_level.upper_mm.value(), 0.2);
  EXPECT_NE(verified(sphere, 1, InsideSide::below).grade, CertificateGrade::certified) << "another level";
}

TEST(VdbVerify, FogVolumeInASkewFrameIsBoundedAtLeast) {
  const openvdb::FloatGrid::Ptr grid = test::fog_grid();  // without its tiles
  grid->fill(openvdb::CoordBBox(openvdb::Coord(-8, 64, 16), openvdb::Coord(-1, 71, 23)), 0, false);
  grid->fill(openvdb::CoordBBox(openvdb::Coord(128, 0, 0), openvdb::Coord(255, 127, 127)), 0, false);
  const Certificate c = verified(meshed(grid, {{"level", "0.5"}}, 1.2), 0.5, InsideSide::above);
  EXPECT_LE(static_cast<int>(c.grade), static_cast<int>(CertificateGrade::bounded)) << certificate_text(c);
  EXPECT_EQ(c.field.components, 3);
}

TEST(VdbVerify, TilesAreVoxelsLikeOthers) {
  const Case fog = meshed(test::fog_grid(), {{"level", "0.35"}}, 4);
  const Certificate c = verified(fog, 0.35, InsideSide::above);
  EXPECT_NE(c.grade, CertificateGrade::not_the_scan) << certificate_text(c);
  EXPECT_EQ(c.field.components, 4);
  EXPECT_EQ(c.mesh.components, 4);
  EXPECT_LT(c.mesh_to_level.upper_mm.value(), 8);
  EXPECT_LT(c.level_to_mesh.upper_mm.value(), 8);
}

TEST(VdbVerify, FlatGridsAreRefused) {
  openvdb::initialize();
  auto flat = openvdb::FloatGrid::create(0);
  flat->fill(openvdb::CoordBBox(openvdb::Coord(0, 0, 0), openvdb::Coord(9, 9, 0)), 1);
  flat->setName("flat");
  EXPECT_EQ(test::error_code([&] { meshed(flat, {{"level", "0.5"}}, 1); }), "input.grid");
}

}  // namespace
}  // namespace scantet
