// From the values of a scan to stiffness: docs/materials.md.
#pragma once

#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace scantet {

/// A piece of a law: what it gives below `below`, from where the piece before ends.
struct LawPiece {
  double below = std::numeric_limits<double>::infinity();
  double a = 0;
  double b = 1;
  double c = 1;  ///< a + b x^c
};

/// What is averaged over a tet; voxels, nodes: moduli, of the voxels in it or of its corners.
enum class Integrate { hu, density, modulus, voxels, nodes };

/// The modulus that a bin of several has.
enum class BinModulus { max, mean };

struct MaterialLaw {
  std::string scan;                  ///< a path
  std::vector<std::string> regions;  ///< names or numbers; empty: all without constants
  double density_a = 0;              ///< radiological density in g/cm³ = a + b · value
  double density_b = 0.001;
  std::vector<LawPiece> ash;      ///< of that density, another one (c is 1); empty: the same
  std::vector<LawPiece> modulus;  ///< of that density, MPa; not empty
  Integrate integrate = Integrate::modulus;
  double least_modulus_mpa = 1e-3;
  double poissons_ratio = 0.3;
  std::optional<double> conductivity;
  double bin_width_mpa = 0;  ///< 0: by number
  double bin_number = 0;     ///< 0: no bins, each modulus a material
  BinModulus bin_modulus = BinModulus::max;

  double density_of(double value) const;            ///< g/cm³, at least 0
  double modulus_of_density(double density) const;  ///< MPa
};

/// Moduli in bins, from the largest down: the largest alone, then widths of `width_mpa`, the upper end of each not in
/// it, as py_bonemat has them. width_mpa > 0. Return: the bin of each, from 0; some may be empty.
std::vector<double> bins_of(const std::vector<double>& moduli_mpa, double width_mpa);

/// Moduli in `number` bins of one width, from the largest down; the upper end of each is in it. number >= 1. Return:
/// the bin of each, from 0; some may be empty.
std::vector<double> even_bins_of(const std::vector<double>& moduli_mpa, double number);

}  // namespace scantet
