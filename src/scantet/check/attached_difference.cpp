// Paired tets say which vertices are alike: corners at the same place, and the nodes on edges between such. So doubled
// vertices find their like, too. Members of sets are compared by the numbers that the first mesh has for them.
#include "scantet/check/attached_difference.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "scantet/base/element_nodes.h"

namespace scantet {
namespace {

constexpr VertexId kNone = std::numeric_limits<VertexId>::max();

bool are_numbered_alike(const TetMesh& first, const TetMesh& second, double tolerance_mm) {
  if (first.tets != second.tets || first.tet_regions != second.tet_regions) return false;
  return std::all_of(first.tets.begin(), first.tets.end(), [&](const Tet& tet) {
    return std::all_of(tet.begin(), tet.end(),
                       [&](VertexId v) { return distance(first.vertices[v], second.vertices[v]) <= tolerance_mm; });
  });
}

// What of the second mesh is what of the first.
class Pairing {
 public:
  Pairing(const TetMesh& first, const TetMesh& second, std::vector<std::uint32_t> tets, bool by_number)
      : first_(first), second_(second), by_number_(by_number), tets_(std::move(tets)) {
    vertices_.assign(second.vertices.size(), kNone);
    std::vector<VertexId> back(first.vertices.size(), kNone);
    is_one_to_one_ = first.vertices.size() == second.vertices.size();
    for_each_node([&](VertexId a, VertexId b, bool) {
      is_one_to_one_ &= (vertices_[b] == kNone || vertices_[b] == a) && (back[a] == kNone || back[a] == b);
      vertices_[b] = a;
      back[a] = b;
    });
    is_one_to_one_ &= std::find(vertices_.begin(), vertices_.end(), kNone) == vertices_.end();
  }

  bool is_one_to_one() const { return is_one_to_one_; }
  std::uint32_t tet(std::uint32_t of_second) const { return tets_[of_second]; }
  VertexId vertex(VertexId of_second) const { return vertices_[of_second]; }

  EdgeNodeDifference edge_nodes() const {
    EdgeNodeDifference found;
    for_each_node([&](VertexId a, VertexId b, bool on_edge) {
      if (!on_edge) return;
      const std::array<Point, 2> places{first_.vertices[a], second_.vertices[b]};
      const double apart_mm = distance(places[0], places[1]);
      if (apart_mm > found.largest_mm) found = {apart_mm, places};
    });
    return found;
  }

 private:
  // The corner of the first mesh's tet that each corner of the second's is.
  std::array<std::size_t, 4> corners_of(const Tet& a, const Tet& b) const {
    std::array<std::size_t, 4> corners{0, 1, 2, 3};
    if (by_number_) return corners;
    for (std::size_t k = 0; k < 4; ++k) {
      const auto is_it = [&](std::size_t c) { return first_.vertices[a[c]] == second_.vertices[b[k]]; };
      const auto found = std::find_if(corners.begin() + static_cast<std::ptrdiff_t>(k), corners.end(), is_it);
      if (found != corners.end()) std::swap(corners[k], *found);
    }
    return corners;
  }

  // Calls visit(vertex of the first mesh, vertex of the second, whether they are on an edge), once for each tet of
  // theirs.
  template <class Visit>
  void for_each_node(const Visit& visit) const {
    const bool with_edges = is_second_order(first_) && is_second_order(second_);
    std::size_t edge_between[4][4] = {};
    for (std::size_t e = 0; e < 6; ++e) {
      edge_between[kEdgesOfNodes[e][0]][kEdgesOfNodes[e][1]] = e;
      edge_between[kEdgesOfNodes[e][1]][kEdgesOfNodes[e][0]] = e;
    }
    for (std::size_t j = 0; j < tets_.size(); ++j) {
      const std::size_t i = tets_[j];
      const std::array<std::size_t, 4> corners = corners_of(first_.tets[i], second_.tets[j]);
      for (std::size_t k = 0; k < 4; ++k) visit(first_.tets[i][corners[k]], second_.tets[j][k], false);
      for (std::size_t e = 0; with_edges && e < 6; ++e) {
        const std::size_t like = edge_between[corners[kEdgesOfNodes[e][0]]][corners[kEdgesOfNodes[e][1]]];
        visit(first_.tet_edge_vertices[i][like], second_.tet_edge_vertices[j][e], true);
      }
    }
  }

