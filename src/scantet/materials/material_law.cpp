#include "scantet/materials/material_law.h"

#include <algorithm>
#include <cmath>

namespace scantet {
namespace {

double by_pieces(const std::vector<LawPiece>& pieces, double x) {
  const auto piece = std::find_if(pieces.begin(), pieces.end() - 1, [x](const LawPiece& p) { return x < p.below; });
  return piece->a + piece->b * std::pow(x, piece->c);
}

}  // namespace

double MaterialLaw::density_of(double value) const {
  const double density = density_a + density_b * value;
  return std::max(0.0, ash.empty() ? density : by_pieces(ash, density));
}

double MaterialLaw::modulus_of_density(double density) const {
  return by_pieces(modulus, std::max(0.0, density));
}

std::vector<double> bins_of(const std::vector<double>& moduli_mpa, double width_mpa) {
  const double highest = *std::max_element(moduli_mpa.begin(), moduli_mpa.end());
  std::vector<double> bins;
  bins.reserve(moduli_mpa.size());
  for (const double modulus : moduli_mpa) bins.push_back(std::ceil((highest - modulus) / width_mpa));
  return bins;
}

std::vector<double> even_bins_of(const std::vector<double>& moduli_mpa, double number) {
  const auto [low, high] = std::minmax_element(moduli_mpa.begin(), moduli_mpa.end());
  const double width_mpa = *high > *low ? (*high - *low) / number : 1;
  std::vector<double> bins;
  bins.reserve(moduli_mpa.size());
  for (const double modulus : moduli_mpa)
    bins.push_back(std::min(number - 1, std::floor((*high - modulus) / width_mpa)));
  return bins;
}

}  // namespace scantet
