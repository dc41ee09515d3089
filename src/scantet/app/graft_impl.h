// Private: one of two meshes that are grafted.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "scantet/app/graft.h"
#include "scantet/base/mesh_topology.h"
#include "scantet/base/parallel.h"
#include "scantet/base/point_grid_impl.h"
#include "scantet/quality/tet_stars.h"

namespace scantet::grafting {

inline constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

/// The tets on either side of a face; kNone where there is none.
struct Sides {
  std::uint32_t behind = kNone;  ///< the face's right-hand normal points out of it
  std::uint32_t front = kNone;
};

/// A mesh, to be asked what is across a face, and the tets of it that are taken out.
class Part {
 public:
  explicit Part(const TetMesh& mesh) : mesh_(mesh), stars_(mesh), is_in_(mesh.tets.size(), 0) {}

  const TetMesh& mesh() const { return mesh_; }
  /// The tets at a vertex.
  auto star_of(VertexId v) const { return stars_.of(v); }
  Sides sides_of(const Triangle& face) const {
    Sides sides;
    for (const std::uint32_t t : stars_.of(*std::min_element(face.begin(), face.end()))) {
      const Tet& tet = mesh_.tets[t];
      const auto is_on_face = [&](VertexId v) { return std::find(face.begin(), face.end(), v) != face.end(); };
      if (std::count_if(tet.begin(), tet.end(), is_on_face) != 3) continue;
      const auto apex = std::find_if_not(tet.begin(), tet.end(), is_on_face) - tet.begin();
      const Triangle own = face_of(tet, static_cast<int>(apex));
      const auto first = static_cast<std::size_t>(std::find(own.begin(), own.end(), face[0]) - own.begin());
      (own[(first + 1) % 3] == face[1] ? sides.behind : sides.front) = t;
    }
    return sides;
  }

  /// Whether a tet is taken out.
  bool holds(std::uint32_t tet) const { return is_in_[tet] != 0; }
  /// Puts a tet back.
  void remove(std::uint32_t tet) {
    size_ -= is_in_[tet];
    is_in_[tet] = 0;
  }
  void add(std::uint32_t tet) {
    if (tet == kNone || holds(tet)) return;
    is_in_[tet] = 1;
    ++size_;
    front_.push_back(tet);
  }
  void add_at(const std::vector<GraftSite>& sites, const PointGrid& centers, double most_mm) {
    const std::vector<Point>& vertices = mesh_.vertices;
    constexpr std::size_t kGrain = 8192;
    std::vector<std::uint8_t> is_near(vertices.size(), 0);
    parallel_for(vertices.size(), kGrain, [&](std::size_t begin, std::size_t end) {
      for (std::size_t v = begin; v < end; ++v) {
        is_near[v] = centers.any_near(vertices[v], most_mm, [&](std::uint32_t site, const Point&, double squared) {
          return squared <= sites[site].radius_mm * sites[site].radius_mm;
        });
      }
    });
    for (std::uint32_t t = 0; t < mesh_.tets.size(); ++t) {
      const Tet& tet = mesh_.tets[t];
      if (std::any_of(tet.begin(), tet.end(), [&](VertexId v) { return is_near[v] != 0; })) add(t);
    }
  }
  /// The tet that was added last and not taken yet; kNone if there is none.
  std::uint32_t take_last() {
    if (front_.empty()) return kNone;
    const std::uint32_t tet = front_.back();
    front_.pop_back();
    return tet;
  }
  bool is_mostly_kept() const { return kLeastKept * size_ < mesh_.tets.size(); }

 private:
  static constexpr std::size_t kLeastKept = 4;  // one of so many tets may be touched

  const TetMesh& mesh_;
  TetStars stars_;
  std::vector<std::uint8_t> is_in_;
  std::size_t size_ = 0;
  std::vector<std::uint32_t> front_;
};

/// Puts tets back of both meshes where a region would have another Euler number with the fresh ones: by groups of tets
/// that hang together at vertices. But a group may bring the sum of all of these numbers nearer to missing_euler more.
/// match: for each fresh vertex that of the kept mesh at the same place, or kNone.
void put_back_other_topology(Part& kept, Part& fresh, const std::vector<VertexId>& match, std::int64_t missing_euler);

}  // namespace scantet::grafting
