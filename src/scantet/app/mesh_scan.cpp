// The steps of a job (job.cpp) without those that read and write.
#include "scantet/app/mesh_scan.h"

#include "scantet/app/mesh_job.h"
#include "scantet/app/opened_job.h"
#include "scantet/app/order_step.h"
#include "scantet/base/error.h"
#include "scantet/base/options.h"
#include "scantet/base/parallel.h"
#include "scantet/base/stopwatch.h"
#include "scantet/image/kept_components.h"
#include "scantet/reading/suggested_level.h"
#include "scantet/scan_input/label_input.h"
#include "scantet/scan_input/scan_object.h"
#include "scantet/scan_input/simplify_options.h"
#include "scantet/size_options/size_plan.h"

namespace scantet {
namespace {

std::optional<ComponentChoice> choice_of(const ScanMeshOptions& options) {
  const ComponentChoice choice{options.largest_count, options.min_component_mm3, options.fill_cavities_mm3};
  if (!choice.drops() && !(choice.fill_cavities_mm3 > 0)) return std::nullopt;
  return choice;
}

MeshJob job_of(const Scan& scan, const ScanMeshOptions& options) {
  MeshJob job;
  static_cast<MeshRequest&>(job) = options;
  job.resolve_bounds();
  job.input = "the scan (" + scan.format + ")";
  return job;
}

MeshOutcome outcome_of(JobResult&& result, Meshing&& meshing) {
  result.report.notes = result.notes;
  return {false, std::move(meshing.refined.mesh), std::move(result.report), std::move(result.notes),
          std::move(result.findings)};
}

OpenedDomain open_grey(const Scan& given, const std::string& input, const ScanMeshOptions& options,
                       Progress& progress) {
  if (!options.as_grey) {
    refuse_labels(given, input,
                  "say which labels are meshed (labels), take the values for grey ones (as_grey), or mesh a mask of 0 "
                  "and 1 at 0.5");
  }
  const Scan scan = simplified(given, options.simplification);
  NestedLevelSettings settings{options.levels, options.inside, options.outside};
  std::vector<std::string> notes;
  if (options.simplification.is_any()) notes.push_back(simplification_note(options.simplification, given.frame));
  if (settings.levels.empty()) {
    settings.levels = {suggested_level(scan)};
    notes.push_back("no level given: " + number_text(settings.levels.front()) + ", Otsu's threshold");
  }
  OpenedDomain opened = open_object(scan, settings, {options.close_handles_mm}, choice_of(options), progress);
  opened.notes.insert(opened.notes.begin(), notes.begin(), notes.end());
  return opened;
}

// What is asked of grey values makes no sense of labels; a part of the image does.
OpenedDomain open_segmentation(const Scan& given, const ScanMeshOptions& options, const std::vector<CutPlane>& cuts,
                               Progress& progress) {
  const Simplification& how = options.simplification;
  const bool of_levels = !options.levels.empty() || options.inside != InsideSide::above || options.outside ||
                         options.as_grey || options.close_handles_mm || choice_of(options) || how.median_voxels > 0 ||
                         how.smooth_mm || how.resample_mm;
  if (of_levels) {
    throw Error(Fault::usage, "usage.labels", "labels are meshed, and something is asked of levels or grey values, too",
                "leave out one of the two");
  }
  OpenedDomain opened = open_label_scan(simplified(given, how), *options.labels, cuts, progress);
  if (how.is_any()) opened.notes.push_back(simplification_note(how, given.frame));
  return opened;
}

MeshOutcome mesh_on_these_threads(const Scan& given, const ScanMeshOptions& options, Progress& progress) {
  MeshOutcome cancelled;
  cancelled.cancelled = true;
  const Stopwatch total;
  const MeshJob job = job_of(given, options);
  const SizePlan sizes = plan_sizes(job.sizes);
  Budget budget(progress, std::nullopt, std::nullopt);
  OpenedDomain opened = options.labels ? open_segmentation(given, options, read_cuts(job.cut), budget)
                                       : open_grey(given, job.input, options, budget);
  if (!opened.domain) return cancelled;
  cut_opened(job, opened);
  ChosenSize size = choose_job_size(job, sizes, opened, budget);
  const std::vector<PhaseAccount> fitting = fit_opened(job, sizes, size, opened, budget);
  if (!size.field) return cancelled;
  opened.phases.insert(opened.phases.end(), fitting.begin(), fitting.end());
  JobResult result;
  ReportTiming timing;
  std::optional<Meshing> meshing = mesh_opened(job, opened, size, budget, timing, result);
  if (!meshing) return cancelled;
  if (job.order == ElementOrder::second && !make_order_two(meshing->refined.mesh, *opened.domain, result, progress)) {
    return cancelled;
  }
  timing.total = total.seconds();
  result.report.timing_s = timing;
  result.report.phases.insert(result.report.phases.begin(), opened.phases.begin(), opened.phases.end());
  result.report.input = ReportInput{job.input, "", opened.frame};
  return outcome_of(std::move(result), std::move(*meshing));
}

}  // namespace

MeshOutcome mesh_scan(const Scan& scan, const ScanMeshOptions& options, Progress& progress) {
  MeshOutcome outcome;
  with_threads(options.mesher.threads, [&] { outcome = mesh_on_these_threads(scan, options, progress); });
  return outcome;
}

}  // namespace scantet
