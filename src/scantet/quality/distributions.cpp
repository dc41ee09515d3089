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

// The bins of a histogram, each cut into narrow ones.
class Bins {
 public:
  // even: how many of the bins, from the first, have the same width.
  Bins(std::vector<double> edges, std::size_t even)
      : edges_(std::move(edges)), scale_(static_cast<double>(kNarrow * even) / (edges_[even] - edges_[0])) {}

  static constexpr std::size_t kNarrow = 32;  // in each bin

  std::size_t count() const { return edges_.size() - 1; }
  // Values that are not finite are in a narrow bin of their own, the last.
  std::size_t narrow_count() const { return kNarrow * count() + 1; }
  // Ascending with the value. What is out of range is in the first or last.
  std::size_t narrow_of(double value) const {
    if (!std::isfinite(value)) return kNarrow * count();
    const double position = std::clamp((value - edges_[0]) * scale_, 0.0, static_cast<double>(kNarrow * count() - 1));
    const auto narrow = static_cast<std::size_t>(position);
    const std::size_t bin = narrow / kNarrow;
    // The product may round across an edge.
    if (bin > 0 && value < edges_[bin]) return kNarrow * bin - 1;
    if (bin + 1 < count() && value >= edges_[bin + 1]) return kNarrow * (bin + 1);
    return narrow;
  }
  // narrow: how many values are in each narrow bin.
  Histogram histogram(const std::vector<std::uint64_t>& narrow) const {
    Histogram histogram{edges_, std::vector<std::uint64_t>(count(), 0)};
    for (std::size_t i = 0; i < narrow.size(); ++i) {
      histogram.counts[std::min(i / kNarrow, count() - 1)] += narrow[i];
    }
    return histogram;
  }

 private:
  std::vector<double> edges_;
  double scale_;
};

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

// The percentiles; infinite where they are beyond the finite values. Only values in narrow bins that hold one are
// looked at. counts: of the narrow bins.
std::array<double, kPercentiles.size()> percentiles_of(Values values, const Bins& bins,
                                                       const std::vector<std::uint64_t>& counts) {
  std::array<std::size_t, kPercentiles.size()> among_held{};
  std::vector<std::uint8_t> holds_one(counts.size(), 0);
  std::size_t below = 0;       // the narrow bin
  std::size_t held_below = 0;  // those of them in bins that hold a percentile
  std::size_t next = 0;
  for (std::size_t bin = 0; bin + 1 < counts.size(); ++bin) {
    for (; next < kPercentiles.size(); ++next) {
      const std::size_t rank = (values.size() * static_cast<std::size_t>(kPercentiles[next]) + 99) / 100 - 1;
      if (rank >= below + counts[bin]) break;
      holds_one[bin] = 1;
      among_held[next] = held_below + rank - below;
    }
    below += counts[bin];
    if (holds_one[bin] != 0) held_below += counts[bin];
  }
  const double share = static_cast<double>(held_below) / static_cast<double>(values.size());
  auto held = parallel_collect<double>(values.size(), kPiece, [&](std::size_t begin, std::size_t end, auto& out) {
    out.reserve(static_cast<std::size_t>(1.25 * share * static_cast<double>(end - begin)));
    for (const double value : values.subspan(begin, end - begin)) {
      if (holds_one[bins.narrow_of(value)] != 0) out.push_back(value);
    }
  });
  select(held, 0, held.size(), std::span(among_held).first(next));
  std::array<double, kPercentiles.size()> found{};
  for (std::size_t i = 0; i < found.size(); ++i) found[i] = i < next ? held[among_held[i]] : kInfinity;
  return found;
}

Distribution describe(Values values, const Bins& bins) {
  struct Piece {
    Extent extent;
    std::vector<std::uint64_t> counts;
  };
  std::vector<Piece> pieces((values.size() + kPiece - 1) / kPiece);
  parallel_for(values.size(), kPiece, [&](std::size_t begin, std::size_t end) {
    Extent extent;
    std::vector<std::uint64_t> counts(bins.narrow_count(), 0);
    for (const double value : values.subspan(begin, end - begin)) {
      if (std::isfinite(value)) extent.add(value);
      ++counts[bins.narrow_of(value)];
    }
    pieces[begin / kPiece] = {extent, std::move(counts)};
  });
  Extent extent;
  std::vector<std::uint64_t> counts(bins.narrow_count(), 0);
  for (const Piece& piece : pieces) {
    extent.add(piece.extent);
    std::transform(piece.counts.begin(), piece.counts.end(), counts.begin(), counts.begin(), std::plus<>());
  }
  Distribution d;
  d.histogram = bins.histogram(counts);
  d.count = values.size();
  if (values.empty()) return d;
  d.infinite = values.size() - extent.count;
  d.min = extent.min;
  d.max = d.infinite > 0 ? kInfinity : extent.max;
  if (extent.count > 0) {
    d.mean = std::clamp(extent.sum / static_cast<double>(extent.count), extent.min, extent.max);  // rounding
  }
  d.percentiles = percentiles_of(values, bins, counts);
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
