// What --materials reads.
#pragma once

#include <map>
#include <optional>
#include <string>

#include "scantet/materials/material_law.h"

namespace scantet {

/// Constants of a region. 0 or none: not known.
struct RegionMaterial {
  double youngs_modulus_mpa = 0;
  double poissons_ratio = 0;
  double density_g_per_cm3 = 0;
  std::optional<double> conductivity;  ///< in the units of the loads: W/(mm K), S/mm
};

struct MaterialFile {
  std::string path;
  std::map<std::string, RegionMaterial> regions;  ///< by name or number
  std::optional<MaterialLaw> law;
};

/// Throws Error (usage.materials): not as docs/materials.md says, with the key.
MaterialFile read_material_file(const std::string& path);

}  // namespace scantet
