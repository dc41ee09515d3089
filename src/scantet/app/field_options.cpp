// A path may have a colon (FOLDER:UID), so what follows the last one is a measure only if it is one of the words.
#include "scantet/app/field_options.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <filesystem>

#include "scantet/base/error.h"
#include "scantet/base/tet_volume.h"
#include "scantet/io/input_files.h"
#include "scantet/io/mesh_losses.h"
#include "scantet/quality/quality_fields.h"
#include "scantet/reading/scan_reader.h"

namespace scantet {
namespace {

constexpr std::array<std::pair<const char*, FieldMeasure>, 5> kMeasures{{{"mean", FieldMeasure::mean},
                                                                         {"std", FieldMeasure::std},
                                                                         {"min", FieldMeasure::min},
                                                                         {"max", FieldMeasure::max},
                                                                         {"median", FieldMeasure::median}}};
constexpr std::string_view kFraction = "fraction=";

[[noreturn]] void refuse(const std::string& text, const std::string& why) {
  throw Error(Fault::usage, "usage.field", "--field: " + text + ": " + why,
              "give NAME=SCAN or NAME=SCAN:MEASURE, such as density=ct.nrrd:mean or bone=labels.nrrd:fraction=3");
}

bool is_name(const std::string& name) {
  return !name.empty() && name.front() != '.' && std::all_of(name.begin(), name.end(), [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-' ||
           c == '.';
  });
}

std::string measure_text(const FieldChoice& choice) {
  for (const auto& [word, measure] : kMeasures) {
    if (measure == choice.measure) return word;
  }
  return std::string(kFraction) + number_text(choice.label);
}

/// Refuses a word that stands where a measure does, behind the name of a file.
void check_word(const std::string& all, const std::string& scan, const std::string& word) {
  std::error_code code;
  const bool is_measure = std::filesystem::is_regular_file(scan.substr(0, scan.size() - word.size() - 1), code) &&
                          !std::filesystem::exists(scan, code);
  if (!is_measure) return;
  std::vector<std::string> names{std::string(kFraction)};
  for (const auto& [name, measure] : kMeasures) names.emplace_back(name);
  const auto meant = closest_name(word, names);
  refuse(all, word + " is no measure" + (meant ? "; did you mean " + *meant + "?" : ""));
}

/// Takes the measure from the end of the text, if there is one.
FieldChoice take_measure(const std::string& all, std::string& scan) {
  const std::size_t colon = scan.rfind(':');
  if (colon == std::string::npos) return {};
  const std::string word = scan.substr(colon + 1);
  for (const auto& [name, measure] : kMeasures) {
    if (word != name) continue;
    scan.resize(colon);
    return {measure, 0};
  }
  if (!word.starts_with(kFraction)) {
    check_word(all, scan, word);
    return {};
  }
  FieldChoice choice{FieldMeasure::fraction, 0};
  const char* const end = word.data() + word.size();
  const auto read = std::from_chars(word.data() + kFraction.size(), end, choice.label);
  if (read.ec != std::errc() || read.ptr != end) refuse(all, "fraction= takes the value of voxels, a number");
  scan.resize(colon);
  return choice;
}

FieldRequest read_request(const std::string& text) {
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos) refuse(text, "there is no '='");
  FieldRequest request{text.substr(0, equals), text.substr(equals + 1), {}};
  if (!is_name(request.name)) refuse(text, "a name has letters, digits and _-. only, and does not begin with a point");
  for (const char* taken : {"region", "boundary", "on_boundary", "provenance"}) {
    if (request.name == taken) refuse(text, "mesh files have another array of this name");
  }
  const bool is_of_materials =
      std::find(kMaterialFields.begin(), kMaterialFields.end(), request.name) != kMaterialFields.end();
  if (is_of_materials) refuse(text, "materials are a field of this name");
  if (request.name.starts_with("set_")) refuse(text, "names that begin with set_ are those of sets");
  const auto measures = quality_field_names();
  if (std::find(measures.begin(), measures.end(), request.name) != measures.end()) {
    refuse(text, "--quality-fields gives a field of this name");
  }
  request.choice = take_measure(text, request.scan);
  if (request.scan.empty()) refuse(text, "there is no scan");
  return request;
}

}  // namespace

