// What is compared is in check/mesh_difference.cpp; here it is decided what of it counts.
#include "scantet/app/diff_job.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "scantet/app/mesh_tools.h"
#include "scantet/app/outputs.h"
#include "scantet/base/parallel.h"
#include "scantet/check/mesh_difference.h"
#include "scantet/io/file_set.h"
#include "scantet/io/input_files.h"
#include "scantet/io/mesh_io.h"
#include "scantet/report/difference.h"

namespace scantet {
namespace {

constexpr double kRounding = 1e-9;  // of a volume

std::string region_text(const RegionDifference& region) {
  const std::string& name = region.sides[0].name.empty() ? region.sides[1].name : region.sides[0].name;
  return "region " + std::to_string(region.region) + (name.empty() ? "" : " (" + name + ")");
}

std::string mm(double value) {
  return number_text(value, 4) + " mm";
}

void judge_regions(const MeshDifference& found, double tolerance_mm, std::vector<std::string>& reasons) {
  for (const RegionDifference& region : found.regions) {
    const auto& [a, b] = region.sides;
    if (a.tets == 0 || b.tets == 0) {
      reasons.push_back(region_text(region) + " is in " + (b.tets == 0 ? "A" : "B") + " alone");
      continue;
    }
    if (a.name != b.name) {
      reasons.push_back("region " + std::to_string(region.region) + " is called \"" + a.name + "\" in A and \"" +
                        b.name + "\" in B");
    }
    const double off_mm3 = std::abs(b.volume_mm3 - a.volume_mm3);
    const double largest_mm3 = std::max(std::abs(a.volume_mm3), std::abs(b.volume_mm3));
    if (off_mm3 > tolerance_mm * std::max(a.area_mm2, b.area_mm2) + kRounding * largest_mm3) {
      reasons.push_back("the volume of " + region_text(region) + " differs by " + number_text(off_mm3, 4) + " mm^3");
    }
  }
}

void judge_distance(const OneWayDistance& way, const std::string& from, double tolerance_mm,
                    std::vector<std::string>& reasons) {
  const std::string head = "the boundary of " + from + " is ";
  if (way.lower_mm > tolerance_mm) {
    reasons.push_back(head + mm(way.lower_mm) + " from the other's");
  } else if (way.upper_mm && *way.upper_mm > tolerance_mm) {
    reasons.push_back(head + "not proved to be within the tolerance of the other's, only within " + mm(*way.upper_mm));
  }
}

template <class Named>
std::set<std::string> names_of(const std::vector<Named>& all) {
  std::set<std::string> names;
  for (const Named& one : all) names.insert(one.name);
  return names;
}

// What files may hold beside regions.
void judge_names(const std::string& what, const std::set<std::string>& a, const std::set<std::string>& b,
                 std::vector<std::string>& reasons) {
  for (const auto& [mine, theirs, which] : {std::tuple{&a, &b, "A"}, std::tuple{&b, &a, "B"}}) {
    for (const std::string& name : *mine) {
      if (theirs->count(name) == 0) reasons.push_back(what + " \"" + name + "\" is in " + which + " alone");
    }
  }
}

std::vector<std::string> judge(const MeshDifference& found, const std::vector<TetMesh>& meshes, double tolerance_mm) {
  std::vector<std::string> reasons;
  if (found.same != Sameness::arrays && found.same != Sameness::numbering) {
    if (found.same == Sameness::tets) {
      reasons.emplace_back(text_of(found.same));
    } else if (tolerance_mm == 0) {
      reasons.push_back(std::to_string(found.tets_alone[0]) + " tets of A are not in B, " +
                        std::to_string(found.tets_alone[1]) + " of B not in A");
    }
    judge_distance(found.to_second, "A", tolerance_mm, reasons);
    judge_distance(found.to_first, "B", tolerance_mm, reasons);
  }
  judge_regions(found, tolerance_mm, reasons);
  judge_names("the set", names_of(meshes[0].sets), names_of(meshes[1].sets), reasons);
  judge_names("the field", names_of(meshes[0].fields), names_of(meshes[1].fields), reasons);
  judge_names("the material", names_of(meshes[0].materials), names_of(meshes[1].materials), reasons);
  return reasons;
}

// Of meshes of second order all else is said of the straight tets between the corners.
void judge_order(const MeshDifference& found, const std::vector<Report>& reports, double tolerance_mm,
                 std::vector<std::string>& reasons) {
  const auto& a = reports[0].second_order;
  const auto& b = reports[1].second_order;
  if (!a && !b) return;
  if (!a || !b) {
    reasons.push_back(std::string("the tetrahedra of ") + (a ? "A" : "B") + " have ten nodes, those of the other four");
    return;
  }
  double area_mm2 = 0;
  for (const PatchDifference& patch : found.patches) area_mm2 += std::max(patch.area_mm2[0], patch.area_mm2[1]);
  const double off_mm3 = std::abs(b->volume_mm3 - a->volume_mm3);
  if (off_mm3 > tolerance_mm * area_mm2 + kRounding * std::max(std::abs(a->volume_mm3), std::abs(b->volume_mm3))) {
    reasons.push_back("the volume of the curved tetrahedra differs by " + number_text(off_mm3, 4) + " mm^3");
  }
}

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
    for (const std::string& part : parts[side]) {
      const auto& others = parts[1 - side];
      if (std::find(others.begin(), others.end(), part) != others.end()) continue;
      alone[side] += (alone[side].empty() ? "" : " ") + part;
    }
    if (parts[side].empty() && !parts[1 - side].empty()) alone[side] = "the file does not say";
  }
  return alone;
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
  std::vector<Report> reports;
  for (const std::string& file : {job.first, job.second}) {
    reports.push_back(report_on_mesh(file, kWaveSpeedMPerS, meshes[reports.size()], progress));
    if (progress.cancelled()) return {true, false, {}, {}};
  }
  progress.report({"compare", {}, 0, std::nullopt, 0});
  ReportDifference difference;
  difference.same_bytes = same_bytes;
  difference.tolerance_mm = job.tolerance_mm;
  difference.provenance = apart({read_provenance(job.first), read_provenance(job.second)});
  DistanceOptions how;
  if (job.tolerance_mm > 0) how.limit_mm = job.tolerance_mm;
  difference.mesh = compare_meshes(meshes[0], meshes[1], how);
  difference.reasons = judge(difference.mesh, meshes, job.tolerance_mm);
  judge_order(difference.mesh, reports, job.tolerance_mm, difference.reasons);
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
       "same, too, in whatever order."});
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
