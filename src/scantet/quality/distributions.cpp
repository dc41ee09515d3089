// Percentiles are selected, not sorted: narrow bins tell which values matter, and of these the median is found first,
// then what is on either side of it. All passes go over the values in pieces on several threads; pieces do not depend
// on the threads, and sums are added up in their order.
#include <algorithm>
#include <cmath>
#include <functional>

#include "scantet/base/parallel.h"
#include "scantet/quality/distributions_impl.h"

namespace scantet {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr std::size_t kPiece = 65536;

using Values = std::span<const double>;

std::vector<double> even_edges(double low, double high, std::size_t bins) {
  std::vector<double> edges(bins + 1);
  for (std::size_t i = 0; i <= bins; ++i) {
    edges[i] = low + (high - low) * static_cast<double>(i) / static_cast<double>(bins);
  }
  edges.back() = high;
  return edges;
}

// Even bins over the data; bins over a range of 1 if the values are equal up to rounding.
std::vector<double> data_edges(const Distribution& d, double finite_max) {
  if (d.count == d.infinite) return even_edges(0, 1, kBins);
  constexpr double kRounding = 1e-9;
  const bool spread = finite_max - d.min > kRounding * std::max(std::abs(d.min), std::abs(finite_max));
  const double high = spread ? finite_max : d.min + std::max(1.0, kRounding * std::abs(d.min));
  return even_edges(d.min, high, kBins);
}

// The finite values.
struct Extent {
  double min = kInfinity;
  double max = -kInfinity;
  double sum = 0;
  std::size_t count = 0;
};

Extent extent_of(Values values) {
  std::vector<Extent> pieces((values.size() + kPiece - 1) / kPiece);
  parallel_for(values.size(), kPiece, [&](std::size_t begin, std::size_t end) {
    Extent piece;
    for (const double value : values.subspan(begin, end - begin)) {
      if (!std::isfinite(value)) continue;
      piece.min = std::min(piece.min, value);
      piece.max = std::max(piece.max, value);
      piece.sum += value;
      ++piece.count;
    }
    pieces[begin / kPiece] = piece;
  });
  Extent all;
  for (const Extent& piece : pieces) {
    all.min = std::min(all.min, piece.min);
    all.max = std::max(all.max, piece.max);
    all.sum += piece.sum;
    all.count += piece.count;
  }
  return all;
}

// How many values there are for which bin_of(value) is 0, …, bins - 1.
template <class BinOf>
std::vector<std::uint64_t> count_by(Values values, std::size_t bins, const BinOf& bin_of) {
  std::vector<std::vector<std::uint64_t>> pieces((values.size() + kPiece - 1) / kPiece);
  parallel_for(values.size(), kPiece, [&](std::size_t begin, std::size_t end) {
    std::vector<std::uint64_t> counts(bins, 0);
    for (const double value : values.subspan(begin, end - begin)) ++counts[bin_of(value)];
    pieces[begin / kPiece] = std::move(counts);
  });
  std::vector<std::uint64_t> all(bins, 0);
  for (const auto& piece : pieces) std::transform(piece.begin(), piece.end(), all.begin(), all.begin(), std::plus<>());
  return all;
}

// `even`: how many of the bins, from the first, have the same width.
Histogram count_in_bins(Values values, std::vector<double> edges, std::size_t even) {
  Histogram histogram{std::move(edges), {}};
  const std::vector<double>& e = histogram.edges;
  const std::size_t bins = e.size() - 1;
  const double scale = static_cast<double>(even) / (e[even] - e[0]);
  histogram.counts = count_by(values, bins, [&](double value) {
    const double position = std::clamp((value - e[0]) * scale, 0.0, static_cast<double>(bins - 1));
    auto bin = static_cast<std::size_t>(position);
    // The product may round across an edge.
    if (bin > 0 && value < e[bin]) --bin;
    if (bin + 1 < bins && value >= e[bin + 1]) ++bin;
    return bin;
  });
  return histogram;
}

// Puts the values of these ascending ranks where they would be if `values` were sorted.
void select(std::vector<double>& values, std::size_t begin, std::size_t end, std::span<const std::size_t> ranks) {
  if (ranks.empty()) return;
  const std::size_t middle = ranks.size() / 2;
  const std::size_t rank = ranks[middle];
  const auto at = [&](std::size_t i) { return values.begin() + static_cast<std::ptrdiff_t>(i); };
  if (rank >= begin && rank < end) std::nth_element(at(begin), at(rank), at(end));
  select(values, begin, std::min(rank, end), ranks.first(middle));
  select(values, std::max(begin, rank + 1), end, ranks.subspan(middle + 1));
}

using Ranks = std::array<std::size_t, kPercentiles.size()>;

// The values that have these ascending ranks among the finite ones, infinity for ranks beyond. Only values in the
// narrow bins that hold a rank are looked at closer.
std::array<double, kPercentiles.size()> values_at(const Ranks& ranks, Values values, const Extent& extent) {
  constexpr std::size_t kNarrow = 1024;
  const double width = (extent.max - extent.min) / kNarrow;
  const double scale = width > 0 && std::isfinite(1 / width) ? 1 / width : 0;
  // Ascending with the value; not-finite values are in a bin of their own.
  const auto bin_of = [&](double value) {
    if (!std::isfinite(value)) return kNarrow;
    return static_cast<std::size_t>(std::min((value - extent.min) * scale, static_cast<double>(kNarrow - 1)));
  };
  const std::vector<std::uint64_t> counts = count_by(values, kNarrow + 1, bin_of);

  std::vector<std::uint8_t> holds_rank(kNarrow + 1, 0);
  Ranks among_held{};
  std::size_t below = 0;       // the bin
  std::size_t held_below = 0;  // those of them in bins that hold a rank
  std::size_t next = 0;
  for (std::size_t bin = 0; bin < kNarrow; ++bin) {
    for (; next < ranks.size() && ranks[next] < below + counts[bin]; ++next) {
      holds_rank[bin] = 1;
      among_held[next] = held_below + ranks[next] - below;
    }
    below += counts[bin];
    if (holds_rank[bin] != 0) held_below += counts[bin];
  }
  auto held = parallel_collect<double>(values.size(), kPiece, [&](std::size_t begin, std::size_t end, auto& out) {
    for (const double value : values.subspan(begin, end - begin)) {
      if (holds_rank[bin_of(value)] != 0) out.push_back(value);
    }
  });
  select(held, 0, held.size(), std::span(among_held).first(next));
  std::array<double, kPercentiles.size()> found{};
  for (std::size_t i = 0; i < found.size(); ++i) found[i] = i < next ? held[among_held[i]] : kInfinity;
  return found;
}

// All but the histogram. Returns the largest finite value.
double describe(Values values, Distribution& d) {
  d.count = values.size();
  if (values.empty()) return 0;
  const Extent extent = extent_of(values);
  d.infinite = values.size() - extent.count;
  d.min = extent.min;
  d.max = d.infinite > 0 ? kInfinity : extent.max;
  if (extent.count > 0) {
    d.mean = std::clamp(extent.sum / static_cast<double>(extent.count), extent.min, extent.max);  // rounding
  }
  Ranks ranks{};
  for (std::size_t i = 0; i < ranks.size(); ++i) {
    ranks[i] = (values.size() * static_cast<std::size_t>(kPercentiles[i]) + 99) / 100 - 1;
  }
  d.percentiles = values_at(ranks, values, extent);
  return extent.max;
}

}  // namespace

Distribution over_range(Values values, double low, double high, std::size_t bins) {
  Distribution d;
  describe(values, d);
  d.histogram = count_in_bins(values, even_edges(low, high, bins), bins);
  return d;
}

Distribution over_data(Values values) {
  Distribution d;
  const double finite_max = describe(values, d);
  d.histogram = count_in_bins(values, data_edges(d, finite_max), kBins);
  return d;
}

Distribution over_range_and_above(Values values, double low, double high) {
  Distribution d;
  const double finite_max = describe(values, d);
  std::vector<double> edges = even_edges(low, high, kBins);
  edges.push_back(std::max(finite_max, high + (high - low) / static_cast<double>(kBins)));
  d.histogram = count_in_bins(values, std::move(edges), kBins);
  return d;
}

Distribution scaled(Distribution d, double factor) {
  for (double* value : {&d.min, &d.max, &d.mean}) *value *= factor;
  for (double& value : d.percentiles) value *= factor;
  for (double& edge : d.histogram.edges) edge *= factor;
  return d;
}

}  // namespace scantet
