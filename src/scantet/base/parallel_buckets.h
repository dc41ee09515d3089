// Items sorted into buckets by several threads at once.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace scantet {

/// Tells where the items of each bucket are in an array of all of them, bucket after bucket: a counting sort. First
/// each item is counted, then each is given a place, both from any number of threads. Which of its bucket's places an
/// item gets depends on the threads, so the items of a bucket must be sorted afterwards, unless their order does not
/// matter.
class ParallelBuckets {
 public:
  /// Makes `count` buckets without items. There may be up to 2^32 - 1 items.
  explicit ParallelBuckets(std::size_t count = 0) : starts_(count + 2, 0) {}

  /// Counts an item. Any thread.
  void count(std::size_t bucket) { next(starts_[bucket + 2]); }
  /// Ends the counting. Return: how many items there are.
  std::size_t close() {
    for (std::size_t i = 2; i < starts_.size(); ++i) starts_[i] += starts_[i - 1];
    return starts_.back();
  }
  /// Gives an item its place; to be called once for each item that was counted. Any thread.
  std::size_t place(std::size_t bucket) { return next(starts_[bucket + 1]); }

  /// The places of a bucket's items, when all have been given one.
  std::size_t begin(std::size_t bucket) const { return starts_[bucket]; }
  std::size_t end(std::size_t bucket) const { return starts_[bucket + 1]; }

 private:
  static std::uint32_t next(std::uint32_t& number) {
    return std::atomic_ref<std::uint32_t>(number).fetch_add(1, std::memory_order_relaxed);
  }

  // The start of bucket b is at b + 2 while items are counted, and at b + 1 while they are given places; giving places
  // moves it on, and so it is at b in the end.
  std::vector<std::uint32_t> starts_;
};

}  // namespace scantet