std::vector<FieldRequest> read_field_requests(const std::vector<std::string>& texts) {
  std::vector<FieldRequest> requests;
  for (const std::string& text : texts) {
    requests.push_back(read_request(text));
    const std::string& name = requests.back().name;
    const auto count = std::count_if(requests.begin(), requests.end(), [&](const auto& r) { return r.name == name; });
    if (count > 1) refuse(text, "there is a field of this name already");
  }
  return requests;
}

void declare_field_options(OptionSet& options, std::vector<std::string>& fields) {
  options.add(
      "field", fields,
      {"Output", "NAME=SCAN[:MEASURE]", "a field",
       "A number a tetrahedron, taken from a scan of any frame: mean (of the trilinear scan; the default), std, "
       "min, max, median, or fraction=LABEL (the share of the volume in voxels of this value). Integrals are "
       "exact; mesh files carry the field under its name (docs/fields.md)."});
}

FieldScans::FieldScans(const std::vector<std::string>& texts, const Box& object, const ScanTable& known,
                       Progress& progress)
    : requests_(read_field_requests(texts)) {
  for (std::size_t i = 0; i < requests_.size(); ++i) {
    const std::string& path = requests_[i].scan;
    const auto same = std::find_if(requests_.begin(), requests_.begin() + static_cast<std::ptrdiff_t>(i),
                                   [&](const FieldRequest& r) { return r.scan == path; });
    if (same != requests_.begin() + static_cast<std::ptrdiff_t>(i)) {
      scans_.push_back(scans_[static_cast<std::size_t>(same - requests_.begin())]);
      continue;
    }
    constexpr bool kMayBeConstant = true;
    const auto there = known.find(path);
    scans_.push_back(there != known.end() ? there->second.scan() : read_scan(path, progress, kMayBeConstant));
    if (progress.cancelled()) return;
    const Scan& scan = scans_.back();
    for (const std::string& file : input_files(path)) files_.push_back(file);
    const Vec last{scan.size[0] - 0.5, scan.size[1] - 0.5, scan.size[2] - 0.5};
    const Box box = scan.frame.world_box({-0.5, -0.5, -0.5}, last);
    for (int axis = 0; axis < 3; ++axis) {
      if (box.min[axis] <= object.max[axis] && box.max[axis] >= object.min[axis]) continue;
      throw Error(Fault::input, "input.field",
                  path + ": this scan for a field is elsewhere than the object: along axis " +
                      std::string(1, "xyz"[axis]) + " it covers " + number_text(box.min[axis], 5) + " to " +
                      number_text(box.max[axis], 5) + " mm, the object " + number_text(object.min[axis], 5) + " to " +
                      number_text(object.max[axis], 5) + " mm",
                  "check its origin and directions");
    }
  }
}

void FieldScans::add_to(TetMesh& mesh, Report& report, std::vector<std::string>& notes) const {
  for (std::size_t i = 0; i < requests_.size(); ++i) {
    const FieldRequest& request = requests_[i];
    ScanField field = scan_field(mesh, scans_[i], request.choice);
    ReportField told{request.name, request.scan,      measure_text(request.choice), 0, 0, 0,
                     field.total,  field.tets_outside};
    const auto [least, most] = std::minmax_element(field.values.begin(), field.values.end());
    double volume_mm3 = 0;
    for (std::size_t t = 0; t < mesh.tets.size(); ++t) volume_mm3 += tet_volume_mm3(mesh, t);
    told.min = *least;
    told.max = *most;
    told.mean = field.total / volume_mm3;
    if (field.tets_outside > 0) {
      notes.push_back("field " + request.name + ": " + std::to_string(field.tets_outside) + " of " +
                      std::to_string(mesh.tets.size()) + " tetrahedra reach beyond " + request.scan +
                      ", where its nearest values count");
    }
    report.fields.push_back(told);
    mesh.fields.push_back({request.name, std::move(field.values)});
  }
}

}  // namespace scantet
