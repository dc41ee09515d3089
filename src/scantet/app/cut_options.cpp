// Cuts are read when the job begins, to be refused before anything is read, and made when the input is open.
#include "scantet/app/cut_options.h"

#include <algorithm>

#include "scantet/app/cut_settling.h"
#include "scantet/app/opened_job.h"
#include "scantet/base/error.h"
#include "scantet/base/options.h"
#include "scantet/cuts/cut_domain.h"
#include "scantet/cuts/cut_grid.h"
#include "scantet/cuts/cut_text.h"

namespace scantet {
namespace {

constexpr double kStepsPerVoxel = 2;
constexpr double kStepsPerSize = 4;
constexpr double kStepsPerDiagonal = 400;

/// The step of the grids that rims are looked for in: half a voxel; of what has no voxels a quarter of the default
/// size, or less.
double step_of(const OpenedDomain& opened) {
  if (opened.frame) return opened.frame->min_spacing_mm() / kStepsPerVoxel;
  return std::min(opened.default_size_mm / kStepsPerSize, opened.domain->bounds().diagonal() / kStepsPerDiagonal);
}

std::string note_on_miss(const std::vector<std::string>& names) {
  std::string list;
  for (const std::string& name : names) list += (list.empty() ? "" : ", ") + name;
  return names.size() == 1 ? "the plane of " + list + " does not meet the object, or what other cuts leave of it"
                           : "the planes of " + list + " do not meet the object, or what other cuts leave of it";
}

}  // namespace

void declare_cut_options(OptionSet& options, CutOptions& cut) {
  const char* const group = "Cuts";
  options.add(
      "border", cut.border, {{"close", Border::close}, {"cap", Border::cap}},
      {group, "HOW", "a way to end the object",
       "What happens where a scan ends within the object. close: the surface closes within one voxel beyond; cap: "
       "the object ends flat at the outermost voxel centres, with sharp rims. Each cap is a boundary of its own "
       "in the files: border_left, border_right, border_anterior, border_posterior, border_superior, "
       "border_inferior."});
  options.add(
      "cut", cut.cuts,
      {group, "PLANE", "a plane",
       "Cuts the object flat, with a sharp rim, and keeps what is said: \"x < 10\", \"x + 2z > -3.5\", or between "
       "two planes \"-10 < y < 10\"; mm along the axes of the world, LPS. Several cuts make a box. Caps are "
       "boundaries of their own in the files: cut_1, cut_2, or as the cut is called, \"clamp: z > -40\". A cut along "
       "layers of voxels shows the labels of the last layer that it leaves."});
}

std::vector<CutPlane> read_cuts(const CutOptions& cut) {
  std::vector<CutPlane> planes;
  for (const std::string& text : cut.cuts) read_cut("--cut", text, planes);
  return planes;
}

void cut_opened(const MeshJob& job, OpenedDomain& opened) {
  if (!job.cut.is_any()) return;
  std::vector<CutPlane> planes = read_cuts(job.cut);
  const std::size_t asked = planes.size();
  if (job.cut.border == Border::cap) {
    if (opened.border.empty()) {
      throw Error(Fault::usage, "usage.no_effect",
                  "--border cap: it does nothing here: " + job.input + " is no grid of voxels, and has no border",
                  "leave it out, or cut the object with --cut");
    }
    planes.insert(planes.end(), opened.border.begin(), opened.border.end());
  }
  double spacing_mm = step_of(opened);
  for (int axis = 0; axis < 3 && opened.frame; ++axis) {
    spacing_mm = std::max(spacing_mm, opened.frame->spacing_mm(axis));
  }
  const Cutting cutting{planes, step_of(opened), spacing_mm};
  CutReport report;
  opened.domain = make_cut_domain(std::move(opened.domain), planes, cutting.step_mm, spacing_mm, &report);
  if (opened.grid) opened.grid = [whole = opened.grid, planes] { return cut_grid(whole(), planes); };
  if (opened.settle) opened.settle = settling_of_cut(std::move(opened.settle), *opened.domain, opened.grid, cutting);
  std::vector<std::string> missed;
  for (std::size_t k = 0; k < asked; ++k) {
    if (!report.meets[k]) missed.push_back(planes[k].name);
  }
  if (!missed.empty()) opened.notes.push_back(note_on_miss(missed));
  if (report.uncounted > 0 && report.uncounted + report.counted > 1) {
    opened.notes.push_back("cuts meet, or come near, " + std::to_string(report.uncounted) +
                           " of the object's components and cavities, and what is left of these is not compared with "
                           "the mesh; of the others " +
                           std::to_string(report.counted) + " are left whole, and are compared");
  }
  if (report.unsettled > 0) {
    opened.notes.push_back(
        "at " + std::to_string(report.unsettled) +
        " points of the cuts regions meet where no curve of the object is known to come: these points "
        "are found to within half a step of the grid that rims are looked for in");
  }
}

}  // namespace scantet
