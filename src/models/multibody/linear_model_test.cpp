// SPDX-License-Identifier: Apache-2.0
// Tests linear models against closed-form solutions, and against finite differences of the forces.
#include "models/multibody/linear_model.h"

#include <gtest/gtest.h>

#include <numbers>

#include "base/random.h"

namespace latsch::multibody {
namespace {

using Complex = std::complex<double>;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

constexpr double kTwoPi = 2.0 * std::numbers::pi;

Body cube(const std::string& name, const Vector3d& origin, double mass) {
  return {name, origin, mass, mass * 0.01 * Eigen::Matrix3d::Identity()};
}

/// Returns a bushing that is soft only along z, with a damper along z.
BushingParameters along_z(double k, double c) {
  BushingParameters bushing{{1e7, 1e7, k}, {1e5, 1e5, 1e5}};
  bushing.damping.z() = c;
  return bushing;
}

Rest drawn(const Mechanism& mechanism) { return {mechanism.at_rest(), mechanism.no_memories()}; }

/// Returns the damped modes that move along z.
std::vector<LinearMode> modes_along_z(const LinearModel& model) {
  std::vector<LinearMode> modes;
  for (const LinearMode& mode : natural_modes(model))
    if (std::abs(mode.shape[2]) > 0.01) modes.push_back(mode);
  return modes;
}

TEST(LinearModel, OfOneMassOnASpringIsTheTextbooks) {
  const double m = 2.0, k = 8e4, c = 120.0;
  const Mechanism mechanism({cube("m", Vector3d::Zero(), m)},
                            {{"spring", kGround, 0, Vector3d::Zero(), along_z(k, c)}});
  const LinearModel model = linear_model(mechanism, drawn(mechanism), {});
  EXPECT_DOUBLE_EQ(model.K(2, 2), k);
  EXPECT_DOUBLE_EQ(model.C(2, 2), c);
  EXPECT_DOUBLE_EQ(model.M(2, 2), m);
  const auto modes = modes_along_z(model);
  ASSERT_EQ(modes.size(), 1u);
  EXPECT_NEAR(modes[0].frequency, std::sqrt(k / m) / kTwoPi, 1e-9);
  EXPECT_NEAR(modes[0].damping, c / (2.0 * std::sqrt(k * m)), 1e-10);

  LinearInputs force{MatrixXd::Zero(6, 1), MatrixXd::Zero(6, 1)};
  force.P(2, 0) = 1.0;
  LinearOutputs all{MatrixXd::Zero(3, 6), MatrixXd::Zero(3, 6), MatrixXd::Zero(3, 6)};
  all.A(0, 2) = all.B(1, 2) = all.D(2, 2) = 1.0;
  for (const double omega : {1.0, 190.0, 200.0, 3000.0}) {
    const Complex x = 1.0 / Complex(k - m * omega * omega, omega * c), i(0.0, 1.0);
    const Eigen::MatrixXcd y = frequency_response(model, force, all, omega);
    EXPECT_LT(std::abs(y(0, 0) - x), 1e-12 * std::abs(x));
    EXPECT_LT(std::abs(y(1, 0) - i * omega * x), 1e-12 * omega * std::abs(x));
    EXPECT_LT(std::abs(y(2, 0) + omega * omega * x), 1e-12 * omega * omega * std::abs(x));
  }
}

TEST(LinearModel, AnInerterIsAMass) {
  const Strut inerter{.name = "inerter",
                      .lines = {{kGround, 0, {0.0, 0.0, -1.0}, Vector3d::Zero()}},
                      .inertance = 1.5};
  const Mechanism mechanism({cube("m", Vector3d::Zero(), 2.0)},
                            {{"spring", kGround, 0, Vector3d::Zero(), along_z(700.0, 0.0)}},
                            {inerter});
  const LinearModel model = linear_model(mechanism, drawn(mechanism), {});
  EXPECT_NEAR(modes_along_z(model).at(0).frequency, std::sqrt(700.0 / 3.5) / kTwoPi, 1e-9);
}

struct QuarterCar {
  double ms = 120.0, mu = 18.0, ks = 3e4, cs = 1500.0, kt = 1.2e5, ct = 300.0;
};

Mechanism quarter_car(const QuarterCar& q) {
  return Mechanism({cube("wheel", {0.0, 0.0, 0.2}, q.mu), cube("body", {0.0, 0.0, 0.5}, q.ms)},
                   {{"tire", kGround, 0, {0.0, 0.0, 0.2}, along_z(q.kt, q.ct)},
                    {"spring", 0, 1, {0.0, 0.0, 0.2}, along_z(q.ks, q.cs)}});
}

// The transfer functions of a quarter car from road to body and to wheel are [any text on vehicle
// dynamics], with S = cs s + ks, T = ct s + kt,
//   z_s = S T/N, z_u = (ms s² + S) T/N, N = (ms s² + S)(mu s² + S + T) - S²
TEST(LinearModel, OfAQuarterCarHasItsTransferFunctions) {
  const QuarterCar q;
  const Mechanism mechanism = quarter_car(q);
  const LinearModel model = linear_model(mechanism, drawn(mechanism), {});
  LinearInputs road{MatrixXd::Zero(12, 1), MatrixXd::Zero(12, 1)};
  road.P(2, 0) = q.kt;
  road.Q(2, 0) = q.ct;
  LinearOutputs heights{MatrixXd::Zero(2, 12), MatrixXd::Zero(2, 12), MatrixXd::Zero(2, 12)};
  heights.A(0, 8) = heights.A(1, 2) = 1.0;
  for (double f = 0.2; f < 100.0; f *= 1.3) {
    const Complex s(0.0, kTwoPi * f), S = q.cs * s + q.ks, T = q.ct * s + q.kt,
                                      N = (q.ms * s * s + S) * (q.mu * s * s + S + T) - S * S;
    const Eigen::MatrixXcd z = frequency_response(model, road, heights, kTwoPi * f);
    EXPECT_LT(std::abs(z(0, 0) - S * T / N), 1e-10 * std::abs(S * T / N)) << f;
    EXPECT_LT(std::abs(z(1, 0) - (q.ms * s * s + S) * T / N), 1e-10 * std::abs(T / N * S)) << f;
  }
}

TEST(LinearModel, OfAnUndampedQuarterCarHasItsTwoNaturalFrequencies) {
  QuarterCar q;
  q.cs = q.ct = 0.0;
  const Mechanism mechanism = quarter_car(q);
  const auto modes = modes_along_z(linear_model(mechanism, drawn(mechanism), {}));
  ASSERT_EQ(modes.size(), 2u);
  // The angular frequencies of an undamped quarter car are roots of ms mu ω⁴ - (ms (ks + kt) + mu
  // ks) ω² + ks kt = 0.
  const double a = q.ms * q.mu, b = q.ms * (q.ks + q.kt) + q.mu * q.ks,
               root = std::sqrt(b * b - 4.0 * a * q.ks * q.kt);
  EXPECT_NEAR(modes[0].frequency, std::sqrt((b - root) / (2.0 * a)) / kTwoPi, 1e-8);
  EXPECT_NEAR(modes[1].frequency, std::sqrt((b + root) / (2.0 * a)) / kTwoPi, 1e-8);
  for (const LinearMode& mode : modes) EXPECT_NEAR(mode.damping, 0.0, 1e-9);
}

/// A mechanism under load: two inclined hanging bodies with a preloaded spring-damper unit, a
/// nonlinear damper and a bump stop, under a load and a force from outside.
class Loaded : public testing::Test {
 protected:
  Loaded() : rest_(drawn(mechanism_)) {
    outside_ = [](const Motion& motion, std::vector<BodyForce>& wrenches) {
      BodyForce wrench{.body = 1};
      wrench.value[2] = 40.0 - 900.0 * motion.poses[1].place.z();
      if (motion.rates) wrench.value[2] -= 12.0 * (*motion.rates)[8];
      wrench.slopes(2, 2) = -900.0 - motion.share * 12.0;
      wrenches.push_back(wrench);
    };
    Equilibrium statics(mechanism_);
    rest_ = *statics.solve(standing(), rest_);
  }
  RestSettings standing() const { return {.loads = loads_, .outside = &outside_}; }

