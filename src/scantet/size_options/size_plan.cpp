// A region's size is "R=MM"; names are looked up when the input is open (region_names.h).
#include "scantet/size_options/size_plan.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <sstream>

#include "scantet/base/error.h"

namespace scantet {
namespace {

/// The number of a region that all of the text is; kOutside if it is none.
Region region_in(const std::string& text) {
  Region region = kOutside;
  const char* const end = text.data() + text.size();
  const auto [stop, code] = std::from_chars(text.data(), end, region);
  return code == std::errc{} && stop == end && region > 0 ? region : kOutside;
}

void read_region_sizes(const std::vector<std::string>& texts, SizePlan& plan) {
  for (const std::string& text : texts) {
    const std::size_t equals = text.rfind('=');
    const std::optional<double> size = equals == std::string::npos ? std::nullopt : number_in(text.substr(equals + 1));
    const std::string name = text.substr(0, equals);
    const Region region = region_in(name);
    const bool no_number = region == kOutside && name.find_first_not_of("0123456789") == std::string::npos;
    if (!size || !(*size > 0) || !std::isfinite(*size) || no_number) {
      throw Error(
          Fault::usage, "usage.region_size", "--region-size: \"" + text + "\" is not a region and its size",
          "give the region's number, from 1, or its name, and a size in mm greater than 0: --region-size 2=1.5");
    }
    const bool is_new = region == kOutside ? plan.named_regions.emplace(name, *size).second
                                           : plan.regions.emplace(region, *size).second;
    if (!is_new) {
      throw Error(Fault::usage, "usage.region_size", "--region-size: region " + name + " has two sizes",
                  "give each region once");
    }
  }
}

LayerRequest read_layers(const std::string& text) {
  constexpr int kMostLayers = 20;
  LayerRequest request;
  if (text.empty()) return request;
  std::istringstream parts(text);
  std::string part;
  std::getline(parts, part, ',');
  const char* const end = part.data() + part.size();
  const auto [stop, code] = std::from_chars(part.data(), end, request.layers);
  while (std::getline(parts, part, ',')) request.regions.push_back(part);
  const bool empty_name = std::find(request.regions.begin(), request.regions.end(), "") != request.regions.end();
  if (code != std::errc{} || stop != end || request.layers < 2 || request.layers > kMostLayers || empty_name ||
      text.back() == ',') {
    throw Error(
        Fault::usage, "usage.layers", "--layers: \"" + text + "\" is no number of layers",
        "give a whole number from 2 to 20, and after commas the regions if not all are meant: --layers 2,skull");
  }
  return request;
}

std::vector<PlaceSize> read_place_sizes(const std::vector<std::string>& texts) {
  std::vector<PlaceSize> sizes;
  for (const std::string& text : texts) {
    const std::size_t equals = text.rfind('=');
    const std::string number = equals == std::string::npos ? "" : text.substr(equals + 1);
    const std::optional<double> size = number_in(number.substr(std::min(number.find_first_not_of(' '), number.size())));
    if (!size || !(*size > 0) || !std::isfinite(*size)) {
      throw Error(Fault::usage, "usage.size_where", "--size-where: \"" + text + "\" is not a place and its size",
                  "give a place and a size in mm greater than 0: --size-where \"ball(0, 0, 90, 12)=1.5\"");
    }
    sizes.push_back({read_place("--size-where", text.substr(0, equals)), *size});
    if (is_of_points(sizes.back().place)) continue;
    throw Error(Fault::usage, "usage.size_where",
                "--size-where: \"" + text +
                    "\": regions, patches, borders, curves, normals, sets and what is nearest "
                    "are told of meshes, and there is none yet",
                "use a box, ball, cylinder, half-space or scan; a size in a region is --region-size");
  }
  return sizes;
}

}  // namespace

SizePlan plan_sizes(const SizeOptions& options) {
  SizePlan plan{read_size("--size", options.size), read_size("--boundary-size", options.boundary_size), {}};
  read_region_sizes(options.region_sizes, plan);
  plan.layers = read_layers(options.layers);
  plan.places = read_place_sizes(options.size_where);
  return plan;
}

}  // namespace scantet
