// Terms are computed in the order in which they were read. A term leaves its place to another when it has been used for
// the last time. Sine and cosine of one term are computed together, with the first of them.
#include "formula.h"

namespace implicit {
namespace {

class Layout {
 public:
  explicit Layout(const Terms& terms);

  /// False if there are too few places.
  bool run() {
    for (std::size_t i = 0; i <= terms_.whole; ++i) {
      if (uses_[i] > 0 && !places_[i] && !compute(i)) return false;
    }
    return true;
  }
  Program program() { return {std::move(steps_), *places_[terms_.whole]}; }

 private:
  static constexpr std::uint8_t kVariables = 3;

  bool compute(std::size_t index);
  bool take(std::size_t index);
  void release(std::size_t index) {
    if (--uses_[index] == 0 && *places_[index] >= kVariables) free_.push_back(*places_[index]);
  }

  const Terms& terms_;
  std::vector<int> uses_;  // that are to come, of each term
  std::vector<std::optional<std::uint8_t>> places_;
  std::vector<std::optional<std::size_t>> sines_, cosines_;  // of each term
  std::vector<std::uint8_t> free_;
  std::vector<Step> steps_;
};

Layout::Layout(const Terms& terms)
    : terms_(terms),
      uses_(terms.all.size(), 0),
      places_(terms.all.size()),
      sines_(terms.all.size()),
      cosines_(terms.all.size()) {
  uses_[terms.whole] = 1;
  for (std::size_t i = terms.whole + 1; i-- > 0;) {
    const Term& term = terms.all[i];
    if (uses_[i] == 0) continue;
    if (operands(term.operation) > 0) ++uses_[term.first];
    if (operands(term.operation) > 1) ++uses_[term.second];
    if (term.operation == Operation::sine) sines_[term.first] = i;
    if (term.operation == Operation::cosine) cosines_[term.first] = i;
  }
  for (std::uint8_t place = Program::kMostPlaces; place-- > kVariables;) free_.push_back(place);
}

bool Layout::compute(std::size_t index) {
  const Term& term = terms_.all[index];
  if (term.operation <= Operation::z) {
    places_[index] = static_cast<std::uint8_t>(term.operation);
    return true;
  }
  Step step{term.operation, 0, 0, 0, 0, term.exponent, term.value};
  const std::size_t count = operands(term.operation);
  if (count > 0) step.first = *places_[term.first];
  if (count > 1) step.second = *places_[term.second];
  if (count > 0) release(term.first);
  if (count > 1) release(term.second);
  const bool wave = term.operation == Operation::sine || term.operation == Operation::cosine;
  if (wave && sines_[term.first] && cosines_[term.first]) {
    const std::size_t sine = *sines_[term.first];
    const std::size_t cosine = *cosines_[term.first];
    release(term.first);
    if (!take(sine) || !take(cosine)) return false;
    step.operation = Operation::sine_and_cosine;
    step.result = *places_[sine];
    step.cosine = *places_[cosine];
  } else {
    if (!take(index)) return false;
    step.result = *places_[index];
  }
  steps_.push_back(step);
  return true;
}

bool Layout::take(std::size_t index) {
  if (free_.empty()) return false;
  places_[index] = free_.back();
  free_.pop_back();
  return true;
}

}  // namespace

std::optional<Program> lay_out(const Terms& terms) {
  Layout layout(terms);
  if (!layout.run()) return std::nullopt;
  return layout.program();
}

}  // namespace implicit
