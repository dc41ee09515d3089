// `scantet diff`: how two meshes differ.
#include "scantet/app/diff_job.h"
#include "scantet/cli/command.h"
#include "scantet/cli/print.h"
#include "scantet/cli/progress_line.h"

namespace scantet {
namespace {

class DiffCommand final : public Command {
 public:
  DiffCommand() { job_.declare_options(options_); }
  const CommandText& text() const override {
    static const CommandText text{
        "diff",
        "diff A B [options]",
        "how two meshes differ",
        "Compares two tetrahedral mesh files, of whatever formats: whether they have the same bytes, or the same tets "
        "in whatever order; how far their boundaries are from each other, both ways, between a lower and an upper "
        "bound; regions with their volumes; nodes on edges, sets and fields where the tets are the same; angles and "
        "shapes; topology; and how they were made, as far as the files say. Exit status 0 if the meshes are the same "
        "within --tolerance, 4 if they differ.",
        {{"after an update, or in another format: the same mesh again?", "scantet diff ours.vtu theirs.msh"},
         {"the same surface to a hundredth of a millimetre, by two programs",
          "scantet diff ours.vtu theirs.msh --tolerance 0.01"},
         {"where they differ, to look at", "scantet diff ours.vtu theirs.msh --report diff.html --report diff.json"}},
        ""};
    return text;
  }
  std::vector<const OptionSet*> option_sets() const override { return {&options_}; }
  int run(const CommandLine& line) override {
    set_all(options_, line.values);
    const std::vector<std::string> files = take_arguments(line, {"A", "B"});
    job_.first = files[0];
    job_.second = files[1];
    ProgressLine progress(error_is_terminal());
    const DiffOutcome outcome = run_diff(job_, progress);
    progress.clear();
    if (outcome.cancelled) return print_cancelled();
    print(outcome.text);
    for (const std::string& file : outcome.written) print("wrote " + file + "\n");
    return outcome.is_same ? kExitDone : kExitUnmet;
  }

 private:
  DiffJob job_;
  OptionSet options_;
};

}  // namespace

std::unique_ptr<Command> make_diff_command() {
  return std::make_unique<DiffCommand>();
}

}  // namespace scantet