  const TetMesh& first_;
  const TetMesh& second_;
  bool by_number_;
  bool is_one_to_one_ = true;
  std::vector<std::uint32_t> tets_;
  std::vector<VertexId> vertices_;
};

template <class Ids>
Point centroid(const TetMesh& mesh, const Ids& vertices) {
  Point sum{};
  for (const VertexId v : vertices) sum = sum + mesh.vertices[v];
  return (1 / static_cast<double>(vertices.size())) * sum;
}

Triangle ascending(Triangle t) {
  std::sort(t.begin(), t.end());
  return t;
}

// One kind of one set. Keys are what members are in the first mesh, place_of says where such a key is.
template <class Key, class PlaceOf>
void compare_members(SetDifference found, std::vector<Key> a, std::vector<Key> b, const PlaceOf& place_of,
                     std::vector<SetDifference>& sets) {
  if (a.empty() && b.empty()) return;
  found.members = {a.size(), b.size()};
  if (found.alone) {
    std::sort(a.begin(), a.end());
    std::sort(b.begin(), b.end());
    std::vector<Key> a_alone;
    std::vector<Key> b_alone;
    std::set_difference(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(a_alone));
    std::set_difference(b.begin(), b.end(), a.begin(), a.end(), std::back_inserter(b_alone));
    found.alone = {a_alone.size(), b_alone.size()};
    for (const auto* alone : {&b_alone, &a_alone}) {
      if (!alone->empty()) found.place = place_of(alone->front());
    }
  }
  sets.push_back(std::move(found));
}

// pairing: null if tets are not paired.
void compare_set(const TetMesh& first, const TetMesh& second, const MeshSet& a, const MeshSet& b,
                 const Pairing* pairing, std::vector<SetDifference>& sets) {
  const auto kind = [&](const char* of, bool by_members) {
    SetDifference found{a.name, of, {}, {}, {}};
    if (by_members) found.alone = {0, 0};
    return found;
  };
  const bool has_vertices = pairing != nullptr && pairing->is_one_to_one();
  std::vector<VertexId> vertices = b.vertices;
  for (VertexId& v : vertices) v = has_vertices ? pairing->vertex(v) : v;
  compare_members(
      kind("vertices", has_vertices), a.vertices, vertices, [&](VertexId v) { return first.vertices[v]; }, sets);

  std::vector<Triangle> facets_a;
  std::vector<Triangle> facets_b;
  for (const std::uint32_t f : a.facets) facets_a.push_back(ascending(first.boundary_facets[f]));
  for (const std::uint32_t f : b.facets) {
    Triangle corners = second.boundary_facets[f];
    for (VertexId& v : corners) v = has_vertices ? pairing->vertex(v) : v;
    facets_b.push_back(ascending(corners));
  }
  compare_members(
      kind("facets", has_vertices), std::move(facets_a), std::move(facets_b),
      [&](const Triangle& t) { return centroid(first, t); }, sets);

  std::vector<std::uint32_t> tets = b.tets;
  for (std::uint32_t& t : tets) t = pairing != nullptr ? pairing->tet(t) : t;
  compare_members(
      kind("tets", pairing != nullptr), a.tets, tets, [&](std::uint32_t t) { return centroid(first, first.tets[t]); },
      sets);
}

double apart(double a, double b) {
  if (a == b || (std::isnan(a) && std::isnan(b))) return 0;
  const double off = std::abs(b - a);
  return std::isfinite(off) ? off : std::numeric_limits<double>::infinity();
}

FieldDifference compare_field(const TetMesh& first, const MeshField& a, const MeshField& b, const Pairing& pairing) {
  FieldDifference found{a.name, 0, 0, {}, {}};
  for (std::uint32_t j = 0; j < b.values.size(); ++j) {
    const std::uint32_t i = pairing.tet(j);
    const std::array<double, 2> values{a.values[i], b.values[j]};
    for (const double value : values) {
      if (std::isfinite(value)) found.scale = std::max(found.scale, std::abs(value));
    }
    const double off = apart(values[0], values[1]);
    if (off <= found.largest) continue;
    found.largest = off;
    found.place = centroid(first, first.tets[i]);
    found.values = values;
  }
  return found;
}

template <class Named>
const Named* named(const std::vector<Named>& all, const std::string& name) {
  const auto found = std::find_if(all.begin(), all.end(), [&](const Named& one) { return one.name == name; });
  return found == all.end() ? nullptr : &*found;
}

}  // namespace

AttachedDifference compare_attached(const TetMesh& first, const TetMesh& second,
                                    const std::vector<std::uint32_t>& pairs, double tolerance_mm) {
  AttachedDifference difference;
  std::optional<Pairing> pairing;
  if (!pairs.empty()) {
    pairing.emplace(first, second, pairs, false);
  } else if (are_numbered_alike(first, second, tolerance_mm)) {
    std::vector<std::uint32_t> all(first.tets.size());
    std::iota(all.begin(), all.end(), 0U);
    pairing.emplace(first, second, std::move(all), true);
  }
  difference.is_paired = pairing.has_value();
  const bool has_edges = is_second_order(first);
  if (pairing && has_edges == is_second_order(second)) {
    difference.is_one_to_one = pairing->is_one_to_one();
    if (has_edges) difference.edge_nodes = pairing->edge_nodes();
  }
  for (const MeshSet& set : first.sets) {
    const MeshSet* other = named(second.sets, set.name);
    if (other != nullptr) compare_set(first, second, set, *other, pairing ? &*pairing : nullptr, difference.sets);
  }
  for (const MeshField& field : first.fields) {
    const MeshField* other = named(second.fields, field.name);
    if (other != nullptr && pairing) difference.fields.push_back(compare_field(first, field, *other, *pairing));
  }
  return difference;
}

}  // namespace scantet
