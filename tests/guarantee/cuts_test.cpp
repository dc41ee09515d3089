// The promise about cuts, of docs/guarantees.md, under its name.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <map>
#include <set>

#include "guarantee/fixture.h"
#include "guarantee/sample_table.h"
#include "scantet/app/meshing.h"
#include "scantet/check/audit.h"
#include "scantet/cuts/cut_domain.h"
#include "scantet/image/level_set.h"
#include "scantet/optimize/optimizer.h"
#include "scantet/quality/quality.h"
#include "scantet/reading/crop.h"
#include "scantet/reading/scan_reader.h"
#include "scantet/refine/mesher.h"

namespace scantet {
namespace {

struct Cut {
  std::string name;
  std::unique_ptr<Domain> domain;
  std::vector<CutPlane> planes;  ///< that meet it
  std::size_t components;        ///< that are known, 0 if none are
};

Scan scan_of(const std::string& sample, const std::string& crop) {
  Progress progress;
  const Scan scan = read_scan(sample_path(sample), progress);
  return crop.empty() ? scan : cropped(scan, read_crop("--crop-voxels", crop, CropBox::Unit::voxels));
}

Cut make_cut(const std::string& name, const Scan& scan, std::unique_ptr<Domain> whole, std::vector<CutPlane> planes) {
  CutReport report;
  const double spacing_mm = std::max({scan.frame.spacing_mm(0), scan.frame.spacing_mm(1), scan.frame.spacing_mm(2)});
  Cut made{
      name, make_cut_domain(std::move(whole), planes, 0.5 * scan.frame.min_spacing_mm(), spacing_mm, &report), {}, 0};
  EXPECT_EQ(report.unsettled, 0U) << name;
  made.components = made.domain->components().size();
  for (std::size_t k = 0; k < planes.size(); ++k) {
    if (report.meets[k]) made.planes.push_back(planes[k]);
  }
  return made;
}

std::vector<Cut> cut_cases() {
  std::vector<Cut> cases;
  const auto add_border = [&](const std::string& sample, const std::string& crop, double level, std::size_t caps) {
    const Scan scan = scan_of(sample, crop);
    cases.push_back(make_cut(sample, scan, make_level_set(scan, {level, InsideSide::above, std::nullopt}),
                             border_planes(scan.frame, scan.size)));
    EXPECT_EQ(cases.back().planes.size(), caps) << sample;
    EXPECT_EQ(cases.back().components, 1U) << sample;
  };
  add_border("bar.mha", "", 0.5, 1);
  add_border("ellipsoid_axis.nrrd", "14:47,:,:25", 0.5, 3);
  add_border("ellipsoid_oblique.nrrd", "10:40,:,:20", 0.5, 3);
  const Scan ball = scan_of("sphere.nrrd", "");
  const double norm = std::sqrt(1 + 0.09 + 0.25);
  cases.push_back(make_cut("two tilted planes", ball, make_level_set(ball, {127, InsideSide::above, std::nullopt}),
                           {{(1 / norm) * Vec{1, 0.3, -0.5}, 2, "first"}, {{0, 0, 1}, 1.5, "second"}}));
  return cases;
}

/// By the middles of many boxes, whose walls are in the planes where these lie along the axes.
double volume_inside(const Cut& cut) {
  constexpr int kBoxes = 150;
  const Domain& domain = *cut.domain;
  Box box = domain.bounds();
  for (const CutPlane& plane : cut.planes) {
    for (int axis = 0; axis < 3; ++axis) {
      if (plane.normal[axis] == 1) box.max[axis] = plane.offset_mm;
      if (plane.normal[axis] == -1) box.min[axis] = -plane.offset_mm;
    }
  }
  std::size_t inside = 0;
  for (int n = 0; n < kBoxes * kBoxes * kBoxes; ++n) {
    Point p;
    int rest = n;
    for (int axis = 0; axis < 3; ++axis, rest /= kBoxes) {
      p[axis] = box.min[axis] + (rest % kBoxes + 0.5) / kBoxes * box.extent()[axis];
    }
    inside += domain.region_at(p) != kOutside ? 1 : 0;
  }
  const Vec extent = box.extent();
  return static_cast<double>(inside) / std::pow(kBoxes, 3) * extent.x * extent.y * extent.z;
}

TetMesh meshed(const Cut& cut) {
  MesherOptions options;
  options.bounds.alpha = 0.25;  // volumes are to be close
  Progress progress;
  MeshResult result = mesh_domain(*cut.domain, UniformSize(1), options, progress);
  EXPECT_EQ(result.stop, Stop::converged) << cut.name;
  optimize_mesh(result.mesh, *cut.domain, {Optimize::full, {.min_dihedral_deg = 10}}, progress);
  return std::move(result.mesh);
}

/// Vertices of facets of a cap are in its plane, and a cap meets other facets at sharp edges alone.
void expect_flat_caps(const Cut& cut, const TetMesh& mesh) {
  const double most_mm = 1e-9 * cut.domain->bounds().diagonal();
  std::map<std::array<VertexId, 2>, std::set<std::uint32_t>> patches_at;
  std::set<std::string> names;
  for (std::size_t i = 0; i < mesh.boundary_facets.size(); ++i) {
    const std::string& name = mesh.patches[mesh.facet_patches[i]].name;
    names.insert(name);
    for (std::size_t k = 0; k < 3; ++k) {
      const auto [a, b] = std::minmax(mesh.boundary_facets[i][k], mesh.boundary_facets[i][(k + 1) % 3]);
      patches_at[{a, b}].insert(mesh.facet_patches[i]);
      for (const CutPlane& plane : cut.planes) {
        if (plane.name != name) continue;
        EXPECT_LE(std::abs(plane.beyond_mm(mesh.vertices[a])), most_mm) << cut.name;
      }
    }
  }
  for (const CutPlane& plane : cut.planes) EXPECT_EQ(names.count(plane.name), 1U) << cut.name << plane.name;
  std::set<std::array<VertexId, 2>> sharp;
  for (std::size_t i = 0; i < mesh.curve_edges.size(); ++i) {
    EXPECT_TRUE(mesh.curves[mesh.edge_curves[i]].is_sharp);
    const auto [a, b] = std::minmax(mesh.curve_edges[i][0], mesh.curve_edges[i][1]);
    sharp.insert({a, b});
  }
  for (const auto& [edge, patches] : patches_at) EXPECT_TRUE(patches.size() == 1 || sharp.count(edge) == 1) << cut.name;
}

TEST_F(Guarantee, CutsAreFlat) {
  for (const Cut& cut : cut_cases()) {
    const TetMesh mesh = meshed(cut);
    AuditOptions auditing;
    auditing.restricted_delaunay = false;
    const AuditReport report = audit(mesh, cut.domain.get(), auditing);
    for (const Finding& finding : report.findings) ADD_FAILURE() << cut.name << ": " << finding.message;
    EXPECT_TRUE(cut.components == 0 || report.components.size() == cut.components) << cut.name;
    EXPECT_EQ(report.handle_ledger.has_value(), cut.components > 0) << cut.name;
    expect_flat_caps(cut, mesh);
    const QualitySummary quality = measure_quality(mesh);
    EXPECT_GE(quality.min_dihedral_deg(), 10) << cut.name;
    const double volume = volume_inside(cut);
    EXPECT_NEAR(quality.total_volume_mm3, volume, 1e-3 * volume) << cut.name;
  }
}

// A part of a brain with its skull taken off: small rims that come close to each other, and threads a voxel beside
// them.
TEST(RoughCut, HasItsRims) {
  const std::string brain = "/usr/share/mricron/templates/ch2bet.nii.gz";
  if (!std::filesystem::exists(brain)) GTEST_SKIP() << brain << " is not installed";
  Progress progress;
  const Scan scan =
      cropped(read_scan(brain, progress), read_crop("--crop-voxels", "60:120,100:170,50:100", CropBox::Unit::voxels));
  const Cut cut = make_cut("brain", scan, make_level_set(scan, {40.5, InsideSide::above, std::nullopt}),
                           border_planes(scan.frame, scan.size));
  const auto size = std::make_shared<UniformSize>(3);
  const Meshing meshing = *mesh_and_optimize(*cut.domain, size, {}, {}, progress);
  EXPECT_TRUE(meshing.conformance.holds()) << meshing.conformance.places.size() << " elements break a bound";
  AuditOptions options;
  options.restricted_delaunay = false;
  options.size = size.get();
  for (const Finding& finding : audit(meshing.refined.mesh, cut.domain.get(), options).findings) {
    ADD_FAILURE() << finding.code << ": " << finding.message;
  }
}

}  // namespace
}  // namespace scantet
