#include "scantet/base/symmetric_matrix.h"

#include <gtest/gtest.h>

#include <array>
#include <random>

#include "scantet/base/tet_volume.h"

namespace scantet {
namespace {

/// The matrix with these eigenvalues along three directions at right angles.
SymmetricMatrix with_eigenvalues(const std::array<double, 3>& values, const Vec& first, const Vec& beside) {
  const Vec third = cross(first, beside);
  const std::array<Vec, 3> axes{(1 / length(first)) * first, (1 / length(cross(third, first))) * cross(third, first),
                                (1 / length(third)) * third};
  SymmetricMatrix m{0, 0, 0, 0, 0, 0};
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec& a = axes[i];
    m.xx += values[i] * a.x * a.x;
    m.yy += values[i] * a.y * a.y;
    m.zz += values[i] * a.z * a.z;
    m.xy += values[i] * a.x * a.y;
    m.xz += values[i] * a.x * a.z;
    m.yz += values[i] * a.y * a.z;
  }
  return m;
}

TEST(SymmetricMatrix, HasTheEigenvaluesItWasMadeOf) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> any(-1, 1);
  for (const auto& values : {std::array<double, 3>{3, 1, -2}, {5, 5, 1}, {5, 1, 1}, {-1, -2, -2}, {1e8, 0, 0}}) {
    for (int i = 0; i < 100; ++i) {
      const Vec first{any(random), any(random), any(random)};
      const EigenvalueForm form = eigenvalue_form(with_eigenvalues(values, first, {any(random), any(random), 1}));
      EXPECT_NEAR(form.largest(), values[0], 1e-7 * std::abs(values[0]) + 1e-7);
      EXPECT_NEAR(form.least(), values[2], 1e-7 * std::abs(values[0]) + 1e-7);
    }
  }
}

TEST(SymmetricMatrix, EqualEigenvaluesHaveNoSpread) {
  EXPECT_EQ(eigenvalue_form({2, 2, 2, 0, 0, 0}).largest(), 2);
  EXPECT_EQ(eigenvalue_form({2, 2, 2, 0, 0, 0}).least(), 2);
}

TEST(TetVolume, IsPositiveOfPositivelyOrientedTets) {
  EXPECT_DOUBLE_EQ(tet_volume({{{0, 0, 0}, {2, 0, 0}, {0, 2, 0}, {0, 0, 2}}}), 8.0 / 6);
  EXPECT_DOUBLE_EQ(tet_volume({{{0, 0, 0}, {0, 2, 0}, {2, 0, 0}, {0, 0, 2}}}), -8.0 / 6);
}

}  // namespace
}  // namespace scantet
