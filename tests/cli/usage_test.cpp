// Wrong use: status 2, one line that names the option and the value, a hint, nothing written, no time lost.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>

#include "run_process.h"

namespace scantet {
namespace {

struct Misuse {
  std::vector<std::string> arguments;
  std::vector<std::string> says;  // each must appear in the error line
};

void expect_usage_error(const Misuse& misuse) {
  const TestFolder folder;
  std::string shown;
  for (const std::string& argument : misuse.arguments) shown += argument + " ";
  const RunResult run = run_scantet(misuse.arguments, {folder.path()});
  EXPECT_EQ(run.status, 2) << shown << run.err;
  EXPECT_EQ(run.out, "") << shown;
  EXPECT_EQ(run.err.rfind("scantet: error: ", 0), 0u) << shown << run.err;
  EXPECT_LE(std::count(run.err.begin(), run.err.end(), '\n'), 2) << shown << run.err;
  const std::string line = run.err.substr(0, run.err.find('\n'));
  for (const std::string& part : misuse.says) {
    EXPECT_NE(line.find(part), std::string::npos) << shown << "does not say " << part << ": " << line;
  }
  EXPECT_TRUE(folder.names().empty()) << shown;
}

std::vector<std::string> mesh_with(std::vector<std::string> more) {
  std::vector<std::string> arguments{"mesh", sample("sphere.nrrd"), "-o", "out.vtu"};
  const auto sets = [&](const char* option) { return std::find(more.begin(), more.end(), option) != more.end(); };
  if (!sets("--level")) arguments.insert(arguments.end(), {"--level", "127.5"});
  arguments.insert(arguments.end(), more.begin(), more.end());
  return arguments;
}

TEST(Usage, CommandsAndArguments) {
  for (const Misuse& misuse : std::vector<Misuse>{
           {{}, {"no command"}},                                             // usage.no_command
           {{"mehs"}, {"mehs", "did you mean mesh?"}},                       // usage.unknown_command
           {{"mesh"}, {"INPUT is missing"}},                                 // usage.arguments
           {{"completion", "csh"}, {"no completion for the shell", "csh"}},  // usage.shell
           {{"mesh", "a.nrrd", "b.nrrd"}, {"unexpected argument", "b.nrrd"}},
           {{"info"}, {"INPUT is missing"}},
           {{"report"}, {"MESH is missing"}},
           {{"convert", "a.vtu"}, {"FILE is missing"}},
           {{"plugins", "x"}, {"unexpected argument"}},
           {mesh_with({"--certify", "maybe"}), {"\"maybe\": --certify takes no, bounded, certified or refine"}},
       }) {
    expect_usage_error(misuse);
  }
}

TEST(Usage, CohortWithoutItsFilesIsRefused) {
  const TestFolder folder;
  std::filesystem::create_directory(folder / "bin");
  std::filesystem::copy_file(SCANTET_EXECUTABLE, folder / "bin/scantet");
  const std::string command = folder / "bin/scantet" + " cohort study meshes participant 2> " + folder / "err";
  EXPECT_EQ(WEXITSTATUS(std::system(command.c_str())), 2);  // usage.cohort
  EXPECT_NE(read_bytes(folder / "err").find("the cohort's files are not in " + folder.path()), std::string::npos);
}

TEST(Usage, UnknownOptionsGetTheClosestName) {
  for (const Misuse& misuse : std::vector<Misuse>{
           {mesh_with({"--levle", "3"}), {"--levle", "did you mean --level?"}},
           {mesh_with({"--facet_distance", "3"}), {"--facet_distance", "did you mean --facet-distance?"}},
           {mesh_with({"--sixe=3"}), {"--sixe", "did you mean --size?"}},
           {mesh_with({"--frobnicate"}), {"--frobnicate"}},
           {mesh_with({"-z"}), {"-z"}},
           {{"info", "a.nrrd", "--jsno"}, {"--jsno", "did you mean --json?"}},
       }) {
    expect_usage_error(misuse);
  }
}

TEST(Usage, SizesThatMakeNoSense) {
  for (const char* value : {"0", "-2", "nan", "inf", "-inf", "1e999", "two", "", "2mm", "2,5"}) {
    expect_usage_error({mesh_with({"--size", value}),
                        {"--size", std::string(value) == "1e999" ? "1e999" : value, "is not a size in mm"}});
  }
  expect_usage_error({mesh_with({"--size", "1e-9"}), {"--size", "1e-09", "--max-vertices"}});
}

TEST(Usage, ValuesOutOfRange) {
  for (const Misuse& misuse : std::vector<Misuse>{
           {mesh_with({"--alpha", "0"}), {"--alpha", "greater than 0"}},
           {mesh_with({"--facet-radius-edge", "0.1"}), {"--facet-radius-edge", "0.1", "at least"}},
           {mesh_with({"--cell-radius-edge", "-1"}), {"--cell-radius-edge", "-1", "at least"}},
           {mesh_with({"--small-slack", "0.9"}), {"--small-slack", "0.9", "at least"}},
           {mesh_with({"--facet-distance", "0"}), {"--facet-distance", "0", "or none"}},
           {mesh_with({"--min-dihedral", "61"}), {"--min-dihedral", "61", "from 0 to 60"}},
           {mesh_with({"--optimize", "fulll"}), {"--optimize", "fulll", "did you mean full?"}},
           {mesh_with({"--max-vertices", "1.5"}), {"--max-vertices", "1.5", "whole number"}},
           {mesh_with({"--seed", "-1"}), {"--seed", "-1", "whole number"}},
           {mesh_with({"--seeding", "lattice"}), {"--seeding", "lattice", "bulk"}},
           {mesh_with({"--space", "lsp"}), {"--space", "lsp", "did you mean lps?"}},
           {mesh_with({"--inside", "abvoe"}), {"--inside", "abvoe", "did you mean above?"}},
           {mesh_with({"--level", "nan"}), {"--level: nan is not a level: it must be a finite number"}},
           {mesh_with({"--level", "high"}), {"--level: \"high\" is not a level: it must be a finite number"}},
           {mesh_with({"--size", "2", "--size", "3"}), {"--size", "more than once", "2", "3"}},
           {mesh_with({"--size"}), {"--size", "value is missing"}},  // usage.value_missing
           {mesh_with({"--outside", "200"}), {"outside"}},
           {mesh_with({"--quiet=3"}), {"quiet"}},  // usage.command_line
       }) {
    expect_usage_error(misuse);
  }
}

void expect_hint(const std::vector<std::string>& arguments, int status, const std::string& error,
                 const std::string& hint) {
  const TestFolder folder;
  const RunResult run = run_scantet(arguments, {folder.path()});
  EXPECT_EQ(run.status, status) << run.err;
  EXPECT_NE(run.err.find(error), std::string::npos) << run.err;
  EXPECT_NE(run.err.find("hint: " + hint), std::string::npos) << run.err;
}

TEST(Usage, HintsSayWhereThingsGo) {
  expect_hint(mesh_with({"-o", "x.html"}), 2, "--output: x.html: .html is a format of reports", "give --report x.html");
  expect_hint(mesh_with({"--report", "x.vtu"}), 2, "--report: x.vtu: .vtu is a format of meshes",
              "scantet mesh writes meshes: --output x.vtu");
  expect_hint({"convert", "a.vtu", "b.foo"}, 2, "error: b.foo: unknown extension .foo", "the extension chooses");
  expect_hint({"convert", "a.vtu", "b.svg"}, 2, "error: b.svg: .svg is a format", "scantet report MESH --report b.svg");
  const TestFolder folder;
  write_bytes(folder / "a.mgz", "\x1f\x8b");
  expect_hint({"info", folder / "a.mgz"}, 3, "FreeSurfer's .mgz is not read",
              "convert it with FreeSurfer's 'mri_convert " + folder / "a.mgz" + " " + folder / "a.nii.gz'");
  expect_hint({"mesh", sample("labels_shell.nrrd"), "--label-names", "nofile"}, 3, "'nofile'", "check the path");
  write_bytes(folder / "a.json", "text");
  expect_hint(mesh_with({"--materials", folder / "a.json", "--deck", "static", "-o", "a.inp"}), 2,
              "not valid JSON: parse error", "docs/materials.md");
  for (const char* text : {"text", "{\"scantet\": \"1\"}", "{\"kind\": \"certificate\"}"}) {
    write_bytes(folder / "a.json", text);
    const RunResult run = run_scantet({"verify", "--certificate", folder / "a.json"});
    EXPECT_EQ(run.status, 3);
    EXPECT_EQ(run.err.find("json.exception"), std::string::npos) << run.err;
  }
}

TEST(Usage, NullOfAFlagInAConfigurationIsAsNotGiven) {
  const TestFolder folder;
  write_bytes(folder / "job.json", "{\"level\": 127.5, \"size\": 5, \"plan\": null, \"as-grey\": null}");
  const RunResult run =
      run_scantet({"mesh", sample("sphere.nrrd"), "--config", folder / "job.json", "-o", folder / "a.vtu"});
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_EQ(folder.names().size(), 2U) << "it is no plan";
}

TEST(Usage, OptionsThatDoNothingAreRefused) {
  const auto idle = [](const std::vector<std::string>& more, const std::vector<std::string>& says) {
    expect_usage_error({mesh_with(more), says});
  };
  idle({"--size", "2", "--least-size", "0.5"},
       {"--least-size: it does nothing here", "the sizes of this job are numbers"});
  idle({"--least-size", "0.5"}, {"--least-size: it does nothing here"});
  idle({"--size", "2", "--boundary-size", "1", "--region-size", "1=1", "--least-size", "0.5"}, {"--least-size"});
  idle({"--size", "auto", "--boundary-size", "1", "--least-size", "0.5"}, {"--least-size: it does nothing here"});
  for (const char* option : {"--feature-share", "--lipschitz"}) {
    const std::vector<std::string> says{std::string(option) + ": it does nothing here", "shape of the boundary"};
    idle({option, "0.3"}, says);
    idle({"--size", "2", option, "0.3"}, says);
    idle({"--size", "2 + 0*x", option, "0.3"}, says);
    idle({"--size", "auto", "--boundary-size", "2", option, "0.3"}, says);
  }
  for (const std::string larger : {"2", "5"}) {
    idle({"--size", "2", "--boundary-size", larger},
         {"--boundary-size: it does nothing here: " + larger + " mm is not less than the size inside, 2 mm"});
    idle({"--boundary-size", larger}, {"--boundary-size: it does nothing here"});  // 2 is the default
  }
  expect_usage_error({{"mesh", sample("sphere.nrrd"), "--level", "127.5", "--space", "lps"},
                      {"--space: it does nothing here", "mesh files, and none is written"}});
  // Options of other inputs.
  idle({"--bounds", "0,0,0,1,1,1"}, {"--bounds: it does nothing here: it is an option of other inputs than "});
  expect_usage_error({{"info", sample("sphere.nrrd"), "--repair"}, {"--repair: it does nothing here", "sphere.nrrd"}});
  expect_usage_error(
      {{"convert", sample("sphere.nrrd"), "a.vdb", "--space", "ras"}, {"--space: it does nothing here"}});
  expect_usage_error({{"convert", "a.mesh", "a.vtk", "--outside", "3"}, {"--outside: it does nothing here", "a.mesh"}});
}

TEST(Usage, OptionsOfAConfigurationThatDoNothingAreRefusedUnlessTakenBack) {
  const TestFolder folder;
  write_bytes(folder / "job.json",
              "{\"level\": 127.5, \"size\": \"auto\", \"least-size\": 3, \"feature-share\": null}");
  const auto run = [&](std::vector<std::string> more) {
    more.insert(more.begin(), {"mesh", sample("sphere.nrrd"), "--config", folder / "job.json"});
    return run_scantet(more);
  };
  EXPECT_EQ(run({}).status, 0);
  const RunResult idle = run({"--size", "3"});
  EXPECT_EQ(idle.status, 2);
  EXPECT_NE(idle.err.find("job.json: \"least-size\": it does nothing here"), std::string::npos) << idle.err;
  EXPECT_EQ(run({"--size", "3", "--least-size", "none"}).status, 0);
}

// The counterpart: each of them beside what it needs.
TEST(Usage, OptionsThatDoSomethingAreTaken) {
  const std::vector<std::vector<std::string>> jobs{
      {"--size", "2.5 + 0*x", "--least-size", "3"},
      {"--size", "3", "--boundary-size", "auto", "--feature-share", "0.3", "--least-size", "2"},
      {"--size", "auto", "--lipschitz", "1"},
      {"--size", "3", "--region-size", "1=4", "--boundary-size", "3.5"},
      {"--size", "3", "--min-dihedral", "1", "--optimize", "none"},
      {"--size", "3", "--space", "lps", "-o", "a.vtk"},
      {"--size", "3", "--quiet", "--no-theory", "--report", "a.json"},
      {"--size", "3", "--seed", "0", "--threads", "0", "--facet-distance", "none", "--components", "all"}};
  for (const std::vector<std::string>& job : jobs) {
    const TestFolder folder;
    std::vector<std::string> arguments{"mesh", sample("sphere.nrrd"), "--level", "127.5"};
    arguments.insert(arguments.end(), job.begin(), job.end());
    const RunResult run = run_scantet(arguments, {folder.path()});
    EXPECT_EQ(run.status, 0) << job[0] << " " << job[2] << ": " << run.err;
  }
}

TEST(Usage, MissingLevelSuggestsOne) {
  const RunResult run = run_scantet({"mesh", sample("sphere.nrrd")});
  EXPECT_EQ(run.status, 2);
  EXPECT_NE(run.err.find("--level is missing"), std::string::npos) << run.err;
  EXPECT_NE(run.err.find("hint: try --level "), std::string::npos) << run.err;
  EXPECT_NE(run.err.find("scantet info"), std::string::npos) << run.err;
}

TEST(Usage, SetsAreLookedForBeforeTheScanIsRead) {
  const TestFolder folder;
  const std::string constants = R"("youngs_modulus_mpa": 1, "poissons_ratio": 0.3)";
  write_bytes(folder / "a.json", "{\"places\": [{\"name\": \"a\", \"where\": \"set(lid)\", " + constants + "}]}");
  write_bytes(folder / "b.json", "{\"places\": [{\"name\": \"a\", \"where\": \"set(foot)\", " + constants + "}]}");
  const std::vector<std::pair<std::vector<std::string>, std::string>> cases{
      {{"--set", "a=set(b)", "--set", "b=x > 0"}, "no set before it is called \"b\""},
      {{"--materials", "a.json"}, "no set before it is called \"lid\""},
      {{"--set", "foot=x > 0", "--deck", "static", "--materials", "b.json", "--hold", "fot"}, "did you mean foot?"},
      {{"--set", "foot=facets:x > 0", "--deck", "static", "--materials", "b.json", "--hold", "foot"}, "has no nodes"},
      {{"--deck", "static", "--materials", "b.json", "-o", "my femur.inp"}, "no names with blanks"},
  };
  for (const auto& [more, says] : cases) {
    std::vector<std::string> words{"mesh", "none.nrrd", "--level", "1", "-o", "out.inp"};
    words.insert(words.end(), more.begin(), more.end());
    const RunResult run = run_scantet(words, {folder.path()});
    EXPECT_EQ(run.status, 2) << run.err;
    EXPECT_NE(run.err.find(says), std::string::npos) << run.err;
  }
}

TEST(Usage, RegionsAreLookedForBeforeMeshing) {
  const TestFolder folder;
  const RunResult run = run_scantet(
      {"mesh", sample("labels_octants.nrrd"), "--labels", "all", "--set", "a=region(region_12)", "-o", "out.vtu"},
      {folder.path()});
  EXPECT_EQ(run.status, 2) << run.err;
  EXPECT_NE(run.err.find("no region of the object is called \"region_12\""), std::string::npos) << run.err;
  EXPECT_NE(run.err.find("did you mean region_1?"), std::string::npos) << run.err;
}

TEST(Usage, BadConfigurations) {
  const std::vector<std::pair<std::string, std::string>> cases{
      {"{", "line 1"},
      {"[]", "not a JSON object"},
      {"{\"levle\": 3}", "did you mean level?"},
      {"{\"size\": \"small\"}", "\"size\": \"small\" is not a size in mm"},
      {"{\"size\": -1}", "-1 is not a size in mm"},
      {"{\"size\": [1, 2]}", "more than once"},
      {"{\"size\": {}}", "\"size\""},
      {"{\"level\": 1, \"level\": 2}", "appears twice"},
      {"{\"config\": \"other.json\"}", "config"},
  };
  for (const auto& [text, says] : cases) {
    const TestFolder folder;
    write_bytes(folder / "job.json", text);
    const RunResult run =
        run_scantet({"mesh", sample("sphere.nrrd"), "--config", "job.json", "-o", "out.vtu"}, {folder.path()});
    EXPECT_EQ(run.status, 2) << text << run.err;
    EXPECT_NE(run.err.find("error: job.json: "), std::string::npos) << text << run.err;
    EXPECT_NE(run.err.find(says), std::string::npos) << run.err;
    EXPECT_EQ(folder.names(), std::vector<std::string>{"job.json"}) << text;
  }
  expect_usage_error({mesh_with({"--config", "none.json"}), {"none.json", "cannot be read"}});
}

}  // namespace
}  // namespace scantet
