// The certificate is the verifier's; here it is only asked for, and put into words.
#include "scantet/verification/verify_job.h"

#include <algorithm>
#include <fstream>

#include "scantet/base/error.h"
#include "scantet/base/mesh_order.h"
#include "scantet/base/parallel.h"
#include "scantet/io/atomic_file.h"
#include "scantet/io/input_files.h"
#include "scantet/io/mesh_io.h"
#include "scantet/io/writable.h"
#include "scantet/labels/label_count.h"
#include "scantet/reading/scan_reader.h"
#include "scantet/reading/simplify.h"
#include "scantet/scan_input/label_input.h"
#include "scantet/verification/certificate_file.h"
#include "scantet/verification/scan_labels.h"
#include "scantet/verify/labels.h"
#include "scantet/verify/surfaces.h"

namespace scantet {
namespace {

/// Whether the certificate that is checked again holds.
void compare(const VerifyJob& job, VerifyOutcome& outcome) {
  const RecordedCertificate recorded = read_certificate(job.certificate);
  outcome.is_as_required = recorded.grade == name_of(outcome.certificate.grade());
  std::string text = outcome.is_as_required ? "" : "it says " + recorded.grade;
  for (const std::string& file : changed_files(recorded, job)) {
    outcome.is_as_required = false;
    text += (text.empty() ? "" : "; ") + file + " is not the file that it names";
  }
  outcome.text += job.certificate + (outcome.is_as_required ? " holds" : " does not hold: " + text) + "\n";
}

[[noreturn]] void refuse_no_level() {
  throw Error(Fault::usage, "usage.level", "--level is missing",
              "give the level that the mesh is of, or --labels all if the scan is a label map");
}

/// Whether something is asked for that only level sets have.
bool is_of_levels(const VerifyJob& job) {
  return !job.levels.empty() || job.options.level.inside != InsideSide::above || job.outside || job.is_capped ||
         job.components.choice() || job.options.vertex_tolerance_mm || job.handles.thinner_mm ||
         job.simplify.simplification().changes_values();
}

/// That nothing is asked for that the object has not.
void check_object(const VerifyJob& job, const VerifiedObject& object) {
  if (!object.surface) {
    if (job.levels.empty() && !job.labels.any()) refuse_no_level();
    return;
  }
  if (is_of_levels(job) || job.labels.any() || job.simplify.simplification().is_any()) {
    throw Error(Fault::usage, "usage.surface",
                job.against + " is a surface: it has no levels, labels, caps, components, or voxels to simplify",
                "leave these options out");
  }
}

/// That a level is given, or labels, and nothing that is of the other.
void check_what(const VerifyJob& job) {
  const bool smooths = job.labels.smoothing != LabelOptions().smoothing;
  if (!job.labels.any()) {
    if (job.levels.empty() && !job.read_object) refuse_no_level();
    if (smooths) {
      throw Error(Fault::usage, "usage.labels", "--label-smoothing: no labels are asked for", "give --labels, too");
    }
    return;
  }
  if (is_of_levels(job)) {
    throw Error(Fault::usage, "usage.labels",
                "--labels: a level is asked for, too, or what only level sets have: a side, caps, components, a "
                "tolerance of vertices, or other values",
                "leave out one of the two");
  }
}

void write_text(const std::string& path, const std::string& text) {
  AtomicFile file(path);
  std::ofstream out(file.part_path(), std::ios::binary);
  out << text;
  out.close();
  if (!out) throw Error(Fault::output, "output.cannot_write", "cannot write " + path, "check the disk's free space");
  file.commit();
}

}  // namespace

void VerifyJob::declare_options(OptionSet& set) {
  const std::string what = "What the mesh is of";
  set.add(
      "against", against,
      {what, "SCAN", "a file name",
       "The scan, in any format of images that scantet mesh reads, an OpenVDB grid, or a closed surface (.off, .stl, "
       ".ply, .obj), which needs no level.",
       0, "required"});
  set.add("grid", grid,
          {what, "NAME", "a name", "Grid of an OpenVDB file (.vdb).", 0, "the only one of a scalar type"});
  set.add("repair", repairs,
          {what, "", "",
           "Of a surface: it is repaired first, as with scantet mesh --repair, and the mesh verified against what that "
           "makes."});
  set.add("level", levels, Range(),
          {what, "V", "a level",
           "Value of the surface, as for scantet mesh. Given several times: each level by itself; the regions of the "
           "mesh, in ascending order, lie between one level and the next.",
           0, "required, or --labels"});
  labels.declare(set, "Label map", false);
  set.add("inside", options.level.inside, {{"above", InsideSide::above}, {"below", InsideSide::below}},
          {what, "SIDE", "a side", "Which side of the level is the object."});
  set.add(
      "outside", outside, Range(),
      {what, "V", "a value",
       "Value of the field one voxel beyond the image, on the outside of the level, as for scantet mesh. It closes the "
       "surface at the border.",
       0, "the smallest value, or the largest with --inside below"});
  set.add("border", is_capped, {{"close", false}, {"cap", true}},
          {what, "HOW", "a way to end the object",
           "Where the object ends that leaves the image, as for scantet mesh: within one voxel beyond, or flat at the "
           "outermost voxel centres. A mesh with caps is bounded at the most."});
  components.declare(set, "What the mesh may lack");
  simplify.declare(set, "The scan, simpler");
  handles.declare(set, "The scan, simpler");
  const std::string asked = "What is asked for";
  set.add("require", require, {{"certified", CertificateGrade::certified}, {"bounded", CertificateGrade::bounded}},
          {asked, "GRADE", "a grade", "The least grade with which the exit status is 0; otherwise it is 4."});
  set.add("max-distance", options.max_distance_mm, Range::above(0),
          {asked, "MM", "a distance in mm",
           "Neither grade is given if the mesh's boundary and the level set are not proved to be within this distance "
           "of each other, both ways."});
  set.add("vertex-tolerance", options.vertex_tolerance_mm, Range::above(0),
          {asked, "MM", "a distance in mm",
           "A mesh is certified only if every boundary vertex is proved to be within this distance of the level set.",
           0, "a thousandth of the smallest distance between voxels"});
  set.add("json", json,
          {"Output", "FILE", "a file name", "Write the certificate as JSON, with the checksums of both files."});
  set.add(
      "certificate", certificate,
      {"Output", "FILE", "a file name",
       "Check again what a certificate says: the same files, by their checksums, the same options, and the same grade. "
       "MESH and --against are needed only if the files have moved."});
  set.add("threads", threads, Range::at_least(0),
          {"Run", "N", "a number of threads",
           "Threads to work with; 0 means one per core. The certificate does not depend on it."});
}

VerifyJob recorded_job(const VerifyJob& job, const std::vector<OptionValue>& given) {
  const RecordedCertificate recorded = read_certificate(job.certificate);
  VerifyJob again;
  OptionSet set;
  again.declare_options(set);
  std::vector<OptionValue> values = recorded.options;
  for (const OptionValue& value : given) {
    std::erase_if(values, [&](const OptionValue& old) { return old.name == value.name; });
  }
  values.insert(values.end(), given.begin(), given.end());
  for (const OptionValue& value : values) set.set(value);
  again.read_object = job.read_object;
  again.mesh = job.mesh.empty() ? recorded.mesh : job.mesh;
  if (again.against.empty()) again.against = recorded.scan;
  return again;
}

VerifyOptions verify_options(const VerifyJob& job) {
  VerifyOptions options = job.options;
  options.level.outside = job.outside;
  options.is_capped = job.is_capped;
  if (const std::optional<ComponentChoice> choice = job.components.choice()) {
    options.left_out = {choice->count, choice->min_volume_mm3, choice->fill_cavities_mm3};
  }
  return options;
}

namespace {

MeshCertificate verify_label_map(const VerifyJob& job, const TetMesh& mesh, const GridField& field,
                                 Progress& progress) {
  const Scan& scan = field.scan;
  if (field.outside.value_or(0) != 0) {
    throw Error(
        Fault::input, "input.background",
        job.against + ": what is beyond its voxels is label " + number_text(*field.outside) + ", which has no end",
        "write the grid with the background 0");
  }
  const LabelSettings settings = label_settings(scan, job.against, count_labels(scan), job.labels);
  const std::unique_ptr<LabelSource> labels = scan_labels(scan, settings, progress);
  if (labels == nullptr) return {};
  return {{}, {verify_labels(mesh, *labels, verify_options(job), progress)}};
}

}  // namespace

MeshCertificate verify_against(const VerifyJob& job, const TetMesh& mesh, const VerifiedObject& object,
                               Progress& progress) {
  if (object.surface) return {{}, {verify_surface(mesh, *object.surface, verify_options(job), progress)}};
  const GridField& field = object.field;
  if (job.labels.any()) return verify_label_map(job, mesh, field, progress);
  MeshCertificate certificate{job.levels, {}};
  std::sort(certificate.levels.begin(), certificate.levels.end());
  if (job.options.level.inside == InsideSide::below) std::reverse(certificate.levels.begin(), certificate.levels.end());
  VerifyOptions options = verify_options(job);
  if (!options.level.outside) options.level.outside = field.outside;
  certificate.certificates = verify_levels(mesh, field.scan, certificate.levels, options, progress);
  return certificate;
}

VerifiedObject object_to_verify(const VerifyJob& job, Progress& progress) {
  progress.report({"read", job.against, 0, std::nullopt, 0});
  const Simplification how = job.simplify.simplification();
  VerifiedObject object;
  if (job.read_object) {
    object = job.read_object(job, progress);
    if (progress.cancelled()) return object;
    check_object(job, object);
    if (object.surface) return object;
  } else if (job.repairs) {
    throw Error(Fault::usage, "usage.repair", "--repair: " + job.against + " is an image and no surface",
                "leave it out");
  } else if (job.grid.empty()) {
    object.field.scan = read_scan(job.against, progress);
  } else {
    throw Error(Fault::usage, "usage.grid", "--grid: " + job.against + " is an image and has no grids",
                "leave it out, or give a .vdb file");
  }
  Scan& scan = object.field.scan;
  if (!progress.cancelled() && how.is_any()) scan = simplified(scan, how);
  if (!progress.cancelled() && job.handles.thinner_mm) {
    const std::optional<double> outside = job.outside ? job.outside : object.field.outside;
    const NestedLevelSettings settings{job.levels, job.options.level.inside, outside};
    scan = without_thin_handles(scan, settings, *job.handles.thinner_mm, progress).scan;
  }
  return object;
}

std::vector<std::string> files_read(const VerifyJob& job) {
  std::vector<std::string> files = input_files(job.against);
  files.push_back(job.mesh);
  if (!job.certificate.empty()) files.push_back(job.certificate);
  const std::vector<std::string> tables = job.labels.files(job.against);
  for (const auto* more : {&job.read, &tables}) files.insert(files.end(), more->begin(), more->end());
  return files;
}

namespace {

/// Throws Error (input.other_cells) if the file holds volume that the mesh lacks.
TetMesh read_whole_mesh(const std::string& file) {
  TetMesh mesh = read_mesh(file);
  if (mesh.other_solids == 0) return mesh;
  throw Error(Fault::input, "input.other_cells",
              file + " holds " + other_solids_text(mesh.other_solids) + ", and these cannot be verified",
              "cut them into tetrahedra, or write a file without them");
}

/// The curved ones may reach elsewhere, however good those between their corners are.
void add_second_order(const TetMesh& straight, MeshCertificate& certificate) {
  for (Certificate& c : certificate.certificates) {
    VerifyFinding finding{"mesh.second_order",
                          "the tetrahedra have ten nodes: all that is said is of the straight ones",
                          straight.vertices[straight.tets.front()[0]], straight.tets.size()};
    finding.is_wrong = finding.bounded = false;
    c.findings.push_back(finding);
    if (c.grade != CertificateGrade::not_the_scan) c.grade = CertificateGrade::undecided;
  }
}

}  // namespace

VerifyOutcome run_verify(const VerifyJob& job, Progress& progress) {
  if (job.against.empty()) {
    throw Error(Fault::usage, "usage.against", "--against is missing", "name the scan: --against head.nii.gz");
  }
  check_what(job);
  if (!job.json.empty()) check_writable({job.json}, files_read(job));
  verify_options(job);
  job.simplify.simplification();
  VerifyOutcome outcome;
  with_threads(job.threads, [&] {
    progress.report({"read", job.mesh, 0, std::nullopt, 0});
    TetMesh mesh = read_whole_mesh(job.mesh);
    const bool is_second_order = !mesh.tet_edge_vertices.empty();
    if (is_second_order) mesh = first_order(mesh);
    const VerifiedObject object = object_to_verify(job, progress);
    outcome.cancelled = progress.cancelled();
    if (!outcome.cancelled) outcome.certificate = verify_against(job, mesh, object, progress);
    if (is_second_order) add_second_order(mesh, outcome.certificate);
  });
  outcome.cancelled = outcome.cancelled || progress.cancelled();
  if (outcome.cancelled) return {true, {}, false, {}};
  outcome.is_as_required = reaches(outcome.certificate.grade(), job.require);
  outcome.text = certificate_text(outcome.certificate);
  if (!job.certificate.empty()) compare(job, outcome);
  if (!job.json.empty()) write_text(job.json, certificate_json(outcome.certificate, job));
  return outcome;
}

}  // namespace scantet
