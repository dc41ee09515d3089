// All passes go over the values in pieces on several threads; pieces do not depend on the threads, and sums are added
// up in their order.
#include <algorithm>
#include <cmath>
#include <functional>

#include "scantet/base/parallel.h"
#include "scantet/quality/distributions_impl.h"
#include "scantet/quality/percentiles_impl.h"

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

// The finite values.
struct Extent {
  double min = kInfinity;
  double max = -kInfinity;
  double sum = 0;
  std::size_t count = 0;

  void add(double value) {
    min = std::min(min, value);
    max = std::max(max, value);
    sum += value;
    ++count;
  }
  void add(const Extent& later) {
    min = std::min(min, later.min);
    max = std::max(max, later.max);
    sum += later.sum;
    count += later.count;
  }
};

Extent extent_of(Values values) {
  std::vector<Extent> pieces((values.size() + kPiece - 1) / kPiece);
  parallel_for(values.size(), kPiece, [&](std::size_t begin, std::size_t end) {
    Extent piece;
    for (const double value : values.subspan(begin, end - begin)) {
      if (std::isfinite(value)) piece.add(value);
    }
    pieces[begin / kPiece] = piece;
  });
  Extent all;
  for (const Extent& piece : pieces) all.add(piece);
  return all;
}

// Even bins over the data; bins over a range of 1 if the values are equal up to rounding.
std::vector<double> data_edges(const Extent& extent) {
  if (extent.count == 0) return even_edges(0, 1, kBins);
  constexpr double kRounding = 1e-9;
  const double size = std::max(std::abs(extent.min), std::abs(extent.max));
  const bool spread = extent.max - extent.min > kRounding * size;
  const double high = spread ? extent.max : extent.min + std::max(1.0, kRounding * std::abs(extent.min));
  return even_edges(extent.min, high, kBins);
}

// The bins of a histogram.
class Bins {
 public:
  // even: how many of the bins, from the first, have the same width.
  Bins(std::vector<double> edges, std::size_t even)
      : edges_(std::move(edges)), scale_(static_cast<double>(even) / (edges_[even] - edges_[0])) {}

  std::size_t count() const { return edges_.size() - 1; }
  // Ascending with the value. What is out of range is in the first or last, what is not finite in the last.
  std::size_t bin_of(double value) const {
    const std::size_t last = count() - 1;
    if (!std::isfinite(value)) return last;
    const double position = std::clamp((value - edges_[0]) * scale_, 0.0, static_cast<double>(last));
    const auto bin = static_cast<std::size_t>(position);
    // The product may round across an edge.
    if (bin > 0 && value < edges_[bin]) return bin - 1;
    if (bin < last && value >= edges_[bin + 1]) return bin + 1;
    return bin;
  }
  const std::vector<double>& edges() const { return edges_; }

 private:
  std::vector<double> edges_;
  double scale_;
};

Distribution describe(Values values, const Bins& bins) {
  struct Piece {
    Extent extent;
    std::vector<std::uint64_t> counts;
  };
  std::vector<Piece> pieces((values.size() + kPiece - 1) / kPiece);
  parallel_for(values.size(), kPiece, [&](std::size_t begin, std::size_t end) {
    Extent extent;
    std::vector<std::uint64_t> counts(bins.count(), 0);
    for (const double value : values.subspan(begin, end - begin)) {
      if (std::isfinite(value)) extent.add(value);
      ++counts[bins.bin_of(value)];
    }
    pieces[begin / kPiece] = {extent, std::move(counts)};
  });
  Extent extent;
  std::vector<std::uint64_t> counts(bins.count(), 0);
  for (const Piece& piece : pieces) {
    extent.add(piece.extent);
    std::transform(piece.counts.begin(), piece.counts.end(), counts.begin(), counts.begin(), std::plus<>());
  }
  Distribution d;
  d.histogram = {bins.edges(), std::move(counts)};
  d.count = values.size();
  if (values.empty()) return d;
  d.infinite = values.size() - extent.count;
  d.min = extent.min;
  d.max = d.infinite > 0 ? kInfinity : extent.max;
  if (extent.count > 0) {
    d.mean = std::clamp(extent.sum / static_cast<double>(extent.count), extent.min, extent.max);  // rounding
  }
  d.percentiles = percentiles_of(values);
  return d;
}

}  // namespace

Distribution over_range(Values values, double low, double high, std::size_t bins) {
  return describe(values, Bins(even_edges(low, high, bins), bins));
}

Distribution over_data(Values values) {
  return describe(values, Bins(data_edges(extent_of(values)), kBins));
}

Distribution over_range_and_above(Values values, double low, double high) {
  std::vector<double> edges = even_edges(low, high, kBins);
  const double one_more = high + (high - low) / static_cast<double>(kBins);
  edges.push_back(one_more);
  Distribution d = describe(values, Bins(std::move(edges), kBins));
  const double largest = d.infinite == 0 ? d.max : extent_of(values).max;
  if (largest > one_more) d.histogram.edges.back() = largest;
  return d;
}

Distribution scaled(Distribution d, double factor) {
  for (double* value : {&d.min, &d.max, &d.mean}) *value *= factor;
  for (double& value : d.percentiles) value *= factor;
  for (double& edge : d.histogram.edges) edge *= factor;
  return d;
}

}  // namespace scantet
