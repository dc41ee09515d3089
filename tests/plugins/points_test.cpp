// What the plugin makes of points on surfaces that are known, and what it refuses.
#include <gtest/gtest.h>

#include <random>

#include "contract/plugin_case.h"
#include "guarantee/surface_distance.h"
#include "point_files.h"
#include "scantet/base/error.h"
#include "scantet/base/parallel.h"
#include "scantet/check/audit.h"
#include "scantet/domain/analytic.h"
#include "scantet/refine/mesher.h"
#include "temporary_file.h"

namespace scantet {
namespace {

using Options = std::vector<std::pair<std::string, std::string>>;

std::unique_ptr<Domain> open_points(const std::string& name, const std::string& bytes, const Options& options = {}) {
  const test::TemporaryFile file(name, bytes);
  return open_with_plugin(SCANTET_POINTS_PLUGIN, file.path(), options);
}

struct Shape {
  std::string name;
  Cloud cloud;
  std::unique_ptr<Domain> truth;
  double size_mm;
  double bound_mm;  // two-sided
  std::size_t components;
  std::int64_t euler;  // of the boundary
};

std::vector<Shape> shapes() {
  std::vector<Shape> all;
  all.push_back({"ball", ball_cloud({1, 2, 3}, 5, 2000), make_sphere({1, 2, 3}, 5), 0.8, 0.1, 1, 2});
  all.push_back({"torus", torus_cloud(4, 1.5, 3000), make_torus({0, 0, 0}, 4, 1.5), 0.6, 0.1, 1, 0});
  Cloud two = ball_cloud({-3.5, 0, 0}, 3, 1000);
  two.add(ball_cloud({3.5, 0, 0}, 3, 1000));
  all.push_back({"two balls", two, make_two_spheres(3, 1), 0.8, 0.1, 2, 4});
  return all;
}

TEST(PointsPlugin, ItsMeshIsThatOfTheSurfaceThePointsAreOn) {
  for (const Shape& shape : shapes()) {
    for (const bool normals : {true, false}) {
      const Cloud cloud = normals ? shape.cloud : shape.cloud.without_normals();
      const std::string what = shape.name + (normals ? " with normals" : " without normals");
      const auto domain = open_points("shape.xyz", cloud.xyz());
      Progress progress;
      const MeshResult meshed = mesh_domain(*domain, UniformSize(shape.size_mm), {}, progress);
      const AuditReport report = audit(meshed.mesh, domain.get(), {});
      for (const Finding& finding : report.findings) ADD_FAILURE() << what << ": " << finding.message;
      EXPECT_EQ(report.components.size(), shape.components) << what;
      std::int64_t euler = 0;
      for (const MeshComponent& component : report.components) euler += component.boundary_euler;
      EXPECT_EQ(euler, shape.euler) << what;
      const SurfaceDistance off = surface_distance(meshed.mesh, *shape.truth, 0.25, 1);
      EXPECT_LT(off.from_mesh_mm, shape.bound_mm) << what;
      EXPECT_LT(off.from_domain_mm, shape.bound_mm) << what;
    }
  }
}

TEST(PointsPlugin, AnyNumberOfThreadsGivesTheSame) {
  const std::string text = torus_cloud(4, 1.5, 1500).without_normals().xyz();
  std::vector<TetMesh> meshes;
  for (const std::size_t threads : {1, 2, 5}) {
    with_threads(threads, [&] {
      const auto domain = open_points("threads.xyz", text);
      Progress progress;
      meshes.push_back(mesh_domain(*domain, UniformSize(0.8), {}, progress).mesh);
    });
  }
  for (const TetMesh& mesh : meshes) {
    EXPECT_TRUE(mesh.vertices == meshes[0].vertices);
    EXPECT_TRUE(mesh.tets == meshes[0].tets);
  }
}

TEST(PointsPlugin, TheUnitMakesNoDifference) {
  const Cloud cloud = ball_cloud({0, 0, 0}, 1, 500);
  Cloud larger = cloud;
  for (Point& p : larger.points) p = 1024 * p;
  const auto domain = open_points("small.ply", cloud.ply());
  const auto scaled = open_points("large.ply", larger.ply());
  EXPECT_NEAR(scaled->bounds().max.x / domain->bounds().max.x, 1024, 1e-3);
  Crossings crossings;
  for (const Vec& direction : {Vec{1, 0.1, 0.2}, Vec{-0.3, 1, 0.5}, Vec{0.2, -0.7, -1}}) {
    domain->crossings({{0, 0, 0}, 2 * direction}, crossings);
    ASSERT_EQ(crossings.size(), 1u);
    const Point near = crossings[0].point;
    scaled->crossings({{0, 0, 0}, 2048 * direction}, crossings);
    ASSERT_EQ(crossings.size(), 1u);
    EXPECT_NEAR(distance(crossings[0].point, 1024 * near), 0, 1e-3);
  }
}

TEST(PointsPlugin, FormatsDuplicatesAndDirectionsMakeNoDifference) {
  const Cloud cloud = ball_cloud({0, 0, 0}, 5, 800);
  Cloud twice = cloud;
  twice.add(cloud);
  const auto domain = open_points("once.xyz", cloud.xyz());
  std::vector<std::unique_ptr<Domain>> others;
  others.push_back(open_points("twice.xyz", twice.xyz()));
  others.push_back(open_points("counted.pwn", "# points\n800\n\n" + cloud.xyz()));
  others.push_back(open_points("text.ply", cloud.ply()));
  others.push_back(open_points("binary.PLY", cloud.binary_ply()));
  others.push_back(open_points("inwards.xyz", cloud.turned().xyz()));
  Crossings expected;
  Crossings crossings;
  const Segment segment{{0.1, 0.2, 0.3}, {6, 4, 1}};
  domain->crossings(segment, expected);
  ASSERT_EQ(expected.size(), 1u);
  for (const auto& other : others) {
    other->crossings(segment, crossings);
    ASSERT_EQ(crossings.size(), 1u);
    EXPECT_LT(distance(crossings[0].point, expected[0].point), 0.06) << "a tenth of the spacing";
    EXPECT_EQ(crossings[0].from, 1) << "inside is within the points, whichever way the normals point";
  }
}

TEST(PointsPlugin, ACavityNeedsNormals) {
  Cloud shell = ball_cloud({0, 0, 0}, 5, 2000);
  shell.add(ball_cloud({0, 0, 0}, 2, 500).turned());
  const auto domain = open_points("shell.xyz", shell.xyz());
  EXPECT_EQ(domain->region_at({0, 0, 0}), kOutside);
  EXPECT_EQ(domain->region_at({3.5, 0, 0}), 1);
  ASSERT_EQ(domain->components().size(), 2u);
}

TEST(PointsPlugin, FacesMakeAPlyFileASurface) {
  PluginRegistry registry;
  load_plugin(SCANTET_POLYHEDRON_PLUGIN, registry);
  load_plugin(SCANTET_POINTS_PLUGIN, registry);
  const std::string points = ball_cloud({0, 0, 0}, 5, 50).ply();
  std::string no_faces = points;
  no_faces.insert(no_faces.find("end_header"), "element face 0\nproperty list uchar int vertex_indices\n");
  std::string faces = no_faces + "3 0 1 2\n";
  faces.replace(faces.find("face 0"), 6, "face 1");
  EXPECT_EQ(registry.create_for(test::TemporaryFile("a.ply", points).path())->name(), "points");
  EXPECT_EQ(registry.create_for(test::TemporaryFile("b.ply", no_faces).path())->name(), "points");
  EXPECT_EQ(registry.create_for(test::TemporaryFile("c.ply", faces).path())->name(), "polyhedron");
  const test::TemporaryFile headless("d.ply", "ply\nformat ascii 1.0\nproperty float x\nend_header\n");
  EXPECT_EQ(registry.create_for(headless.path())->name(), "polyhedron");
  EXPECT_THROW(open_with_plugin(SCANTET_POLYHEDRON_PLUGIN, headless.path()), Error) << "the reader would crash";
}

struct PointsRefusal {
  std::string name;
  std::string bytes;
  std::string says;
  Options options{};
};

std::string with_line(const Cloud& cloud, const std::string& line) {
  const std::string text = cloud.xyz();
  return text.substr(0, text.find('\n') + 1) + line + "\n" + text.substr(text.find('\n') + 1);
}

Cloud flattened(Cloud cloud, const Vec& by) {
  for (Point& p : cloud.points) p = {by.x * p.x, by.y * p.y, by.z * p.z};
  return cloud;
}

Cloud with_random_normals(Cloud cloud) {
  std::mt19937 random(7);
  for (Vec& normal : cloud.normals) normal = (random() % 2 == 0 ? 1.0 : -1.0) * normal;
  return cloud;
}

std::vector<PointsRefusal> refusals() {
  const Cloud ball = ball_cloud({0, 0, 0}, 5, 500);
  const Cloud bare = ball.without_normals();
  std::string huge = ball.ply();
  huge.replace(huge.find("vertex 500"), 10, "vertex 1000000000000000000");
  std::string whole = ball.ply();
  while (whole.find("double") != std::string::npos) whole.replace(whole.find("double"), 6, "int");
  std::string word = ball.ply();
  word.replace(word.find("end_header\n") + 11, 1, "x");
  std::string nan = ball.binary_ply();
  nan.replace(nan.find("end_header\n") + 11, 4, "\xff\xff\xff\x7f");
  Cloud beyond = bare;
  beyond.points[3].y = 1e12;
  Cloud unlike = ball;
  unlike.normals[9] = {};
  return {{"words.xyz", with_line(bare, "1 2 three"), "line 2 is not numbers"},
          {"binary.xyz", std::string("\x00\xff\x13\x07 1 2\x80", 9), "line 1 is not numbers"},
          {"nan.xyz", with_line(bare, "1 nan 2"), "line 2 has a number that is not finite"},
          {"overflow.xyz", with_line(bare, "1 1e999 2"), "line 2 is not numbers"},
          {"four.xyz", with_line(bare, "1 2 3 4"), "line 2 has 4 numbers"},
          {"mixed.xyz", with_line(ball, "1 2 3"), "line 2 has 3 numbers"},
          {"counted.pwn", "501\n" + bare.xyz(), "says 501 points, and there are 500"},
          {"few.xyz", ball_cloud({0, 0, 0}, 5, 49).xyz(), "has 49 different points"},
          {"same.xyz", flattened(bare, {0, 0, 0}).xyz(), "has 1 different points"},
          {"comments.xyz", "# nothing\n\n", "has 0 different points"},
          {"flat.xyz", flattened(bare, {1, 1, 0}).xyz(), "of a plane"},
          {"line.xyz", flattened(bare, {0, 0, 1}).xyz(), "of a plane"},
          {"far.xyz", beyond.xyz(), "1e+12 mm is beyond"},
          {"some.xyz", unlike.xyz(), "point 10 of the different ones has no normal"},
          {"random.xyz", with_random_normals(ball).xyz(), "the surface "},
          {"cut.ply", ball.binary_ply().substr(0, 5000), "ends before the 500 of element vertex"},
          {"short.ply", ball.ply().substr(0, 20000), "after"},
          {"huge.ply", huge, "ends before the 1000000000000000000"},
          {"whole.ply", whole, "property x"},
          {"word.ply", word, "cannot be read after 0 points"},
          {"nan.ply", nan, "point 1 has a number that is not finite"},
          {"fine.xyz", ball.xyz(), "--grid-step: a grid of 0.001 mm", {{"grid-step", "0.001"}}},
          {"finest.xyz", ball.xyz(), "choose --grid-step 0.0", {{"grid-step", "1e-200"}}},
          {"coarse.xyz", ball.xyz(), "encloses no node", {{"grid-step", "1e6"}}}};
}

TEST(PointsPlugin, RefusesWithTheReason) {
  for (const PointsRefusal& refusal : refusals()) {
    try {
      open_points(refusal.name, refusal.bytes, refusal.options);
      ADD_FAILURE() << refusal.name << " was opened";
    } catch (const Error& error) {
      const std::string what = error.what();
      EXPECT_EQ(error.code(), error.fault() == Fault::input ? "input.points" : "usage.grid_step") << what;
      EXPECT_NE(what.find(refusal.says), std::string::npos) << refusal.name << ": " << what;
      EXPECT_FALSE(error.remedy().empty()) << what;
    }
  }
}

TEST(PointsPlugin, EstimatedNormalsTakeThePlaceOfBadOnes) {
  const auto domain =
      open_points("random.xyz", with_random_normals(ball_cloud({0, 0, 0}, 5, 500)).xyz(), {{"normals", "estimate"}});
  EXPECT_EQ(domain->region_at({0, 0, 0}), 1);
  EXPECT_EQ(domain->region_at({5.5, 0, 0}), kOutside);
}

}  // namespace
}  // namespace scantet
