// A run of scantet mesh, and the report it wrote.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "read_json.h"
#include "run_process.h"

namespace scantet {

struct Meshed {
  RunResult result;
  nlohmann::json report;  ///< null if there is no mesh
};

/// Runs `scantet mesh` with these arguments, in a folder of its own.
inline Meshed run_mesh(std::vector<std::string> arguments) {
  const TestFolder folder;
  arguments.insert(arguments.begin(), "mesh");
  arguments.insert(arguments.end(), {"--report", "a.json"});
  Meshed run{run_scantet(arguments, {folder.path()}), {}};
  if (run.result.status == 0 || run.result.status == 4) run.report = read_json(folder / "a.json");
  return run;
}

/// The same with torus.nrrd before the arguments, at a level.
inline Meshed mesh_torus_at(const std::string& level, std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), {sample("torus.nrrd"), "--level", level});
  return run_mesh(std::move(arguments));
}

}  // namespace scantet
