// Theorem 3: alpha < 1/5, facet_radius_edge >= 1/(1 - γ), cell_radius_edge >= 4/(1 - 5γ), with γ = max(alpha, 0.03).
// Theorem 5 adds θ < 18.6° and facet_radius_edge < sin(60° - θ) / (2 sin θ), for lr_k with k = tan θ. Both start from a
// 0.09 d_M-sample (I1), or one of lr_k.
#include "scantet/app/proven_range.h"

#include <cmath>

#include "scantet/base/options.h"

namespace scantet {
namespace {

constexpr double kMostAlpha = 0.2;
constexpr double kLeastGamma = 0.03;
constexpr double kMostShare = 0.09;
constexpr double kMostThetaDeg = 18.6;
constexpr double kRounding = 1e-9;  // a bound typed with all its digits holds
constexpr double kRadians = 3.141592653589793 / 180;

/// Collects the bounds that do not hold, as parts of sentences.
class Needs {
 public:
  void at_least(const char* option, double value, double bound) {
    if (value < bound * (1 - kRounding)) add(option, " at least ", bound, value);
  }
  void under(const char* option, double value, double bound) {
    if (value >= bound) add(option, " under ", bound, value);
  }
  void at_most(const char* option, double value, double bound) {
    if (value > bound * (1 + kRounding)) add(option, " at most ", bound, value);
  }
  const std::vector<std::string>& texts() const { return texts_; }

 private:
  void add(const char* option, const char* relation, double bound, double value) {
    texts_.push_back(option + (relation + number_text(bound, 4)) + " (here " + number_text(value, 4) + ")");
  }
  std::vector<std::string> texts_;
};

std::string listed(const std::vector<std::string>& texts) {
  std::string list;
  for (std::size_t i = 0; i < texts.size(); ++i) {
    list += (i == 0 ? "" : i + 1 < texts.size() ? ", " : " and ") + texts[i];
  }
  return list;
}

}  // namespace

std::optional<ReportTheory> beyond_proofs(const MesherOptions& mesher, const SizeOptions& sizes) {
  const bool automatic = (sizes.boundary_size.empty() ? sizes.size : sizes.boundary_size) == "auto";
  const bool lipschitz = automatic && sizes.lipschitz_k;
  const double gamma = mesher.bounds.alpha < kMostAlpha ? std::max(mesher.bounds.alpha, kLeastGamma) : kLeastGamma;
  Needs needs;
  needs.under("--alpha", mesher.bounds.alpha, kMostAlpha);
  needs.at_least("--facet-radius-edge", mesher.bounds.facet_radius_edge, 1 / (1 - gamma));
  if (lipschitz) {
    const double theta = std::atan(*sizes.lipschitz_k);
    needs.under("--lipschitz", *sizes.lipschitz_k, std::tan(kMostThetaDeg * kRadians));
    needs.under("--facet-radius-edge x --small-slack", mesher.bounds.facet_radius_edge * mesher.bounds.small_slack,
                std::max(0.0, std::sin(60 * kRadians - theta) / (2 * std::sin(theta))));
  }
  needs.at_least("--cell-radius-edge", mesher.bounds.cell_radius_edge, 4 / (1 - 5 * gamma));
  if (automatic) {
    needs.at_most("--feature-share x --alpha", sizes.feature_share.value_or(kFeatureShare) * mesher.bounds.alpha,
                  kMostShare);
  }
  if (needs.texts().empty()) return std::nullopt;
  const std::string theorem = std::string("Theorem ") + (lipschitz ? "5" : "3");
  return ReportTheory{theorem, needs.texts(),
                      theorem +
                          " of the paper proves that refinement ends and that the mesh has the topology of the "
                          "object, for " +
                          listed(needs.texts()) +
                          ". Other bounds, the defaults among them, make smaller meshes, without that "
                          "proof. The audit checks the topology of this mesh, whatever the bounds."};
}

std::string theory_note(const ReportTheory& theory) {
  return theory.theorem + " proves that refinement ends and that the mesh has the topology of the object for " +
         listed(theory.needed) + "; the audit checks this mesh anyway; --no-theory hides this";
}

}  // namespace scantet
