// Percentiles are selected, not sorted: the median first, then on either side of it.
#include <algorithm>
#include <cmath>
#include <span>

#include "scantet/quality/distributions_impl.h"

namespace scantet {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

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

// `even`: how many of the bins, from the first, have the same width.
Histogram count_in_bins(const std::vector<double>& values, std::vector<double> edges, std::size_t even) {
  Histogram histogram{std::move(edges), {}};
  const std::vector<double>& e = histogram.edges;
  const std::size_t bins = e.size() - 1;
  histogram.counts.assign(bins, 0);
  const double scale = static_cast<double>(even) / (e[even] - e[0]);
  for (const double value : values) {
    const double position = std::clamp((value - e[0]) * scale, 0.0, static_cast<double>(bins - 1));
    auto bin = static_cast<std::size_t>(position);
    // The product may round across an edge.
    if (bin > 0 && value < e[bin]) --bin;
    if (bin + 1 < bins && value >= e[bin + 1]) ++bin;
    ++histogram.counts[bin];
  }
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

// All but the histogram; values are reordered. Returns the largest finite value.
double describe(std::vector<double>& values, Distribution& d) {
  d.count = values.size();
  if (values.empty()) return 0;
  const auto finite_end = std::partition(values.begin(), values.end(), [](double v) { return std::isfinite(v); });
  const auto finite = static_cast<std::size_t>(finite_end - values.begin());
  d.infinite = values.size() - finite;
  double sum = 0;
  double finite_max = -kInfinity;
  d.min = kInfinity;
  for (std::size_t i = 0; i < finite; ++i) {
    sum += values[i];
    d.min = std::min(d.min, values[i]);
    finite_max = std::max(finite_max, values[i]);
  }
  d.max = d.infinite > 0 ? kInfinity : finite_max;
  if (finite > 0) d.mean = std::clamp(sum / static_cast<double>(finite), d.min, finite_max);  // rounding
  std::array<std::size_t, kPercentiles.size()> ranks{};
  for (std::size_t i = 0; i < ranks.size(); ++i) {
    ranks[i] = (values.size() * static_cast<std::size_t>(kPercentiles[i]) + 99) / 100 - 1;
  }
  select(values, 0, finite, ranks);
  for (std::size_t i = 0; i < ranks.size(); ++i) {
    d.percentiles[i] = ranks[i] < finite ? values[ranks[i]] : kInfinity;
  }
  return finite_max;
}

}  // namespace

Distribution over_range(std::vector<double>& values, double low, double high, std::size_t bins) {
  Distribution d;
  describe(values, d);
  d.histogram = count_in_bins(values, even_edges(low, high, bins), bins);
  return d;
}

Distribution over_data(std::vector<double>& values) {
  Distribution d;
  const double finite_max = describe(values, d);
  d.histogram = count_in_bins(values, data_edges(d, finite_max), kBins);
  return d;
}

Distribution over_range_and_above(std::vector<double>& values, double low, double high) {
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
