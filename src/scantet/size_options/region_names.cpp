#include "scantet/size_options/region_names.h"

#include <algorithm>

#include "scantet/base/error.h"
#include "scantet/base/options.h"
#include "scantet/size_options/region_probe.h"

namespace scantet {
namespace {

/// The region of that name or number. place: opens messages, "--layers: \"skull\"".
Region find_region(const std::string& text, const Domain& domain, const std::set<Region>& known, const char* code,
                   const std::string& place) {
  std::vector<std::string> names;
  std::vector<Region> found;
  for (const Region region : known) {
    names.push_back(domain.name_of_region(region));
    if (names.back() == text || std::to_string(region) == text) found.push_back(region);
  }
  if (found.size() == 1) return found.front();
  const auto meant = closest_name(text, names);
  throw Error(Fault::usage, code,
              place + (found.empty() ? ": no region of the object is called so" : ": several regions are called so"),
              found.empty() && meant ? "did you mean " + *meant + "? Numbers name regions, too"
                                     : "give the region's number; scantet info lists the regions");
}

}  // namespace

SizePlan plan_with_numbers(const SizePlan& plan, const Domain& domain) {
  SizePlan numbered = plan;
  numbered.named_regions.clear();
  if (plan.named_regions.empty()) return numbered;
  const std::set<Region> known = regions_of(domain);
  for (const auto& [name, size_mm] : plan.named_regions) {
    const std::string place = "--region-size: \"" + name + "=" + number_text(size_mm) + "\"";
    const Region region = find_region(name, domain, known, "usage.region_size", place);
    if (!numbered.regions.emplace(region, size_mm).second) {
      throw Error(Fault::usage, "usage.region_size",
                  place + ": that is region " + std::to_string(region) + ", which has two sizes",
                  "give each region once");
    }
  }
  return numbered;
}

std::set<Region> regions_in_layers(const LayerRequest& request, const Domain& domain) {
  std::set<Region> known = regions_of(domain);
  if (request.regions.empty()) return known;
  std::set<Region> chosen;
  for (const std::string& name : request.regions) {
    chosen.insert(find_region(name, domain, known, "usage.layers", "--layers: \"" + name + "\""));
  }
  return chosen;
}

}  // namespace scantet
