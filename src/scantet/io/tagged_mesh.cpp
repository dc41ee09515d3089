// Tags may be any numbers in any order. In a file of ours tets are grouped by region; their tags keep the order in
// which they were made.
#include <algorithm>
#include <numeric>

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

std::uint64_t index_of(std::int64_t tag, const std::vector<std::int64_t>& tags, const std::string& path) {
  const bool inside = !tags.empty() && tag >= tags.front() && tag <= tags.back();
  if (inside) {
    const auto guess =
        static_cast<std::uint64_t>(tag) - static_cast<std::uint64_t>(tags.front());  // right without gaps
    if (guess < tags.size() && tags[guess] == tag) return guess;
    const auto place = std::lower_bound(tags.begin(), tags.end(), tag);
    if (*place == tag) return static_cast<std::uint64_t>(place - tags.begin());
  }
  throw_bad_mesh(path, "an element uses node " + std::to_string(tag) + ", which the file does not have");
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
}

}  // namespace scantet
