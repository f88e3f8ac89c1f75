// SPDX-License-Identifier: Apache-2.0
// Tests third derivatives of an element's energy against finite differences of its stiffness in
// every kernel set. Tests derivatives with respect to parameters against finite differences of its
// forces and stiffness.
#include "models/fe_tire/element/hex8_motions.h"

#include <gtest/gtest.h>

#include <cmath>

#include "numerics/kernels/kernel_set.h"

namespace latsch::fe_tire {
namespace {

// The pressure is zero, because gas on a single face, which encloses no volume, has no energy that
// could be differentiated.
constexpr double kGasPressure = 0.0;

Matrix38 corners_of_belt() {
  Matrix38 X;
  for (int a = 0; a < 8; ++a) {
    const double r = 0.3 + 4e-3 * kZeta[a] + 1e-3 * kEta[a], theta = 0.03 * kXi[a];
    X.col(a) << r * std::sin(theta), -6e-3 * kEta[a], -r * std::cos(theta);
  }
  return X;
}

Matrix38 motion_field(double size, double seed) {
  Matrix38 u;
  for (int k = 0; k < 24; ++k) u.data()[k] = size * std::sin(seed + 1.7 * k + 0.3 * k * k);
  return u;
}

struct MovedElement {
  HexShape shape;
  Materials materials;
  Element element;
  Matrix38 u = motion_field(3e-4, 0.4), phi = motion_field(1.0, 1.1), zeta = motion_field(1.0, 2.3);

  explicit MovedElement(ElementKind kind) : shape(make_shape(kind, corners_of_belt())) {
    materials.solids = {{Hyperelastic{1e6, 2e5, 5e7}, 1100.0}};
    materials.layers = {{.E_tension = 2e9,
                         .E_compression = 2e8,
                         .thickness = 5e-4,
                         .angle = 0.4,
                         .pretension = 1e5,
                         .density = 1400.0}};
    element.inner = true;
    element.rebars = {{0, 0.3}};
  }
  ElementLaw law() const { return element_law(shape, materials, element); }
  int alphas() const { return internal_parameters(shape.kind); }
  /// Returns forces and stiffness at the displacement u, with alpha in equilibrium.
  ElementBatch at(const ElementLaw& of, const Matrix38& place) const {
    ElementBatch batch;
    batch.count = 1;
    const std::array<double, 8> none{};
    batch.set(0, place, none.data(), alphas());
    EXPECT_EQ(evaluate(of, {.pressure = kGasPressure}, Stiffness::exact, batch), 1u);
    return batch;
  }
  ElementMotion motion() const {
    ElementMotion motion{};
    for (int k = 0; k < 24; ++k) {
      motion.mode[k][0] = phi.data()[k];
      motion.along[k][0] = zeta.data()[k];
    }
    return motion;
  }
};

Vector24 stiffness_times(const ElementBatch& batch, const Matrix38& phi, Vector24* f = nullptr) {
  Vector24 force;
  Matrix24 K;
  std::array<double, 8> enhanced{};
  batch.take(0, force, &K, enhanced.data(), 8);
  if (f) *f = force;
  return K * Vector24::Map(phi.data());
}

class ElementMotions : public testing::TestWithParam<ElementKind> {};

TEST_P(ElementMotions, CurvatureIsTheChangeOfStiffness) {
  for (const KernelSet set : kernel_sets()) {
    const WithKernelSet with(set);
    const MovedElement of(GetParam());
    const ElementLaw law = of.law();
    ElementBatch batch = of.at(law, of.u);
    std::vector<ElementMotion> motions = {of.motion()};
    ElementSurroundings around{.pressure = kGasPressure};
    ASSERT_TRUE(add_curvatures(law, around, batch, motions));
    // Step of the differences, m; their error is of order h^4: 2.0e-6 at 4 um, 1.2e-7 at 2 um.
    constexpr double h = 1.5e-6;
    const auto change = [&](double step) {
      return Vector24((stiffness_times(of.at(law, of.u + step * of.phi), of.phi) -
                       stiffness_times(of.at(law, of.u - step * of.phi), of.phi)) /
                      (2.0 * step));
    };
    const Vector24 expected = (4.0 * change(0.5 * h) - change(h)) / 3.0;
    for (int k = 0; k < 24; ++k) {
      EXPECT_NEAR(motions[0].curvature[k][0], expected[k], 1e-7 * expected.norm())
          << name(set) << ", unknown " << k;
    }
  }
}

// If alpha is in equilibrium and the positions are kept, d/dp (phi.K phi + zeta.f) equals dL/dp of
// (M.4).
TEST_P(ElementMotions, SlopesInNumbersAreThoseOfForcesAndStiffness) {
  const MovedElement of(GetParam());
  const ElementLaw law = of.law();
  const auto moved = [&](int number, double share) {
    MovedElement other(GetParam());
    auto& rubber = std::get<Hyperelastic>(other.materials.solids[0].law);
    double* const numbers[] = {&rubber.C10,
                               &rubber.C01,
                               &rubber.K,
                               &other.materials.layers[0].E_tension,
                               &other.materials.layers[0].thickness,
                               &other.materials.layers[0].angle};
    *numbers[number] *= 1.0 + share;
    return other;
  };
  for (int number = 0; number < 6; ++number) {
    ElementBatch batch = of.at(law, of.u);
    std::vector<ElementMotion> motions = {of.motion()};
    ASSERT_TRUE(add_curvatures(law, {.pressure = kGasPressure}, batch, motions));
    ASSERT_TRUE(follow_along(law, batch, motions));
    const auto slope = [&](double h) {
      const MovedElement below = moved(number, -h), above = moved(number, h);
      const ElementLaw laws[] = {below.law(), above.law()};
      const VariedElement varied[] = {{&laws[0], kGasPressure}, {&laws[1], kGasPressure}};
      alignas(64) double sums[2][ElementBatch::kLanes];
      sum_motions(varied, 0, batch, motions, sums);
      return (sums[1][0] - sums[0][0]) / (2.0 * h);
    };
    const auto difference = [&](double h) {
      double sides[2];
      for (const bool up : {false, true}) {
        const MovedElement tire = moved(number, up ? h : -h);
        const ElementLaw other = tire.law();
        Vector24 f;
        const Vector24 Kphi = stiffness_times(of.at(other, of.u), of.phi, &f);
        sides[up] = Kphi.dot(Vector24::Map(of.phi.data())) + f.dot(Vector24::Map(of.zeta.data()));
      }
      return (sides[1] - sides[0]) / (2.0 * h);
    };
    const double expected = (4.0 * difference(5e-4) - difference(1e-3)) / 3.0;
    const double found = slope(1e-4);
    EXPECT_NEAR(found, expected, 1e-6 * std::abs(expected)) << number;
    // L is linear in the moduli, so differences are exact for any step.
    if (number < 4) {
      EXPECT_NEAR(slope(0.1), found, 1e-9 * std::abs(found)) << number;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(BothElements,
                         ElementMotions,
                         testing::Values(ElementKind::solid_shell, ElementKind::full_integration));

}  // namespace
}  // namespace latsch::fe_tire
