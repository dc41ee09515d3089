// The surface Delaunay balls of the restricted facets, in one pool.
#pragma once

#include <cassert>
#include <cstdint>
#include <optional>
#include <vector>

#include "scantet/base/large_pages.h"
#include "scantet/domain/domain.h"

namespace scantet::engine {

/// A ball centred where the dual edge of a facet meets ∂O, through the facet's vertices, empty of points (paper,
/// section 2). A facet whose dual edge meets ∂O several times has a chain of them.
struct SurfaceBall {
  Point center;
  double radius = 0;             ///< mm
  Patch patch;                   ///< of ∂O, that the centre lies on
  std::uint32_t facet = 0;       ///< code of the facet, as a cell that has it sees it
  std::uint32_t next = 0;        ///< next ball of the facet, or kNone
  std::uint32_t generation = 0;  ///< of the use of this entry; odd while in use
};

/// All balls. Entries are reused, so an index together with a generation names a ball for good.
class SurfaceBalls {
 public:
  std::size_t slots() const { return balls_.size(); }
  const SurfaceBall& operator[](std::uint32_t id) const { return balls_[id]; }
  SurfaceBall& operator[](std::uint32_t id) { return balls_[id]; }
  /// Makes room for so many entries, which are to be added, and for those that follow them.
  void reserve(std::size_t count) { balls_.reserve(kRoomAhead * count); }
  /// Adds so many entries at the end, each to be set before it is used. Return: the first.
  std::uint32_t append(std::size_t count) {
    balls_.resize(balls_.size() + count);
    return static_cast<std::uint32_t>(balls_.size() - count);
  }
  bool alive(std::uint32_t id, std::uint32_t generation) const { return balls_[id].generation == generation; }

 private:
  friend class BallStock;
  LargeVector<SurfaceBall> balls_;
  std::vector<std::uint32_t> free_;
};

/// The entries that one editor may use.
class BallStock {
 public:
  /// Takes entries from the pool, which grows as needed: no other stock may be in use.
  explicit BallStock(SurfaceBalls& pool) : pool_(pool), grows_(true) {}
  /// Has `count` free entries, and those that are removed through it.
  BallStock(SurfaceBalls& pool, std::size_t count) : pool_(pool), grows_(false) {
    while (free_.size() < count) free_.push_back(from_pool());
  }
  void retire() {
    pool_.free_.insert(pool_.free_.end(), free_.rbegin(), free_.rend());
    free_.clear();
    grows_ = true;
  }

  bool has_room_for(std::size_t count) const { return grows_ || free_.size() >= count; }
  /// Pre: has_room_for(1).
  std::uint32_t add(const SurfaceBall& ball) {
    assert(has_room_for(1));
    std::uint32_t id = 0;
    if (grows_) {
      id = from_pool();
    } else {
      id = free_.back();
      free_.pop_back();
    }
    const std::uint32_t generation = pool_.balls_[id].generation;
    assert(generation % 2 == 0);
    pool_.balls_[id] = ball;
    pool_.balls_[id].generation = generation + 1;
    return id;
  }
  void remove(std::uint32_t id) {
    assert(pool_.balls_[id].generation % 2 == 1);
    ++pool_.balls_[id].generation;
    (grows_ ? pool_.free_ : free_).push_back(id);
  }

 private:
  std::uint32_t from_pool() {
    if (pool_.free_.empty()) {
      pool_.balls_.push_back({});
      return static_cast<std::uint32_t>(pool_.balls_.size() - 1);
    }
    const std::uint32_t id = pool_.free_.back();
    pool_.free_.pop_back();
    return id;
  }

  SurfaceBalls& pool_;
  bool grows_;
  std::vector<std::uint32_t> free_;
};

}  // namespace scantet::engine
