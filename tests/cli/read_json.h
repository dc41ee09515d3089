// Reports, read back.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "run_process.h"

namespace scantet {

inline nlohmann::json read_json(const std::string& file) {
  return nlohmann::json::parse(read_bytes(file));
}

}  // namespace scantet
