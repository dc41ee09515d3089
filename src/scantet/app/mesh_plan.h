// What is to be expected of a job, without doing it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "scantet/app/mesh_job.h"
#include "scantet/plugin/input_plugin.h"
#include "scantet/size_options/mesh_prediction.h"
#include "scantet/size_options/size_choice.h"

namespace scantet {

/// What a job has to keep to; none: no bound.
struct PlanLimits {
  double vertices = 0;           ///< --max-vertices
  double memory_bytes = 0;       ///< --max-memory, or what the machine has
  bool is_memory_asked = false;  ///< by --max-memory
  std::optional<double> time_s;  ///< --max-time
};

/// A prediction for this machine, and whether it keeps to the limits.
struct MeshPlan {
  std::string size;  ///< as the report has it
  MeshFeatures features;
  MeshPrediction mesh;
  double held_bytes = 0;  ///< by the program before it meshes
  double seconds = 0;     ///< on this machine, with the threads of the job; without reading, audit and writing
  double trial_s = 0;     ///< processor time of a small mesh, by which this machine is compared
  int threads = 1;
  PlanLimits limits;

  /// What does not fit, each as a sentence without a full stop; empty: all does.
  std::vector<std::string> misfits() const;
};

/// Makes the plan for the size that was chosen; runs on the threads of with_threads(). None if cancelled.
std::optional<MeshPlan> plan_mesh(const MeshJob& job, const OpenedDomain& opened, const ChosenSize& size,
                                  Progress& progress);

/// For people and programs.
std::vector<InfoSection> describe_plan(const MeshPlan& plan);

/// Writes the plan as JSON to the reports of the job. Throws Error: usage.format (a report that is not .json);
/// output.*.
void write_plan(const MeshJob& job, const std::vector<InfoSection>& plan);

/// Throws Error (usage.format) if a report of the job is not JSON.
void check_plan_reports(const MeshJob& job);

}  // namespace scantet
