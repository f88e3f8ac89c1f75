// SPDX-License-Identifier: Apache-2.0
// Tests the forces of all elements of a mechanism together: their derivatives J against finite
// differences, their values against the gradient of the energy, and the hysteresis loop that
// friction causes in statics.
#include "models/multibody/assembly.h"

#include <gtest/gtest.h>

#include "base/random.h"
#include "models/multibody/equilibrium.h"

namespace latsch::multibody {
namespace {

using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

/// Returns a mechanism of three bodies on bushings, with a rod between two of them, a strut along
/// two lines, and drivers of the rod's joint and of the strut.
Mechanism some_mechanism(bool with_parts) {
  const auto body = [](const char* name, const Vector3d& origin, double mass) -> Body {
    return {name, origin, mass, mass * Vector3d(0.02, 0.03, 0.025).asDiagonal()};
  };
  BushingParameters soft{{3e4, 5e4, 2e4}, {90.0, 60.0, 120.0}};
  soft.damping = {30.0, 20.0, 40.0};
  soft.rotational_damping = {0.1, 0.2, 0.3};
  if (with_parts)
    soft.parts = {{1, Play{1e-4, 1e5}},
                  {4, ElasticCurve{ForceCharacteristic({{-1, -30}, {0, 0}, {1, 90}})}}};
  Joint driven{"c", 0, 2, {0.5, 0.1, 0.2}, soft};
  driven.driver = 0;
  driven.along = Vector3d(0.6, 0.0, 0.8);
  Strut strut{.name = "strut",
              .lines = {{kGround, 1, {0.4, 0.6, 0.4}, {0.4, 0.1, 0.1}, 1.0},
                        {0, 2, {0.0, 0.2, 0.3}, {0.8, 0.1, 0.1}, -0.6}},
              .stiffness = 4e4,
              .damping = 100.0,
              .preload = -300.0,
              .driver = 1};
  if (with_parts) strut.parts = {ViscousCurve{ForceCharacteristic({{-1, -500}, {0, 0}, {1, 900}})}};
  return Mechanism(
      {body("a", {0.0, 0.0, 0.0}, 1.0),
       body("b", {0.4, 0.0, 0.1}, 2.0),
       body("c", {0.8, 0.1, 0.0}, 1.5)},
      {{"a", kGround, 0, {-0.1, 0.0, 0.0}, soft}, {"b", 0, 1, {0.2, 0.05, 0.0}, soft}, driven},
      {strut},
      2,
      {0.0, 0.0, -9.81});
}

Poses stirred(const Mechanism& mechanism) {
  RandomStream random(4, 2);
  Poses poses = mechanism.at_rest();
  for (Pose& pose : poses) {
    Vector6d by;
    for (double& x : by) x = 0.05 * (random.uniform() - 0.5);
    pose.move(by);
  }
  return poses;
}

MatrixXd dense(const BlockElimination& J) {
  MatrixXd matrix = MatrixXd::Zero(6 * J.bodies(), 6 * J.bodies());
  for (int i = 0; i < J.bodies(); ++i)
    for (int j = 0; j < J.bodies(); ++j)
      if (const int place = J.place(i, j); place >= 0)
        matrix.block<6, 6>(6 * i, 6 * j) = J.at(place);
  return matrix;
}

TEST(Assembly, JIsThatOfDifferencesAtRest) {
  const Mechanism mechanism = some_mechanism(true);
  const Poses poses = stirred(mechanism);
  const std::vector<double> drivers = {0.01, -0.02};
  const std::vector<Load> loads = {{1, {0.5, 0.2, 0.1}, {100.0, -50.0, 200.0}, {3.0, 0.0, -1.0}}};
  Assembly assembly(mechanism);
  const auto forces = [&](const Poses& at) -> VectorXd {
    assembly.evaluate({.poses = at, .drivers = drivers}, loads, 0.8, {});
    return assembly.forces();
  };
  forces(poses);
  const MatrixXd J = dense(assembly.J());
  const double h = 1e-6;
  for (int k = 0; k < J.cols(); ++k) {
    Vector6d by = Vector6d::Zero();
    by[k % 6] = h;
    Poses up = poses, down = poses;
    up[static_cast<std::size_t>(k / 6)].move(by);
    down[static_cast<std::size_t>(k / 6)].move(-by);
    const VectorXd differences = (forces(up) - forces(down)) / (2.0 * h);
    EXPECT_LT((J.col(k) - differences).norm(), 1e-7 * J.norm()) << k;
  }
}

TEST(Assembly, ForcesOfSpringsAreTheGradientOfTheirEnergy) {
  const Mechanism mechanism = some_mechanism(true);
  const Poses poses = stirred(mechanism);
  const std::vector<double> drivers = {0.01, -0.02};
  Assembly assembly(mechanism);
  assembly.evaluate({.poses = poses, .drivers = drivers}, {}, 1.0, {});
  const VectorXd forces = assembly.forces();
  const double h = 1e-6;
  for (int k = 0; k < forces.size(); ++k) {
    Vector6d by = Vector6d::Zero();
    by[k % 6] = h;
    Poses up = poses, down = poses;
    up[static_cast<std::size_t>(k / 6)].move(by);
    down[static_cast<std::size_t>(k / 6)].move(-by);
    const double slope = (assembly.potential_energy({.poses = up, .drivers = drivers}) -
                          assembly.potential_energy({.poses = down, .drivers = drivers})) /
                         (2.0 * h);
    EXPECT_NEAR(-slope, forces[k], 1e-6 * forces.norm()) << k;
  }
}

TEST(Assembly, ItsShareOfRatesIsThatOfDifferences) {
  const Mechanism mechanism = some_mechanism(true);
  const Poses poses = stirred(mechanism);
  VectorXd rates(18);
  for (int i = 0; i < 18; ++i) rates[i] = 0.1 * std::sin(1.0 + i);
  Assembly assembly(mechanism);
  const Memories memories = mechanism.no_memories();
  const auto forces = [&](const VectorXd& v, double share) -> VectorXd {
    assembly.evaluate(
        {.poses = poses, .rates = &v, .memories = &memories, .step = 1e-3, .share = share},
        {},
        1.0,
        {});
    return assembly.forces();
  };
  forces(rates, 1.0);
  MatrixXd C = dense(assembly.J());
  forces(rates, 0.0);
  C -= dense(assembly.J());
  const double h = 1e-5;
  for (int k = 0; k < 18; ++k) {
    VectorXd up = rates, down = rates;
    up[k] += h;
    down[k] -= h;
    VectorXd differences = (forces(up, 0.0) - forces(down, 0.0)) / (2.0 * h);
    // The gyroscopic term ω × I ω belongs to no element, so its derivative by ω is subtracted.
    const Body& body = mechanism.bodies()[static_cast<std::size_t>(k / 6)];
    if (k % 6 >= 3) {
      const Eigen::Matrix3d I = turned_inertia(body, poses[static_cast<std::size_t>(k / 6)]);
      const Vector3d w = rates.segment<3>(6 * (k / 6) + 3), e = Vector3d::Unit(k % 6 - 3);
      differences.segment<3>(6 * (k / 6) + 3) += e.cross(I * w) + w.cross(I * e);
    }
    EXPECT_LT((C.col(k) - differences).norm(), 1e-7 * C.norm()) << k;
  }
}

// A body between a spring and a joint with play and friction is pushed to and fro. Force over
// displacement forms a hysteresis loop whose height is twice the friction.
TEST(Assembly, PlayAndFrictionDrawALoop) {
  BushingParameters joint{{0.0, 1e6, 1e6}, {100.0, 100.0, 100.0}};
  joint.parts = {{0, Play{1e-4, 1e7}}, {0, Friction{1e6, 30.0}}};
  const Mechanism mechanism({{"slider", Vector3d::Zero()}},
                            {{"joint", kGround, 0, Vector3d::Zero(), joint}});
  Equilibrium statics(mechanism);
  Rest rest = statics.unloaded();
  const auto push = [&](double force) {
    const Load load{0, Vector3d::Zero(), {force, 0.0, 0.0}};
    auto found = statics.solve({.loads = {&load, 1}}, rest);
    EXPECT_TRUE(found) << (found ? "" : found.failure().reason);
    rest = *found;
    return rest.poses[0].place.x();
  };
  EXPECT_NEAR(push(20.0), 20.0 / 1e6, 1e-12);  // friction sticks
  const double out = push(130.0);              // beyond the play, friction slips
  EXPECT_NEAR(out, 1e-4 + 100.0 / 1e7, 1e-12);
  EXPECT_NEAR(push(100.0), out - 30.0 / (1e7 + 1e6), 1e-12);  // reversal: friction sticks again
  EXPECT_NEAR(push(-130.0), -out, 1e-12);
}

}  // namespace
}  // namespace latsch::multibody
