// SPDX-License-Identifier: Apache-2.0
// Tests simulated motion against closed-form solutions, its order of convergence, and conserved
// quantities.
#include "models/multibody/transient.h"

#include <gtest/gtest.h>

#include <numbers>

#include "base/random.h"

namespace latsch::multibody {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using Eigen::VectorXd;

Body cube(const std::string& name, const Vector3d& origin, double mass) {
  return {name, origin, mass, mass * 0.01 * Matrix3d::Identity()};
}

/// Returns a bushing whose stiffness along x is k and whose other springs are so soft that only the
/// motion along x matters.
BushingParameters along_x(double k, double c) {
  BushingParameters bushing{{k, 1.0, 1.0}, {1.0, 1.0, 1.0}};
  bushing.damping.x() = c;
  return bushing;
}

MechanismState started(Transient& transient,
                       const Mechanism& mechanism,
                       const Rest& rest,
                       const VectorXd* rates = nullptr) {
  (void)mechanism;
  auto state = transient.start(rest, {}, 0.0, rates);
  EXPECT_TRUE(state) << (state ? "" : state.failure().reason);
  return *state;
}

/// Returns the position x of the only body 1 s after it was released 1 mm from rest.
double swing(const BushingParameters& bushing, int steps, std::vector<Strut> struts = {}) {
  const Mechanism mechanism({cube("m", Vector3d::Zero(), 2.0)},
                            {{"spring", kGround, 0, Vector3d::Zero(), bushing}},
                            std::move(struts));
  Transient transient(mechanism);
  Rest rest{mechanism.at_rest(), mechanism.no_memories()};
  rest.poses[0].place.x() = 1e-3;
  MechanismState state = started(transient, mechanism, rest);
  for (int i = 0; i < steps; ++i) EXPECT_TRUE(transient.advance(state, 1.0 / steps, {}).ok());
  return state.poses[0].place.x();
}

double closed_form(double m, double k, double c) {
  const double delta = c / (2.0 * m), omega = std::sqrt(k / m - delta * delta);
  return 1e-3 * std::exp(-delta) * (std::cos(omega) + delta / omega * std::sin(omega));
}

TEST(Transient, OfOneSpringAndDamperIsTheClosedFormWithOrderTwo) {
  const double exact = closed_form(2.0, 800.0, 3.0);
  const double coarse = std::abs(swing(along_x(800.0, 3.0), 400) - exact);
  const double fine = std::abs(swing(along_x(800.0, 3.0), 800) - exact);
  EXPECT_LT(fine, 3e-6);
  EXPECT_NEAR(coarse / fine, 4.0, 0.1);
}

TEST(Transient, AnInerterAddsItsInertanceToTheMass) {
  Strut inerter{.name = "inerter",
                .lines = {{kGround, 0, {-1.0, 0.0, 0.0}, Vector3d::Zero()}},
                .inertance = 1.5};
  const double exact = closed_form(3.5, 800.0, 3.0);
  const double coarse = std::abs(swing(along_x(800.0, 3.0), 400, {inerter}) - exact);
  const double fine = std::abs(swing(along_x(800.0, 3.0), 800, {inerter}) - exact);
  EXPECT_LT(fine, 3e-6);
  EXPECT_NEAR(coarse / fine, 4.0, 0.15);
}

// A mass m on a spring k, in parallel with a Maxwell element of stiffness k2 and relaxation time T,
// has the equations m x'' + k x + s = 0, s' = k2 x' - s/T.
TEST(Transient, AMaxwellPartIsItsDifferentialEquation) {
  BushingParameters bushing = along_x(800.0, 0.0);
  bushing.parts.push_back({0, Maxwell{400.0, 0.05}});
  // The reference is a classical Runge-Kutta solution with negligible error.
  const auto slope = [](const Vector3d& y) -> Vector3d {
    return {y[1], (-800.0 * y[0] - y[2]) / 2.0, 400.0 * y[1] - y[2] / 0.05};
  };
  // The Maxwell element, too, is stretched by 1 mm at the start.
  Vector3d y(1e-3, 0.0, 400.0 * 1e-3);
  const int n = 100000;
  for (int i = 0; i < n; ++i) {
    const double h = 1.0 / n;
    const Vector3d k1 = slope(y), k2 = slope(y + 0.5 * h * k1), k3 = slope(y + 0.5 * h * k2),
                   k4 = slope(y + h * k3);
    y += h / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4);
  }
  const double coarse = std::abs(swing(bushing, 400) - y[0]);
  const double fine = std::abs(swing(bushing, 800) - y[0]);
  EXPECT_LT(fine, 5e-6);
  EXPECT_NEAR(coarse / fine, 4.0, 0.2);
}

