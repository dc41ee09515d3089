// Boundary and mesh move together until regions have the volumes of their voxels.
#include "scantet/app/volume_settling.h"

#include <gtest/gtest.h>

#include <map>

#include "scantet/check/audit.h"
#include "scantet/check/facet_crossings.h"
#include "scantet/labels/label_field.h"
#include "scantet/labels/label_object.h"
#include "scantet/quality/quality.h"
#include "unit/labels/label_scan.h"

namespace scantet {
namespace {

/// A label map that is fitted to the size, as a job opens it, and an improved mesh of it.
struct Case {
  explicit Case(const Scan& scan) {
    Progress progress;
    LabelSettings settings;
    settings.smoothing = LabelSmoothing::keep;
    LabelObject object = make_label_object(scan, settings, progress).fit({size}, progress);
    opened.domain = std::move(object.domain);
    opened.settle = wrapped(std::move(object.settle));
    const auto shared = std::make_shared<UniformSize>(size);
    meshing = *mesh_and_optimize(*opened.domain, shared, {}, optimizer, progress);
    optimizer.bounds.rules = RuleTarget{{}, &size};
  }

  /// By how much the volumes of regions with over 300 voxels are off at the most, as a share.
  double worst(const Scan& scan) const {
    const auto field = make_label_field(scan, {});
    std::map<Region, double> voxels;
    for (std::size_t n = 0; n < field->regions().size(); ++n) {
      voxels[field->regions()[n]] = static_cast<double>(field->voxels()[n]);
    }
    double worst = 0;
    for (const RegionVolume& region : measure_quality(meshing.refined.mesh).regions) {
      const double count = voxels[region.region];
      if (count > 300) worst = std::max(worst, std::abs(region.volume_mm3 / count - 1));
    }
    return worst;
  }

  UniformSize size{2};
  OptimizerOptions optimizer{Optimize::full, {10, 165, 0.05}};
  OpenedDomain opened;
  Meshing meshing;

 private:
  static Settling wrapped(decltype(LabelObject::settle) settle) {
    return [settle = std::move(settle)](const std::map<Region, double>& volumes_mm3, std::span<const Point> held,
                                        Progress& progress) {
      LabelObject object = settle(volumes_mm3, held, progress);
      FittedDomain fitted{std::move(object.domain), std::move(object.grid)};
      if (object.settle) fitted.settle = wrapped(std::move(object.settle));
      return fitted;
    };
  }
};

TEST(VolumeSettling, RegionsGetTheVolumesOfTheirVoxels) {
  Progress progress;
  const Scan scan = test::label_cells({60, 56, 52}, 10);
  Case made(scan);
  const double before = made.worst(scan);
  const std::size_t faults = made.meshing.conformance.places.size();
  settle_volumes(made.optimizer, made.size, {}, made.opened, progress, made.meshing);
  EXPECT_GT(before, 0.01);
  EXPECT_LT(made.worst(scan), 0.0025);
  EXPECT_LE(made.meshing.conformance.places.size(), faults);
  EXPECT_TRUE(crossing_facets(made.meshing.refined.mesh).empty());
  for (std::size_t v = 0; v < made.meshing.refined.mesh.vertices.size(); ++v) {
    if (made.meshing.refined.mesh.strata[v].dimension != 2) continue;
    EXPECT_LT(std::abs(*made.opened.domain->residual_at(made.meshing.refined.mesh.vertices[v])), 1e-8) << v;
  }
}

TEST(VolumeSettling, WhatWouldBreakTheMeshIsLeftOut) {
  Progress progress;
  const Scan scan = test::label_cells({40, 35, 30}, 12);
  Case made(scan);
  const Domain* const domain = made.opened.domain.get();
  const std::vector<Point> vertices = made.meshing.refined.mesh.vertices;
  int asked = 0;
  made.opened.settle = [&](const std::map<Region, double>&, std::span<const Point> held, Progress& of_settling) {
    EXPECT_EQ(held.empty(), asked++ == 0);
    const Scan other = test::label_cells({40, 35, 30}, 12, {}, 6);  // its boundary is elsewhere
    return FittedDomain{make_label_object(other, {}, of_settling).domain};
  };
  settle_volumes(made.optimizer, made.size, {}, made.opened, progress, made.meshing);
  EXPECT_GT(asked, 1);
  EXPECT_EQ(made.opened.domain.get(), domain);
  EXPECT_EQ(made.meshing.refined.mesh.vertices, vertices);
}

TEST(VolumeSettling, UnimprovedMeshesStay) {
  Progress progress;
  Case made(test::label_cells({24, 20, 20}, 4));
  made.opened.settle = [](const std::map<Region, double>&, std::span<const Point>, Progress&) -> FittedDomain {
    ADD_FAILURE() << "was asked";
    return {};
  };
  made.optimizer.optimize = Optimize::none;
  settle_volumes(made.optimizer, made.size, {}, made.opened, progress, made.meshing);
}

}  // namespace
}  // namespace scantet
