// SPDX-License-Identifier: Apache-2.0
// Losses of known motions against closed forms, and of a tire that rolls.
#include "models/fe_tire/rolling/rolling_losses.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "models/fe_tire/description/reference_tires.h"
#include "models/fe_tire/element/hex8_shape.h"
#include "models/fe_tire/motion/spinning_tire.h"
#include "models/fe_tire/rolling/rolling_tire.h"

namespace latsch::fe_tire {
namespace {

constexpr double kLossPressure = 2.6e5, kSpin = 60.0;  // Pa, rad/s

/// Tire B with few columns and one Prony term on its rubber.
TireDescription lossy_tire(int sectors, bool is_zoned = false) {
  TireDescription tire = reference_tire_b();
  tire.element = ElementKind::solid_shell;
  tire.section.meridional = 13;
  tire.section.sectors = sectors;
  if (is_zoned) tire.section.sector_zones = {{8, 0.035}, {8, 0.07}};
  for (Rubber& rubber : tire.rubbers) rubber.prony = {{0.2, 2e-3}};
  return tire;
}

/// u_y = a cos(n theta) at all places of the section: a pure shear along the circumference.
Eigen::Matrix3Xd axial_wave(const Mesh& mesh, double a, int n) {
  Eigen::Matrix3Xd u = Eigen::Matrix3Xd::Zero(3, mesh.nodes());
  for (int s = 0; s < mesh.sectors; ++s)
    u.middleCols(s * mesh.nodes_per_sector(), mesh.nodes_per_sector())
        .row(1)
        .setConstant(a * std::cos(n * mesh.angle(s)));
  return u;
}

/// Power that the rubber of the wave loses: with the shear gamma = a n/r sin(n theta),
/// P = n Omega/2 G''(n Omega) times the integral of (a n/r)^2 over the volume.
double wave_power(const TireDescription& tire, const Mesh& mesh, double a, int n) {
  const Materials materials = build_materials(tire);
  const double G = 2.0 * std::get<Hyperelastic>(materials.solids[0].law).C10;
  double sum = 0.0;
  for (int s = 0; s < mesh.sectors; ++s) {
    for (const Element& element : mesh.elements) {
      const HexShape shape =
          make_shape(ElementKind::full_integration, mesh.coordinates(element, s));
      for (int q = 0; q < 8; ++q) {
        const Eigen::Vector3d X =
            shape.X * shape_functions(kGauss * kXi[q], kGauss * kEta[q], kGauss * kZeta[q]);
        sum += shape.dV[q] * std::pow(a * n, 2) / (X.x() * X.x() + X.z() * X.z());
      }
    }
  }
  const double loss = relative_modulus(tire.rubbers[0].prony, n * kSpin).imag();
  return 0.5 * n * kSpin * G * loss * sum;
}

Inflated at_rest(const Mesh& mesh) {
  Inflated none;
  none.u = Eigen::Matrix3Xd::Zero(3, mesh.nodes_per_sector());
  none.alpha = Eigen::VectorXd::Zero(8 * std::ssize(mesh.elements));
  return none;
}

/// Relative error of the rubber's power in a wave.
double error_of_wave(const TireDescription& tire, int n) {
  const FeTire fe(tire);
  const Mesh& mesh = fe.mesh();
  constexpr double kSmall = 1e-6;  // m, so that rotations do not matter
  const LossMeter meter(fe, build_losses(tire), at_rest(mesh));
  const RollingLosses losses = meter.measure(
      axial_wave(mesh, kSmall, n), Eigen::VectorXd::Zero(8 * mesh.element_count()), kSpin);
  return losses.rubber / wave_power(tire, mesh, kSmall, n) - 1.0;
}

TEST(RollingLosses, OfAWaveAreThoseOfTheComplexModulusWithSecondOrder) {
  const double coarse = error_of_wave(lossy_tire(60), 4), fine = error_of_wave(lossy_tire(120), 4);
  EXPECT_LT(std::abs(coarse), 0.05);
  EXPECT_NEAR(std::log2(coarse / fine), 2.0, 0.1);
}

TEST(RollingLosses, OfAWaveDoNotDependOnTheWidthsOfSectors) {
  EXPECT_LT(std::abs(error_of_wave(lossy_tire(60, true), 2)), 0.03);
}

TEST(RollingLosses, ComparisonElementsLoseTheSame) {
  TireDescription tire = lossy_tire(120);
  const double shell = error_of_wave(tire, 4);
  tire.element = ElementKind::full_integration;
  EXPECT_NEAR(error_of_wave(tire, 4), shell, 0.003);
}

TEST(RollingLosses, ATireThatSpinsOffTheGroundLosesNothing) {
  for (const bool is_zoned : {false, true}) {
    const TireDescription tire = lossy_tire(60, is_zoned);
    FeTire fe(tire);
    const Inflated rest = *fe.inflate(kLossPressure);
    const Inflated spun = *SpinningTire(fe).inflate(rest, kSpin);
    const Mesh& mesh = fe.mesh();
    const int n = mesh.nodes_per_sector();
    Eigen::Matrix3Xd u(3, mesh.nodes());
    for (int s = 0; s < mesh.sectors; ++s) u.middleCols(s * n, n) = spun.u;
    const Eigen::VectorXd alpha = spun.alpha.replicate(mesh.sectors, 1);
    const RollingLosses of_rest = LossMeter(fe, build_losses(tire), rest).measure(u, alpha, kSpin);
    EXPECT_LT(std::abs(of_rest.rubber), 1e-4) << is_zoned;  // W; a rolling tire loses some 100 W
    // A tire that is not round at all, for comparison.
    u.row(1) += axial_wave(mesh, 1e-3, 4).row(1);
    EXPECT_GT(LossMeter(fe, build_losses(tire), rest).measure(u, alpha, kSpin).rubber, 1.0);
  }
}

TEST(RollingLosses, GrowWithTheShareAndGoToTheirOwners) {
  TireDescription tire = lossy_tire(60);
  const FeTire fe(tire);
  const Mesh& mesh = fe.mesh();
  const Eigen::Matrix3Xd u = axial_wave(mesh, 1e-4, 3);
  const Eigen::VectorXd alpha = Eigen::VectorXd::Zero(8 * mesh.element_count());
  const auto losses = [&] {
    return LossMeter(fe, build_losses(tire), at_rest(mesh)).measure(u, alpha, kSpin);
  };
  const RollingLosses once = losses();
  EXPECT_EQ(once.cords, 0.0);
  EXPECT_NEAR(once.parts[0] + once.parts[1], once.rubber, 1e-12 * once.rubber);
  for (Rubber& rubber : tire.rubbers) rubber.prony[0].beta *= 2.0;
  EXPECT_NEAR(losses().rubber, 2.0 * once.rubber, 1e-12 * once.rubber);
  for (CordPly& ply : tire.plies) ply.prony = {{0.05, 2e-3}};
  const RollingLosses with_cords = losses();
  EXPECT_GT(with_cords.cords, 0.0);
  double sum = 0.0;
  for (const double part : with_cords.parts) sum += part;
  EXPECT_NEAR(sum, with_cords.rubber + with_cords.cords, 1e-12 * sum);
}

TEST(RollingLosses, OfAWheelThatRollsFreelyGrowWithLoadAndAreAPercentOfIt) {
  TireDescription tire = lossy_tire(60);
  for (Rubber& rubber : tire.rubbers) rubber.prony = *constant_loss_factor(0.15, 0.1, 1000.0);
  FeTire fe(tire);
  RollingTire rolling(fe);
  const Inflated inflated = *fe.inflate(kLossPressure);
  const LossMeter meter(fe, build_losses(tire), inflated);
  double before = 0.0;
  for (const double deflection : {0.01, 0.02}) {
    const auto pressed = fe.advance(fe.over(inflated, {}, FeTire::Poses::any),
                                    {FeTire::below(inflated, deflection)});
    const RollingState start = rolling.start(pressed->back());
    RollingCase of;
    of.speed = 20.0;
    of.height = start.of.height;
    of.spin = of.speed / 0.312;
    of.friction.at_rest = 0.0;
    const auto state = rolling.roll(start, of);
    ASSERT_TRUE(state) << state.failure().reason;
    const double resistance =
        meter.measure(state->u, state->alpha, of.spin).rubber / of.speed / state->forces.force.z();
    EXPECT_GT(resistance, 1.2 * before);
    before = resistance;
  }
  EXPECT_GT(before, 0.003);
  EXPECT_LT(before, 0.03);
}

}  // namespace
}  // namespace latsch::fe_tire
