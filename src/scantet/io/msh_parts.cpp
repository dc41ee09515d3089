// A set cuts each part that it has elements of in two.
#include <algorithm>
#include <map>

#include "scantet/io/msh_parts_impl.h"

namespace scantet {
namespace {

void count_elements(GroupParts& parts) {
  for (GroupParts::Part& part : parts.parts) part.count = 0;
  for (const std::uint32_t part : parts.part_of) ++parts.parts[part].count;
}

}  // namespace

std::size_t GroupParts::used() const {
  return static_cast<std::size_t>(
      std::count_if(parts.begin(), parts.end(), [](const Part& part) { return part.count > 0; }));
}

std::vector<std::uint32_t> GroupParts::order() const {
  std::vector<std::size_t> sizes;
  for (const Part& part : parts) sizes.push_back(part.count);
  return order_by_group(part_of, sizes);
}

GroupParts without_sets(const std::vector<std::uint32_t>& group_of, std::size_t groups) {
  GroupParts result;
  result.part_of = group_of;
  for (std::uint32_t g = 0; g < groups; ++g) result.parts.push_back({g, {}, 0});
  count_elements(result);
  return result;
}

GroupParts with_sets(const std::vector<NamedSet>& sets, std::vector<std::uint32_t> MeshSet::*members,
                     const std::vector<std::uint32_t>& group_of, std::size_t groups) {
  GroupParts result = without_sets(group_of, groups);
  for (std::uint32_t s = 0; s < sets.size(); ++s) {
    std::map<std::uint32_t, std::uint32_t> with_set;  // part to what it becomes
    for (const std::uint32_t i : sets[s].set.*members) {
      const std::uint32_t before = result.part_of[i];
      const auto [place, is_new] = with_set.emplace(before, static_cast<std::uint32_t>(result.parts.size()));
      if (is_new) {
        GroupParts::Part part = result.parts[before];
        part.sets.push_back(s);
        result.parts.push_back(std::move(part));
      }
      result.part_of[i] = place->second;
    }
  }
  count_elements(result);
  return result;
}

}  // namespace scantet
