// SPDX-License-Identifier: Apache-2.0
#include "models/fe_tire/element/hyperelastic.h"

#include <gtest/gtest.h>

#include <Eigen/LU>

#include "models/fe_tire/element/cord_law.h"

namespace latsch::fe_tire {
namespace {

const Vector6 kStrain = (Vector6() << 0.2, -0.15, 0.1, 0.12, -0.2, 0.07).finished();

template <class Law>
void expect_gradients(const Law& law) {
  Vector6 S;
  Matrix6 D;
  ASSERT_TRUE(stress(law, kStrain, S, &D));
  const double h = 1e-4;
  for (int k = 0; k < 6; ++k) {
    const auto at = [&](double step) {
      Vector6 E = kStrain;
      E[k] += step;
      return E;
    };
    const auto dW = [&](double s) {
      return (energy(law, at(s)) - energy(law, at(-s))) / (2.0 * s);
    };
    const auto dS = [&](double s) {
      Vector6 plus, minus;
      EXPECT_TRUE(stress(law, at(s), plus, nullptr) && stress(law, at(-s), minus, nullptr));
      return Vector6((plus - minus) / (2.0 * s));
    };
    EXPECT_NEAR((4.0 * dW(h) - dW(2.0 * h)) / 3.0, S[k], 1e-8 * S.norm());
    EXPECT_LT(((4.0 * dS(h) - dS(2.0 * h)) / 3.0 - D.col(k)).norm(), 1e-8 * D.norm());
  }
}

TEST(Hyperelastic, StressAndTangentAreDerivativesOfTheEnergy) {
  expect_gradients(Hyperelastic{.C10 = 1.0, .C01 = 0.0, .K = 100.0});
  expect_gradients(Hyperelastic{.C10 = 0.7, .C01 = 0.3, .K = 50.0});
}

TEST(Hyperelastic, SmallStrainIsHookesLaw) {
  const double E = 6e6, nu = 0.49;
  for (double ratio : {0.0, 0.25}) {
    Vector6 S;
    Matrix6 D;
    ASSERT_TRUE(stress(Hyperelastic::from_young_modulus(E, nu, ratio), Vector6::Zero(), S, &D));
    EXPECT_LT(S.norm(), 1e-9);
    const Matrix6 compliance = D.inverse();
    EXPECT_NEAR(compliance(0, 0) * E, 1.0, 1e-12);
    EXPECT_NEAR(compliance(0, 1) * E, -nu, 1e-12);
    EXPECT_NEAR(compliance(3, 3) * E, 2.0 * (1.0 + nu), 1e-12);
  }
}

// In uniaxial tension an incompressible neo-Hooke solid has the stress sigma = 2 C10 (lambda^2 -
// 1/lambda) [Holzapfel 2000, 6.5].
TEST(Hyperelastic, UniaxialTension) {
  const Hyperelastic law{.C10 = 0.5, .C01 = 0.0, .K = 1e6};
  const double lambda = 1.5;
  double t = 1.0 / std::sqrt(lambda);
  Vector6 E = Vector6::Zero(), S;
  Matrix6 D;
  for (int i = 0; i < 20; ++i) {  // finds the lateral strain at which the lateral stress vanishes
    E[0] = 0.5 * (lambda * lambda - 1.0);
    E[1] = E[2] = 0.5 * (t * t - 1.0);
    ASSERT_TRUE(stress(law, E, S, &D));
    E[1] -= S[1] / (D(1, 1) + D(1, 2));
    t = std::sqrt(1.0 + 2.0 * E[1]);
  }
  const double cauchy = S[0] * lambda * lambda / (lambda * t * t);
  EXPECT_NEAR(cauchy, 2.0 * 0.5 * (lambda * lambda - 1.0 / lambda), 1e-5);  // K / G = 1e6
}

TEST(Hyperelastic, MaterialTurnedInsideOutIsRefused) {
  Vector6 E = Vector6::Zero(), S;
  E[0] = -0.6;
  EXPECT_FALSE(stress(Hyperelastic{.C10 = 1.0, .C01 = 0.0, .K = 10.0}, E, S, nullptr));
}

TEST(CordLaw, FullModulusInTensionTheOtherInCompression) {
  const CordLayer layer{.E_tension = 2e9, .E_compression = 1e8, .pretension = 3e6};
  EXPECT_DOUBLE_EQ(stress(layer, 0.0).S, 3e6);
  EXPECT_NEAR(stress(layer, 0.01).tangent, 2e9, 1e-4 * 2e9);
  EXPECT_NEAR(stress(layer, -0.01).tangent, 1e8, 1e-4 * 2e9);
  const double h = 1e-6;
  for (double e : {-1e-4, 0.0, 3e-5, 2e-3}) {
    const double slope = (stress(layer, e + h).S - stress(layer, e - h).S) / (2.0 * h);
    EXPECT_NEAR(slope, stress(layer, e).tangent, 1e-4 * 2e9);
  }
}

}  // namespace
}  // namespace latsch::fe_tire
