// SPDX-License-Identifier: Apache-2.0
// Tests coupled plies (32) and the conical belt (33): modes against those of the continuous ring,
// and lateral forces of a tire that rolls straight ahead.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "models/ring_tire/description/ring_parameters_testing.h"
#include "models/ring_tire/ring/ring_modes.h"
#include "models/ring_tire/ring/ring_tire.h"
#include "models/road/plane_road.h"
#include "numerics/dense/self_adjoint_eigen.h"

namespace latsch::ring_tire {
namespace {

using Eigen::Vector4d;

/// Returns the frequencies of modes with n waves of the continuous ring with fixed rim. For coupled
/// plies the shapes are u_r = A cos, u_t = B sin, u_y = C sin, ψ = D sin of nθ; for a conical belt
/// C and D multiply cosines. All energies are of second order.
Eigen::VectorXd continuous_frequencies(const RingParameters& ring, int n) {
  const Belt& b = ring.belt;
  const double R = b.radius, T0 = b.pressure * b.pressure_width * R;
  const bool cone = b.conicity != 0.0;
  const double odd = cone ? 1.0 : -1.0;  // sign in d(C cos)/dθ = -n C sin and d(C sin)/dθ = n C cos
  const Vector4d stretch(1.0 / R, n / R, 0.0, 0.0), turn(-n / R, -1.0 / R, 0.0, 0.0);
  const Vector4d bend(-(n * n + 1.0) / (R * R), -2.0 * n / (R * R), 0.0, 0.0);
  // Curvature of (4) by the displacements, s L0^-2: u'' - ψ s, with s = -1/R + δs. For a conical
  // belt (33) adds the term -ψ_0 δs.
  Vector4d across = Vector4d(0.0, 0.0, -n * n / (R * R), 1.0 / R);
  if (cone) across -= b.conicity * bend;
  const Vector4d lean(0.0, 0.0, -odd * n / R, 0.0);
  const Vector4d twist(0.0, 0.0, odd * n / (R * R), -odd * n / R);
  const auto square = [](const Vector4d& v) { return Eigen::Matrix4d(v * v.transpose()); };
  Eigen::Matrix4d K = b.extension * square(stretch) + T0 * (square(turn) + square(lean)) +
                      b.bending_in_plane * square(bend) + b.bending_out_of_plane * square(across) +
                      b.twist * square(twist) +
                      b.bending_twist * (bend * twist.transpose() + twist * bend.transpose());
  // Stiffness by the tension T0 of the inflated belt: pressure times width times the second-order
  // change of the enclosed area, T0/R² (u_r² + u_t² + 2 u_r u_t').
  K(0, 0) -= T0 / (R * R);
  K(1, 1) -= T0 / (R * R);
  K(0, 1) -= n * T0 / (R * R);
  K(1, 0) -= n * T0 / (R * R);
  K.diagonal() += Vector4d(ring.sidewall.radial.stiffness,
                           ring.sidewall.tangential.stiffness,
                           ring.sidewall.lateral.stiffness,
                           ring.sidewall.torsion);
  const double m = b.mass / (2.0 * std::numbers::pi * R);
  const Eigen::MatrixXd M = Vector4d(m, m, m, b.torsion_inertia).asDiagonal();
  return numerics::generalized_eigenvalues(Eigen::MatrixXd(K), M).cwiseSqrt() /
         (2.0 * std::numbers::pi);
}

double largest_deviation(RingParameters ring, int nodes, int n) {
  ring.nodes = nodes;
  std::vector<double> found;
  for (const RingMode& mode : unloaded_modes(ring, n))
    if (mode.n == n) found.push_back(mode.frequency);
  std::sort(found.begin(), found.end());
  const Eigen::VectorXd expected = continuous_frequencies(ring, n);
  double worst = 0.0;
  for (int i = 0; i < 4; ++i)
    worst = std::max(worst, std::abs(found[static_cast<std::size_t>(i)] / expected[i] - 1.0));
  return worst;
}

RingParameters stiff_ring() {
  RingParameters ring = passenger_ring();
  ring.belt.bending_in_plane = 10.0;
  return ring;
}

TEST(PlySteer, ModesOfCoupledPliesConvergeToTheContinuousRing) {
  RingParameters ring = stiff_ring();
  ring.belt.bending_twist = 25.0;
  RingParameters apart = ring;
  apart.belt.bending_twist = 0.0;
  for (const int n : {2, 5, 8}) {
    EXPECT_LT(largest_deviation(ring, 200, n), 2e-4) << n;
    EXPECT_LT(largest_deviation(apart, 200, n), 2e-4) << n;
    const double order = std::log2(largest_deviation(ring, 40, n) / largest_deviation(ring, 80, n));
    EXPECT_GT(order, 3.5) << n;
  }
  // The coupling must be visible: one frequency must change by more than the error that remains.
  const auto moved = [&](int n) {
    const Eigen::ArrayXd ratio =
        continuous_frequencies(ring, n).array() / continuous_frequencies(apart, n).array();
    return (ratio - 1.0).abs().maxCoeff();
  };
  EXPECT_GT(moved(2), 1e-3);
  EXPECT_GT(moved(8), 0.1);
}

TEST(PlySteer, ModesOfAConeConvergeToTheContinuousRing) {
  RingParameters ring = stiff_ring();
  ring.belt.bending_out_of_plane = 2000.0;
  ring.belt.conicity = 0.1;
  for (const int n : {2, 5}) EXPECT_LT(largest_deviation(ring, 200, n), 2e-4) << n;
  RingParameters upright = ring;
  upright.belt.conicity = 0.0;
  EXPECT_GT((continuous_frequencies(ring, 5) - continuous_frequencies(upright, 5)).norm(),
            1.0);  // Hz
}

/// Returns the lateral force, N, positive to the left, of a tire that rolls straight ahead (`way` =
/// 1) or back (-1) with nearly no longitudinal force. It is the mean over one meter, after five
/// meters of rolling.
double side_force(const RingParameters& ring, double way) {
  RingTire tire(ring);
  const road::PlaneRoad road;
  WheelMotion motion;
  const double speed = 5.0, h = 1e-3;
  motion.center.z() = tire.free_radius() - 0.02;
  motion.velocity.x() = way * speed;
  motion.spin_rate = way * speed / 0.3085;
  EXPECT_TRUE(tire.settle(motion, road, 0.0));
  double sum = 0.0;
  constexpr int kSteps = 800, kCounted = 200;
  for (int i = 1; i <= kSteps; ++i) {
    motion.center.x() += h * motion.velocity.x();
    motion.spin += h * motion.spin_rate;
    const auto hub = tire.advance(motion, road, i * h, h);
    EXPECT_TRUE(hub);
    if (i > kSteps - kCounted) sum += hub->force.y() / kCounted;
  }
  return sum;
}

RingParameters coarse() {
  RingParameters ring = stiff_ring();
  ring.nodes = 60;
  ring.tread.blocks = 8;
  return ring;
}

// If D16 is positive, the sections in the front half of a standing tire's contact patch lean to the
// right, those in the rear half to the left.
TEST(PlySteer, FlattenedPliesLeanOneWayBeforeAndTheOtherBehind) {
  RingParameters ring = coarse();
  ring.belt.bending_twist = 5.0;
  RingTire tire(ring);
  WheelMotion motion;
  motion.center.z() = tire.free_radius() - 0.02;
  const auto hub = tire.settle(motion, road::PlaneRoad(), 0.0);
  ASSERT_TRUE(hub);
  for (const int k : {1, 2}) {
    EXPECT_LT(tire.positions()(3, k), -1e-4) << k;
    EXPECT_NEAR(tire.positions()(3, ring.nodes - k), -tire.positions()(3, k), 1e-6) << k;
  }
}

// In axes fixed to the wheel, the force of ply steer changes its sign with the direction of
// rolling, while that of conicity does not. By this the two are distinguished [SAE J670, J1988].
// Small forces are proportional to their cause.
TEST(PlySteer, ForceOfPliesTurnsWithTheRollingThatOfAConeKeepsItsSide) {
  const double none = side_force(coarse(), 1.0);
  EXPECT_NEAR(none, 0.0, 1e-3);
  const auto of = [](double bending_twist, double conicity, double way) {
    RingParameters ring = coarse();
    ring.belt.bending_twist = bending_twist;
    ring.belt.conicity = conicity;
    return side_force(ring, way);
  };
  const double plies = of(5.0, 0.0, 1.0), plies_back = of(5.0, 0.0, -1.0);
  EXPECT_GT(std::abs(plies), 5.0);
  EXPECT_NEAR(plies_back / plies, -1.0, 0.02);
  EXPECT_NEAR(of(2.5, 0.0, 1.0) / plies, 0.5, 0.01);
  EXPECT_NEAR(of(-5.0, 0.0, 1.0) / plies, -1.0, 1e-3);
  const double cone = of(0.0, 0.002, 1.0), cone_back = of(0.0, 0.002, -1.0);
  EXPECT_GT(std::abs(cone), 5.0);
  EXPECT_NEAR(cone_back / cone, 1.0, 0.02);
  EXPECT_NEAR(of(0.0, 0.001, 1.0) / cone, 0.5, 0.01);
  EXPECT_NEAR(of(0.0, -0.002, 1.0) / cone, -1.0, 1e-3);
}

}  // namespace
}  // namespace latsch::ring_tire
