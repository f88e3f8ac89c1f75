// SPDX-License-Identifier: Apache-2.0
// Responses of tire B with few columns. The references do not depend on shapes and ports:
// differences of equilibria, and tires with other moduli.
#include "models/fe_tire/motion/tire_response.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "models/fe_tire/description/reference_tires.h"

namespace latsch::fe_tire {
namespace {

constexpr double kResponsePressure = 2.6e5;  // Pa
constexpr double kSlow = 0.1;                // Hz, far below any mode

TireDescription responding_tire(const PronyTerms& of_rubber = {}) {
  TireDescription tire = reference_tire_b();
  tire.element = ElementKind::solid_shell;
  tire.cord_model = CordModel::rebar;
  tire.section.meridional = 13;
  tire.section.sectors = 40;
  tire.section.sector_zones.clear();
  for (Rubber& rubber : tire.rubbers) rubber.prony = of_rubber;
  return tire;
}

ResponsePort ground_along(int d, bool turns = false) {
  return {.of = ResponsePort::Of::ground, .axis = Eigen::Vector3d::Unit(d), .turns = turns};
}
ResponsePort wheel_along(int d, bool turns = false) {
  return {.of = ResponsePort::Of::wheel, .axis = Eigen::Vector3d::Unit(d), .turns = turns};
}
/// The lowest tread node in the middle plane of the section plane.
ResponsePort tread_point(const Mesh& mesh, int plane, int d) {
  const int sensor = mesh.sensors[mesh.sensors.size() / 2];
  return {.node = plane * mesh.nodes_per_sector() + sensor, .axis = Eigen::Vector3d::Unit(d)};
}

// Half of the ring represents all of it, or the whole is computed; losses have died out at 0.1 Hz.
TEST(TireResponse, SlowlyIsTheSlopeOfTheStaticLoad) {
  const TireDescription tire = responding_tire(*constant_loss_factor(0.15, 10.0, 1000.0));
  const LossMaterials losses = build_losses(tire);
  FeTire fe(tire);
  const Inflated inflated = *fe.inflate(kResponsePressure);
  constexpr double kDeflection = 0.015, kStep = 1e-5;
  const auto pressed =
      fe.press(inflated, {}, {kDeflection - kStep, kDeflection, kDeflection + kStep});
  ASSERT_TRUE(pressed) << pressed.failure().reason;
  const double slope =
      (fe.stand((*pressed)[2]).force.z() - fe.stand((*pressed)[0]).force.z()) / (2.0 * kStep);
  const std::vector<ResponsePort> ports = {ground_along(2), wheel_along(2)};
  for (const auto poses : {FeTire::Poses::below, FeTire::Poses::any}) {
    const auto state =
        fe.advance(fe.over(inflated, {}, poses), {FeTire::below(inflated, kDeflection)});
    const auto response = TireResponse::about(fe, losses, state->back(), ports, {.highest = 60.0});
    ASSERT_TRUE(response) << response.failure().reason;
    const Eigen::MatrixXcd H = response->at(kSlow);
    // Rows: force on the tire, force on the rim; columns: ground up, wheel up.
    EXPECT_NEAR(H(0, 0).real() / slope, 1.0, 1e-3);
    EXPECT_NEAR(H(1, 0).real() / slope, 1.0, 1e-3);
    EXPECT_NEAR(H(1, 1).real() / slope, -1.0, 1e-3);
    EXPECT_NEAR(H(0, 1).real() / slope, -1.0, 1e-3);
  }
}

// Ground with much friction that moves a little: all points stick.
TEST(TireResponse, SlowlyIsTheSlopeOfForcesOnGroundThatSticks) {
  const TireDescription tire = responding_tire();
  FeTire fe(tire);
  const Inflated inflated = *fe.inflate(kResponsePressure);
  const Ground rough{.mu = 5.0};
  const GroundPose pose = FeTire::below(inflated, 0.012);
  const auto standing = fe.advance(fe.over(inflated, rough, FeTire::Poses::any), {pose});
  ASSERT_TRUE(standing) << standing.failure().reason;
  const std::vector<ResponsePort> ports = {ground_along(0),
                                           ground_along(1),
                                           ground_along(2, true),
                                           wheel_along(0),
                                           wheel_along(1, true)};
  const auto response =
      TireResponse::about(fe, build_losses(tire), standing->back(), ports, {.highest = 60.0});
  ASSERT_TRUE(response) << response.failure().reason;
  const Eigen::MatrixXcd H = response->at(kSlow);
  constexpr double kStep = 2e-5;  // m, rad
  const auto slope = [&](const auto& move) {
    GroundPose plus = pose, minus = pose;
    move(plus, kStep), move(minus, -kStep);
    const auto a = fe.advance(standing->back(), {plus}), b = fe.advance(standing->back(), {minus});
    const Standing more = fe.stand(a->back()), less = fe.stand(b->back());
    Eigen::Matrix<double, 6, 1> d;
    d << more.force - less.force, more.moment - less.moment;
    return Eigen::Matrix<double, 6, 1>(d / (2.0 * kStep));
  };
  const auto along = slope([](GroundPose& p, double d) { p.x += d; });
  const auto across = slope([](GroundPose& p, double d) { p.y += d; });
  const auto yawed = slope([](GroundPose& p, double d) { p.yaw += d; });
  EXPECT_NEAR(H(0, 0).real() / along[0], 1.0, 5e-3);
  EXPECT_NEAR(H(1, 1).real() / across[1], 1.0, 5e-3);
  EXPECT_NEAR(H(2, 2).real() / yawed[5], 1.0, 5e-3);
  EXPECT_NEAR(H(4, 0).real() / along[4], 1.0, 5e-3);  // moment about the axle
  EXPECT_NEAR(H(3, 0).real() / along[0], 1.0, 5e-3);
}

// The wheel that moves is the ground that moves the other way, but for inertia; ports are
// reciprocal.
TEST(TireResponse, PortsAreReciprocal) {
  const TireDescription tire = responding_tire(*constant_loss_factor(0.2, 1.0, 1000.0));
  FeTire fe(tire);
  const Inflated inflated = *fe.inflate(kResponsePressure);
  const auto state = fe.press(inflated, {.mu = 0.8}, {0.012});
  ASSERT_TRUE(state) << state.failure().reason;
  const std::vector<ResponsePort> ports = {tread_point(fe.mesh(), 20, 2),
                                           tread_point(fe.mesh(), 10, 0),
                                           ground_along(2),
                                           ground_along(0),
                                           wheel_along(2),
                                           wheel_along(0)};
  const auto response =
      TireResponse::about(fe, build_losses(tire), state->back(), ports, {.highest = 120.0});
  ASSERT_TRUE(response) << response.failure().reason;
  const Eigen::MatrixXcd H = response->at(100.0);
  const auto same = [&](std::complex<double> a, std::complex<double> b) {
    return std::abs(a - b) < 1e-9 * std::abs(b);
  };
  EXPECT_TRUE(same(H(0, 1), H(1, 0)));
  EXPECT_TRUE(same(H(0, 2), -H(2, 0)));  // force on the tire, motion of the ground
  EXPECT_TRUE(same(H(0, 4), H(4, 0)));
  EXPECT_TRUE(same(H(2, 4), -H(4, 2)));
  EXPECT_TRUE(same(H(3, 5), -H(5, 3)));
  // A driven point takes power, and rubber that relaxes keeps the force behind the ground.
  EXPECT_LT(H(0, 0).imag(), 0.0);
  EXPECT_GT(H(2, 2).imag(), 0.0);
}

// Terms far slower than the motion leave the tire with the unrelaxed moduli, without loss.
TEST(TireResponse, SlowTermsGiveTheStifferTire) {
  constexpr double kShare = 0.3;
  const TireDescription slow = responding_tire({{kShare, 1e4}});
  FeTire fe(slow);
  const Materials relaxed = fe.materials();
  // Without pressure nothing is stressed, so the stiffer tire has the same state.
  TireState state = fe.over(*fe.inflate(0.0), {});
  state.pose.height *= 2.0;
  const std::vector<ResponsePort> ports = {tread_point(fe.mesh(), 20, 2), wheel_along(2)};
  const auto relaxing =
      TireResponse::about(fe, build_losses(slow), state, ports, {.highest = 100.0});
  ASSERT_TRUE(relaxing) << relaxing.failure().reason;
  Materials stiff = relaxed;
  for (Solid& solid : stiff.solids)
    if (auto* rubber = std::get_if<Hyperelastic>(&solid.law)) {
      rubber->C10 *= 1.0 + kShare;
      rubber->C01 *= 1.0 + kShare;
    }
  fe.set(stiff);
  const TireDescription elastic = responding_tire();
  const auto expected =
      TireResponse::about(fe, build_losses(elastic), state, ports, {.highest = 100.0});
  ASSERT_TRUE(expected) << expected.failure().reason;
  // The shapes carry the enhanced strains of the relaxed tire, which differ from those of the
  // stiffer one, so that stiffness errs to second order in this difference. A receptance is
  // compared with the size that it has at 5 Hz if it passes through zero.
  const Eigen::MatrixXd slowly = expected->at(5.0).cwiseAbs();
  for (const double frequency : {5.0, 40.0, 90.0}) {
    const Eigen::MatrixXcd H = relaxing->at(frequency), E = expected->at(frequency);
    for (int i = 0; i < 2; ++i)
      for (int j = 0; j < 2; ++j)
        EXPECT_LT(std::abs(H(i, j) - E(i, j)), 4e-3 * std::max(std::abs(E(i, j)), slowly(i, j)))
            << frequency << " Hz, " << i << " by " << j;
  }
}

}  // namespace
}  // namespace latsch::fe_tire
