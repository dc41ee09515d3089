// A certificate says what was verified, with checksums and options, so that anyone can do so again.
#include "scantet/app/certificate_file.h"

#include <algorithm>
#include <array>
#include <fstream>
#include <nlohmann/json.hpp>

#include "scantet/base/error.h"
#include "scantet/base/version.h"
#include "scantet/io/input_files.h"

namespace scantet {
namespace {

using nlohmann::ordered_json;

ordered_json json_of(const Point& p) {
  return {p.x, p.y, p.z};
}

ordered_json json_of(const VerifiedDistance& d) {
  ordered_json json{{"lower_mm", d.lower_mm}, {"lower_place", json_of(d.lower_place)}};
  json["upper_mm"] = d.upper_mm ? ordered_json(*d.upper_mm) : ordered_json();
  json["upper_place"] = json_of(d.upper_place);
  return json;
}

ordered_json json_of(const VerifiedInvariants& i) {
  return {{"components", i.components},
          {"cavities", i.cavities},
          {"euler", i.euler},
          {"handles", i.handles()},
          {"known", i.is_known}};
}

ordered_json json_of(const std::vector<VerifyFinding>& findings) {
  ordered_json list = ordered_json::array();
  for (const VerifyFinding& f : findings) {
    list.push_back({{"code", f.code},
                    {"message", f.what},
                    {"wrong", f.is_wrong},
                    {"count", f.count},
                    {"place", json_of(f.place)}});
  }
  return list;
}

/// Options that say nothing of what was verified.
bool is_of_the_run(const std::string& name) {
  constexpr std::array kNames{"against", "json", "threads", "certificate", "require"};
  return std::find(kNames.begin(), kNames.end(), name) != kNames.end();
}

/// Those that have a value, by their names.
ordered_json options_of(VerifyJob job) {
  OptionSet set;
  job.declare_options(set);
  ordered_json json = ordered_json::object();
  for (const Option& option : set.options()) {
    const std::vector<std::string> values = option.read();
    if (!values.empty() && !is_of_the_run(option.name)) json[option.name] = values;
  }
  return json;
}

[[noreturn]] void refuse(const std::string& path, const std::string& why) {
  throw Error(Fault::input, "input.certificate", path + " is no certificate: " + why,
              "give a file that scantet verify --json has written");
}

}  // namespace

std::string certificate_json(const Certificate& c, const VerifyJob& job) {
  ordered_json json;
  json["scantet"] = kVersion;
  json["kind"] = "certificate";
  json["grade"] = name_of(c.grade);
  json["mesh_file"] = {{"name", job.mesh}, {"sha256", input_sha256(input_files(job.mesh))}};
  json["scan"] = {{"name", job.against}, {"sha256", input_sha256(input_files(job.against))}};
  json["options"] = options_of(job);
  json["findings"] = json_of(c.findings);
  json["tets"] = c.tets;
  json["facets"] = {{"count", c.facets},
                    {"certified", c.facets_certified},
                    {"beyond_outermost_voxels", c.facets_at_border},
                    {"area_mm2", c.area_mm2},
                    {"area_certified_mm2", c.area_certified_mm2}};
  json["mesh_to_level"] = json_of(c.mesh_to_level);
  json["level_to_mesh"] = json_of(c.level_to_mesh);
  json["field_topology"] = json_of(c.field);
  json["mesh_topology"] = json_of(c.mesh);
  json["field_volume_mm3"] = c.field_volume_mm3;
  json["mesh_volume_mm3"] = c.mesh_volume_mm3;
  ordered_json places = ordered_json::array();
  for (const UndecidedPlace& place : c.undecided) {
    places.push_back({{"reason", place.reason}, {"min", json_of(place.box.min)}, {"max", json_of(place.box.max)}});
  }
  json["undecided"] = places;
  json["seconds"] = c.seconds;
  return json.dump(2) + "\n";
}

RecordedCertificate read_certificate(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  if (!in) throw Error(Fault::input, "input.cannot_open", "cannot open " + path, "check the name");
  const ordered_json json = ordered_json::parse(in, nullptr, false);
  RecordedCertificate recorded;
  try {
    if (json.is_discarded() || json.at("kind") != "certificate") refuse(path, "it is of another kind");
    recorded.grade = json.at("grade").get<std::string>();
    recorded.mesh = json.at("mesh_file").at("name").get<std::string>();
    recorded.mesh_sha256 = json.at("mesh_file").at("sha256").get<std::string>();
    recorded.scan = json.at("scan").at("name").get<std::string>();
    recorded.scan_sha256 = json.at("scan").at("sha256").get<std::string>();
    for (const auto& [name, values] : json.at("options").items()) {
      for (const auto& value : values) {
        recorded.options.push_back({name, value.get<std::string>(), path + ": \"" + name + "\""});
      }
    }
  } catch (const nlohmann::json::exception& error) {
    refuse(path, error.what());
  }
  return recorded;
}

std::vector<std::string> changed_files(const RecordedCertificate& recorded, const VerifyJob& job) {
  std::vector<std::string> changed;
  if (input_sha256(input_files(job.mesh)) != recorded.mesh_sha256) changed.push_back(job.mesh);
  if (input_sha256(input_files(job.against)) != recorded.scan_sha256) changed.push_back(job.against);
  return changed;
}

}  // namespace scantet
