// What --materials reads.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "scantet/materials/material_law.h"
#include "scantet/places/place.h"

namespace scantet {

/// Constants of a material. 0 or none: not known.
struct MaterialConstants {
  double youngs_modulus_mpa = 0;
  double poissons_ratio = 0;  ///< given where the modulus is
  double density_g_per_cm3 = 0;
  std::optional<double> conductivity;  ///< in the units of the loads: W/(mm K), S/mm
};

/// A material for the elements of a place.
struct PlaceMaterial {
  NamedPlace place;
  MaterialConstants constants;
};

struct MaterialFile {
  std::string path;
  std::vector<PlaceMaterial> places;                 ///< an element in several is of the first
  std::map<std::string, MaterialConstants> regions;  ///< by name or number; what places leave
  std::optional<MaterialLaw> law;
};

/// Throws Error (usage.materials): not as docs/materials.md says, with the key; (usage.place): as read_place().
MaterialFile read_material_file(const std::string& path);

}  // namespace scantet
