#include <algorithm>

#include "scantet/base/error.h"
#include "scantet/base/options.h"
#include "scantet/places/place_items_impl.h"

namespace scantet {

void refuse_empty_set(const NamedPlace& named, PlaceItems items, const std::vector<Hit>& hits,
                      const std::vector<Point>& points) {
  const std::string one = items == PlaceItems::nodes ? "node" : items == PlaceItems::facets ? "facet" : "element";
  std::string what = "--set: \"" + named.text + "\": no " + one + " is in the place";
  const auto nearest =
      std::min_element(hits.begin(), hits.end(), [](const Hit& a, const Hit& b) { return a.miss < b.miss; });
  if (nearest == hits.end() || !std::isfinite(nearest->miss)) {
    throw Error(Fault::usage, "usage.empty_set", what + ", and none would be if it were moved",
                "look at the names of the parts that are joined");
  }
  const auto index = static_cast<std::size_t>(nearest - hits.begin());
  const Point& p = points[index];
  constexpr int kDigits = 4;
  const char* const unit = nearest->unit == Hit::Unit::mm        ? " mm away from it"
                           : nearest->unit == Hit::Unit::degrees ? " degrees away from it"
                                                                 : " in the scan's value away from it";
  what += "; the nearest, " + one + " " + std::to_string(index + 1) + " at (" + number_text(p.x, kDigits) + ", " +
          number_text(p.y, kDigits) + ", " + number_text(p.z, kDigits) + "), is " +
          number_text(nearest->miss, kDigits) + unit;
  throw Error(Fault::usage, "usage.empty_set", what, "make the place larger; coordinates are mm along LPS axes");
}

}  // namespace scantet
