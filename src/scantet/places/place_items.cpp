// Each place gives one hit an item; joined places join these. What belongs to facets (patches, normals) is found for
// all facets first, and told of the nodes and elements that have one.
#include "scantet/places/place_items.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "scantet/base/error.h"
#include "scantet/base/options.h"
#include "scantet/places/place_items_impl.h"

namespace scantet {
namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();

Hit sure(bool is_in) {
  return {kNever, is_in, Hit::Unit::mm};
}

template <std::size_t N>
std::vector<Point> centres(const TetMesh& mesh, const std::vector<std::array<VertexId, N>>& elements) {
  std::vector<Point> points;
  points.reserve(elements.size());
  for (const auto& element : elements) {
    Point sum;
    for (const VertexId v : element) sum = sum + mesh.vertices[v];
    points.push_back((1.0 / N) * sum);
  }
  return points;
}

[[noreturn]] void refuse_name(const char* what, const std::string& name, std::vector<std::string> known,
                              const std::string& text) {
  const auto meant = closest_name(name, known);
  std::string list;
  constexpr std::size_t kMost = 20;
  for (std::size_t i = 0; i < known.size() && i < kMost; ++i) list += (i == 0 ? "" : ", ") + known[i];
  if (known.size() > kMost) list += " and more";
  throw Error(Fault::usage, "usage.place",
              "--set: \"" + text + "\": the mesh has no " + what + " called \"" + name + "\"",
              meant           ? "did you mean " + *meant + "?"
              : known.empty() ? std::string("it has none with a name")
                              : "it has " + list);
}

std::vector<std::uint32_t> members(const std::vector<Hit>& hits) {
  std::vector<std::uint32_t> found;
  for (std::size_t i = 0; i < hits.size(); ++i) {
    if (hits[i].is_in) found.push_back(static_cast<std::uint32_t>(i));
  }
  return found;
}

}  // namespace

ItemPlaces::ItemPlaces(const TetMesh& mesh, PlaceItems items, const ScanTable& scans)
    : mesh_(mesh), items_(items), scans_(scans) {
  points_ = items == PlaceItems::nodes    ? mesh.vertices
            : items == PlaceItems::facets ? centres(mesh, mesh.boundary_facets)
                                          : centres(mesh, mesh.tets);
}

std::vector<Hit> ItemPlaces::hits(const Place& place, const std::string& text) const {
  switch (place.kind) {
    case Place::Kind::all_of:
    case Place::Kind::any_of:
    case Place::Kind::not_in:
      return joined(place, text);
    case Place::Kind::region:
      return of_region(place, text);
    case Place::Kind::patch:
    case Place::Kind::border:
      return of_patch(place, text);
    case Place::Kind::curve:
      return of_curve(place, text);
    case Place::Kind::set:
      return of_set(place, text);
    case Place::Kind::normal:
      return of_normal(place);
    case Place::Kind::nearest:
      return nearest(place);
    default:
      break;
  }
  std::vector<Hit> hits;
  hits.reserve(points_.size());
  for (const Point& p : points_) hits.push_back(hit_of_shape(place, scans_, p));
  return hits;
}

std::vector<Hit> ItemPlaces::joined(const Place& place, const std::string& text) const {
  std::vector<Hit> all = hits(place.parts.front(), text);
  if (place.kind == Place::Kind::not_in) {
    for (Hit& hit : all) hit = hit_of_complement(hit);
    return all;
  }
  const auto join = place.kind == Place::Kind::all_of ? hit_of_both : hit_of_either;
  for (std::size_t part = 1; part < place.parts.size(); ++part) {
    const std::vector<Hit> more = hits(place.parts[part], text);
    for (std::size_t i = 0; i < all.size(); ++i) all[i] = join(all[i], more[i]);
  }
  return all;
}

