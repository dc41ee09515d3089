// A sheet or a spike that is thinner than the tets beside it may shrink to a few of them: its component is still there,
// and so are its handles, but most of it is not. That shows in how far its boundary is from the mesh's.
#include "scantet/base/options.h"
#include "scantet/check/audit_impl.h"

namespace scantet::auditing {

void check_distance(const BoundaryDistance& distance, const SizingField& size, AuditReport& report) {
  Tally tally("audit.lost_part");
  // Measured without a size: of the farthest places alone it can be said.
  const OneWayDistance& way = distance.to_mesh;
  for (const FarPlace& place : way.far.empty() ? way.worst : way.far) {
    const double size_mm = size.size_at(place.point);
    if (!(place.distance_mm > kFarInSizes * size_mm)) continue;
    tally.hit(place.point, [&] {
      return "one of " + number_text(place.distance_mm, 3) + " mm where the size is " + number_text(size_mm, 3) + " mm";
    });
  }
  record(tally, report);
}

}  // namespace scantet::auditing
