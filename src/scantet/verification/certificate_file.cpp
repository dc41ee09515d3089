// A certificate says what was verified, with checksums and options, so that anyone can do so again.
#include "scantet/verification/certificate_file.h"

#include <algorithm>
#include <array>
#include <fstream>
#include <nlohmann/json.hpp>

#include "scantet/base/error.h"
#include "scantet/base/json_depth.h"
#include "scantet/base/json_message.h"
#include "scantet/base/regular_file.h"
#include "scantet/base/version.h"
#include "scantet/certificate/certificate_json_impl.h"
#include "scantet/io/input_files.h"
#include "scantet/labels/label_choice.h"

namespace scantet {
namespace {

using nlohmann::ordered_json;

/// Options that say nothing of what was verified. A certificate that sets them would choose files to be written.
bool is_of_the_run(const std::string& name) {
  constexpr std::array kNames{"against", "json", "threads", "certificate", "require"};
  return std::find(kNames.begin(), kNames.end(), name) != kNames.end();
}

/// Those that have a value, by their names.
ordered_json options_of(const VerifyJob& asked) {
  VerifyJob job;
  OptionSet set;
  job.declare_options(set);  // before the values, as an option tells one that is none from its own default
  job = asked;
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

std::string certificate_json(const MeshCertificate& c, const VerifyJob& job, const std::string& mesh_file) {
  ordered_json json;
  json["scantet"] = kVersion;
  json["kind"] = "certificate";
  json["grade"] = name_of(c.grade());
  json["mesh_file"] = {{"name", job.mesh},
                       {"sha256", input_sha256(input_files(mesh_file.empty() ? job.mesh : mesh_file))}};
  json["scan"] = {{"name", job.against}, {"sha256", input_sha256(input_files(job.against))}};
  if (is_label_table(job.labels.labels)) {
    json["labels_table"] = {{"name", job.labels.labels}, {"sha256", input_sha256({job.labels.labels})}};
  }
  json["options"] = options_of(job);
  json.update(json_of(c));
  return json.dump(2, ' ', false, ordered_json::error_handler_t::replace) + "\n";
}

RecordedCertificate read_certificate(const std::string& path) {
  check_regular_file(path);
  std::ifstream in(path, std::ios::binary);
  if (!in) throw Error(Fault::input, "input.cannot_open", "cannot open " + path, "check the name");
  const auto within_depth = [&](int depth, ordered_json::parse_event_t, ordered_json&) {
    if (depth > kMostJsonDepth) refuse(path, "it is nested too deeply");
    return true;
  };
  const ordered_json json = ordered_json::parse(in, within_depth, false);
  RecordedCertificate recorded;
  try {
    if (!json.is_object()) refuse(path, "it is no JSON object");
    if (json.value("kind", ordered_json()) != "certificate") refuse(path, "it is of another kind");
    recorded.grade = json.at("grade").get<std::string>();
    recorded.mesh = json.at("mesh_file").at("name").get<std::string>();
    recorded.mesh_sha256 = json.at("mesh_file").at("sha256").get<std::string>();
    recorded.scan = json.at("scan").at("name").get<std::string>();
    recorded.scan_sha256 = json.at("scan").at("sha256").get<std::string>();
    if (json.contains("labels_table")) recorded.labels_sha256 = json["labels_table"].at("sha256").get<std::string>();
    for (const auto& [name, values] : json.at("options").items()) {
      if (is_of_the_run(name)) refuse(path, "it sets --" + name + ", which is the caller's to choose");
      for (const auto& value : values) {
        recorded.options.push_back({name, value.get<std::string>(), path + ": \"" + name + "\""});
      }
    }
  } catch (const nlohmann::json::exception& error) {
    refuse(path, without_json_tag(error.what()));
  }
  return recorded;
}

std::vector<std::string> changed_files(const RecordedCertificate& recorded, const VerifyJob& job) {
  std::vector<std::string> changed;
  if (input_sha256(input_files(job.mesh)) != recorded.mesh_sha256) changed.push_back(job.mesh);
  if (input_sha256(input_files(job.against)) != recorded.scan_sha256) changed.push_back(job.against);
  const std::string& table = job.labels.labels;
  if (!recorded.labels_sha256.empty() && (!is_label_table(table) || input_sha256({table}) != recorded.labels_sha256)) {
    changed.push_back(table);
  }
  return changed;
}

}  // namespace scantet
