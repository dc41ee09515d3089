// Private: of which vertices it is known that the boundary facets around them form a disk.
#pragma once

#include <cassert>
#include <utility>
#include <vector>

#include "scantet/delaunay/triangulation_impl.h"

namespace scantet::engine {

/// Notes on each vertex. Threads may work on different vertices at the same time.
class DiskNotes {
 public:
  /// Makes room for the notes on so many vertex slots; nothing is known of the new ones.
  void grow(PointId vertex_slots) {
    if (vertex_slots > notes_.size()) notes_.resize(vertex_slots);
  }

  /// Whether the boundary facets of v are known to form a disk.
  bool has_disk(PointId v) const {
    assert(v < notes_.size());
    return notes_[v].has_disk;
  }
  void set_disk(PointId v, bool has_disk) {
    assert(v < notes_.size());
    notes_[v].has_disk = has_disk;
  }

  /// Notes that nothing is known of v, and that it is to be asked of; returns whether that is news.
  bool question(PointId v) {
    assert(v < notes_.size());
    notes_[v].has_disk = false;
    return !std::exchange(notes_[v].in_question, true);
  }
  /// Notes that v has been asked of.
  void take(PointId v) { notes_[v].in_question = false; }

  /// Notes whether the facets of v have changed; returns whether that is news.
  bool set_changed(PointId v, bool has_changed) {
    return std::exchange(notes_[v].has_changed, has_changed) != has_changed;
  }

 private:
  struct Notes {
    bool has_disk = false;
    bool in_question = false;
    bool has_changed = false;
  };
  std::vector<Notes> notes_;
};

}  // namespace scantet::engine
