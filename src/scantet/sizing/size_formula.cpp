// muParser compiles the text; its parser writes to itself while it evaluates, so every call has one of its own.
#include "scantet/sizing/size_formula.h"

#include <muParser.h>

#include <cmath>

#include "scantet/base/error.h"

namespace scantet {
namespace {

/// A parser with its variables: not to be copied or moved, as it keeps their addresses.
class Evaluation {
 public:
  explicit Evaluation(const std::string& text) {
    parser_.DefineConst("pi", 3.141592653589793);
    parser_.DefineVar("x", &x_);
    parser_.DefineVar("y", &y_);
    parser_.DefineVar("z", &z_);
    parser_.DefineVar("d", &d_);
    parser_.DefineVar("region", &region_);
    parser_.SetExpr(text);
  }
  Evaluation(const Evaluation&) = delete;
  Evaluation& operator=(const Evaluation&) = delete;

  double at(const SizePlace& place) {
    x_ = place.point.x;
    y_ = place.point.y;
    z_ = place.point.z;
    d_ = place.depth_mm;
    region_ = place.region;
    return parser_.Eval();
  }
  bool is_one_value() {
    int values = 0;
    parser_.Eval(values);
    return values == 1;
  }
  /// Whether the formula has the same value everywhere, which is no size.
  bool is_useless() {
    const double value = parser_.Eval();
    return parser_.GetUsedVar().empty() && !(std::isfinite(value) && value > 0);
  }
  bool uses(const char* variable) { return parser_.GetUsedVar().count(variable) > 0; }

 private:
  double x_ = 0;
  double y_ = 0;
  double z_ = 0;
  double d_ = 0;
  double region_ = 0;
  mu::Parser parser_;
};

/// The place of an "=" that assigns, which muParser would do silently.
std::size_t find_assignment(const std::string& text) {
  const std::string compares = "=<>!";
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] != '=') continue;
    if (i + 1 < text.size() && text[i + 1] == '=') {
      ++i;
      continue;
    }
    if (i == 0 || compares.find(text[i - 1]) == std::string::npos) return i;
  }
  return std::string::npos;
}

}  // namespace

SizeFormula::SizeFormula(std::string text, const std::string& place) : text_(std::move(text)) {
  const auto refuse = [&](const std::string& why) {
    throw Error(Fault::usage, "usage.formula",
                place + ": \"" + text_ + "\" is not a size in mm: no number, auto or file, and as a formula " + why,
                "a formula has the variables x, y, z, d (distance to the boundary, mm) and region, + - * / ^, "
                "comparisons, c ? a : b, and functions such as min, max, abs, sqrt: \"1 + 0.2*d\"");
  };
  const std::size_t assignment = find_assignment(text_);
  if (assignment != std::string::npos) {
    refuse("it is wrong at character " + std::to_string(assignment + 1) + ": \"=\" assigns, == compares");
  }
  try {
    Evaluation evaluation(text_);
    if (!evaluation.is_one_value()) refuse("it has several values");
    if (evaluation.is_useless()) refuse("it is nowhere finite and greater than 0");
    needs_depth_ = evaluation.uses("d");
  } catch (const mu::Parser::exception_type& error) {
    refuse("it is wrong at character " + std::to_string(error.GetPos() + 1) + ": " + error.GetMsg());
  }
}

void SizeFormula::sizes_at(std::span<const SizePlace> places, std::span<double> sizes) const {
  Evaluation evaluation(text_);
  for (std::size_t i = 0; i < places.size(); ++i) sizes[i] = evaluation.at(places[i]);
}

}  // namespace scantet
