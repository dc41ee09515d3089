// `scantet mesh`: the main job.
#include "scantet/app/job.h"
#include "scantet/app/mesh_command_options.h"
#include "scantet/cli/command.h"
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
  explicit MeshCommand(const PluginRegistry& plugins) : plugins_(plugins), options_(plugins) {}
  const CommandText& text() const override {
    static const CommandText text = describe();
    return text;
  }
  std::vector<const OptionSet*> option_sets() const override { return options_.sets(); }
  int run(const CommandLine& line) override {
    options_.job().input = take_arguments(line, {"INPUT"}).front();
    options_.take(line.values);
    const bool quiet = options_.is_quiet();
    ProgressLine progress(!quiet && error_is_terminal());
    const JobResult result = run_mesh_job(options_.job(), plugins_, progress);
    progress.clear();
    if (result.cancelled) return print_cancelled();
    return print_result(result, quiet);
  }

 private:
  const PluginRegistry& plugins_;
  MeshCommandOptions options_;
};

}  // namespace

std::unique_ptr<Command> make_mesh_command(const PluginRegistry& plugins) {
  return std::make_unique<MeshCommand>(plugins);
}

}  // namespace scantet
