// Nodes are visited in the order of their distance from the piece, in steps. The piece is closed but for its channels:
// the search fills it and leaves it through these, so that few nodes beyond are visited. At the narrowest places of a
// channel the domain often gives a hint of size. The places of hints are nodes, too, and carry the search through where
// the grid would be too coarse.
#include <algorithm>
#include <cassert>
#include <cmath>

#include "scantet/base/coordinate_hash.h"
#include "scantet/base/neighbors.h"
#include "scantet/surface/boundary_around_impl.h"
#include "scantet/surface/channel_search_impl.h"

namespace scantet::engine {
namespace {

constexpr std::size_t kMostNodes = 400'000;  // a few seconds

}  // namespace

std::size_t ChannelSearch::HashOfKey::operator()(const Key& key) const {
  const auto bits = [](std::int64_t x) { return static_cast<std::uint64_t>(x); };
  return hash_of_words({bits(key[0]), bits(key[1]), bits(key[2])});
}

ChannelSearch::ChannelSearch(const Domain& domain, RestrictedTriangulation& triangulation, Pieces& pieces,
                             const std::vector<Point>& hints)
    : domain_(domain), t_(triangulation.triangulation()), inserter_(t_), pieces_(pieces), hints_(hints) {}

std::vector<SamplePoint> ChannelSearch::points(const std::vector<FacetCode>& facets, double first_mm, double last_mm) {
  assert(!facets.empty() && first_mm > 0 && last_mm > 0);
  points_.clear();
  piece_ = pieces_.of(facets.front() / 4);
  side_ = t_.info(facets.front() / 4).region;
  bool found = false;
  for (step_mm_ = first_mm; step_mm_ >= last_mm && !found; step_mm_ /= 2) found = find_way(facets);
  if (!found) return {};
  for (auto i = static_cast<std::uint32_t>(nodes_.size() - 1); i != kNone; i = nodes_[i].from) {
    if (pieces_.of(nodes_[i].cell) == piece_) break;
    sample_around(nodes_[i]);
  }
  return std::move(points_);
}

ChannelSearch::Key ChannelSearch::key_of(const Point& p) const {
  return {std::llround(p.x / step_mm_), std::llround(p.y / step_mm_), std::llround(p.z / step_mm_)};
}

/// Searches the whole way. Returns whether the last node is in another piece of the side.
bool ChannelSearch::find_way(const std::vector<FacetCode>& facets) {
  nodes_.clear();
  known_.clear();
  places_.clear();
  for (const Point& p : hints_) places_[key_of(p)].push_back(p);
  for (const FacetCode facet : facets) {
    const Point& center = t_.cell(facet / 4).circumcentre;
    if (!domain_.bounds().contains(center) || domain_.region_at(center) != side_) continue;
    if (reach_around(center, kNone, facet / 4)) return true;
  }
  for (std::uint32_t i = 0; i < nodes_.size() && nodes_.size() < kMostNodes; ++i) {
    const Node node = nodes_[i];
    if (reach_around(node.place, i, node.cell)) return true;
  }
  return false;
}

/// Makes nodes of the places around that can be reached. Returns whether the last one is in another piece of the side.
bool ChannelSearch::reach_around(const Point& from, std::uint32_t parent, CellId near) {
  const Key center = key_of(from);
  for (const NeighborOffset& offset : kNeighborhood) {
    const Key key{center[0] + offset[0], center[1] + offset[1], center[2] + offset[2]};
    std::vector<Point>& places = places_[key];
    if (known_.insert(key).second) {
      places.push_back({step_mm_ * static_cast<double>(key[0]), step_mm_ * static_cast<double>(key[1]),
                        step_mm_ * static_cast<double>(key[2])});
    }
    if (reach(from, parent, near, places)) return true;
  }
  return false;
}

/// Makes nodes of those of these places that can be reached, and returns the same.
bool ChannelSearch::reach(const Point& from, std::uint32_t parent, CellId near, std::vector<Point>& places) {
  for (std::size_t i = 0; i < places.size();) {
    domain_.crossings({from, places[i]}, crossings_);
    if (!crossings_.empty()) {
      ++i;
      continue;
    }
    const CellId cell = inserter_.cell_at(places[i], near);
    nodes_.push_back({places[i], parent, cell});
    places.erase(places.begin() + static_cast<std::ptrdiff_t>(i));
    if (t_.info(cell).region == side_ && pieces_.of(cell) != piece_) return true;
  }
  return false;
}

/// The nearest boundary points around a node, but for those close to a vertex.
void ChannelSearch::sample_around(const Node& node) {
  const BoundaryAround around = boundary_around(domain_, node.place, kNeighborDirections, domain_.bounds().diagonal());
  for (const Point& p : around.points) {
    const auto is_near = [&](const Point& q) { return distance(p, q) < around.apart_mm; };
    const std::array<Point, 4> corners = t_.points_of(inserter_.cell_at(p, node.cell));
    if (std::any_of(corners.begin(), corners.end(), is_near)) continue;
    if (std::any_of(points_.begin(), points_.end(), [&](const SamplePoint& q) { return is_near(q.point); })) continue;
    points_.push_back({p, 2});
  }
}

}  // namespace scantet::engine
