// A sum that has a min or max among its summands is the min or max of two sums, if its factor is positive, else the
// other of the two; abs(u) is max(u, -u). So summands are taken apart until none has such a kink.
#include "sign_tree.h"

#include <algorithm>
#include <cmath>

#include "scantet/base/error.h"

namespace implicit {
namespace {

constexpr std::size_t kMostParts = 32;
constexpr std::size_t kMostNodes = 512;

[[noreturn]] void refuse(const std::string& what) {
  throw scantet::Error(scantet::Fault::input, "input.formula", "--sharp-edges: the formula " + what,
                       "leave out --sharp-edges, or make the formula simpler");
}

bool is_constant(const Terms& terms, std::size_t term) {
  return terms.all[term].operation == Operation::constant;
}

double middle(const Interval& interval) {
  return 0.5 * (interval.lo + interval.hi);
}

}  // namespace

SignTree::SignTree(const std::string& text) {
  const Terms terms = parse_formula(text, true);
  build(terms, {{1, terms.whole}});
}

std::size_t SignTree::build(const Terms& terms, Sum sum) {
  if (++depth_ > kMostNodes) refuse("has too many min, max and abs");
  for (std::size_t at = 0; at < sum.size();) {
    const std::size_t before = sum.size();
    const Summand old = sum[at];
    if (const auto node = take_apart(terms, sum, at)) {
      --depth_;
      return *node;
    }
    if (sum.size() == before && sum[at] == old) ++at;  // it is smooth
  }
  --depth_;
  return part_of(terms, std::move(sum));
}

std::optional<std::size_t> SignTree::take_apart(const Terms& terms, Sum& sum, std::size_t at) {
  const auto [factor, index] = sum[at];
  const Term& term = terms.all[index];
  switch (term.operation) {
    case Operation::negate:
      sum[at] = {-factor, term.first};
      return std::nullopt;
    case Operation::add:
    case Operation::subtract:
      sum[at] = {factor, term.first};
      sum.push_back({term.operation == Operation::add ? factor : -factor, term.second});
      return std::nullopt;
    case Operation::multiply:
      if (is_constant(terms, term.first)) {
        sum[at] = {factor * terms.all[term.first].value, term.second};
      } else if (is_constant(terms, term.second)) {
        sum[at] = {factor * terms.all[term.second].value, term.first};
      }
      return std::nullopt;
    case Operation::divide:
      if (is_constant(terms, term.second)) sum[at] = {factor / terms.all[term.second].value, term.first};
      return std::nullopt;
    case Operation::minimum:
    case Operation::maximum:
    case Operation::absolute:
      break;
    default:
      return std::nullopt;
  }
  const bool is_abs = term.operation == Operation::absolute;
  Sum other = sum;
  sum[at] = {factor, term.first};
  other[at] = is_abs ? Summand{-factor, term.first} : Summand{factor, term.second};
  const bool is_max = (is_abs || term.operation == Operation::maximum) == (factor > 0);
  const std::size_t first = build(terms, std::move(sum));
  const std::size_t second = build(terms, std::move(other));
  nodes_.push_back({false, is_max, first, second, false});
  return nodes_.size() - 1;
}

/// A part that is there already, with either sign, is not made anew.
std::size_t SignTree::part_of(const Terms& terms, Sum sum) {
  if (nodes_.size() >= kMostNodes) refuse("has too many min, max and abs");
  std::sort(sum.begin(), sum.end(), [](const Summand& a, const Summand& b) { return a.term < b.term; });
  Sum joined;
  for (const Summand& summand : sum) {
    if (!joined.empty() && joined.back().term == summand.term) {
      joined.back().factor += summand.factor;
    } else {
      joined.push_back(summand);
    }
  }
  std::erase_if(joined, [](const Summand& summand) { return summand.factor == 0; });
  if (joined.empty()) joined.push_back(sum.front());
  const bool flipped = joined.front().factor < 0;
  for (Summand& summand : joined) summand.factor = flipped ? -summand.factor : summand.factor;
  const auto known = std::find(sums_.begin(), sums_.end(), joined);
  const auto part = static_cast<std::size_t>(known - sums_.begin());
  if (known == sums_.end()) {
    if (sums_.size() == kMostParts) refuse("has more than 32 smooth parts");
    Terms own = terms;
    const auto add = [&own](Term term) {
      own.all.push_back(term);
      return own.all.size() - 1;
    };
    std::optional<std::size_t> total;
    for (const Summand& summand : joined) {
      const std::size_t factor = add({Operation::constant, 0, 0, summand.factor});
      const std::size_t product = add({Operation::multiply, factor, summand.term});
      total = total ? add({Operation::add, *total, product}) : product;
    }
    own.whole = *total;
    std::optional<Program> program = lay_out(own);
    if (!program) refuse("has a part that is too long");
    parts_.emplace_back(std::move(*program));
    sums_.push_back(std::move(joined));
  }
  nodes_.push_back({true, false, part, 0, flipped});
  return nodes_.size() - 1;
}

SurfaceValue SignTree::at(std::size_t part, const scantet::Point& p) const {
  const auto exact = [](double value) { return Interval{value, value}; };
  const Slopes found = parts_[part](Slopes{exact(p.x), {exact(1), exact(0), exact(0)}},
                                    Slopes{exact(p.y), {exact(0), exact(1), exact(0)}},
                                    Slopes{exact(p.z), {exact(0), exact(0), exact(1)}});
  return {value(part, p), {middle(found.rate.x), middle(found.rate.y), middle(found.rate.z)}};
}

bool SignTree::is_inside(std::size_t node, const std::vector<char>& negative) const {
  const Node& at = nodes_[node];
  if (at.is_part) return (negative[at.first] != 0) != at.flipped;
  const bool first = is_inside(at.first, negative);
  const bool second = is_inside(at.second, negative);
  return at.is_max ? first && second : first || second;
}

bool SignTree::depends_on(std::size_t a, std::size_t b, std::vector<char> negative) const {
  const auto inside = [&](char of_a, char of_b) {
    negative[a] = of_a;
    negative[b] = of_b;
    return is_inside(negative);
  };
  const bool none = inside(0, 0);
  const bool first = inside(1, 0);
  const bool second = inside(0, 1);
  const bool both = inside(1, 1);
  return (none != first || second != both) && (none != second || first != both);
}

int SignTree::side_of(std::size_t a, std::size_t b, std::vector<char> negative) const {
  for (const char of_b : {1, 0}) {
    negative[b] = of_b;
    negative[a] = 1;
    const bool below = is_inside(negative);
    negative[a] = 0;
    if (below != is_inside(negative)) return below ? 1 : -1;
  }
  return 1;
}

}  // namespace implicit
