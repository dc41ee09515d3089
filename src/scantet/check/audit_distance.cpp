// A sheet or a spike that is thinner than the tets beside it may shrink to a few of them: its component is still there,
// and so are its handles, but most of it is not. That shows in how far its boundary is from the mesh's.
#include <algorithm>

#include "scantet/base/options.h"
#include "scantet/check/audit_impl.h"
#include "scantet/check/boundary_points.h"
#include "scantet/check/lost_parts.h"

namespace scantet::auditing {

void check_distance(const TetMesh& mesh, const Domain& domain, const BoundaryDistance& distance,
                    const SizingField& size, AuditReport& report) {
  // Measured without a size: of the farthest places alone it can be said.
  const OneWayDistance& way = distance.to_mesh;
  std::vector<FarPlace> far = way.far.empty() ? way.worst : way.far;
  std::erase_if(far, [&](const FarPlace& p) { return !(p.distance_mm > kFarInSizes * size.size_at(p.point)); });
  const auto has_none = [&](const FarPlace& p) { return !has_width(domain, p.point, size.size_at(p.point)); };
  // The farthest point of a cell says nothing of the others if it has no width.
  if (std::any_of(far.begin(), far.end(), has_none)) far = find_lost_parts(mesh, domain, size);
  Tally tally("audit.lost_part");
  for (const FarPlace& place : far) {
    const double size_mm = size.size_at(place.point);
    tally.hit(place.point, [&] {
      return "one of " + number_text(place.distance_mm, 3) + " mm where the size is " + number_text(size_mm, 3) + " mm";
    });
  }
  record(tally, report);
}

}  // namespace scantet::auditing
