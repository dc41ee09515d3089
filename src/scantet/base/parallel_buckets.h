// Items sorted into buckets by several threads at once.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace scantet {

/// Where the items of each bucket are in an array of all of them, bucket after bucket: a counting sort. First each item
/// is counted, then each is given a place. Both from any number of threads; which of its bucket's places an item gets
/// depends on them, so the buckets' items are to be sorted afterwards, or their order is not to matter.
class ParallelBuckets {
 public:
  /// So many buckets, without items. Of items there may be up to 2^32 - 1.
  explicit ParallelBuckets(std::size_t count = 0) : starts_(count + 2, 0) {}

  /// One more item. Any thread.
  void count(std::size_t bucket) { next(starts_[bucket + 2]); }
  /// When all are counted. Return: how many there are.
  std::size_t close() {
    for (std::size_t i = 2; i < starts_.size(); ++i) starts_[i] += starts_[i - 1];
    return starts_.back();
  }
  /// The place of an item: once for each that was counted. Any thread.
  std::size_t place(std::size_t bucket) { return next(starts_[bucket + 1]); }

  /// The places of a bucket's items, when all have been given one.
  std::size_t begin(std::size_t bucket) const { return starts_[bucket]; }
  std::size_t end(std::size_t bucket) const { return starts_[bucket + 1]; }

 private:
  static std::uint32_t next(std::uint32_t& number) {
    return std::atomic_ref<std::uint32_t>(number).fetch_add(1, std::memory_order_relaxed);
  }

  // Two further than the bucket while counting, one further while giving places: so it ends up at the bucket's start.
  std::vector<std::uint32_t> starts_;
};

}  // namespace scantet
