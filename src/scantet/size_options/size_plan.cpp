// A region's size is "R=MM".
#include "scantet/size_options/size_plan.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "scantet/base/error.h"

namespace scantet {
namespace {

/// "2" of "2=1.5"; kOutside if that is no number of a region.
Region region_in(const std::string& text) {
  Region region = kOutside;
  const char* const end = text.data() + std::min(text.find('='), text.size());
  const auto [stop, code] = std::from_chars(text.data(), end, region);
  return code == std::errc{} && stop == end && region > 0 ? region : kOutside;
}

std::map<Region, double> region_sizes_of(const std::vector<std::string>& texts) {
  std::map<Region, double> sizes;
  for (const std::string& text : texts) {
    const std::size_t equals = text.find('=');
    const std::optional<double> size = equals == std::string::npos ? std::nullopt : number_in(text.substr(equals + 1));
    const Region region = region_in(text);
    if (!size || !(*size > 0) || !std::isfinite(*size) || region == kOutside) {
      throw Error(Fault::usage, "usage.region_size", "--region-size: \"" + text + "\" is not a region and its size",
                  "give the region's number, from 1, and a size in mm greater than 0: --region-size 2=1.5");
    }
    if (!sizes.emplace(region, *size).second) {
      throw Error(Fault::usage, "usage.region_size",
                  "--region-size: region " + std::to_string(region) + " has two sizes", "give each region once");
    }
  }
  return sizes;
}

}  // namespace

SizePlan plan_sizes(const SizeOptions& options) {
  return {read_size("--size", options.size), read_size("--boundary-size", options.boundary_size),
          region_sizes_of(options.region_sizes)};
}

}  // namespace scantet
