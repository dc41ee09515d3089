#include "scantet/base/parallel_buckets.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "scantet/base/parallel.h"

namespace scantet {
namespace {

TEST(ParallelBuckets, EachItemHasAPlaceOfItsOwnInItsBucket) {
  constexpr std::size_t kItems = 50'000;
  constexpr std::size_t kBuckets = 97;
  constexpr std::size_t kGrain = 64;
  const auto bucket_of = [](std::size_t item) { return item * item % kBuckets; };  // some stay empty
  for (const std::size_t threads : {1, 4}) {
    with_threads(threads, [&] {
      ParallelBuckets buckets(kBuckets);
      parallel_for(kItems, kGrain, [&](std::size_t begin, std::size_t end) {
        for (std::size_t item = begin; item < end; ++item) buckets.count(bucket_of(item));
      });
      ASSERT_EQ(buckets.close(), kItems);
      std::vector<std::size_t> items(kItems, kItems);
      parallel_for(kItems, kGrain, [&](std::size_t begin, std::size_t end) {
        for (std::size_t item = begin; item < end; ++item) items[buckets.place(bucket_of(item))] = item;
      });
      EXPECT_EQ(buckets.begin(0), 0U);
      EXPECT_EQ(buckets.end(kBuckets - 1), kItems);
      for (std::size_t bucket = 0; bucket < kBuckets; ++bucket) {
        if (bucket > 0) {
          EXPECT_EQ(buckets.begin(bucket), buckets.end(bucket - 1));
        }
        for (std::size_t i = buckets.begin(bucket); i < buckets.end(bucket); ++i) {
          EXPECT_EQ(bucket_of(items[i]), bucket);
        }
      }
      std::sort(items.begin(), items.end());
      std::vector<std::size_t> all(kItems);
      std::iota(all.begin(), all.end(), 0);
      EXPECT_EQ(items, all);
    });
  }
}

TEST(ParallelBuckets, MayAllBeEmpty) {
  ParallelBuckets buckets(3);
  EXPECT_EQ(buckets.close(), 0U);
  EXPECT_EQ(buckets.begin(2), buckets.end(2));
}

}  // namespace
}  // namespace scantet