  static Mechanism made() {
    std::vector<Body> bodies;
    std::vector<Joint> joints;
    RandomStream random(15, 9);
    const auto any = [&] { return Vector3d(random.uniform(), random.uniform(), random.uniform()); };
    for (int i = 0; i < 2; ++i) {
      bodies.push_back(cube("body " + std::to_string(i), Vector3d(0.3 * i, 0.0, 0.0), 1.0 + i));
      BushingParameters bushing{1e4 * (any() + Vector3d::Ones()), 20.0 * any()};
      bushing.damping = 30.0 * any();
      bushing.rotational_damping = 0.1 * any();
      joints.push_back(
          {"joint " + std::to_string(i), i - 1, i, Vector3d(0.3 * i - 0.15, 0.02, 0.0), bushing});
    }
    const Strut unit{
        .name = "unit",
        .lines = {{kGround, 1, {0.2, 0.4, 0.3}, {0.3, 0.05, 0.02}, 1.0},
                  {0, 1, {0.0, 0.3, 0.1}, {0.3, -0.05, 0.0}, -0.7}},
        .stiffness = 2e3,
        .damping = 40.0,
        .inertance = 0.3,
        .preload = 15.0,
        .parts = {ViscousCurve{ForceCharacteristic({{-1.0, -70.0}, {0.1, 9.0}, {1.0, 50.0}})},
                  ElasticCurve{ForceCharacteristic({{-0.1, -300.0}, {0.02, 50.0}, {0.1, 500.0}})}}};
    return Mechanism(bodies, joints, {unit}, 0, {0.0, 0.0, -9.81});
  }

