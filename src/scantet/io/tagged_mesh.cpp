// Tags may be any numbers in any order. In a file of ours tets are grouped by region; their tags keep the order in
// which they were made.
#include <algorithm>
#include <numeric>
#include <optional>

#include "scantet/io/tagged_mesh_impl.h"
#include "scantet/io/text_scanner_impl.h"

namespace scantet {
namespace {

std::vector<std::size_t> ascending(const std::vector<std::int64_t>& tags) {
  std::vector<std::size_t> order(tags.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return tags[a] < tags[b]; });
  return order;
}

template <typename T>
void reorder(std::vector<T>& values, const std::vector<std::size_t>& order) {
  std::vector<T> sorted;
  sorted.reserve(values.size());
  for (std::size_t i : order) sorted.push_back(values[i]);
  values = std::move(sorted);
}

std::optional<std::uint64_t> find(std::int64_t tag, const std::vector<std::int64_t>& tags) {
  const bool inside = !tags.empty() && tag >= tags.front() && tag <= tags.back();
  if (!inside) return std::nullopt;
  const auto guess = static_cast<std::uint64_t>(tag) - static_cast<std::uint64_t>(tags.front());  // right without gaps
  if (guess < tags.size() && tags[guess] == tag) return guess;
  const auto place = std::lower_bound(tags.begin(), tags.end(), tag);
  return *place == tag ? std::optional(static_cast<std::uint64_t>(place - tags.begin())) : std::nullopt;
}

std::uint64_t index_of(std::int64_t tag, const std::vector<std::int64_t>& tags, const std::string& path) {
  if (const auto found = find(tag, tags)) return *found;
  throw_bad_mesh(path, "an element uses node " + std::to_string(tag) + ", which the file does not have");
}

void resolve_node_sets(TaggedMesh& file) {
  for (const TaggedSet& set : file.node_sets) {
    NamedIndices& found = file.mesh.vertex_sets.emplace_back(NamedIndices{set.name, {}});
    for (const std::int64_t tag : set.tags) {
      if (const auto node = find(tag, file.node_tags)) found.members.push_back(*node);
    }
  }
}

void resolve_element_sets(TaggedMesh& file, const std::string& path) {
  std::vector<TaggedTriangle>& triangles = file.triangles;
  std::stable_sort(triangles.begin(), triangles.end(), [](const auto& a, const auto& b) { return a.tag < b.tag; });
  std::vector<std::int64_t> triangle_tags;
  triangle_tags.reserve(triangles.size());
  for (const TaggedTriangle& triangle : triangles) triangle_tags.push_back(triangle.tag);
  for (const TaggedSet& set : file.element_sets) {
    NamedIndices tets{set.name, {}};
    NamedTriangles facets{set.name, {}};
    bool has_others = false;
    for (const std::int64_t tag : set.tags) {
      if (const auto tet = find(tag, file.element_tags)) {
        tets.members.push_back(*tet);
      } else if (const auto triangle = find(tag, triangle_tags)) {
        facets.corners.push_back(triangles[*triangle].corners);
        for (std::uint64_t& v : facets.corners.back()) {
          v = index_of(static_cast<std::int64_t>(v), file.node_tags, path);
        }
      } else {
        has_others = true;
      }
    }
    if (has_others) {
      file.mesh.left_out.push_back(named_text("what of the set", set.name) + " is neither tetrahedra nor triangles");
    }
    file.mesh.tet_sets.push_back(std::move(tets));
    file.mesh.facet_sets.push_back(std::move(facets));
  }
}

void resolve_fields(TaggedMesh& file) {
  for (const TaggedField& field : file.fields) {
    NamedNumbers numbers{field.name, std::vector<double>(file.element_tags.size())};
    std::vector<std::uint8_t> is_set(file.element_tags.size(), 0);
    for (std::size_t i = 0; i < field.tags.size(); ++i) {
      const auto tet = find(field.tags[i], file.element_tags);
      if (!tet) continue;
      numbers.values[*tet] = field.values[i];
      is_set[*tet] = 1;
    }
    const bool is_whole = std::find(is_set.begin(), is_set.end(), 0) == is_set.end();
    if (is_whole) {
      file.mesh.tet_numbers.push_back(std::move(numbers));
    } else {
      file.mesh.left_out.push_back(named_text("$ElementData", field.name) + ", which some tetrahedra lack");
    }
  }
}

}  // namespace

void sort_by_tag(TaggedMesh& file, const std::string& path) {
  require_one_order(file.mesh, path);
  if (!std::is_sorted(file.element_tags.begin(), file.element_tags.end())) {
    const std::vector<std::size_t> order = ascending(file.element_tags);
    reorder(file.mesh.tets, order);
    if (!file.mesh.edge_nodes.empty()) reorder(file.mesh.edge_nodes, order);
    reorder(file.mesh.references, order);
    reorder(file.element_tags, order);
  }
  if (!std::is_sorted(file.node_tags.begin(), file.node_tags.end())) {
    const std::vector<std::size_t> order = ascending(file.node_tags);
    reorder(file.mesh.vertices, order);
    reorder(file.node_tags, order);
  }
  const auto twice = std::adjacent_find(file.node_tags.begin(), file.node_tags.end());
  if (twice != file.node_tags.end()) throw_bad_mesh(path, "node " + std::to_string(*twice) + " is there twice");
  for (auto& tet : file.mesh.tets) {
    for (std::uint64_t& v : tet) v = index_of(static_cast<std::int64_t>(v), file.node_tags, path);
  }
  for (auto& nodes : file.mesh.edge_nodes) {
    for (std::uint64_t& v : nodes) v = index_of(static_cast<std::int64_t>(v), file.node_tags, path);
  }
  resolve_node_sets(file);
  resolve_element_sets(file, path);
  resolve_fields(file);
}

}  // namespace scantet