// Coulomb friction reduces the amplitude by 4 R/k in every period [any text on vibrations].
TEST(Transient, DryFrictionTakesTheSameFromEverySwing) {
  BushingParameters bushing = along_x(800.0, 0.0);
  const double R = 0.04;
  bushing.parts.push_back({0, Friction{1e6, R}});
  const Mechanism mechanism({cube("m", Vector3d::Zero(), 2.0)},
                            {{"spring", kGround, 0, Vector3d::Zero(), bushing}});
  Transient transient(mechanism, {.dissipation = 0.0, .corrections = 4});
  Rest rest{mechanism.at_rest(), mechanism.no_memories()};
  rest.poses[0].place.x() = 1e-3;
  // The friction element slips at the start, because the body is held out there by an external
  // force.
  rest.memories[0] = {R, 1e-3};
  MechanismState state = started(transient, mechanism, rest);
  const double period = 2.0 * std::numbers::pi / std::sqrt(400.0), h = period / 4000.0;
  double highest = 0.0;
  for (int i = 0; i < 4400; ++i) {
    EXPECT_TRUE(transient.advance(state, h, {}).ok());
    if (i > 3600) highest = std::max(highest, state.poses[0].place.x());
  }
  EXPECT_NEAR(highest, 1e-3 - 4.0 * R / 800.0, 1e-6);
}

// A body without forces conserves its angular momentum and its energy.
TEST(Transient, AFreeBodyTurnsAsEulersEquationsSay) {
  Body body{"top", Vector3d::Zero(), 3.0, Vector3d(0.02, 0.05, 0.06).asDiagonal()};
  const Mechanism mechanism({body}, {});
  ASSERT_EQ(Mechanism::fault({body}, {}), "");
  VectorXd rates(6);
  rates << 1.0, -2.0, 0.5, 3.0, 5.0, 0.4;
  const auto drift = [&](int steps) {
    Transient transient(mechanism, {.dissipation = 0.0});
    const Rest rest{mechanism.at_rest(), {}};
    MechanismState state = started(transient, mechanism, rest, &rates);
    for (int i = 0; i < steps; ++i) EXPECT_TRUE(transient.advance(state, 1.0 / steps, {}).ok());
    EXPECT_LT((state.poses[0].place - Vector3d(1.0, -2.0, 0.5)).norm(), 1e-12);
    const Vector3d before = body.inertia * rates.tail<3>();
    const Vector3d after = turned_inertia(body, state.poses[0]) * state.rates.tail<3>();
    return (after - before).norm() / before.norm();
  };
  const double coarse = drift(1000), fine = drift(2000);
  EXPECT_LT(fine, 1e-4);
  EXPECT_NEAR(coarse / fine, 4.0, 0.2);
}

/// Returns a chain of three bodies on different bushings, with an inclined spring-damper unit.
Mechanism chain(double damping, double inertance) {
  std::vector<Body> bodies;
  std::vector<Joint> joints;
  RandomStream random(15, 7);
  const auto any = [&] { return Vector3d(random.uniform(), random.uniform(), random.uniform()); };
  for (int i = 0; i < 3; ++i) {
    Body body = cube("body " + std::to_string(i), Vector3d(0.3 * i, 0.0, 0.0), 1.0 + i);
    body.inertia = body.mass * Vector3d(0.01, 0.013, 0.008).asDiagonal();
    bodies.push_back(body);
    BushingParameters bushing{1e4 * (any() + Vector3d::Ones()), 20.0 * (any() + Vector3d::Ones())};
    bushing.damping = damping * any();
    bushing.rotational_damping = 1e-3 * damping * any();
    joints.push_back(
        {"joint " + std::to_string(i), i - 1, i, Vector3d(0.3 * i - 0.15, 0.02, 0.0), bushing});
  }
  const Strut unit{.name = "unit",
                   .lines = {{kGround, 2, {0.2, 0.4, 0.3}, {0.6, 0.05, 0.02}, 1.0},
                             {0, 2, {0.0, 0.3, 0.1}, {0.6, -0.05, 0.0}, -0.7}},
                   .stiffness = 2e3,
                   .damping = damping,
                   .inertance = inertance,
                   .preload = 15.0};
  return Mechanism(bodies, joints, {unit}, 0, {0.0, 0.0, -9.81});
}