std::vector<Hit> ItemPlaces::from_facets(const std::vector<Hit>& of_facets) const {
  if (items_ == PlaceItems::facets) return of_facets;
  std::vector<Hit> hits(points_.size(), sure(false));
  const auto take = [&](std::size_t item, const Hit& hit) { hits[item] = hit_of_either(hits[item], hit); };
  if (items_ == PlaceItems::nodes) {
    for (std::size_t f = 0; f < of_facets.size(); ++f) {
      for (const VertexId v : mesh_.boundary_facets[f]) take(v, of_facets[f]);
    }
    return hits;
  }
  const std::vector<TetFace> behind = faces_behind_facets(mesh_);
  const std::vector<TetFace> before = faces_before_facets(mesh_);
  constexpr std::uint8_t kNone = 4;
  for (std::size_t f = 0; f < of_facets.size(); ++f) {
    take(behind[f].tet, of_facets[f]);
    if (before[f].face != kNone) take(before[f].tet, of_facets[f]);
  }
  return hits;
}

std::vector<Hit> ItemPlaces::from_vertices(const std::vector<std::uint8_t>& in, std::size_t least) const {
  std::vector<Hit> hits;
  hits.reserve(points_.size());
  const auto count = [&](const auto& vertices) {
    return static_cast<std::size_t>(
        std::count_if(vertices.begin(), vertices.end(), [&](VertexId v) { return in[v] != 0; }));
  };
  for (std::size_t i = 0; i < points_.size(); ++i) {
    if (items_ == PlaceItems::nodes) hits.push_back(sure(in[i] != 0));
    if (items_ == PlaceItems::facets) hits.push_back(sure(count(mesh_.boundary_facets[i]) >= least));
    if (items_ == PlaceItems::elements) hits.push_back(sure(count(mesh_.tets[i]) >= least));
  }
  return hits;
}

std::vector<Hit> ItemPlaces::of_region(const Place& place, const std::string& text) const {
  std::vector<Region> known = mesh_.tet_regions;
  std::sort(known.begin(), known.end());
  known.erase(std::unique(known.begin(), known.end()), known.end());
  std::vector<std::string> names;
  std::vector<Region> found;
  for (const Region region : known) {
    names.push_back(region_name(mesh_, region));
    if (names.back() == place.name || std::to_string(region) == place.name) found.push_back(region);
  }
  if (found.empty()) refuse_name("region", place.name, names, text);
  const Region region = found.front();
  std::vector<Hit> hits(points_.size(), sure(false));
  for (std::size_t t = 0; t < mesh_.tets.size() && items_ != PlaceItems::facets; ++t) {
    if (mesh_.tet_regions[t] != region) continue;
    if (items_ == PlaceItems::elements) hits[t] = sure(true);
    for (std::size_t i = 0; i < 4 && items_ == PlaceItems::nodes; ++i) hits[mesh_.tets[t][i]] = sure(true);
  }
  for (std::size_t f = 0; f < points_.size() && items_ == PlaceItems::facets; ++f) {
    hits[f] = sure(mesh_.facet_regions[f][0] == region || mesh_.facet_regions[f][1] == region);
  }
  return hits;
}

std::vector<Hit> ItemPlaces::of_patch(const Place& place, const std::string& text) const {
  const bool is_border = place.kind == Place::Kind::border;
  const std::string wanted = is_border ? "border_" + place.name : place.name;
  std::vector<std::string> names;
  std::vector<std::uint8_t> in;
  for (const MeshPatch& patch : mesh_.patches) {
    names.push_back(patch_name(patch));
    in.push_back(names.back() == wanted || (is_border && names.back().starts_with(wanted + "_")) ? 1 : 0);
  }
  if (std::find(in.begin(), in.end(), 1) == in.end()) {
    if (!is_border) refuse_name("patch", wanted, names, text);
    throw Error(Fault::usage, "usage.place",
                "--set: \"" + text + "\": the object does not end flat at the " + place.name + " border of the scan",
                "ask for flat ends with --border cap, or write a half-space");
  }
  std::vector<Hit> of_facets;
  of_facets.reserve(mesh_.facet_patches.size());
  for (const std::uint32_t patch : mesh_.facet_patches) of_facets.push_back(sure(in[patch] != 0));
  return from_facets(of_facets);
}

