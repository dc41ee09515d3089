// The files are verified under their temporary names, so that what appears has been verified, and a report that appears
// with it says so. The scan is read again: what the mesher has in memory is not trusted.
#include "scantet/app/certify.h"

#include <algorithm>
#include <map>
#include <optional>
#include <ostream>

#include "scantet/app/mesh_tools.h"
#include "scantet/app/outputs.h"
#include "scantet/app/plugin_object.h"
#include "scantet/base/error.h"
#include "scantet/base/file_extension.h"
#include "scantet/io/atomic_file.h"
#include "scantet/io/input_files.h"
#include "scantet/io/link_folder.h"
#include "scantet/io/mesh_io.h"
#include "scantet/labels/label_count.h"
#include "scantet/scan_input/label_input.h"
#include "scantet/verification/certificate_file.h"
#include "scantet/verification/scan_labels.h"

namespace scantet {
namespace {

[[noreturn]] void refuse(const std::string& why, const std::string& remedy) {
  throw Error(Fault::usage, "usage.certify", "--certify: " + why, remedy);
}

std::string first_readable(const std::vector<std::string>& outputs) {
  for (const std::string& file : outputs) {
    const MeshFormat* const format = mesh_format_of(file);
    if (format != nullptr && format->can_read && format->holds == MeshContent::tets) return file;
  }
  refuse("no mesh file is written that can be read again", "name one: -o mesh.vtu");
}

/// What a page shows beside the mesh; none of a surface.
std::optional<ReportScan> scan_beside(const VerifyJob& job, const VerifiedObject& object, const TetMesh& mesh,
                                      const MeshCertificate& proved) {
  if (object.surface) return std::nullopt;
  const Scan& scan = object.field.scan;
  Box around;
  for (const Point& p : mesh.vertices) around.extend(p);
  if (!job.labels.any()) return report_scan(scan, around, proved.levels);
  const std::vector<LabelCount> counts = count_labels(scan);
  const std::vector<std::int64_t> labels = labels_of(counts);
  const LabelSettings settings = label_settings(scan, job.against, counts, job.labels);
  const std::vector<Region> regions = regions_of_labels(labels, settings);
  std::map<std::int64_t, Region> region_of;
  for (std::size_t n = 0; n < labels.size(); ++n) region_of[labels[n]] = regions[n];
  if (settings.smoothing == LabelSmoothing::none) return report_labels(scan, region_of, nullptr, around);
  const std::unique_ptr<LabelSource> fields = scan_labels(scan, settings, Progress());
  return report_labels(
      scan, region_of,
      [&](int i, int j, int k) {
        return values_at(*fields, {i, j, k});
      },
      around);
}

}  // namespace

std::vector<double> take_facet_bounds(MeshCertificate& certificate, const TetMesh& mesh) {
  std::map<Triangle, double> by_facet;
  for (Certificate& c : certificate.certificates) {
    for (const FacetBound& bound : c.bounds) {
      Triangle key = bound.facet;
      std::sort(key.begin(), key.end());
      by_facet[key] = bound.bound_mm;
    }
    c.bounds = {};
  }
  std::vector<double> bounds;
  for (Triangle facet : mesh.boundary_facets) {
    std::sort(facet.begin(), facet.end());
    const auto found = by_facet.find(facet);
    bounds.push_back(found == by_facet.end() ? -1 : found->second);
  }
  return bounds;
}

bool has_page(const std::vector<std::string>& reports) {
  return std::any_of(reports.begin(), reports.end(),
                     [](const std::string& report) { return file_extension(report) == ".html"; });
}

Certifier::Certifier(const MeshJob& job, const PluginRegistry& plugins, const std::string& plugin,
                     const OptionSet& of_plugin)
    : refines_(job.certify == Certify::refine), certificate_file_(job.certificate), pages_(job.reports) {
  const bool is_surface = plugin == "polyhedron";
  if (plugin == "vdb" || is_surface) {
    job_.read_object = [&plugins](const VerifyJob& of, Progress& progress) {
      return plugin_object(plugins, of, progress);
    };
  } else if (plugin != "image") {
    refuse("only images, OpenVDB grids and surfaces can be verified", "leave it out");
  }
  if (is_surface && job.certify != Certify::bounded) {
    refuse("the mesh of a surface is bounded at the most", "ask for that: --certify bounded");
  }
  if (job.order != ElementOrder::first)
    refuse("a mesh with curved facets (--order 2) cannot be verified", "leave one of the two out");
  if (!job.cut.cuts.empty()) refuse("a mesh with cuts (--cut) cannot be verified", "leave one of the two out");
  job_.mesh = first_readable(job.outputs);
  job_.against = job.input;
  job_.is_capped = job.cut.border == Border::cap;
  if (job_.is_capped && job.certify != Certify::bounded) {
    refuse("a mesh with caps (--border cap) is bounded at the most", "ask for that: --certify bounded");
  }
  job_.require = job.certify == Certify::bounded ? CertificateGrade::bounded : CertificateGrade::certified;
  OptionSet set;
  job_.declare_options(set);
  for (const Option& option : of_plugin.options()) {
    // The plugin has chosen these two itself if they were not given; of a label map there is neither.
    const bool is_chosen = option.name == "level" || (option.name == "inside" && !job_.levels.empty());
    if ((!option.given && !is_chosen) || set.find(option.name) == nullptr) continue;
    for (const std::string& value : option.read()) set.set({option.name, value, "--" + option.name});
  }
  if (job_.levels.empty() && !is_surface) take_labels(job, of_plugin);
}

void Certifier::take_labels(const MeshJob& job, const OptionSet& of_plugin) {
  const Option* tissues = of_plugin.find("tissue");
  if (tissues != nullptr && tissues->given) refuse("probability maps (--tissue) cannot be verified", "leave it out");
  if (job.certify != Certify::bounded) {
    refuse("the mesh of a label map is bounded at the most", "ask for that: --certify bounded");
  }
  if (job_.labels.labels.empty()) job_.labels.labels = "all";
}

const VerifiedObject& Certifier::object(Progress& progress) {
  if (!object_) object_ = object_to_verify(job_, progress);
  return *object_;
}

FaultSearch Certifier::search() {
  if (!refines_) return {};
  return [this](const TetMesh& mesh, Progress& progress) {
    VerifyJob job = job_;
    job.options.only_collars = true;
    job.options.most_places = mesh.boundary_facets.size();
    std::vector<Point> places;
    const VerifiedObject& of = object(progress);
    if (progress.cancelled()) return places;
    const MeshCertificate proved = verify_against(job, mesh, of, progress);
    for (const Certificate& certificate : proved.certificates) {
      for (const UndecidedPlace& place : certificate.undecided) places.push_back(place.box.center());
    }
    return places;
  };
}

void Certifier::note_refinement(const Meshing& meshing) {
  if (!refines_) return;
  const std::size_t now = meshing.refined.mesh.vertices.size();
  points_added_ = now > meshing.first_points ? now - meshing.first_points : 0;
}

bool Certifier::certify(FileSet& set, const TetMesh& mesh, JobResult& result, Progress& progress) {
  const VerifiedObject& against = object(progress);
  if (progress.cancelled()) return false;
  const std::vector<std::string> names = mesh_files(job_.mesh);
  const LinkFolder links;  // the files have no names of their own yet
  std::string file;
  std::string content;
  for (const FileSet::Part& part : set.parts()) {
    if (std::find(names.begin(), names.end(), part.path) == names.end()) continue;
    const std::string link = links.add(part.path, part.part_path);
    if (part.path == job_.mesh) file = link;
  }
  const TetMesh read = read_mesh(file);
  if (read.tets.size() != mesh.tets.size()) {
    result.findings.push_back("certificate: " + job_.mesh + " has " + std::to_string(read.tets.size()) +
                              " tets when it is read again, and " + std::to_string(mesh.tets.size()) +
                              " were written; tell the makers of scantet");
  }
  ReportCertificate certificate;
  const bool has_facets = has_page(pages_) && !job_.labels.any();
  job_.options.lists_facets = has_facets;
  certificate.proved = verify_against(job_, read, against, progress);
  if (progress.cancelled()) return false;
  certificate.file = job_.mesh;
  if (has_facets) {
    certificate.facets_mm = take_facet_bounds(certificate.proved, mesh);
  }
  if (has_page(pages_)) result.report.scan = scan_beside(job_, against, mesh, certificate.proved);
  certificate.points_added = points_added_;
  if (!reaches(certificate.proved.grade(), job_.require)) {
    result.findings.push_back("the mesh is " + name_of(certificate.proved.grade()) + ", not " + name_of(job_.require) +
                              "; " +
                              (refines_ ? "choose a smaller --size" : "choose a smaller --size, or --certify refine"));
  }
  if (!certificate_file_.empty()) {
    const std::string json = certificate_json(certificate.proved, job_, file);
    write_file(
        certificate_file_, [&](std::ostream& out) { out << json; }, &set);
  }
  result.report.certificate = std::move(certificate);
  return true;
}

void check_reports(const VerifyJob& job, const std::vector<std::string>& reports) {
  std::vector<std::string> beside;
  if (!job.json.empty()) beside.push_back(job.json);
  check_outputs({}, reports, files_read(job), beside);
}

std::vector<std::string> report_on_verification(const VerifyJob& job, VerifyOutcome& outcome,
                                                const std::vector<std::string>& reports, Progress& progress) {
  TetMesh mesh;
  Report report = report_on_mesh(job.mesh, kWaveSpeedMPerS, mesh, progress);
  ReportCertificate certificate{outcome.certificate, job.mesh, {}, {}};
  if (has_page(reports) && !job.labels.any()) {
    certificate.facets_mm = take_facet_bounds(certificate.proved, mesh);
  }
  if (has_page(reports)) {
    const VerifiedObject object = object_to_verify(job, progress);
    if (!progress.cancelled()) report.scan = scan_beside(job, object, mesh, certificate.proved);
  }
  if (progress.cancelled()) return {};
  report.certificate = std::move(certificate);
  FileSet set;
  for (const std::string& file : reports) write_report({&report, 1}, {&mesh, 1}, file, &set);
  set.commit();
  return reports;
}

}  // namespace scantet
