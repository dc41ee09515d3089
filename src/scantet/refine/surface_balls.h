// The surface Delaunay balls of the restricted facets, in one pool.
#pragma once

#include <cstdint>
#include <vector>

#include "scantet/domain/domain.h"

namespace scantet::refine {

/// A ball centred where the dual edge of a facet meets ∂O, through the facet's vertices, empty of points (paper,
/// section 2). A facet whose dual edge meets ∂O several times has a chain of them.
struct SurfaceBall {
  Point center;
  double radius = 0;         ///< mm
  BoundaryId boundary = 0;   ///< component of ∂O at the centre
  std::uint32_t cell = 0;    ///< slot of a cell that has the facet
  std::uint32_t next = 0;    ///< next ball of the facet, or kNone
  std::uint32_t serial = 0;  ///< of this use of the pool's entry; 0 when free
  std::uint8_t facet = 0;    ///< index of the facet in that cell
};

/// Entries are reused; a pair of index and serial names a ball for good.
class SurfaceBalls {
 public:
  std::uint32_t add(const SurfaceBall& ball) {
    std::uint32_t id;
    if (free_.empty()) {
      id = static_cast<std::uint32_t>(balls_.size());
      balls_.push_back(ball);
    } else {
      id = free_.back();
      free_.pop_back();
      balls_[id] = ball;
    }
    balls_[id].serial = ++last_serial_;
    return id;
  }
  void remove(std::uint32_t id) {
    balls_[id].serial = 0;
    free_.push_back(id);
  }
  const SurfaceBall& operator[](std::uint32_t id) const { return balls_[id]; }
  SurfaceBall& operator[](std::uint32_t id) { return balls_[id]; }
  bool alive(std::uint32_t id, std::uint32_t serial) const { return balls_[id].serial == serial; }

 private:
  std::vector<SurfaceBall> balls_;
  std::vector<std::uint32_t> free_;
  std::uint32_t last_serial_ = 0;
};

}  // namespace scantet::refine