  VectorXd forces(const Poses& poses, const VectorXd& rates) {
    Assembly assembly(mechanism_);
    assembly.evaluate(
        {.poses = poses, .rates = &rates, .memories = &rest_.memories}, loads_, 1.0, outside_);
    return assembly.forces();
  }
  /// Returns the derivatives of a function by central differences, with respect to displacement and
  /// rotation of the bodies or to their rates.
  template <class Of>
  MatrixXd differences(bool by_rates, const Of& of) {
    const double h = by_rates ? 1e-5 : 1e-6;
    MatrixXd slopes;
    for (int i = 0; i < 12; ++i) {
      VectorXd column;
      for (const double sign : {1.0, -1.0}) {
        Poses poses = rest_.poses;
        VectorXd rates = VectorXd::Zero(12);
        Vector6d by = Vector6d::Zero();
        by[i % 6] = sign * h;
        if (by_rates)
          rates[i] = sign * h;
        else
          poses[static_cast<std::size_t>(i / 6)].move(by);
        const VectorXd value = sign / (2.0 * h) * of(poses, rates);
        column = column.size() == 0 ? value : (column + value).eval();
      }
      slopes.conservativeResize(column.size(), 12);
      slopes.col(i) = column;
    }
    return slopes;
  }

  const Mechanism mechanism_ = made();
  const std::vector<Load> loads_ = {{1, {0.4, 0.1, 0.0}, {5.0, -8.0, -30.0}, {0.4, 0.2, -0.3}}};
  Outside outside_;
  Rest rest_;
};

TEST_F(Loaded, StiffnessAndDampingAreTheDifferencesOfForces) {
  const LinearModel model = linear_model(mechanism_, rest_, standing());
  const auto f = [&](const Poses& poses, const VectorXd& rates) { return forces(poses, rates); };
  EXPECT_LT((model.K + differences(false, f)).norm(), 1e-7 * model.K.norm());
  EXPECT_LT((model.C + differences(true, f)).norm(), 1e-7 * model.C.norm());
}

TEST_F(Loaded, TheForceInAJointAlongALineOfItsBodyIsADifference) {
  const Vector3d line = Vector3d(0.3, -0.5, 0.8).normalized();
  const Eigen::Matrix3d back = rest_.poses[1].turn.transpose();
  const auto force = [&](const Poses& poses, const VectorXd& rates) {
    const Vector6d load =
        Assembly(mechanism_)
            .joint_load(1, {.poses = poses, .rates = &rates, .memories = &rest_.memories});
    return VectorXd::Constant(1, (poses[1].turn * back * line).dot(load.head<3>()));
  };
  const JointRow row = joint_force_row(mechanism_, rest_, standing(), 1, line, 1);
  EXPECT_LT((row.by_x - differences(false, force)).norm(), 1e-7 * row.by_x.norm());
  EXPECT_LT((row.by_v - differences(true, force)).norm(), 1e-7 * row.by_v.norm());
}

}  // namespace
}  // namespace latsch::multibody