std::vector<Hit> ItemPlaces::of_curve(const Place& place, const std::string& text) const {
  std::vector<std::string> names;
  for (const MeshCurve& curve : mesh_.curves) names.push_back(curve_name(curve));
  std::vector<std::uint8_t> in(mesh_.vertices.size(), 0);
  bool is_known = false;
  for (std::size_t e = 0; e < mesh_.curve_edges.size(); ++e) {
    if (!place.name.empty() && names[mesh_.edge_curves[e]] != place.name) continue;
    is_known = true;
    for (const VertexId v : mesh_.curve_edges[e]) in[v] = 1;
  }
  if (!is_known) refuse_name("curve", place.name, names, text);
  return from_vertices(in, 2);
}

std::vector<Hit> ItemPlaces::of_set(const Place& place, const std::string& text) const {
  std::vector<std::string> names;
  for (const MeshSet& set : mesh_.sets) {
    names.push_back(set.name);
    if (set.name != place.name) continue;
    std::vector<Hit> hits(points_.size(), sure(false));
    const auto& indices = items_ == PlaceItems::nodes    ? set.vertices
                          : items_ == PlaceItems::facets ? set.facets
                                                         : set.tets;
    for (const std::uint32_t i : indices) hits[i] = sure(true);
    return hits;
  }
  refuse_name("set before this one", place.name, names, text);
}

std::vector<Hit> ItemPlaces::of_normal(const Place& place) const {
  const std::vector<double>& n = place.numbers;
  const Vec direction = (1 / length(Vec{n[0], n[1], n[2]})) * Vec{n[0], n[1], n[2]};
  std::vector<Hit> of_facets;
  of_facets.reserve(mesh_.boundary_facets.size());
  for (const Triangle& facet : mesh_.boundary_facets) {
    const Point& a = mesh_.vertices[facet[0]];
    const Vec normal = cross(mesh_.vertices[facet[1]] - a, mesh_.vertices[facet[2]] - a);
    constexpr double kDegrees = 57.29577951308232;
    const double angle = kDegrees * std::atan2(length(cross(normal, direction)), dot(normal, direction));
    of_facets.push_back({std::abs(angle - n[3]), angle <= n[3], Hit::Unit::degrees});
  }
  return from_facets(of_facets);
}

std::vector<Hit> ItemPlaces::nearest(const Place& place) const {
  const Point to{place.numbers[1], place.numbers[2], place.numbers[3]};
  std::vector<std::uint32_t> order(points_.size());
  std::iota(order.begin(), order.end(), 0U);
  const auto count = static_cast<std::size_t>(std::min(place.numbers[0], static_cast<double>(order.size())));
  std::partial_sort(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(count), order.end(),
                    [&](std::uint32_t a, std::uint32_t b) {
                      const double da = squared_distance(points_[a], to);
                      const double db = squared_distance(points_[b], to);
                      return da < db || (da == db && a < b);
                    });
  std::vector<Hit> hits(points_.size(), sure(false));
  for (std::size_t i = 0; i < count; ++i) hits[order[i]] = sure(true);
  return hits;
}

MeshSet items_in_place(const TetMesh& mesh, const NamedPlace& named, const ScanTable& scans) {
  MeshSet set;
  set.name = named.name;
  for (const PlaceItems items : {PlaceItems::nodes, PlaceItems::facets, PlaceItems::elements}) {
    if (named.items != PlaceItems::all && named.items != items) continue;
    const ItemPlaces places(mesh, items, scans);
    const std::vector<Hit> hits = places.hits(named.place, named.text);
    std::vector<std::uint32_t> found = members(hits);
    const bool is_needed = named.items != PlaceItems::all || items == PlaceItems::nodes;
    if (found.empty() && is_needed) refuse_empty_set(named, items, hits, places.points());
    (items == PlaceItems::nodes    ? set.vertices
     : items == PlaceItems::facets ? set.facets
                                   : set.tets) = std::move(found);
  }
  return set;
}

}  // namespace scantet
