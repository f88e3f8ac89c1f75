// SPDX-License-Identifier: Apache-2.0
// (30) is compared with strains written here from the equations of docs/ring_tire.md, and their
// differences.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "base/random.h"
#include "models/ring_tire/belt/belt.h"
#include "models/ring_tire/belt/belt_curve.h"
#include "models/ring_tire/belt/belt_testing.h"
#include "models/ring_tire/description/ring_parameters_testing.h"

namespace latsch::ring_tire {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using Eigen::VectorXd;

constexpr int kDampedNodes = 16;
constexpr double kBeltTime = 3e-4, kExtensionTime = 1e-5;

RingParameters damped_ring() {
  RingParameters ring = passenger_ring();
  ring.belt.damping_time = kBeltTime;
  ring.belt.extension_damping_time = kExtensionTime;
  ring.belt.bending_in_plane = 10.0;
  ring.belt.bending_twist = 20.0;
  return ring;
}

RimFrame turning_rim() {
  WheelMotion motion;
  motion.center = {0.3, -0.1, 0.4};
  motion.carrier = Eigen::AngleAxisd(0.1, Vector3d::UnitX()).toRotationMatrix();
  motion.spin = 0.7;
  motion.velocity = {20.0, 0.5, -0.3};
  motion.angular_velocity = {0.2, -0.1, 0.4};
  motion.spin_rate = 66.0;
  return RimFrame::of(motion);
}

NodeValues resting_nodes(const RimFrame& rim, double radius) {
  const NodeAngles angles(kDampedNodes);
  NodeValues q(4, kDampedNodes);
  for (int k = 0; k < kDampedNodes; ++k)
    q.col(k) << rim.center +
                    radius * node_radius_over_knot_radius(kDampedNodes) * angles.radial(rim, k),
        0.0;
  return q;
}

NodeValues shaken(NodeValues q, double place, double torsion) {
  RandomStream random(5, 1);
  for (Eigen::Index k = 0; k < q.cols(); ++k) {
    for (int i = 0; i < 3; ++i) q(i, k) += place * (random.uniform() - 0.5);
    q(3, k) += torsion * (random.uniform() - 0.5);
  }
  return q;
}

/// A strain e and its viscosity c: the power lost is c e'². The plies couple twist to the bend, two
/// before it in the list.
struct DampedStrain {
  double viscosity, value, joined = 0.0;
};

/// Returns all strains of (1), (3), (4), (5) at q.
std::vector<DampedStrain> strains(const RingParameters& ring,
                                  const NodeValues& q,
                                  const RimFrame& rim) {
  const int N = static_cast<int>(q.cols());
  const Belt& b = ring.belt;
  const double x = 2.0 * std::numbers::pi / N, L0 = b.radius * x;
  std::vector<DampedStrain> all;
  for (int k = 0; k < N; ++k) {
    const auto node = [&](int i) -> Eigen::Vector4d {
      Eigen::Vector4d at = q.col((k + i + N) % N);
      at.head<3>() = rim.axes().transpose() * (at.head<3>() - rim.center);
      return at;
    };
    const auto curve = [&](double s) -> std::array<Eigen::Vector4d, 3> {
      const double r = 1.0 - s;
      const double place[4] = {r * r * r / 6.0,
                               2.0 / 3.0 - s * s + 0.5 * s * s * s,
                               2.0 / 3.0 - r * r + 0.5 * r * r * r,
                               s * s * s / 6.0};
      const double slope[4] = {
          -0.5 * r * r, -2.0 * s + 1.5 * s * s, 2.0 * r - 1.5 * r * r, 0.5 * s * s};
      const double second[4] = {r, -2.0 + 3.0 * s, 1.0 - 3.0 * s, s};
      std::array<Eigen::Vector4d, 3> sums{
          Eigen::Vector4d::Zero(), Eigen::Vector4d::Zero(), Eigen::Vector4d::Zero()};
      for (int i = 0; i < 4; ++i) {
        sums[0] += place[i] * node(i - 1);
        sums[1] += slope[i] * node(i - 1);
        sums[2] += second[i] * node(i - 1);
      }
      return sums;
    };
    for (const double s : {0.0, 0.5}) {
      const auto [p, c, d] = curve(s);
      const double share = s == 0.0 ? 1.0 / 3.0 : 2.0 / 3.0;
      const double bend = (d.x() * c.z() - d.z() * c.x()) / std::hypot(c.x(), c.z());
      // The ring tilted by 1 over its radius, u = cos φ, ψ = cos φ / R, has zero strains in (4),
      // (5).
      const auto wave = [&](double at) { return std::cos(x * at); };
      const double rest = -b.radius * node_radius_over_knot_radius(N) *
                          (s == 0.0 ? 2.0 * (1.0 - wave(1.0)) : wave(0.5) - wave(1.5));
      const double place =
          s == 0.0 ? (2.0 + wave(1.0)) / 3.0 : (23.0 * wave(0.5) + wave(1.5)) / 24.0;
      const double second = s == 0.0 ? 2.0 * (wave(1.0) - 1.0) : wave(1.5) - wave(0.5);
      const double zeta = second * b.radius / (place * rest);
      const double cube = L0 * L0 * L0;
      all.push_back({kBeltTime * share * b.bending_in_plane / cube, bend});
      all.push_back(
          {kBeltTime * share * b.bending_out_of_plane / cube, d.y() - zeta * p[3] * bend});
      // The twist is coupled to the bend, two before it; at the knots it has no viscosity of its
      // own.
      const double across = -L0 * L0 / (b.radius * rest);
      all.push_back({s == 0.0 ? 0.0 : kBeltTime * b.twist / L0,
                     c[3] + across * c.y() * bend / (L0 * L0),
                     kBeltTime * share * b.bending_twist / (L0 * L0)});
      if (s == 0.0) continue;
      const double node_radius = b.radius * node_radius_over_knot_radius(N);
      const double g0 = 0.25 * node_radius * (5.0 * std::sin(0.5 * x) + std::sin(1.5 * x));
      all.push_back({kExtensionTime * b.extension * L0, c.head<3>().norm() / g0});
    }
  }
  return all;
}

/// Returns -Σ c (de/dq) e', with e' = (de/dq) v and v relative to the rotating rim.
NodeValues viscous_force(const RingParameters& ring,
                         const NodeValues& q,
                         const NodeValues& v,
                         const RimFrame& rim) {
  NodeValues against = v;
  for (Eigen::Index k = 0; k < q.cols(); ++k)
    against.col(k).head<3>() -= rim.velocity_at(q.col(k).head<3>());
  const Eigen::Index count = static_cast<Eigen::Index>(strains(ring, q, rim).size());
  Eigen::MatrixXd gradient(count, q.size());
  VectorXd viscosity(count);
  constexpr double h = 1e-6;
  for (Eigen::Index i = 0; i < q.size(); ++i) {
    NodeValues more = q, less = q;
    more.data()[i] += h;
    less.data()[i] -= h;
    const auto a = strains(ring, more, rim), b = strains(ring, less, rim);
    for (Eigen::Index e = 0; e < count; ++e) {
      gradient(e, i) =
          (a[static_cast<std::size_t>(e)].value - b[static_cast<std::size_t>(e)].value) / (2.0 * h);
      viscosity[e] = a[static_cast<std::size_t>(e)].viscosity;
    }
  }
  const VectorXd rate = gradient * against.reshaped();
  VectorXd stress = viscosity.cwiseProduct(rate);
  const auto all = strains(ring, q, rim);
  for (Eigen::Index e = 2; e < count; ++e) {
    const double joined = all[static_cast<std::size_t>(e)].joined;
    stress[e] += joined * rate[e - 2];
    stress[e - 2] += joined * rate[e];
  }
  return (-gradient.transpose() * stress).reshaped(4, q.cols());
}

/// Returns the force that the belt adds if its nodes move with v.
NodeValues damping_force(const BeltForces& belt,
                         const NodeValues& q,
                         const NodeValues& v,
                         const RimFrame& rim) {
  RimRows at(kDampedNodes), rate(kDampedNodes), force(kDampedNodes, BeltForces::kScratch);
  at.place(q, rim);
  rate.place_rates(at, v, rim);
  NodeValues moving(4, kDampedNodes), still(4, kDampedNodes);
  belt.find_force(at, &rate, force);
  force.turn_back(rim, moving);
  belt.find_force(at, nullptr, force);
  force.turn_back(rim, still);
  return moving - still;
}

/// Returns the velocity of the rim's material at the nodes plus `more`.
NodeValues with_rim(const NodeValues& q, const RimFrame& rim, const NodeValues& more) {
  NodeValues v = more;
  for (Eigen::Index k = 0; k < q.cols(); ++k)
    v.col(k).head<3>() += rim.velocity_at(q.col(k).head<3>());
  return v;
}

TEST(BeltDamping, IsTheStrainsRateTimesItsViscosity) {
  const RingParameters ring = damped_ring();
  const BeltForces belt(ring.belt, kDampedNodes);
  const RimFrame rim = turning_rim();
  const NodeValues q = shaken(resting_nodes(rim, ring.belt.radius), 0.02, 0.1);
  const NodeValues v = with_rim(q, rim, shaken(NodeValues::Zero(4, kDampedNodes), 3.0, 10.0));
  const NodeValues force = damping_force(belt, q, v, rim);
  const NodeValues expected = viscous_force(ring, q, v, rim);
  EXPECT_GT(expected.norm(), 100.0);
  EXPECT_LT((force - expected).norm(), 1e-8 * expected.norm());  // rounding of the differences
  // Each of the two damping times is also tested alone.
  for (const bool of_extension : {false, true}) {
    RingParameters one = ring;
    (of_extension ? one.belt.damping_time : one.belt.extension_damping_time) = 0.0;
    const double power = (damping_force(BeltForces(one.belt, kDampedNodes), q, v, rim).array() *
                          shaken(NodeValues::Zero(4, kDampedNodes), 3.0, 10.0).array())
                             .sum();
    EXPECT_LT(power, -1.0);
  }
}

// A rotation with the rim, or any rigid motion in the plane of the rim, loses nothing.
TEST(BeltDamping, HoldsNothingOfARigidMotion) {
  const RingParameters ring = damped_ring();
  const BeltForces belt(ring.belt, kDampedNodes);
  const RimFrame rim = turning_rim();
  const NodeValues q = shaken(resting_nodes(rim, ring.belt.radius), 0.02, 0.1);
  const double ordinary =
      damping_force(belt, q, with_rim(q, rim, shaken(0.0 * q, 3.0, 10.0)), rim).norm();
  EXPECT_LT(damping_force(belt, q, with_rim(q, rim, 0.0 * q), rim).norm(), 1e-9 * ordinary);
  NodeValues turning = 0.0 * q;
  for (Eigen::Index k = 0; k < q.cols(); ++k)
    turning.col(k).head<3>() = (10.0 * rim.a).cross(q.col(k).head<3>()) + 2.0 * rim.X - rim.Z;
  EXPECT_LT(damping_force(belt, q, with_rim(q, rim, turning), rim).norm(), 1e-9 * ordinary);
}

// The damping matrix is the derivative of the force by the rates; Newton's stiffness contains its
// share.
TEST(BeltDamping, MatrixIsTheSlopeByTheRates) {
  const RingParameters ring = damped_ring();
  const BeltForces belt(ring.belt, kDampedNodes);
  const RimFrame rim = turning_rim();
  const NodeValues q = shaken(resting_nodes(rim, ring.belt.radius), 0.02, 0.1);
  RimRows at(kDampedNodes);
  at.place(q, rim);
  const auto matrix = [&](const auto& find) {
    StiffnessRows rows(kDampedNodes);
    find(rows);
    CyclicBand band(kDampedNodes);
    rows.turn_back(rim, band);
    return band;
  };
  const CyclicBand C = matrix([&](StiffnessRows& rows) { belt.find_damping(at, 1.0, rows); });
  const CyclicBand K =
      matrix([&](StiffnessRows& rows) { belt.find_stiffness(at, 0.0, 1.0, rows); });
  const double velocity = 4000.0;
  const CyclicBand both =
      matrix([&](StiffnessRows& rows) { belt.find_stiffness(at, velocity, 1.0, rows); });
  const NodeValues rate = shaken(0.0 * q, 3.0, 10.0);
  const NodeValues force = damping_force(belt, q, with_rim(q, rim, rate), rim);
  EXPECT_LT((C.multiply(rate) + force).norm(), 1e-9 * force.norm());
  EXPECT_LT((both.multiply(rate) - K.multiply(rate) - velocity * C.multiply(rate)).norm(),
            1e-9 * both.multiply(rate).norm());
}

}  // namespace
}  // namespace latsch::ring_tire
