// `scantet cohort`: many scans by Snakemake. The command is a program in Python, which this finds and becomes. Its
// options are declared in cohort/options.tsv, for it and for the manual page and completions, which are made from here.
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <sstream>
#include <string_view>

#include "scantet/base/error.h"
#include "scantet/cli/command.h"

namespace scantet {
namespace {

namespace fs = std::filesystem;
using namespace std::string_view_literals;

#include "scantet/cli/cohort_options.inc"

constexpr const char* kPython = "/usr/bin/python3";  // Debian's: it has Debian's Snakemake

fs::path own_path() {
  std::error_code code;
  return fs::read_symlink("/proc/self/exe", code);
}

// The folder that holds the package: beside the program's, installed or in a build.
fs::path package_folder() {
  fs::path folder = own_path().parent_path().parent_path() / "share" / "scantet" / "cohort";
  if (!fs::exists(folder / "scantet_cohort" / "__main__.py")) {
    throw Error(Fault::usage, "usage.cohort", "the cohort's files are not in " + folder.string(),
                "install Debian's package scantet-cohort, or all of scantet by cmake --install");
  }
  return folder;
}

class CohortCommand final : public Command {
 public:
  CohortCommand() {
    std::istringstream lines{std::string(kCohortOptions)};
    for (std::string name; std::getline(lines, name, '\t');) {
      std::string kind;
      OptionText told;
      std::getline(lines, kind, '\t');
      std::getline(lines, told.metavar, '\t');
      std::getline(lines, told.group, '\t');
      std::getline(lines, told.help);
      if (kind == "flag") {
        options_.add(name, flag_, told);
      } else if (kind == "list") {
        options_.add(name, list_, told);
      } else {
        options_.add(name, value_, told);
      }
    }
  }
  const CommandText& text() const override {
    static const CommandText text{
        "cohort",
        "cohort BIDS_DIR OUTPUT_DIR participant|group [options] [-- MESH-OPTIONS]",
        "mesh all scans of a study, here or on a cluster",
        "Meshes every scan of a BIDS dataset or of a folder, one job each, by Snakemake: goes on where it was killed, "
        "meshes nothing twice, and puts bad scans into quarantine with their reason. Then `group` makes one page about "
        "all of them. It needs /usr/bin/python3 with Snakemake and NumPy. Lists of values follow their option, with "
        "spaces between.",
        {{"every scan of a study, on two cores",
          "scantet cohort study meshes participant --n-cpus 2 -- --level 60 --size 3"},
         {"one page about all of them", "scantet cohort study meshes group"}},
        ""};
    return text;
  }
  std::vector<const OptionSet*> option_sets() const override { return {&options_}; }
  bool takes_words() const override { return true; }
  int run_words(const std::vector<std::string>& words) override {
    const std::string folder = package_folder().string();
    // Nothing is imported from the working folder, which may be a stranger's dataset; an empty part of an inherited
    // PYTHONPATH would mean that folder.
    ::setenv("PYTHONSAFEPATH", "1", 1);
    ::setenv("PYTHONPATH", folder.c_str(), 1);
    ::setenv("SCANTET_PROGRAM", own_path().c_str(), 1);
    ::setenv("PYTHONDONTWRITEBYTECODE", "1", 0);  // an installation stays as it was installed
    std::vector<std::string> all{kPython, "-m", "scantet_cohort"};
    all.insert(all.end(), words.begin(), words.end());
    std::vector<char*> pointers;
    pointers.reserve(all.size() + 1);
    for (std::string& word : all) pointers.push_back(word.data());
    pointers.push_back(nullptr);
    ::execv(kPython, pointers.data());
    throw Error(Fault::usage, "usage.cohort", std::string(kPython) + " cannot be run: " + std::strerror(errno),
                "apt-get install python3 python3-numpy snakemake");
  }
  int run(const CommandLine&) override { return run_words({}); }

 private:
  OptionSet options_;  // for what is made of the declarations; the Python program reads the words
  bool flag_ = false;
  std::vector<std::string> list_;
  std::string value_;
};

}  // namespace

std::unique_ptr<Command> make_cohort_command() {
  return std::make_unique<CohortCommand>();
}

}  // namespace scantet
