// The arc tangent of Cephes (Moshier, Methods and programs for mathematical functions, 1989): its argument is brought
// under 0.66 with the addition theorem for π/4 or π/2, there a rational function is right to the last digit. Without
// branches, and with one division less, as the argument is a quotient anyway. Vectors are those of GCC and Clang.
#include "scantet/quality/angles_impl.h"

namespace scantet {
namespace {

constexpr std::size_t kLanes = 8;  // the last two are not used
using Lanes = double __attribute__((vector_size(kLanes * sizeof(double))));

constexpr double kPi = 3.14159265358979323846;
constexpr double kPiRest = 1.2246467991473531772e-16;  // π less its double

}  // namespace

std::array<double, 6> angles_deg(const std::array<double, 6>& sines, const std::array<double, 6>& cosines) {
  constexpr double kTan3Pi8 = 2.41421356237309504880;
  constexpr double kMiddle = 0.66;
  const Lanes sine{sines[0], sines[1], sines[2], sines[3], sines[4], sines[5], 0, 0};
  const Lanes cosine{cosines[0], cosines[1], cosines[2], cosines[3], cosines[4], cosines[5], 1, 1};
  const Lanes zero{};
  const Lanes one = zero + 1.0;
  const Lanes adjacent = cosine < zero ? -cosine : cosine;
  const auto is_steep = sine > kTan3Pi8 * adjacent;
  const auto is_flat = sine <= kMiddle * adjacent;
  const Lanes above = is_steep ? -adjacent : (is_flat ? sine : sine - adjacent);
  const Lanes below = is_steep ? sine : (is_flat ? adjacent : sine + adjacent);
  const Lanes base = is_steep ? zero + kPi / 2 : (is_flat ? zero : zero + kPi / 4);
  const Lanes rest = is_steep ? zero + kPiRest / 2 : (is_flat ? zero : zero + kPiRest / 4);
  const Lanes x = above / (below == zero ? one : below);
  const Lanes z = x * x;
  const Lanes p = (((-8.750608600031904122785E-1 * z - 1.615753718733365076637E1) * z - 7.500855792314704667340E1) * z -
                   1.228866684490136173410E2) *
                      z -
                  6.485021904942025371773E1;
  const Lanes q =
      ((((z + 2.485846490142306297962E1) * z + 1.650270098316988542046E2) * z + 4.328810604912902668951E2) * z +
       4.853903996359136964868E2) *
          z +
      1.945506571482613964425E2;
  const Lanes angle = base + (x + (x * z * p / q + rest));
  const Lanes whole = cosine < zero ? (kPi - angle) + kPiRest : angle;
  std::array<double, 6> degrees;
  for (std::size_t i = 0; i < degrees.size(); ++i) degrees[i] = 180.0 / kPi * whole[i];
  return degrees;
}

}  // namespace scantet
