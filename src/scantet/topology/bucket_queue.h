// What comes first, but for small differences.
#pragma once

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

namespace scantet {

/// A queue from which the values of the largest priority come first; of those that differ by less than a 4,096th of the
/// largest possible, the last that went in.
template <class Value>
class BucketQueue {
 public:
  /// largest: > 0.
  explicit BucketQueue(double largest) : buckets_(kBuckets), scale_((kBuckets - 1) / largest) {}

  bool empty() const { return count_ == 0; }
  /// priority: from 0 to the largest.
  void push(double priority, const Value& value) {
    const auto bucket = static_cast<std::size_t>(std::clamp(priority * scale_, 0.0, kBuckets - 1.0));
    buckets_[bucket].push_back(value);
    first_ = std::max(first_, bucket);
    ++count_;
  }
  /// Pre: not empty.
  Value pop() {
    while (buckets_[first_].empty()) --first_;
    const Value value = buckets_[first_].back();
    buckets_[first_].pop_back();
    --count_;
    return value;
  }

 private:
  static constexpr std::size_t kBuckets = 4096;
  std::vector<std::vector<Value>> buckets_;
  double scale_;
  std::size_t first_ = 0;
  std::size_t count_ = 0;
};

}  // namespace scantet