MechanismState run(const Mechanism& mechanism, int steps, double seconds, double theta) {
  Transient transient(mechanism, {.dissipation = theta});
  VectorXd rates(18);
  for (int i = 0; i < 18; ++i) rates[i] = 0.6 * std::cos(1.7 * i);
  MechanismState state =
      started(transient, mechanism, {mechanism.at_rest(), mechanism.no_memories()}, &rates);
  for (int i = 0; i < steps; ++i) EXPECT_TRUE(transient.advance(state, seconds / steps, {}).ok());
  return state;
}

TEST(Transient, OfAChainOfBodiesIsOfOrderTwo) {
  for (const double theta : {0.0, 0.05}) {
    const Mechanism mechanism = chain(30.0, 0.8);
    const auto end = [&](int steps) {
      const MechanismState state = run(mechanism, steps, 0.2, theta);
      VectorXd v(18);
      for (int i = 0; i < 3; ++i) {
        v.segment<3>(6 * i) = state.poses[i].place;
        v.segment<3>(6 * i + 3) = state.poses[i].turn.col(0);
      }
      return v;
    };
    const VectorXd a = end(1000), b = end(2000), c = end(4000);
    EXPECT_NEAR((a - b).norm() / (b - c).norm(), 4.0, 0.25) << theta;
    EXPECT_LT((b - c).norm(), 1e-5);
  }
}

TEST(Transient, UndampedMotionKeepsItsEnergy) {
  const Mechanism mechanism = chain(0.0, 0.0);
  Transient transient(mechanism, {.dissipation = 0.0});
  VectorXd rates(18);
  for (int i = 0; i < 18; ++i) rates[i] = 0.1 * std::cos(1.7 * i);
  MechanismState state =
      started(transient, mechanism, {mechanism.at_rest(), mechanism.no_memories()}, &rates);
  const auto energy = [&] {
    return transient.assembly().potential_energy(transient.motion_of(state)) +
           transient.assembly().kinetic_energy(state.poses, state.rates);
  };
  const double before = energy(),
               moving = transient.assembly().kinetic_energy(state.poses, state.rates);
  double most = 0.0;
  for (int i = 0; i < 20000; ++i) {
    ASSERT_TRUE(transient.advance(state, 2.5e-5, {}).ok());
    if (i % 100 == 0) most = std::max(most, std::abs(energy() - before));
  }
  EXPECT_LT(most / moving, 1e-6);
}

TEST(Transient, AStateIsAValue) {
  const Mechanism mechanism = chain(30.0, 0.8);
  Transient transient(mechanism), other(mechanism);
  MechanismState state = run(mechanism, 50, 0.01, 0.05);
  const MechanismState kept = state;
  for (int i = 0; i < 20; ++i) ASSERT_TRUE(transient.advance(state, 2e-4, {}).ok());
  EXPECT_FALSE(state == kept);
  MechanismState again = kept;
  for (int i = 0; i < 20; ++i) ASSERT_TRUE(other.advance(again, 2e-4, {}).ok());
  EXPECT_TRUE(again == state);
}

TEST(Transient, ABodyWithoutMassIsNamed) {
  Body body = cube("the rocker", Vector3d::Zero(), 0.0);
  EXPECT_NE(Mechanism::fault_in_motion({body}).find("the rocker has no mass"), std::string::npos);
  body.mass = 1.0;
  body.inertia = Vector3d(1.0, 1.0, 3.0).asDiagonal();
  EXPECT_NE(Mechanism::fault_in_motion({body}).find("inertia"), std::string::npos);
}

}  // namespace
}  // namespace latsch::multibody
