// Wrong use: status 2, one line that names the option and the value, a hint, nothing written, no time lost.
#include <gtest/gtest.h>

#include <algorithm>

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
           {{}, {"no command"}},
           {{"mehs"}, {"mehs", "did you mean mesh?"}},
           {{"mesh"}, {"INPUT is missing"}},
           {{"mesh", "a.nrrd", "b.nrrd"}, {"unexpected argument", "b.nrrd"}},
           {{"info"}, {"INPUT is missing"}},
           {{"report"}, {"MESH is missing"}},
           {{"convert", "a.vtu"}, {"FILE is missing"}},
           {{"plugins", "x"}, {"unexpected argument"}},
       }) {
    expect_usage_error(misuse);
  }
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
           {mesh_with({"--facet-distance", "0"}), {"--facet-distance", "0", "or none"}},
           {mesh_with({"--min-dihedral", "61"}), {"--min-dihedral", "61", "from 0 to 60"}},
           {mesh_with({"--optimize", "fulll"}), {"--optimize", "fulll", "did you mean full?"}},
           {mesh_with({"--max-vertices", "1.5"}), {"--max-vertices", "1.5", "whole number"}},
           {mesh_with({"--seed", "-1"}), {"--seed", "-1", "whole number"}},
           {mesh_with({"--seeding", "lattice"}), {"--seeding", "lattice", "bulk"}},
           {mesh_with({"--space", "lsp"}), {"--space", "lsp", "did you mean lps?"}},
           {mesh_with({"--inside", "abvoe"}), {"--inside", "abvoe", "did you mean above?"}},
           {mesh_with({"--level", "nan"}), {"--level", "nan", "finite"}},
           {mesh_with({"--level", "high"}), {"--level", "high", "number"}},
           {mesh_with({"--size", "2", "--size", "3"}), {"--size", "more than once", "2", "3"}},
           {mesh_with({"--size"}), {"--size", "value is missing"}},
           {mesh_with({"--outside", "200"}), {"outside"}},
       }) {
    expect_usage_error(misuse);
  }
}

TEST(Usage, MissingLevelSuggestsOne) {
  const RunResult run = run_scantet({"mesh", sample("sphere.nrrd")});
  EXPECT_EQ(run.status, 2);
  EXPECT_NE(run.err.find("--level is missing"), std::string::npos) << run.err;
  EXPECT_NE(run.err.find("hint: try --level "), std::string::npos) << run.err;
  EXPECT_NE(run.err.find("scantet info"), std::string::npos) << run.err;
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
