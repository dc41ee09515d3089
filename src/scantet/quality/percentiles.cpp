// Percentiles are selected, not sorted: a sample tells between which two values each is, and only values between these
// are held and looked at. However often one value occurs, few are strictly between two: that many of it would be in
// the sample, too, and it would be one of the two.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "scantet/base/parallel.h"
#include "scantet/quality/percentiles_impl.h"

namespace scantet {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr std::size_t kPiece = 65536;
constexpr std::size_t kSample = 16384;  // values; of so many all are taken
constexpr double kDeviations = 4;       // of a percentile's rank in the sample, to either side

using Values = std::span<const double>;
using Percentiles = std::array<double, kPercentiles.size()>;
using Ranks = std::array<std::size_t, kPercentiles.size()>;

double or_infinity(double value) {
  return std::isfinite(value) ? value : kInfinity;
}

/// Of the percentiles among so many values, ascending.
Ranks ranks_among(std::size_t count) {
  Ranks ranks{};
  for (std::size_t i = 0; i < ranks.size(); ++i) {
    ranks[i] = (count * static_cast<std::size_t>(kPercentiles[i]) + 99) / 100 - 1;
  }
  return ranks;
}

std::vector<double> sorted_sample(Values values) {
  const std::size_t count = std::min(values.size(), kSample);
  std::vector<double> sample(count);
  for (std::size_t i = 0; i < count; ++i) sample[i] = or_infinity(values[i * values.size() / count]);
  std::sort(sample.begin(), sample.end());
  return sample;
}

/// Two values of a sample around each percentile, which part all values into classes.
class Cuts {
 public:
  explicit Cuts(const std::vector<double>& sample) {
    const auto count = static_cast<double>(sample.size());
    for (std::size_t i = 0; i < kPercentiles.size(); ++i) {
      const double share = kPercentiles[i] / 100.0;
      const double around = 1 + kDeviations * std::sqrt(count * share * (1 - share));
      cuts_[2 * i] = sample[static_cast<std::size_t>(std::max(0.0, share * count - around))];
      cuts_[2 * i + 1] = sample[static_cast<std::size_t>(std::min(count - 1, share * count + around))];
    }
    std::sort(cuts_.begin(), cuts_.end());
  }

  static constexpr std::size_t kClasses = 4 * kPercentiles.size() + 1;

  /// Ascending with the value. An odd one has one value only: that of the cut.
  std::size_t class_of(double value) const {
    std::size_t below = 0;
    for (const double cut : cuts_) below += cut < value ? 1 : 0;
    return 2 * below + (below < cuts_.size() && cuts_[below] == value ? 1 : 0);
  }
  double value_of(std::size_t odd_class) const { return cuts_[odd_class / 2]; }

 private:
  std::array<double, 2 * kPercentiles.size()> cuts_{};
};

using Counts = std::array<std::size_t, Cuts::kClasses>;

Counts count_classes(Values values, const Cuts& cuts) {
  std::vector<Counts> pieces((values.size() + kPiece - 1) / kPiece);
  parallel_for(values.size(), kPiece, [&](std::size_t begin, std::size_t end) {
    Counts counts{};
    for (const double value : values.subspan(begin, end - begin)) ++counts[cuts.class_of(or_infinity(value))];
    pieces[begin / kPiece] = counts;
  });
  Counts all{};
  for (const Counts& piece : pieces) {
    for (std::size_t c = 0; c < all.size(); ++c) all[c] += piece[c];
  }
  return all;
}

/// Puts the values of these ascending ranks where they would be if `values` were sorted.
void select(std::vector<double>& values, std::size_t begin, std::size_t end, std::span<const std::size_t> ranks) {
  if (ranks.empty()) return;
  const std::size_t middle = ranks.size() / 2;
  const std::size_t rank = ranks[middle];
  const auto at = [&](std::size_t i) { return values.begin() + static_cast<std::ptrdiff_t>(i); };
  if (rank >= begin && rank < end) std::nth_element(at(begin), at(rank), at(end));
  select(values, begin, std::min(rank, end), ranks.first(middle));
  select(values, std::max(begin, rank + 1), end, ranks.subspan(middle + 1));
}

}  // namespace

Percentiles percentiles_of(Values values) {
  const Ranks ranks = ranks_among(values.size());
  const std::vector<double> sample = sorted_sample(values);
  Percentiles found{};
  if (sample.size() == values.size()) {
    std::transform(ranks.begin(), ranks.end(), found.begin(), [&](std::size_t rank) { return sample[rank]; });
    return found;
  }
  const Cuts cuts(sample);
  const Counts counts = count_classes(values, cuts);
  std::array<std::uint8_t, Cuts::kClasses> is_held{};
  std::vector<std::size_t> among_held;  // ranks of those percentiles that are not at a cut
  std::vector<std::size_t> held_ones;   // the percentiles
  std::size_t below = 0;
  std::size_t held_below = 0;
  std::size_t next = 0;
  for (std::size_t c = 0; c < counts.size(); ++c) {
    for (; next < ranks.size() && ranks[next] < below + counts[c]; ++next) {
      if (c % 2 == 1) {
        found[next] = cuts.value_of(c);
        continue;
      }
      is_held[c] = 1;
      among_held.push_back(held_below + ranks[next] - below);
      held_ones.push_back(next);
    }
    below += counts[c];
    if (is_held[c] != 0) held_below += counts[c];
  }
  auto held = parallel_collect<double>(values.size(), kPiece, [&](std::size_t begin, std::size_t end, auto& out) {
    for (const double value : values.subspan(begin, end - begin)) {
      if (is_held[cuts.class_of(or_infinity(value))] != 0) out.push_back(or_infinity(value));
    }
  });
  select(held, 0, held.size(), among_held);
  for (std::size_t i = 0; i < held_ones.size(); ++i) found[held_ones[i]] = held[among_held[i]];
  return found;
}

}  // namespace scantet
