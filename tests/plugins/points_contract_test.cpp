#include "contract/plugin_case.h"
#include "point_files.h"
#include "temporary_file.h"

namespace scantet {
namespace {

DomainCase cloud(const std::string& name, const std::string& extension, const std::string& bytes) {
  const auto make = [=] {
    const test::TemporaryFile file("contract_" + name + extension, bytes);
    return open_with_plugin(SCANTET_POINTS_PLUGIN, file.path());
  };
  return {name, make};
}

Cloud two_balls() {
  Cloud both = ball_cloud({0, 0, 0}, 3, 600);
  both.add(ball_cloud({8, 1, 0}, 2, 300));
  return both;
}

INSTANTIATE_TEST_SUITE_P(
    Points, DomainContract,
    ::testing::Values(cloud("BallXyz", ".xyz", ball_cloud({1, 2, 3}, 5, 1000).xyz()),
                      cloud("BallNoNormals", ".xyz", ball_cloud({1, 2, 3}, 5, 1000).without_normals().xyz()),
                      cloud("TorusPwn", ".pwn", torus_cloud(4, 1.5, 2000).xyz()),
                      cloud("TorusNoNormals", ".ply", torus_cloud(4, 1.5, 2000).without_normals().ply()),
                      cloud("TwoBallsPly", ".ply", two_balls().binary_ply())),
    [](const auto& test) { return test.param.name; });

}  // namespace
}  // namespace scantet
