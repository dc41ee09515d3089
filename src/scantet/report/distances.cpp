#include "scantet/report/distances_impl.h"
#include "scantet/report/numbers_impl.h"

namespace scantet {

std::string distance_text(const OneWayDistance& distance) {
  if (distance.points == 0) return "not measured";
  if (!distance.upper_mm) {
    return number(distance.lower_mm) + " mm at the worst of " + grouped(distance.points) + " points, without a bound";
  }
  return number(distance.lower_mm) + " to " + number(*distance.upper_mm) + " mm";
}

}  // namespace scantet
