// Help teaches: it shows real command lines, every option with its range and default, and the exit statuses.
#include <gtest/gtest.h>

#include <sstream>

#include "run_process.h"

namespace scantet {
namespace {

const std::vector<std::string> kCommands{"mesh", "info", "report", "diff", "convert", "plugins"};

std::vector<std::string> words_of(const std::string& line) {
  std::istringstream stream(line);
  std::vector<std::string> words;
  for (std::string word; stream >> word;) words.push_back(word);
  return words;
}

TEST(Help, ProgramHelpListsCommandsExamplesAndStatuses) {
  for (const char* form : {"--help", "-h", "help"}) {
    const RunResult run = run_scantet({form});
    EXPECT_EQ(run.status, 0);
    EXPECT_EQ(run.err, "");
    for (const std::string& command : kCommands) EXPECT_TRUE(contains(run.out, "\n  " + command + " ")) << command;
    for (const char* status : {"  0 ", "  1 ", "  2 ", "  3 ", "  4 ", "  5 ", "  130 "}) {
      EXPECT_TRUE(contains(run.out, std::string("\n") + status)) << status;
    }
    EXPECT_TRUE(contains(run.out, "scantet mesh ")) << run.out;
  }
}

TEST(Help, EveryCommandExplainsItself) {
  for (const std::string& command : kCommands) {
    const RunResult run = run_scantet({command, "--help"});
    EXPECT_EQ(run.status, 0) << command;
    EXPECT_EQ(run.err, "") << command;
    EXPECT_TRUE(contains(run.out, "Usage: scantet " + command)) << run.out;
    EXPECT_TRUE(contains(run.out, "Examples:")) << run.out;
    EXPECT_TRUE(contains(run.out, "Exit status:")) << run.out;
    EXPECT_EQ(run_scantet({"help", command}).out, run.out) << command;
  }
}

TEST(Help, LinesFitATerminal) {
  for (const std::string& command : kCommands) {
    std::istringstream lines(run_scantet({command, "--help"}).out);
    for (std::string line; std::getline(lines, line);) EXPECT_LE(line.size(), 120u) << line;
  }
}

// The command lines shown are real: nothing is wrong with them but that head.nii.gz is not there.
TEST(Help, ExamplesAreValid) {
  int examples = 0;
  for (const std::string& command : kCommands) {
    std::istringstream lines(run_scantet({command, "--help"}).out);
    for (std::string line; std::getline(lines, line);) {
      if (line.rfind("  scantet ", 0) != 0) continue;
      const TestFolder folder;
      std::vector<std::string> words = words_of(line);
      words.erase(words.begin());
      write_bytes(folder / "job.json", "{\"level\": 60}");
      const RunResult run = run_scantet(words, {folder.path()});
      ++examples;
      if (command == "plugins") {
        EXPECT_EQ(run.status, 0) << line;
      } else {
        EXPECT_EQ(run.status, 3) << line << "\n" << run.err;
        EXPECT_TRUE(contains(run.err, words[1])) << run.err;
      }
    }
  }
  EXPECT_GE(examples, 8);
}

TEST(Help, MeshHelpGivesRangesDefaultsAndUnits) {
  const std::string help = run_scantet({"mesh", "--help"}).out;
  for (const char* option : {"--level V",
                             "--inside SIDE",
                             "--outside V",
                             "--size SIZE",
                             "--alpha X",
                             "--facet-radius-edge X",
                             "--cell-radius-edge X",
                             "--small-slack X",
                             "--facet-distance MM",
                             "--max-vertices N",
                             "--max-time TIME",
                             "--max-memory SIZE",
                             "--seeding HOW",
                             "--optimize HOW",
                             "--seed N",
                             "--space AXES",
                             "-o, --output FILE",
                             "--report FILE",
                             "--config FILE",
                             "--quiet"}) {
    EXPECT_TRUE(contains(help, option)) << option;
  }
  std::string flowing;  // wherever lines break
  for (const std::string& word : words_of(help)) flowing += word + " ";
  EXPECT_TRUE(contains(help, "greater than 0"));
  EXPECT_TRUE(contains(flowing, "default 20000000"));
  EXPECT_TRUE(contains(help, "above or below; default above"));
  EXPECT_TRUE(contains(help, "in mm"));
}

TEST(Help, VersionIsPrinted) {
  const RunResult run = run_scantet({"--version"});
  EXPECT_EQ(run.status, 0);
  EXPECT_EQ(words_of(run.out).size(), 2u);
  EXPECT_EQ(words_of(run.out).front(), "scantet");
}

TEST(Help, PluginsListsInputsAndFormats) {
  const std::string list = run_scantet({"plugins"}).out;
  for (const char* part : {"image:", "NRRD", "NIfTI", "DICOM", ".vtu", ".stl", ".msh", ".inp"}) {
    EXPECT_TRUE(contains(list, part)) << part;
  }
}

TEST(Help, OptionsPageIsWhatTheProgramPrints) {
  const std::string page = read_bytes(SCANTET_OPTIONS_PAGE);
  ASSERT_FALSE(page.empty());
  EXPECT_EQ(run_scantet({"options"}).out, page) << "run: scantet options > docs/options.md";
}

}  // namespace
}  // namespace scantet
