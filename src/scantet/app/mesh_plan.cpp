// The machine is timed by a small mesh of its own, so that seconds are those of this machine; all else follows from the
// domain and the sizes.
#include "scantet/app/mesh_plan.h"

#include <algorithm>
#include <ostream>

#include "scantet/app/info.h"
#include "scantet/app/machine_speed.h"
#include "scantet/base/error.h"
#include "scantet/base/file_extension.h"
#include "scantet/base/memory.h"
#include "scantet/base/parallel.h"
#include "scantet/base/quantity.h"
#include "scantet/io/atomic_file.h"
#include "scantet/size_options/prediction_coefficients.h"
#include "scantet/size_options/target_size.h"

namespace scantet {
namespace {

constexpr int kDigits = 3;

double rounded(double value) {
  return std::stod(number_text(value, kDigits));
}

std::string count_text(double count) {
  constexpr double kPlain = 1e12;
  return count < kPlain ? std::to_string(static_cast<std::uint64_t>(count)) : number_text(count, kDigits);
}

}  // namespace

std::vector<std::string> MeshPlan::misfits() const {
  std::vector<std::string> found;
  if (mesh.vertices > limits.vertices) {
    found.push_back("about " + count_text(rounded(mesh.vertices)) + " vertices are more than --max-vertices " +
                    count_text(limits.vertices));
  }
  if (held_bytes + mesh.bytes > limits.memory_bytes) {
    found.push_back("about " + bytes_text(held_bytes + mesh.bytes) + " of memory are more than " +
                    (limits.is_memory_asked ? "--max-memory " + bytes_text(limits.memory_bytes)
                                            : "the " + bytes_text(limits.memory_bytes) + " that this machine has"));
  }
  if (limits.time_s && seconds > *limits.time_s) {
    found.push_back("about " + number_text(seconds, 2) + " s are more than --max-time " + number_text(*limits.time_s) +
                    " s");
  }
  return found;
}

std::optional<MeshPlan> plan_mesh(const MeshJob& job, const OpenedDomain& opened, const ChosenSize& size,
                                  Progress& progress) {
  MeshPlan plan;
  plan.size = size.text;
  plan.held_bytes = resident_bytes();
  const double available = plan.held_bytes + available_bytes();
  progress.report({"plan", {}, 0, std::nullopt, 0});
  const auto features =
      find_features(*opened.domain, *size.field, job.mesher.bounds.alpha, finest_mm(opened), progress);
  if (!features) return std::nullopt;
  plan.features = *features;
  plan.mesh = predict(*features);
  plan.mesh.vertices = std::max(plan.mesh.vertices, size.expected_vertices);
  plan.threads = thread_count();
  plan.trial_s = trial_seconds();
  plan.seconds = plan.mesh.seconds(plan.threads) * plan.trial_s / kTrialSeconds;
  plan.limits.vertices = static_cast<double>(job.mesher.max_vertices);
  plan.limits.is_memory_asked = job.budget.memory_bytes().has_value();
  plan.limits.memory_bytes = job.budget.memory_bytes().value_or(available);
  plan.limits.time_s = job.budget.time_s();
  if (progress.cancelled()) return std::nullopt;
  return plan;
}

std::vector<InfoSection> describe_plan(const MeshPlan& plan) {
  const auto count = [](double value) {
    constexpr double kMost = 9e18;  // of the integers of info
    return static_cast<std::int64_t>(std::min(rounded(value), kMost));
  };
  const std::vector<std::string> misfits = plan.misfits();
  InfoSection expected{"plan",
                       "To be expected (nothing was meshed)",
                       {{"size", "size", plan.size, ""},
                        {"vertices", "vertices, about", count(plan.mesh.vertices), ""},
                        {"tets", "tetrahedra, about", count(plan.mesh.tets), ""},
                        {"memory_bytes", "memory, about", count(plan.held_bytes + plan.mesh.bytes), "bytes"},
                        {"seconds", "time to mesh, about", rounded(plan.seconds), "s"},
                        {"threads", "on threads", static_cast<std::int64_t>(plan.threads), ""},
                        {"fits", "fits", misfits.empty(), ""}}};
  for (std::size_t n = 0; n < misfits.size(); ++n) {
    const std::string number = n == 0 ? "" : "_" + std::to_string(n + 1);
    expected.entries.push_back({"misfit" + number, "does not fit", misfits[n], ""});
  }
  InfoSection features{
      "features",
      "What that follows from",
      {{"inside", "cubes of the size inside", rounded(plan.features.inside), ""},
       {"cubes", "cubes of the size on the boundary", rounded(plan.features.cubes), ""},
       {"narrow", "places narrow beside the size", rounded(plan.features.narrow), ""},
       {"bent", "small cubes where the boundary is rough", rounded(plan.features.bent), ""},
       {"held_bytes", "memory held before", count(plan.held_bytes), "bytes"},
       {"trial_s", "processor time of a trial", rounded(plan.trial_s), "s"},
       {"processor_s", "processor time on the machine measured", rounded(plan.mesh.processor_s), "s"}}};
  return {std::move(expected), std::move(features)};
}

void write_plan(const MeshJob& job, const std::vector<InfoSection>& plan) {
  for (const std::string& file : job.reports) {
    write_file(file, [&](std::ostream& out) { out << info_json(plan); });
  }
}

void check_plan_reports(const MeshJob& job) {
  for (const std::string& file : job.reports) {
    if (file_extension(file) == ".json") continue;
    throw Error(Fault::usage, "usage.format", "--report: " + file + ": a plan is written as JSON only",
                "name a .json file, or leave out --plan");
  }
}

}  // namespace scantet
