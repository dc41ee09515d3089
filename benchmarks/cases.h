// What is meshed, and at which criteria.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "scantet/domain/sizing_field.h"
#include "scantet/image/level_set.h"
#include "scantet/refine/mesher.h"

namespace scantet::bench {

struct Case {
  std::string name;
  std::string scan;  ///< path; empty: the tanglecube
  LevelSetSettings level;
  double size_mm = 0;  ///< the uniform σ; 0: graded, see tanglecube.h
  MesherOptions options;
  int runs = 1;       ///< of each contestant, unless the caller says otherwise
  bool peers = true;  ///< false: too large for the other contestants

  /// "σ = 2 mm, α = 1", as read in tables.
  std::string criteria() const;
};

/// All cases. volumes: the folder with skull.nrrd.
std::vector<Case> all_cases(const std::string& volumes);

/// The scan of a case that has one.
Scan open_scan(const Case& c);

/// The size as a field.
std::unique_ptr<SizingField> sizing(const Case& c);

}  // namespace scantet::bench
