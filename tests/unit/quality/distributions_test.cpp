#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "scantet/base/parallel.h"
#include "scantet/quality/distributions_impl.h"

namespace scantet {
namespace {

// Against a full sort, for values that crowd in the first bin, that are all equal, of which many are infinite or the
// same, or of which a sample at even steps shows nothing.
TEST(Distributions, PercentilesAreThoseOfSortedValues) {
  constexpr double kLargest = std::numeric_limits<double>::infinity();
  std::mt19937 random(5);
  std::exponential_distribution<double> spread(1);
  constexpr std::size_t kCount = 150000;  // several pieces
  std::vector<std::vector<double>> cases(7, std::vector<double>(kCount));
  for (double& value : cases[0]) value = spread(random);
  for (double& value : cases[1]) value = std::exp(40 * spread(random));  // almost all in the first bin
  for (double& value : cases[2]) value = 7;
  for (double& value : cases[3]) value = random() % 10 == 0 ? kLargest : spread(random) - 2;
  for (double& value : cases[4]) value = kLargest;
  for (double& value : cases[5]) value = random() % 3 == 0 ? std::floor(8 * spread(random)) : spread(random);
  for (double& value : cases[6]) value = spread(random);
  constexpr std::size_t kSample = 16384;
  for (std::size_t n = 0; n < kSample; ++n) cases[6][n * kCount / kSample] = -1;
  cases.push_back({3});
  cases.push_back({2, 1, 5});
  for (std::size_t i = 0; i < cases.size(); ++i) {
    std::vector<double>& values = cases[i];
    const Distribution d = over_data(values);
    std::sort(values.begin(), values.end());
    EXPECT_EQ(d.count, values.size());
    for (std::size_t k = 0; k < kPercentiles.size(); ++k) {
      const std::size_t rank = (values.size() * static_cast<std::size_t>(kPercentiles[k]) + 99) / 100 - 1;
      EXPECT_EQ(d.percentiles[k], values[rank]) << i << ", " << k;
    }
    EXPECT_EQ(d.infinite, static_cast<std::uint64_t>(std::count(values.begin(), values.end(), kLargest))) << i;
    if (d.infinite < d.count) {
      EXPECT_EQ(d.min, values.front()) << i;
    }
  }
}

TEST(Distributions, DoNotDependOnTheNumberOfThreads) {
  std::mt19937 random(8);
  std::normal_distribution<double> spread(1);
  std::vector<double> values(200000);
  for (double& value : values) value = spread(random);
  std::vector<Distribution> all;
  for (const std::size_t threads : {1, 2, 5}) {
    with_threads(threads, [&] { all.push_back(over_range(values, -2, 3, 25)); });
  }
  for (const Distribution& d : all) {
    EXPECT_EQ(d.mean, all[0].mean);
    EXPECT_EQ(d.percentiles, all[0].percentiles);
    EXPECT_EQ(d.histogram.counts, all[0].histogram.counts);
  }
}

}  // namespace
}  // namespace scantet
