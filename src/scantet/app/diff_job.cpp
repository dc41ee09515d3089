// What is compared is in check/; what of it counts is decided in diff_judgement.cpp.
#include "scantet/app/diff_job.h"

#include <algorithm>
#include <set>

#include "scantet/app/diff_judgement.h"
#include "scantet/app/mesh_tools.h"
#include "scantet/app/outputs.h"
#include "scantet/base/file_extension.h"
#include "scantet/base/name_list.h"
#include "scantet/base/parallel.h"
#include "scantet/check/mesh_difference.h"
#include "scantet/io/file_set.h"
#include "scantet/io/input_files.h"
#include "scantet/io/mesh_io.h"
#include "scantet/report/difference.h"

namespace scantet {
namespace {

// "scantet 0.1.0 mesh a.nrrd", "--level 60", ...
std::vector<std::string> parts_of(const std::string& provenance) {
  std::vector<std::string> parts;
  for (std::size_t begin = 0; begin < provenance.size();) {
    const std::size_t end = std::min(provenance.find(" --", begin + 1), provenance.size());
    parts.push_back(provenance.substr(begin, end - begin));
    begin = end;
  }
  for (std::string& part : parts) part.erase(0, part.find_first_not_of(' '));
  return parts;
}

// Of each what the other has not.
std::array<std::string, 2> apart(const std::array<std::string, 2>& provenance) {
  const std::array<std::vector<std::string>, 2> parts{parts_of(provenance[0]), parts_of(provenance[1])};
  std::array<std::string, 2> alone;
  for (std::size_t side = 0; side < 2; ++side) {
    const std::set<std::string> others(parts[1 - side].begin(), parts[1 - side].end());
    for (const std::string& part : parts[side]) {
      if (others.contains(part)) continue;
      alone[side] += (alone[side].empty() ? "" : " ") + part;
    }
    if (parts[side].empty() && !parts[1 - side].empty()) alone[side] = "the file does not say";
  }
  return alone;
}

// What of each mesh is not compared, for one format or the other has not got it, or tets without their like.
std::array<std::string, 2> not_compared(const DiffJob& job, const std::array<const TetMesh*, 2>& meshes,
                                        const std::vector<MeshBeside>& beside, AttachedDifference& attached) {
  const std::array<std::string, 2> files{job.first, job.second};
  std::array<std::string, 2> told;
  const auto tell = [&](std::size_t side, const std::string& what) {
    told[side] += (told[side].empty() ? "" : "; ") + what;
  };
  for (std::size_t side = 0; side < 2; ++side) {
    const TetMesh& mesh = *meshes[side];
    const std::string unread = name_list(beside[side].left_out, kShownUnread);
    if (!unread.empty()) tell(side, "what is not read: " + unread);
    if (!mesh_format_of(files[1 - side])->can_hold(MeshExtra::facet_sets)) {  // it has been read
      const auto is_lost = [&](const SetDifference& set) { return set.of == "facets" && set.members[1 - side] == 0; };
      if (std::erase_if(attached.sets, is_lost) > 0) {
        tell(side, "facets of sets, which " + file_extension(files[1 - side]) + " does not hold");
      }
    }
    if (attached.is_paired) continue;
    if (!mesh.sets.empty()) tell(side, "members of sets but for their numbers, for the tets are others");
    if (!mesh.fields.empty()) tell(side, "values of fields, for the tets are others");
    if (!mesh.tet_edge_vertices.empty()) tell(side, "nodes on edges but for the volume, for the tets are others");
  }
  return told;
}

DiffOutcome compare(const DiffJob& job, Progress& progress) {
  DiffOutcome outcome;
  std::vector<TetMesh> meshes(2);
  const std::string first = input_sha256({job.first});  // which is told of first, if it cannot be read
  const bool same_bytes = first == input_sha256({job.second});
  if (same_bytes && job.reports.empty()) {
    read_mesh(job.first);  // throws where it is none
    ReportDifference nothing;
    nothing.same_bytes = true;
    return {progress.cancelled(), true, difference_verdict(nothing) + "\n", {}};
  }
  std::vector<MeshBeside> beside(2);
  std::vector<Report> reports;
  for (const std::string& file : {job.first, job.second}) {
    const std::size_t side = reports.size();
    reports.push_back(report_on_mesh(file, kWaveSpeedMPerS, meshes[side], progress, &beside[side]));
    if (progress.cancelled()) return {true, false, {}, {}};
  }
  progress.report({"compare", {}, 0, std::nullopt, 0});
  ReportDifference difference;
  difference.same_bytes = same_bytes;
  difference.tolerance_mm = job.tolerance_mm;
  difference.field_tolerance = job.field_tolerance;
  difference.provenance = apart({read_provenance(job.first), read_provenance(job.second)});
  DistanceOptions how;
  if (job.tolerance_mm > 0) how.limit_mm = job.tolerance_mm;
  difference.mesh = compare_meshes(meshes[0], meshes[1], how);
  std::array<const TetMesh*, 2> as_read{};
  for (std::size_t side = 0; side < 2; ++side) {
    const TetMesh& curved = beside[side].second_order;
    as_read[side] = curved.tets.empty() ? &meshes[side] : &curved;
  }
  difference.attached = compare_attached(*as_read[0], *as_read[1], difference.mesh.pairs, job.tolerance_mm);
  difference.not_compared = not_compared(job, as_read, beside, difference.attached);
  difference.reasons = reasons_to_differ(difference, as_read, reports);
  if (progress.cancelled()) return {true, false, {}, {}};
  FileSet set;
  for (const std::string& file : job.reports) write_report(reports, meshes, file, &set, &difference);
  set.commit();
  return {false, difference.is_same(), difference_text(difference, reports), job.reports};
}

}  // namespace

void DiffJob::declare_options(OptionSet& set) {
  set.add(
      "tolerance", tolerance_mm, Range::at_least(0),
      {"What is the same", "MM", "a distance in mm",
       "Meshes are the same if their boundaries are proved to be within this distance of each other, both ways, and "
       "regions and names are the same, with volumes that such a distance can explain. With 0 the tets must be the "
       "same, too, in whatever order. Where they are, members of sets must be the same, and the nodes of second order "
       "on edges must be within this distance of the other's; where not, sets must have as many members."});
  set.add("field-tolerance", field_tolerance, Range::at_least(0),
          {"What is the same", "SHARE", "a share, such as 1e-6",
           "Values of a field may differ by this share of the field's greatest magnitude. With 0 they must be equal. "
           "Compared where the tets are the same."});
  set.add("report", reports,
          {"Output", "FILE", "a file name",
           "Report file: .html (a page of both meshes, coloured by distance), .json (all of the comparison), .svg or "
           ".png (both histograms as a picture), .csv."});
  set.add("threads", threads, Range::at_least(0),
          {"Run", "N", "a number of threads",
           "Threads to work with; 0 means one per core. The outcome does not depend on it."});
}

DiffOutcome run_diff(const DiffJob& job, Progress& progress) {
  check_outputs({}, job.reports, {job.first, job.second});
  DiffOutcome outcome;
  with_threads(job.threads, [&] { outcome = compare(job, progress); });
  return outcome;
}

}  // namespace scantet
