// Values become texts again and are handled as on the command line, so that one set of checks serves both.
#include "scantet/app/config.h"

#include <fstream>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "scantet/base/error.h"
#include "scantet/base/json_depth.h"
#include "scantet/base/json_message.h"

namespace scantet {
namespace {

using nlohmann::json;

[[noreturn]] void refuse(const std::string& file, const std::string& what, const std::string& remedy) {
  throw Error(Fault::usage, "usage.config", file + ": " + what, remedy);
}

std::string value_text(const json& value, const std::string& place) {
  if (value.is_null()) return "none";
  if (value.is_string()) return value.get<std::string>();
  if (value.is_number() || value.is_boolean()) return value.dump();
  throw Error(Fault::usage, "usage.config", place + ": an option's value cannot be an object or a nested list",
              "give a number, a text, true, false, null or a list of texts");
}

std::string read_text(const std::string& file) {
  std::ifstream stream(file, std::ios::binary);
  std::ostringstream text;
  if (stream) text << stream.rdbuf();
  if (!stream || !text) refuse(file, "the configuration cannot be read", "check the path given to --config");
  return text.str();
}

json parse(const std::string& file) {
  std::set<std::string> keys;
  const auto once = [&](int depth, json::parse_event_t event, json& parsed) {
    if (depth > kMostJsonDepth) {
      refuse(file, "nested too deeply", "write an object such as {\"level\": 60, \"size\": 2}");
    }
    if (event == json::parse_event_t::key && depth == 1 && !keys.insert(parsed.get<std::string>()).second) {
      refuse(file, "\"" + parsed.get<std::string>() + "\" appears twice", "keep one of them");
    }
    return true;
  };
  try {
    return json::parse(read_text(file), once);
  } catch (const json::out_of_range& error) {
    refuse(file, without_json_tag(error.what()), "write numbers of up to 1.7e308");
  } catch (const json::exception& error) {
    refuse(file, "not valid JSON: " + without_json_tag(error.what()),
           "write an object such as {\"level\": 60, \"size\": 2}");
  }
}

}  // namespace

std::vector<OptionValue> read_config(const std::string& file) {
  const json config = parse(file);
  if (!config.is_object()) refuse(file, "not a JSON object", "write an object such as {\"level\": 60, \"size\": 2}");
  std::vector<OptionValue> values;
  for (const auto& [name, value] : config.items()) {
    const std::string place = file + ": \"" + name + "\"";
    if (!value.is_array()) {
      values.push_back({name, value_text(value, place), place});
      continue;
    }
    for (const json& one : value) values.push_back({name, value_text(one, place), place});
  }
  return values;
}

}  // namespace scantet
