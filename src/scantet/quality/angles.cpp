// The arc tangent of Cephes (Moshier, Methods and programs for mathematical functions, 1989): its argument is brought
// under 0.66 with the addition theorem for π/4 or π/2, there a rational function is right to the last digit. Without
// branches, and with one division less, as the argument is a quotient anyway. Vectors are those of GCC and Clang.
#include "scantet/quality/angles_impl.h"

namespace scantet {
namespace {

// Two numbers at once, as every processor of 64 bits has it.
using Pair = double __attribute__((vector_size(2 * sizeof(double))));

constexpr double kPi = 3.14159265358979323846;
constexpr double kPiRest = 1.2246467991473531772e-16;  // π less its double

Pair angle(Pair sine, Pair cosine) {
  constexpr double kTan3Pi8 = 2.41421356237309504880;
  constexpr double kMiddle = 0.66;
  const Pair zero{};
  const Pair adjacent = cosine < zero ? -cosine : cosine;
  const auto is_steep = sine > kTan3Pi8 * adjacent;
  const auto is_flat = sine <= kMiddle * adjacent;
  const Pair above = is_steep ? -adjacent : (is_flat ? sine : sine - adjacent);
  const Pair below = is_steep ? sine : (is_flat ? adjacent : sine + adjacent);
  const Pair base = is_steep ? zero + kPi / 2 : (is_flat ? zero : zero + kPi / 4);
  const Pair rest = is_steep ? zero + kPiRest / 2 : (is_flat ? zero : zero + kPiRest / 4);
  const Pair x = above / (below == zero ? zero + 1.0 : below);
  const Pair z = x * x;
  const Pair p = (((-8.750608600031904122785E-1 * z - 1.615753718733365076637E1) * z - 7.500855792314704667340E1) * z -
                  1.228866684490136173410E2) *
                     z -
                 6.485021904942025371773E1;
  const Pair q =
      ((((z + 2.485846490142306297962E1) * z + 1.650270098316988542046E2) * z + 4.328810604912902668951E2) * z +
       4.853903996359136964868E2) *
          z +
      1.945506571482613964425E2;
  const Pair first = base + (x + (x * z * p / q + rest));
  return cosine < zero ? (kPi - first) + kPiRest : first;
}

}  // namespace

std::array<double, 6> angles_deg(const std::array<double, 6>& sines, const std::array<double, 6>& cosines) {
  std::array<double, 6> degrees{};
  for (std::size_t i = 0; i < 6; i += 2) {
    const Pair pair = 180.0 / kPi * angle(Pair{sines[i], sines[i + 1]}, Pair{cosines[i], cosines[i + 1]});
    degrees[i] = pair[0];
    degrees[i + 1] = pair[1];
  }
  return degrees;
}

}  // namespace scantet
