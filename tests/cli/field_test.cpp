// Fields of scans, from the command line to the report and the file.
#include <gtest/gtest.h>

#include "meshed.h"

namespace scantet {
namespace {

using nlohmann::json;

TEST(Field, IsInTheReportAndTheFile) {
  const TestFolder folder;
  const std::string torus = sample("torus.nrrd");
  const RunResult run = run_scantet({"mesh", torus, "--level", "0.5", "--field", "value=" + torus, "--field",
                                     "share=" + torus + ":fraction=1", "-o", "a.msh", "--report", "a.json"},
                                    {folder.path()});
  ASSERT_EQ(run.status, 0) << run.err;
  const json report = read_json(folder / "a.json");
  ASSERT_EQ(report["fields"].size(), 2u);
  const json& value = report["fields"][0];
  EXPECT_EQ(value["name"], "value");
  EXPECT_EQ(value["measure"], "mean");
  EXPECT_EQ(value["tets_outside"], 0);
  EXPECT_GT(value["mean"], 0.5) << "inside the level set";
  EXPECT_NEAR(value["total"].get<double>(), value["mean"].get<double>() * report["mesh"]["volume_mm3"].get<double>(),
              1e-6 * value["total"].get<double>());
  EXPECT_EQ(report["fields"][1]["measure"], "fraction=1");
  const std::string mesh = read_bytes(folder / "a.msh");
  EXPECT_NE(mesh.find("$ElementData\n1\n\"value\"\n"), std::string::npos);
  EXPECT_NE(mesh.find("$ElementData\n1\n\"share\"\n"), std::string::npos);
}

TEST(Field, RefusesWhatMakesNoSense) {
  const std::string torus = sample("torus.nrrd");
  for (const std::string& field :
       {std::string("value"), "=" + torus, "re gion=" + torus, "region=" + torus, "a=" + torus + ":fraction=bone",
        "a=" + torus + ":maen", "material=" + torus, "set_foot=" + torus}) {
    const Meshed run = mesh_torus_at("0.5", {"--field", field});
    EXPECT_EQ(run.result.status, 2) << field;
    EXPECT_NE(run.result.err.find("--field: " + field), std::string::npos) << run.result.err;
  }
  EXPECT_EQ(mesh_torus_at("0.5", {"--field", "a=" + torus, "--field", "a=" + torus + ":std"}).result.status, 2);
  EXPECT_EQ(mesh_torus_at("0.5", {"--field", "a=missing.nrrd"}).result.status, 3);
  EXPECT_EQ(mesh_torus_at("0.5", {"--field", "a=missing.nrrd:maen"}).result.status, 3) << "as FOLDER:UID is";
  const Meshed meant = mesh_torus_at("0.5", {"--field", "a=" + torus + ":maen"});
  EXPECT_NE(meant.result.err.find("maen is no measure; did you mean mean?"), std::string::npos) << meant.result.err;
}

}  // namespace
}  // namespace scantet
