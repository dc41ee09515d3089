// One message for all that ask a source and get no size.
#include "scantet/sizing/size_source.h"

#include <cmath>

#include "scantet/base/error.h"
#include "scantet/base/options.h"

namespace scantet {

void refuse_size(const std::string& option, const std::string& text, const SizePlace& place, bool depth_matters,
                 double size_mm) {
  const Point& p = place.point;
  std::string where = "(" + number_text(p.x, 6) + ", " + number_text(p.y, 6) + ", " + number_text(p.z, 6) + ") mm";
  if (depth_matters) where += ", d = " + number_text(place.depth_mm, 4) + " mm";
  where += ", region " + std::to_string(place.region);
  throw Error(Fault::usage, "usage.size",
              option + ": \"" + text + "\" gives " +
                  (std::isnan(size_mm) ? std::string("no number") : number_text(size_mm, 6) + " mm") + " at " + where,
              "sizes must be greater than 0 everywhere in the object and on its boundary");
}

}  // namespace scantet
