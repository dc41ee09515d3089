// Along a segment each field is a cubic. Of two regions the sign changes of the difference are the answer. Of more, the
// roots of all differences part the segment into stretches on which the order of the fields is fixed, so the largest in
// the middle of a stretch is the largest on all of it. A field that lies under another one with all its coefficients is
// left out at once. On each stretch the region of the one before stays if it ties with the largest to rounding.
#include "scantet/labels/region_changes.h"

#include <algorithm>
#include <limits>

#include "scantet/field/bernstein_cubic.h"
#include "scantet/field/trilinear_cell.h"

namespace scantet {
namespace {

constexpr double kRounding = 16 * std::numeric_limits<double>::epsilon();

struct Field {
  Region region;
  BernsteinCubic cubic;
};

BernsteinCubic minus(const BernsteinCubic& a, const BernsteinCubic& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2], a[3] - b[3]};
}

/// The fields that are largest somewhere, perhaps with others that are not.
class Candidates {
 public:
  Candidates(const LabelCell& cell, const Vec& a, const Vec& b) {
    for (std::size_t i = 0; i < cell.count; ++i) {
      fields_[count_++] = {cell.regions[i], heights_along(cell.values[i], a, b)};
    }
    const Field start = largest([](const BernsteinCubic& cubic) { return cubic[0]; });
    const Field end = largest([](const BernsteinCubic& cubic) { return cubic[3]; });
    at_start_ = start.region;
    at_end_ = end.region;
    std::size_t kept = 0;
    for (std::size_t i = 0; i < count_; ++i) {
      if (under(fields_[i].cubic, start.cubic) || under(fields_[i].cubic, end.cubic)) continue;
      fields_[kept++] = fields_[i];
    }
    count_ = kept;
  }
  std::size_t count() const { return count_; }
  const Field& operator[](std::size_t i) const { return fields_[i]; }
  Region at_start() const { return at_start_; }
  Region at_end() const { return at_end_; }

  /// The region of the largest at t; `now` if that ties with it.
  Region at(double t, Region now) const {
    double most = -std::numeric_limits<double>::infinity();
    double value_now = most;
    Region best = kOutside;
    for (std::size_t i = 0; i < count_; ++i) {
      const double value = value_at(fields_[i].cubic, t);
      if (fields_[i].region == now) value_now = value;
      if (value > most) {
        most = value;
        best = fields_[i].region;
      }
    }
    return most - value_now <= kRounding ? now : best;
  }

 private:
  template <class Value>
  Field largest(const Value& value) const {
    std::size_t best = 0;
    for (std::size_t i = 1; i < count_; ++i) {
      if (value(fields_[i].cubic) > value(fields_[best].cubic)) best = i;
    }
    return fields_[best];
  }
  static bool under(const BernsteinCubic& cubic, const BernsteinCubic& other) {
    const BernsteinCubic difference = minus(cubic, other);
    return std::all_of(difference.begin(), difference.end(), [](double d) { return d < 0; });
  }

  std::array<Field, 8> fields_{};
  std::size_t count_ = 0;
  Region at_start_ = kOutside;
  Region at_end_ = kOutside;
};

void find_changes_of_two(const LabelCell& cell, const Vec& a, const Vec& b, Region before, RegionsAlong& out) {
  const BernsteinCubic cubic = heights_along(cell.difference(), a, b);
  out.at_start = cell.regions[cubic[0] > 0 ? 1 : 0];
  out.at_end = cell.regions[cubic[3] > 0 ? 1 : 0];
  if (before != cell.regions[0] && before != cell.regions[1]) {
    before = out.at_start;
    out.changes.push_back({0, before});
  }
  bool upper = before == cell.regions[1];
  const SignChanges changes = sign_changes(cubic, upper, positive_before_end(cubic, upper));
  for (int i = 0; i < changes.count; ++i) {
    upper = !upper;
    out.changes.push_back({changes.t[static_cast<std::size_t>(i)], cell.regions[upper ? 1 : 0]});
  }
}

}  // namespace

void find_region_changes(const LabelCell& cell, const Vec& a, const Vec& b, Region before, RegionsAlong& out) {
  out.changes.clear();
  if (cell.count == 2) return find_changes_of_two(cell, a, b, before, out);
  const Candidates fields(cell, a, b);
  out.at_start = fields.at_start();
  out.at_end = fields.at_end();
  std::array<double, 2 + 3 * 28> t{0};  // three roots for each pair of eight
  std::size_t count = 1;
  for (std::size_t i = 0; i < fields.count(); ++i) {
    for (std::size_t j = i + 1; j < fields.count(); ++j) {
      const BernsteinCubic difference = minus(fields[j].cubic, fields[i].cubic);
      const bool upper = difference[0] > 0;
      const SignChanges changes = sign_changes(difference, upper, positive_before_end(difference, upper));
      for (int n = 0; n < changes.count; ++n) t[count++] = changes.t[static_cast<std::size_t>(n)];
    }
  }
  std::sort(t.begin(), t.begin() + static_cast<std::ptrdiff_t>(count));
  t[count] = 1;
  Region now = before;
  for (std::size_t n = 0; n < count; ++n) {
    if (t[n + 1] == t[n]) continue;
    const Region region = fields.at(0.5 * (t[n] + t[n + 1]), now);
    if (region != now) out.changes.push_back({t[n], region});
    now = region;
  }
}

}  // namespace scantet
