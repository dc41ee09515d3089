#include "scantet/materials/assign_materials.h"

#include <algorithm>
#include <map>

#include "scantet/base/error.h"
#include "scantet/base/options.h"
#include "scantet/materials/sample_means.h"
#include "scantet/materials/tet_means.h"
#include "scantet/places/place_items.h"

namespace scantet {
namespace {

constexpr double kTonnePerMm3 = 1e-9;  // of g/cm³
constexpr std::uint32_t kNone = 0xFFFFFFFF;

[[noreturn]] void refuse(const MaterialFile& file, const std::string& why) {
  throw Error(Fault::usage, "usage.materials", file.path + ": " + why,
              "docs/materials.md says how materials are written");
}

class Assignment {
 public:
  Assignment(const MaterialFile& file, const ScanTable& scans, TetMesh& mesh)
      : file_(file), scans_(scans), mesh_(mesh) {
    mesh.materials.clear();
    mesh.tet_materials.assign(mesh.tets.size(), kNone);
    for (const Region region : mesh.tet_regions) known_[region] = region_name(mesh, region);
  }

  std::vector<std::optional<double>> run() {
    for (const PlaceMaterial& each : file_.places) {
      const bool is_used = assign(items_in_place(mesh_, each.place, scans_).tets, each.place.name, each.constants);
      if (!is_used) refuse(file_, "the place " + each.place.name + " has only elements of places before it");
    }
    std::map<Region, const MaterialConstants*> constant;
    for (const auto& [name, material] : file_.regions) constant[region_of(name)] = &material;
    for (const auto& [region, material] : constant) assign_region(region, *material);
    if (file_.law) assign_law(*file_.law);
    for (std::size_t t = 0; t < mesh_.tets.size(); ++t) {
      if (mesh_.tet_materials[t] == kNone) {
        refuse(file_, "the region " + known_[mesh_.tet_regions[t]] + " has no material");
      }
    }
    return std::move(conductivities_);
  }

 private:
  Region region_of(const std::string& name) const {
    std::vector<std::string> names;
    for (const auto& [region, own] : known_) {
      if (own == name || std::to_string(region) == name) return region;
      names.push_back(own);
    }
    const auto meant = closest_name(name, names);
    refuse(file_, "the mesh has no region \"" + name + "\"" + (meant ? "; did you mean " + *meant + "?" : ""));
  }

  /// Gives a material to those of the tets that have none yet. Return: whether there are such.
  bool assign(const std::vector<std::uint32_t>& tets, const std::string& name, const MaterialConstants& constants) {
    const auto index = static_cast<std::uint32_t>(mesh_.materials.size());
    bool is_used = false;
    for (const std::uint32_t t : tets) {
      if (mesh_.tet_materials[t] != kNone) continue;
      mesh_.tet_materials[t] = index;
      is_used = true;
    }
    if (!is_used) return false;
    mesh_.materials.push_back(
        {name, constants.youngs_modulus_mpa, constants.poissons_ratio, constants.density_g_per_cm3 * kTonnePerMm3});
    conductivities_.push_back(constants.conductivity);
    return true;
  }

  void assign_region(Region region, const MaterialConstants& constants) {
    std::vector<std::uint32_t> tets;
    for (std::uint32_t t = 0; t < mesh_.tets.size(); ++t) {
      if (mesh_.tet_regions[t] == region) tets.push_back(t);
    }
    assign(tets, known_[region], constants);
  }

  /// The tets that the law is for.
  std::vector<std::uint32_t> tets_of(const MaterialLaw& law) const {
    std::vector<Region> regions;
    for (const std::string& name : law.regions) regions.push_back(region_of(name));
    std::vector<std::uint32_t> tets;
    for (std::uint32_t t = 0; t < mesh_.tets.size(); ++t) {
      const bool is_free = mesh_.tet_materials[t] == kNone;
      const bool is_meant =
          regions.empty() || std::find(regions.begin(), regions.end(), mesh_.tet_regions[t]) != regions.end();
      if (is_free && is_meant) tets.push_back(t);
    }
    return tets;
  }

  void assign_law(const MaterialLaw& law) {
    const std::vector<std::uint32_t> tets = tets_of(law);
    if (tets.empty()) refuse(file_, "no tetrahedron is left for the law of \"scan\": all regions have constants");
    const ScanValues& scan = scans_.at(law.scan);
    const auto value = [](double x) { return x; };
    const auto density = [&law](double x) { return law.density_of(x); };
    const auto modulus = [&law](double x) { return law.modulus_of_density(law.density_of(x)); };
    const auto means = law.integrate == Integrate::voxels  ? voxel_means
                       : law.integrate == Integrate::nodes ? corner_means
                                                           : tet_means;
    std::vector<double> densities = means(mesh_, scan, density);
    std::vector<double> moduli;
    if (law.integrate >= Integrate::modulus) moduli = means(mesh_, scan, modulus);
    if (law.integrate == Integrate::hu) {
      densities = tet_means(mesh_, scan, value);
      for (double& x : densities) x = law.density_of(x);
    }
    std::vector<double> of_tets;
    for (const std::uint32_t t : tets) {
      const double mpa = moduli.empty() ? law.modulus_of_density(densities[t]) : moduli[t];
      of_tets.push_back(std::max(mpa, law.least_modulus_mpa));
    }
    put_into_bins(law, tets, of_tets, densities);
  }

  void put_into_bins(const MaterialLaw& law, const std::vector<std::uint32_t>& tets, const std::vector<double>& moduli,
                     const std::vector<double>& densities) {
    std::map<double, std::vector<std::uint32_t>, std::greater<>> groups;  // stiffest first; places in `tets`
    if (law.bin_width_mpa == 0 && law.bin_number == 0) {
      for (std::uint32_t i = 0; i < tets.size(); ++i) groups[moduli[i]].push_back(i);
    } else {
      const std::vector<double> bins =
          law.bin_width_mpa > 0 ? bins_of(moduli, law.bin_width_mpa) : even_bins_of(moduli, std::floor(law.bin_number));
      for (std::uint32_t i = 0; i < tets.size(); ++i) groups[-bins[i]].push_back(i);
    }
    int number = 0;
    for (const auto& [key, members] : groups) {
      double most = 0;
      double sum = 0;
      double density = 0;
      for (const std::uint32_t i : members) {
        most = std::max(most, moduli[i]);
        sum += moduli[i];
        density += densities[tets[i]];
        mesh_.tet_materials[tets[i]] = static_cast<std::uint32_t>(mesh_.materials.size());
      }
      const auto count = static_cast<double>(members.size());
      mesh_.materials.push_back({"scan_" + std::to_string(++number),
                                 law.bin_modulus == BinModulus::max ? most : sum / count, law.poissons_ratio,
                                 density / count * kTonnePerMm3});
      conductivities_.push_back(law.conductivity);
    }
  }

  const MaterialFile& file_;
  const ScanTable& scans_;
  TetMesh& mesh_;
  std::map<Region, std::string> known_;
  std::vector<std::optional<double>> conductivities_;
};

}  // namespace

std::vector<std::optional<double>> assign_materials(const MaterialFile& file, const ScanTable& scans, TetMesh& mesh) {
  return Assignment(file, scans, mesh).run();
}

}  // namespace scantet
