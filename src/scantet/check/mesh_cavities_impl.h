// Private to check/: which cavity of a mesh the nodes of a grid lie in.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "scantet/base/frame.h"
#include "scantet/check/audit_impl.h"

namespace scantet::auditing {

/// The walls of a mesh's cavities, where rows of nodes cross them.
class MeshCavities {
 public:
  /// frame: node index to world mm. outside, report: as check_boundary() gave them.
  MeshCavities(const TetMesh& mesh, const FaceMatch& match, const OutsideSurfaces& outside, const Frame& frame,
               const AuditReport& report);

  /// The cavity that a node clearly outside the mesh lies in, by its place in AuditReport::cavity_walls; kNone if it
  /// lies in none.
  std::uint32_t at(int i, int j, int k) const;

 private:
  /// Where a row crosses a cavity's wall.
  struct Crossing {
    std::int32_t k;
    std::int32_t j;
    std::uint32_t cavity;
    double i;
    friend auto operator<=>(const Crossing&, const Crossing&) = default;
  };
  void add_face(const TetMesh& mesh, const Triangle& face, std::uint32_t cavity, const Frame& frame);

  std::vector<Crossing> crossings_;
  std::vector<double> volumes_mm3_;
};

}  // namespace scantet::auditing
