// `scantet mesh`: the main job.
#include <algorithm>

#include "scantet/app/config.h"
#include "scantet/app/job.h"
#include "scantet/base/error.h"
#include "scantet/base/regular_file.h"
#include "scantet/cli/command.h"
#include "scantet/cli/plugin_options.h"
#include "scantet/cli/print.h"
#include "scantet/cli/progress_line.h"
#include "scantet/cli/results.h"

namespace scantet {
namespace {

CommandText describe() {
  return {
      "mesh",
      "mesh INPUT [-o FILE]... [options]",
      "mesh a scan",
      "Meshes the object in INPUT with tetrahedra. For a grey image that is where the trilinear field between the "
      "voxel "
      "centres is above --level; boundary vertices lie on it. Prints a table of the mesh and its quality, and writes "
      "the files asked for once the mesh is complete.",
      {{"a brain: values above 60, tetrahedra of circumradius up to 3 mm",
        "scantet mesh head.nii.gz --level 60 --size 3 -o brain.vtu"},
       {"for a solver and a printer, with a report",
        "scantet mesh head.nii.gz --level 60 --size 3 -o brain.inp -o brain.stl --report brain.json"},
       {"a smoother surface: triangles within 0.1 mm of it, and finer balls",
        "scantet mesh head.nii.gz --level 60 --size 3 --alpha 0.5 --facet-distance 0.1 -o fine.vtu"},
       {"without islands of noise: the largest component alone",
        "scantet mesh head.nii.gz --level 60 --components largest -o head.vtu"},
       {"the dark side of a level (air in a CT)", "scantet mesh head.nii.gz --level -300 --inside below -o air.vtu"},
       {"soft tissue and bone: two regions, one conforming mesh",
        "scantet mesh head.nii.gz --level -300 --level 300 --size 4 -o regions.msh"},
       {"options from a file, one of them changed", "scantet mesh head.nii.gz --config job.json --size 2"}},
      "INPUT is a file (NRRD, NIfTI, MetaImage, TIFF stack), a folder with a DICOM series, or FOLDER:UID to choose\n"
      "among several; scantet plugins lists what can be opened and written, scantet info suggests a level.\n"};
}

class MeshCommand final : public Command {
 public:
  explicit MeshCommand(const PluginRegistry& plugins)
      : plugins_(plugins), plugin_options_(plugins, &InputPlugin::declare_options) {
    job_.declare_options(job_options_);
    declare_plugin_files(options_, plugin_files_);
    options_.add("config", config_,
                 {"Run", "FILE", "a file name",
                  "JSON file with options, e.g. {\"level\": 60, \"size\": 3}; those on the command line win."});
    options_.add("quiet", quiet_,
                 {"Run", "", "a flag", "Print no table and no progress; errors and unmet bounds still are."});
  }
  const CommandText& text() const override {
    static const CommandText text = describe();
    return text;
  }
  std::vector<const OptionSet*> option_sets() const override {
    std::vector<const OptionSet*> sets = plugin_options_.sets();
    sets.push_back(&job_options_);
    sets.push_back(&options_);
    return sets;
  }
  int run(const CommandLine& line) override {
    job_.input = take_arguments(line, {"INPUT"}).front();
    take_options(line.values);
    job_.read = plugin_files_;
    if (!config_.empty()) job_.read.push_back(config_);
    ProgressLine progress(!quiet_ && error_is_terminal());
    const JobResult result = run_mesh_job(job_, plugins_, progress);
    progress.clear();
    if (result.cancelled) return print_cancelled();
    return print_result(result, quiet_);
  }

 private:
  void take_options(const std::vector<OptionValue>& typed);

  const PluginRegistry& plugins_;
  PluginOptions plugin_options_;  // for parsing and help; the job makes its own plugin
  MeshJob job_;
  OptionSet job_options_;
  std::vector<std::string> plugin_files_;
  std::string config_;
  bool quiet_ = false;
  OptionSet options_;  // of the command itself
};

// The command line wins over the configuration file, option by option.
void MeshCommand::take_options(const std::vector<OptionValue>& typed) {
  std::vector<OptionValue> for_job;
  const auto take = [&](const OptionValue& value) {
    if (options_.find(value.name) != nullptr) {
      options_.set(value);
    } else {
      for_job.push_back(value);
    }
  };
  for (const OptionValue& value : typed) take(value);
  if (!config_.empty()) {
    check_regular_file(config_);
    for (const OptionValue& value : read_config(config_)) {
      if (value.name == "config") {
        throw Error(Fault::usage, "usage.config", value.place + ": a configuration cannot name another", "remove it");
      }
      if (value.name == "plugin") {
        throw Error(Fault::usage, "usage.config", value.place + ": a configuration cannot load plugins",
                    "name it on the command line");
      }
      const bool overridden =
          std::any_of(typed.begin(), typed.end(), [&](const OptionValue& other) { return other.name == value.name; });
      if (!overridden) take(value);
    }
  }
  distribute_options(for_job, job_options_, plugin_options_.sets(), job_);
}

}  // namespace

std::unique_ptr<Command> make_mesh_command(const PluginRegistry& plugins) {
  return std::make_unique<MeshCommand>(plugins);
}

}  // namespace scantet
