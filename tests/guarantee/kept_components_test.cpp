// The boundary lies on the level of the scan as it was read, with components left out, too.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "guarantee/fixture.h"
#include "scantet/check/audit.h"
#include "scantet/image/level_set.h"
#include "scantet/reading/scan_reader.h"
#include "scantet/refine/mesher.h"
#include "scantet/scan_input/image_plugin.h"

namespace scantet {
namespace {

/// The input as `scantet mesh INPUT --level … --components largest` opens it.
OpenedDomain open_largest(const std::string& input, const std::vector<std::string>& levels) {
  const auto plugin = make_image_plugin();
  OptionSet options;
  plugin->declare_options(options);
  for (const std::string& level : levels) options.set({"level", level, "--level"});
  options.set({"components", "largest", "--components"});
  Progress progress;
  return plugin->open(input, progress);
}

/// A brain whose shell of noise shares cells with it. Debian's mricron-data.
TEST_F(Guarantee, BoundaryIsOnTheLevelOfTheScanAsRead) {
  const std::string brain = "/usr/share/mricron/templates/ch2bet.nii.gz";
  if (!std::filesystem::exists(brain)) GTEST_SKIP() << brain << " is not installed";
  Progress progress;
  const Scan scan = read_scan(brain, progress);
  const OpenedDomain opened = open_largest(brain, {"20"});
  ASSERT_EQ(opened.dropped->components.size(), 57U);
  const MeshResult result = mesh_domain(*opened.domain, UniformSize(3), {}, progress);
  const auto as_read = make_level_set(scan, {20, InsideSide::above, std::nullopt});
  double worst = 0;
  for (std::size_t v = 0; v < result.mesh.vertices.size(); ++v) {
    if (result.mesh.on_boundary(v)) worst = std::max(worst, as_read->residual_at(result.mesh.vertices[v]).value());
  }
  EXPECT_LE(worst, 1e-6);
  EXPECT_NEAR(*audit(result.mesh, opened.domain.get()).max_residual, worst, 1e-12) << "the audit asks the same scan";
}

}  // namespace
}  // namespace scantet
