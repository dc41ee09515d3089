// The certificate is the verifier's; here it is only asked for, and put into words.
#include "scantet/app/verify_job.h"

#include <fstream>

#include "scantet/app/certificate_file.h"
#include "scantet/base/error.h"
#include "scantet/base/parallel.h"
#include "scantet/io/atomic_file.h"
#include "scantet/io/mesh_io.h"
#include "scantet/reading/scan_reader.h"
#include "scantet/reading/simplify.h"

namespace scantet {
namespace {

constexpr std::size_t kShownFindings = 30;
constexpr std::size_t kShownPlaces = 5;

std::string mm(double value) {
  return number_text(value, 4) + " mm";
}

std::string place_text(const Point& p) {
  return "(" + number_text(p.x, 6) + ", " + number_text(p.y, 6) + ", " + number_text(p.z, 6) + ")";
}

std::string share_text(double part, double whole) {
  return number_text(whole > 0 ? 100 * part / whole : 0, 6) + " %";
}

std::string distance_text(const VerifiedDistance& d) {
  std::string text = d.upper_mm ? "at most " + mm(*d.upper_mm) + ", proved" : "not bounded";
  if (d.upper_mm) text += " (largest near " + place_text(d.upper_place) + ")";
  if (d.lower_mm > 0) text += "; at least " + mm(d.lower_mm) + " at " + place_text(d.lower_place);
  return text;
}

std::string count_text(std::int64_t count, const char* one, const char* many) {
  return std::to_string(count) + " " + (count == 1 ? one : many);
}

std::string invariants_text(const VerifiedInvariants& i) {
  if (!i.is_known)
    return "components and cavities are not known for sure: values are at the level, or too close to tell";
  return count_text(i.components, "component", "components") + ", " + count_text(i.cavities, "cavity", "cavities") +
         ", Euler number " + std::to_string(i.euler) + " (" + count_text(i.handles(), "handle", "handles") + ")";
}

std::string volume_text(const std::array<double, 2>& v) {
  return number_text(v[0], 8) + " to " + number_text(v[1], 8) + " mm^3";
}

/// Whether the certificate that is checked again holds.
void compare(const VerifyJob& job, VerifyOutcome& outcome) {
  const RecordedCertificate recorded = read_certificate(job.certificate);
  outcome.is_as_required = recorded.grade == name_of(outcome.certificate.grade);
  std::string text = outcome.is_as_required ? "" : "it says " + recorded.grade;
  for (const std::string& file : changed_files(recorded, job)) {
    outcome.is_as_required = false;
    text += (text.empty() ? "" : "; ") + file + " is not the file that it names";
  }
  outcome.text += job.certificate + (outcome.is_as_required ? " holds" : " does not hold: " + text) + "\n";
}

/// A grade is worth more the earlier it is listed.
bool reaches(CertificateGrade grade, CertificateGrade required) {
  return static_cast<int>(grade) <= static_cast<int>(required);
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
  set.add("against", against,
          {what, "SCAN", "a file name", "The scan, in any format that scantet mesh reads.", 0, "required"});
  set.add("level", levels, Range(),
          {what, "V", "a level", "Value of the surface, as for scantet mesh; one.", 0, "required"});
  set.add("inside", options.level.inside, {{"above", InsideSide::above}, {"below", InsideSide::below}},
          {what, "SIDE", "a side", "Which side of the level is the object."});
  set.add(
      "outside", outside, Range(),
      {what, "V", "a value",
       "Value of the field one voxel beyond the image, on the outside of the level, as for scantet mesh. It closes the "
       "surface at the border.",
       0, "the smallest value, or the largest with --inside below"});
  simplify.declare(set, "The scan, simpler");
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
  again.mesh = job.mesh.empty() ? recorded.mesh : job.mesh;
  if (again.against.empty()) again.against = recorded.scan;
  return again;
}

VerifyOutcome run_verify(const VerifyJob& asked, Progress& progress) {
  VerifyJob job = asked;
  if (job.against.empty()) {
    throw Error(Fault::usage, "usage.against", "--against is missing", "name the scan: --against head.nii.gz");
  }
  if (job.levels.size() != 1) {
    throw Error(
        Fault::usage, "usage.level",
        job.levels.empty() ? "--level is missing" : "--level was given " + std::to_string(job.levels.size()) + " times",
        "give the one level that the mesh is of; meshes of several levels cannot be verified yet");
  }
  job.options.level.level = job.levels.front();
  job.options.level.outside = job.outside;
  if (!job.json.empty()) AtomicFile probe(job.json);  // that it can be written, before hours of work
  const Simplification how = job.simplify.simplification();
  VerifyOutcome outcome;
  with_threads(job.threads, [&] {
    progress.report({"read", job.mesh, 0, std::nullopt, 0});
    const TetMesh mesh = read_mesh(job.mesh);
    progress.report({"read", job.against, 0, std::nullopt, 0});
    Scan scan = read_scan(job.against, progress);
    outcome.cancelled = progress.cancelled();
    if (outcome.cancelled) return;
    if (how.is_any()) scan = simplified(scan, how);
    outcome.certificate = verify_mesh(mesh, scan, job.options, progress);
  });
  outcome.cancelled = outcome.cancelled || progress.cancelled();
  if (outcome.cancelled) return {true, {}, false, {}};
  outcome.is_as_required = reaches(outcome.certificate.grade, job.require);
  outcome.text = certificate_text(outcome.certificate);
  if (!job.certificate.empty()) compare(job, outcome);
  if (!job.json.empty()) write_text(job.json, certificate_json(outcome.certificate, job));
  return outcome;
}

std::string certificate_text(const Certificate& c) {
  std::string text;
  const auto line = [&](const std::string& name, const std::string& value) {
    text += name + std::string(name.size() < 14 ? 14 - name.size() : 1, ' ') + value + "\n";
  };
  line("grade", name_of(c.grade));
  line("facets", std::to_string(c.facets_certified) + " of " + std::to_string(c.facets) + " with a collar (" +
                     share_text(c.area_certified_mm2, c.area_mm2) + " of the area)");
  if (c.facets_at_border > 0) {
    line("border", std::to_string(c.facets_at_border) +
                       " facets lie beyond the outermost voxels, where the field is continued to the outside value");
  }
  line("mesh to level", distance_text(c.mesh_to_level));
  line("level to mesh", distance_text(c.level_to_mesh));
  line("scan", invariants_text(c.field));
  line("mesh", invariants_text(c.mesh));
  line("scan's volume", volume_text(c.field_volume_mm3));
  line("mesh's volume", volume_text(c.mesh_volume_mm3));
  line("time", number_text(c.seconds, 3) + " s");
  for (std::size_t n = 0; n < std::min(c.findings.size(), kShownFindings); ++n) {
    const VerifyFinding& f = c.findings[n];
    text += std::string(f.is_wrong ? "wrong: " : "not proved: ") + f.what + " [" + f.code + "]";
    text += f.count > 1 ? "; " + std::to_string(f.count) + " places, one at " : "; at ";
    text += place_text(f.place) + "\n";
  }
  for (std::size_t n = 0; n < std::min(c.undecided.size(), kShownPlaces); ++n) {
    const UndecidedPlace& place = c.undecided[n];
    text += (n == 0 ? "largest undecided facets: " : "                          ") + place.reason + " within " +
            place_text(place.box.min) + " to " + place_text(place.box.max) + "\n";
  }
  return text;
}

}  // namespace scantet
