// Each tet is asked which nodes of the grid lie in it, row by row: a row crosses it along one stretch, between the four
// planes of its faces. What is within rounding of a face counts for the tets on both sides; a node of kOutside that is
// on a face lies outside if that is a face between a tet and the outside, else it is buried in the mesh.
#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>

#include "scantet/check/facet_tree_impl.h"
#include "scantet/check/grid_nodes_impl.h"

namespace scantet::auditing {

void NodeBits::set(std::size_t node) {
  std::atomic_ref<std::uint64_t>(words_[node / 64]).fetch_or(std::uint64_t{1} << node % 64, std::memory_order_relaxed);
}

void NodeBits::clear(std::size_t node) {
  std::atomic_ref<std::uint64_t>(words_[node / 64])
      .fetch_and(~(std::uint64_t{1} << node % 64), std::memory_order_relaxed);
}

void Meetings::add(const Key& key, const Meeting& meeting) {
  if (last_ == nullptr || last_->first != key) last_ = &*meetings_.emplace(key, Meeting{meeting.first_node, 0}).first;
  Meeting& known = last_->second;
  known = {std::min(known.first_node, meeting.first_node), known.nodes + meeting.nodes};
}

void Meetings::add(const Meetings& others) {
  for (const auto& [key, meeting] : others.meetings_) add(key, meeting);
}

/// Unit normals inward, and where they are 0.
struct GridNodes::Planes {
  std::array<Vec, 4> normals;
  std::array<double, 4> offsets{};

  /// Return: false for a tet without a volume.
  bool set(const std::array<Vec, 4>& p) {
    for (std::size_t n = 0; n < 4; ++n) {
      const Vec& a = p[(n + 1) % 4];
      Vec normal = cross(p[(n + 2) % 4] - a, p[(n + 3) % 4] - a);
      const double size = length(normal);
      if (!(size > 0)) return false;
      normal = (1 / size) * normal;
      if (dot(normal, p[n] - a) < 0) normal = -1.0 * normal;
      normals[n] = normal;
      offsets[n] = -dot(normal, a);
    }
    return true;
  }

  /// How far within the tet a point is.
  double depth(const Vec& p) const {
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t n = 0; n < 4; ++n) least = std::min(least, dot(normals[n], p) + offsets[n]);
    return least;
  }
};

GridNodes::GridNodes(const TetMesh& mesh, const RegionGrid& grid, const GridParts& parts)
    : mesh_(mesh),
      grid_(grid),
      parts_(parts),
      rows_(grid.runs, grid.size),
      found_(extent(0) * extent(1) * extent(2)),
      touched_(extent(0) * extent(1) * extent(2)),
      buried_(0) {}

template <class Meet>
void GridNodes::mark_row(const Planes& planes, std::array<int, 2> ends, std::array<int, 2> row, Region region,
                         const Meet& meet) {
  const auto [j, k] = row;
  const std::size_t at = rows_.row(j, k);
  std::size_t run = rows_.begin(at);
  for (int i = ends[0]; i <= ends[1]; ++i) {
    const double depth = planes.depth({double(i), double(j), double(k)});
    if (depth < -kNodeRounding) continue;
    while (run < rows_.end(at) && grid_.runs[run].end <= i) ++run;
    if (run == rows_.end(at) || grid_.runs[run].begin > i) {
      (depth > kNodeRounding ? found_ : touched_).set(node(i, at));
    } else if (grid_.parts[grid_.runs[run].part].region == region) {
      found_.set(node(i, at));
      meet(parts_.joined[run], node(i, at));
    }
  }
}

/// meet(set, node): is called for each node that is in the tet, of its region.
template <class Meet>
void GridNodes::mark_tet(std::size_t tet, const Meet& meet) {
  std::array<Vec, 4> p;
  for (std::size_t n = 0; n < 4; ++n) p[n] = grid_.frame.to_index(mesh_.vertices[mesh_.tets[tet][n]]);
  Planes planes;
  if (!planes.set(p)) return;
  Box box;
  for (const Vec& corner : p) box.extend(corner);
  const std::array<int, 2> ends = nodes_in(box, 0);
  const auto [first_j, last_j] = nodes_in(box, 1);
  const auto [first_k, last_k] = nodes_in(box, 2);
  for (int k = first_k; k <= last_k; ++k) {
    for (int j = first_j; j <= last_j; ++j) {
      mark_row(planes, ends, {j, k}, mesh_.tet_regions[tet], meet);
    }
  }
}

