// Private: an order in which things near each other follow each other.
#pragma once

#include <cstdint>
#include <functional>
#include <utility>
#include <vector>

#include "scantet/base/geometry.h"
#include "scantet/base/morton_impl.h"
#include "scantet/base/parallel.h"

namespace scantet::engine {

/// The numbers of things along a space-filling curve: each is looked for from where the one before it was.
template <class Things, class PointOf>
std::vector<std::uint32_t> along_curve(const Things& things, const Box& box, const PointOf& point_of) {
  constexpr std::size_t kGrain = 4096;
  std::vector<std::pair<std::uint64_t, std::uint32_t>> order(things.size());
  parallel_for(things.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t n = begin; n < end; ++n) {
      order[n] = {morton_code(point_of(things[n]), box), static_cast<std::uint32_t>(n)};
    }
  });
  parallel_sort(order, std::less<>());
  std::vector<std::uint32_t> numbers;
  numbers.reserve(order.size());
  for (const auto& [code, number] : order) numbers.push_back(number);
  return numbers;
}

}  // namespace scantet::engine
