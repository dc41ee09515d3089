// What a place is to the items of one kind. Private to places/.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "scantet/base/mesh_topology.h"
#include "scantet/places/place_items.h"
#include "scantet/places/place_shapes.h"

namespace scantet {

/// The items of one kind, where they are, and what is in places; made anew for each kind.
class ItemPlaces {
 public:
  /// items: not PlaceItems::all.
  ItemPlaces(const TetMesh& mesh, PlaceItems items, const ScanTable& scans);

  /// One hit an item. text: of the place, for messages. Throws Error (usage.place).
  std::vector<Hit> hits(const Place& place, const std::string& text) const;

  const std::vector<Point>& points() const { return points_; }

 private:
  std::vector<Hit> joined(const Place& place, const std::string& text) const;
  std::vector<Hit> of_region(const Place& place, const std::string& text) const;
  std::vector<Hit> of_patch(const Place& place, const std::string& text) const;
  std::vector<Hit> of_curve(const Place& place, const std::string& text) const;
  std::vector<Hit> of_set(const Place& place, const std::string& text) const;
  std::vector<Hit> of_normal(const Place& place) const;
  std::vector<Hit> nearest(const Place& place) const;
  /// What is known of facets, told of the items: an item is in if one of its facets is.
  std::vector<Hit> from_facets(const std::vector<Hit>& of_facets) const;
  /// An item is in if all its vertices are (facets, elements), or one of an element's edges on a curve is.
  std::vector<Hit> from_vertices(const std::vector<std::uint8_t>& in, std::size_t least) const;

  const TetMesh& mesh_;
  PlaceItems items_;
  const ScanTable& scans_;
  std::vector<Point> points_;
};

/// Throws usage.empty_set with the nearest miss among the hits, none of which is in.
[[noreturn]] void refuse_empty_set(const NamedPlace& named, PlaceItems items, const std::vector<Hit>& hits,
                                   const std::vector<Point>& points);

}  // namespace scantet