Meetings GridNodes::find(const FaceMatch& match, const std::vector<std::uint32_t>& component_of) {
  constexpr std::size_t kPiece = 4096;
  std::vector<Meetings> pieces((mesh_.tets.size() + kPiece - 1) / kPiece);
  parallel_for(mesh_.tets.size(), kPiece, [&](std::size_t begin, std::size_t end) {
    for (std::size_t t = begin; t < end; ++t) {
      const std::uint32_t component = component_of[t];
      mark_tet(t, [&](std::uint32_t set, std::size_t node) {
        if (component != kNone) pieces[begin / kPiece].add({set, component}, node);
      });
    }
  });
  buried_ = touched_;
  parallel_for(match.boundary.size(), kPiece, [&](std::size_t begin, std::size_t end) {
    for (std::size_t f = begin; f < end; ++f) {
      if (match.boundary[f].front == kNone) clear_face(match.boundary[f]);
    }
  });
  Meetings meetings;
  for (const Meetings& piece : pieces) meetings.add(piece);
  return meetings;
}

std::map<Meetings::Key, std::vector<std::size_t>> GridNodes::nodes_of(const std::set<Meetings::Key>& keys,
                                                                      const std::vector<std::uint32_t>& component_of) {
  std::set<std::uint32_t> components;
  for (const auto& [set, component] : keys) components.insert(component);
  std::map<Meetings::Key, std::vector<std::size_t>> found;
  for (std::size_t t = 0; t < component_of.size(); ++t) {
    if (components.count(component_of[t]) == 0) continue;
    mark_tet(t, [&](std::uint32_t set, std::size_t node) {
      const Meetings::Key key{set, component_of[t]};
      if (keys.count(key) != 0) found[key].push_back(node);
    });
  }
  for (auto& [key, nodes] : found) {
    std::sort(nodes.begin(), nodes.end());
    nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  }
  return found;
}

std::optional<std::size_t> GridNodes::run_of(std::size_t node) const {
  return rows_.find(static_cast<int>(node % extent(0)), node / extent(0));
}

std::uint32_t GridNodes::set_of(std::size_t node) const {
  const std::optional<std::size_t> run = run_of(node);
  return run ? parts_.joined[*run] : kNone;
}

Region GridNodes::region_of(std::size_t node) const {
  const std::optional<std::size_t> run = run_of(node);
  return run ? grid_.parts[grid_.runs[*run].part].region : kOutside;
}

bool GridNodes::is_kept(int i, int j, int k, Region region) const {
  const std::size_t at = node(i, rows_.row(j, k));
  return region != kOutside ? found_.test(at) : !found_.test(at) && !buried_.test(at);
}

bool GridNodes::is_clearly_outside(int i, int j, int k) const {
  const std::size_t at = node(i, rows_.row(j, k));
  return !found_.test(at) && !touched_.test(at);
}

std::array<int, 2> GridNodes::nodes_in(const Box& box, int axis) const {
  return {std::max(0, static_cast<int>(std::ceil(box.min[axis] - kNodeRounding))),
          std::min(grid_.size[static_cast<std::size_t>(axis)] - 1,
                   static_cast<int>(std::floor(box.max[axis] + kNodeRounding)))};
}

void GridNodes::clear_face(const BoundaryFace& face) {
  FacetCorners corners;
  Box box;
  for (std::size_t n = 0; n < 3; ++n) {
    corners[n] = grid_.frame.to_index(mesh_.vertices[face.vertices[n]]);
    box.extend(corners[n]);
  }
  const auto [first_i, last_i] = nodes_in(box, 0);
  const auto [first_j, last_j] = nodes_in(box, 1);
  const auto [first_k, last_k] = nodes_in(box, 2);
  for (int k = first_k; k <= last_k; ++k) {
    for (int j = first_j; j <= last_j; ++j) {
      for (int i = first_i; i <= last_i; ++i) {
        const std::size_t at = node(i, rows_.row(j, k));
        const Vec p{double(i), double(j), double(k)};
        if (touched_.test(at) && distance(p, nearest_on_triangle(p, corners)) <= kNodeRounding) buried_.clear(at);
      }
    }
  }
}

std::uint64_t count_nodes(const GridNodes& nodes, const RegionGrid& grid, const GridRun& run, KeptRegion& region) {
  std::uint64_t kept = 0;
  for (int i = run.begin; i < run.end; ++i) {
    if (nodes.is_kept(i, run.j, run.k, region.grid.region)) {
      ++kept;
    } else if (region.lost.size() < kMostLostNodes) {
      region.lost.push_back(world_place(grid, {i, run.j, run.k}));
    }
  }
  region.kept += kept;
  return kept;
}

std::string counted_voxels(std::uint64_t nodes) {
  return std::to_string(nodes) + (nodes == 1 ? " voxel" : " voxels");
}

}  // namespace scantet::auditing
