// Theorem 3: alpha < 1/5, facet_radius_edge >= 1/(1 - γ), cell_radius_edge >= 4/(1 - 5γ), with γ = max(alpha, 0.03).
// Theorem 5 adds θ < 18.6° and facet_radius_edge < sin(60° - θ) / (2 sin θ), for lr_k with k = tan θ. Both start from a
// 0.09 d_M-sample (I1), or one of lr_k.
#include "scantet/app/proven_range.h"

#include <cmath>

namespace scantet {
namespace {

constexpr double kMostAlpha = 0.2;
constexpr double kLeastGamma = 0.03;
constexpr double kMostShare = 0.09;
constexpr double kMostThetaDeg = 18.6;
constexpr double kRounding = 1e-9;  // a bound typed with all its digits holds
constexpr double kRadians = 3.141592653589793 / 180;

class Excesses {
 public:
  void at_least(const char* option, double value, double bound) {
    if (value < bound * (1 - kRounding)) add(option, value, "at least ", bound, bound - value, " short");
  }
  void under(const char* option, double value, double bound) {
    if (value >= bound) add(option, value, "under ", bound, value - bound, " too much");
  }
  void at_most(const char* option, double value, double bound) {
    if (value > bound * (1 + kRounding)) add(option, value, "at most ", bound, value - bound, " too much");
  }
  const std::string& text() const { return text_; }

 private:
  void add(const char* option, double value, const char* relation, double bound, double excess, const char* how) {
    text_ += std::string(text_.empty() ? "" : ", ") + option + " " + number_text(value, 4) + " must be " + relation +
             number_text(bound, 4) + " (" + number_text(excess, 4) + how + ")";
  }
  std::string text_;
};

}  // namespace

std::optional<std::string> beyond_proofs(const MesherOptions& mesher, const SizeOptions& sizes) {
  const bool automatic = sizes.size == "auto" || sizes.boundary_size == "auto";
  const bool lipschitz = automatic && sizes.lipschitz_k;
  const double gamma = mesher.alpha < kMostAlpha ? std::max(mesher.alpha, kLeastGamma) : kLeastGamma;
  Excesses excesses;
  excesses.under("--alpha", mesher.alpha, kMostAlpha);
  excesses.at_least("--facet-radius-edge", mesher.facet_radius_edge, 1 / (1 - gamma));
  if (lipschitz) {
    const double theta = std::atan(*sizes.lipschitz_k);
    excesses.under("--lipschitz", *sizes.lipschitz_k, std::tan(kMostThetaDeg * kRadians));
    excesses.under("--facet-radius-edge", mesher.facet_radius_edge,
                   std::max(0.0, std::sin(60 * kRadians - theta) / (2 * std::sin(theta))));
  }
  excesses.at_least("--cell-radius-edge", mesher.cell_radius_edge, 4 / (1 - 5 * gamma));
  if (automatic) {
    excesses.at_most("--feature-share x --alpha", sizes.feature_share.value_or(kFeatureShare) * mesher.alpha,
                     kMostShare);
  }
  if (excesses.text().empty()) return std::nullopt;
  return "beyond what Theorem " + std::string(lipschitz ? "5" : "3") +
         " proves (termination, topology): " + excesses.text() +
         "; the audit tells how it went; --no-theory hides this";
}

}  // namespace scantet
