// Intervals first. Where they do not decide, numbers become sums of doubles that do not overlap ("expansions",
// Shewchuk 1997), on which addition and multiplication make no error.
#include "scantet/verify/exact_sign.h"

#include <cmath>
#include <vector>

#include "scantet/verify/interval.h"

namespace scantet::verify {
namespace {

/// A sum of doubles, ascending in magnitude, that do not overlap; zeros are left out.
class Expansion {
 public:
  Expansion() = default;
  /// a - b.
  Expansion(double a, double b) {
    add(a);
    add(-b);
  }
  /// Adds x without error: it is carried through the terms, each leaving what it cannot hold.
  void add(double x) {
    std::vector<double> terms;
    for (const double term : terms_) {
      const double sum = x + term;
      const double part = sum - x;
      const double error = (x - (sum - part)) + (term - part);
      if (error != 0) terms.push_back(error);
      x = sum;
    }
    if (x != 0) terms.push_back(x);
    terms_ = std::move(terms);
  }
  void add(const Expansion& other, double factor = 1) {
    for (const double term : other.terms_) add(factor * term);  // factor: 1 or -1
  }
  friend Expansion operator*(const Expansion& a, const Expansion& b) {
    Expansion product;
    for (const double s : a.terms_) {
      for (const double t : b.terms_) {
        const double high = s * t;
        product.add(std::fma(s, t, -high));
        product.add(high);
      }
    }
    return product;
  }
  friend Expansion operator-(Expansion a, const Expansion& b) {
    a.add(b, -1);
    return a;
  }
  /// The last term is larger than all before it together.
  int sign() const { return terms_.empty() ? 0 : terms_.back() > 0 ? 1 : -1; }

 private:
  std::vector<double> terms_;
};

int sign_if_sure(const Interval& value) {
  return value.is_positive() ? 1 : value.is_negative() ? -1 : 0;
}

IntervalVec difference(const Point& a, const Point& b) {
  return {Interval(a.x) - b.x, Interval(a.y) - b.y, Interval(a.z) - b.z};
}

}  // namespace

int orientation(const Point& a, const Point& b, const Point& c, const Point& d) {
  const int sure = sign_if_sure(det(difference(b, a), difference(c, a), difference(d, a)));
  if (sure != 0) return sure;
  const auto minor = [&](int u, int v) {
    return Expansion(c[u], a[u]) * Expansion(d[v], a[v]) - Expansion(c[v], a[v]) * Expansion(d[u], a[u]);
  };
  Expansion sum = Expansion(b.x, a.x) * minor(1, 2);
  sum.add(Expansion(b.y, a.y) * minor(2, 0));
  sum.add(Expansion(b.z, a.z) * minor(0, 1));
  return sum.sign();
}

int orientation_yz(const Point& a, const Point& b, const Point& c) {
  const Interval value = (Interval(b.y) - a.y) * (Interval(c.z) - a.z) - (Interval(b.z) - a.z) * (Interval(c.y) - a.y);
  const int sure = sign_if_sure(value);
  if (sure != 0) return sure;
  return (Expansion(b.y, a.y) * Expansion(c.z, a.z) - Expansion(b.z, a.z) * Expansion(c.y, a.y)).sign();
}

int sign_of_saddle(double a, double d, double b, double c, double o) {
  const int sure = sign_if_sure((Interval(a) - o) * (Interval(d) - o) - (Interval(b) - o) * (Interval(c) - o));
  if (sure != 0) return sure;
  return (Expansion(a, o) * Expansion(d, o) - Expansion(b, o) * Expansion(c, o)).sign();
}

}  // namespace scantet::verify
