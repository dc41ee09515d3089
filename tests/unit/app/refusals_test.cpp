// What is refused before a job has begun, by its codes.
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "error_code.h"
#include "fake_plugin.h"
#include "scantet/app/certify.h"
#include "scantet/app/field_options.h"
#include "scantet/app/order_step.h"
#include "scantet/app/plugin_object.h"
#include "scantet/decks/deck.h"
#include "scantet/size_options/size_plan.h"
#include "scantet/verification/certificate_file.h"

namespace scantet {
namespace {

using test::error_code;

TEST(Refusals, OfFilesThatAreNoCertificate) {
  const std::string path = testing::TempDir() + "no_certificate_" + std::to_string(getpid()) + ".json";
  const std::string brackets(200'000, '[');
  const std::string closed = brackets + std::string(brackets.size(), ']') + "}";
  for (const std::string& text : {std::string(), std::string("{}"), std::string("[1, 2]"), "{\"kind\": " + closed,
                                  std::string("{\"grade\": \"certified\"}"), brackets}) {
    std::ofstream(path) << text;
    EXPECT_EQ(error_code([&] { read_certificate(path); }), "input.certificate") << text.substr(0, 30);
  }
  std::filesystem::remove(path);
  EXPECT_EQ(error_code([&] { read_certificate(path); }), "input.cannot_open");
}

TEST(Refusals, OfWhatNoMeshIsVerifiedAgainst) {
  Progress progress;
  VerifyJob job;
  EXPECT_EQ(error_code([&] { run_verify(job, progress); }), "usage.against");
  job.against = "a.nrrd";
  job.repairs = true;
  EXPECT_EQ(error_code([&] { object_to_verify(job, progress); }), "usage.repair");
  job = VerifyJob();
  job.levels = {1};
  job.read_object = [](const VerifyJob&, Progress&) {
    VerifiedObject object;
    object.surface.emplace();
    return object;
  };
  EXPECT_EQ(error_code([&] { object_to_verify(job, progress); }), "usage.surface");
}

TEST(Refusals, OfPluginsWithoutWhatIsAskedFor) {
  Progress progress;
  PluginRegistry plugins;
  plugins.add(fake_plugin("balls", ".ball", 10));
  VerifyJob job;
  job.against = "a.ball";
  EXPECT_EQ(error_code([&] { plugin_object(plugins, job, progress); }), "input.no_field");
  job.repairs = true;
  EXPECT_EQ(error_code([&] { plugin_object(plugins, job, progress); }), "usage.repair");
  job.repairs = false;
  job.grid = "density";
  EXPECT_EQ(error_code([&] { plugin_object(plugins, job, progress); }), "usage.grid");
}

TEST(Refusals, OfCertificatesOfWhatCannotBeVerified) {
  const PluginRegistry plugins;
  MeshJob job;
  job.certify = Certify::certified;
  EXPECT_EQ(error_code([&] { Certifier(job, plugins, "image", {}); }), "usage.certify") << "no mesh file";
  job.outputs = {"a.vtu"};
  EXPECT_EQ(error_code([&] { Certifier(job, plugins, "implicit", {}); }), "usage.certify") << "a formula";
  job.cut.cuts = {"z > 0"};
  EXPECT_EQ(error_code([&] { Certifier(job, plugins, "image", {}); }), "usage.certify") << "cuts";
}

TEST(Refusals, OfSecondOrderWithACertificate) {
  MeshJob job;
  job.outputs = {"a.vtu"};
  job.order = ElementOrder::second;
  EXPECT_EQ(error_code([&] { check_order(job); }), "");
  job.certify = Certify::certified;
  EXPECT_EQ(error_code([&] { check_order(job); }), "usage.order");
}

TEST(Refusals, OfHoldsAndLoadsThatCannotBeRead) {
  for (const char* text : {"", "=z", "foot=", "foot=q", "foot=yq"}) {
    EXPECT_EQ(error_code([&] { read_hold(text, DeckKind::statics); }), "usage.deck") << text;
  }
  for (const char* text : {"", "tip", "tip=", "tip=1,2", "tip=x"}) {
    EXPECT_EQ(error_code([&] { read_load(text, DeckKind::statics); }), "usage.deck") << text;
  }
  Deck deck;
  deck.kind = DeckKind::statics;
  deck.holds = {read_hold("foot=z", DeckKind::statics)};
  EXPECT_EQ(error_code([&] { check_deck_sets(deck, TetMesh()); }), "usage.deck") << "no such set";
}

TEST(Refusals, OfSizesAtPlacesThatOnlyMeshesHave) {
  for (const char* text :
       {"", "ball(0,0,0,1)", "ball(0,0,0,1)=0", "ball(0,0,0,1)=x", "region(1)=2", "normal(0,0,1,9)=2"}) {
    SizeOptions sizes;
    sizes.size_where = {text};
    EXPECT_EQ(error_code([&] { plan_sizes(sizes); }), "usage.size_where") << text;
  }
}

TEST(Refusals, OfScansForFieldsThatAreElsewhere) {
  Scan scan;
  scan.size = {2, 2, 2};
  const auto values = std::make_shared<const std::vector<double>>(8, 5.0);
  scan.voxels = VoxelPointer{values->data()};
  scan.owner = values;
  const ScanTable known{{"a.nrrd", ScanValues(scan)}};
  Progress progress;
  const auto read = [&](const Box& object) { FieldScans({"a=a.nrrd"}, object, known, progress); };
  EXPECT_EQ(error_code([&] { read({{-9, 0, 0}, {-0.4, 1, 1}}); }), "");
  EXPECT_EQ(error_code([&] { read({{-9, 0, 0}, {-0.6, 1, 1}}); }), "input.field");
  EXPECT_EQ(error_code([&] { read({{0, 0, 2}, {1, 1, 3}}); }), "input.field");
}

}  // namespace
}  // namespace scantet
