// Lists of few numbers, most of which come several times.
#pragma once

#include <algorithm>
#include <vector>

namespace scantet {

/// Leaves each value once, in an order that depends on the values alone if `values` was in such an order. Short lists
/// are searched, which is faster than to sort them as long as few values differ.
template <class Value>
void drop_repeats(std::vector<Value>& values) {
  constexpr std::size_t kShort = 128;
  if (values.size() > kShort) {
    std::sort(values.begin(), values.end());
    values.erase(std::unique(values.begin(), values.end()), values.end());
    return;
  }
  auto end = values.begin();
  for (const Value& value : values) {
    if (std::find(values.begin(), end, value) == end) *end++ = value;
  }
  values.erase(end, values.end());
}

}  // namespace scantet
