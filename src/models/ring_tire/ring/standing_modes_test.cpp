// SPDX-License-Identifier: Apache-2.0
#include "models/ring_tire/ring/standing_modes.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>

#include "models/ring_tire/belt/belt_curve.h"
#include "models/ring_tire/belt/belt_testing.h"
#include "models/ring_tire/description/ring_parameters_testing.h"
#include "models/ring_tire/ring/ring_modes.h"
#include "models/road/plane_road.h"
#include "numerics/dense/self_adjoint_eigen.h"

namespace latsch::ring_tire {
namespace {

using Eigen::MatrixXd;
using Eigen::Vector3d;

RingTire standing(const RingParameters& ring, double depth, double camber = 0.0) {
  RingTire tire(ring);
  WheelMotion motion;
  motion.center.z() = tire.free_radius() - depth;
  motion.carrier = Eigen::AngleAxisd(camber, Vector3d::UnitX()).toRotationMatrix();
  const auto hub = tire.settle(motion, road::PlaneRoad(), 0.0);
  EXPECT_TRUE(hub) << hub.failure().reason;
  return tire;
}

using NodesOfBlock = std::array<Eigen::Vector4d, 4>;

/// Returns the weights of four nodes for a tread block at the relative position s of its segment:
/// the cubic B-spline.
std::array<double, 4> weights_at(double s) {
  const double r = 1.0 - s;
  return {r * r * r / 6.0,
          2.0 / 3.0 - s * s + 0.5 * s * s * s,
          2.0 / 3.0 - r * r + 0.5 * r * r * r,
          s * s * s / 6.0};
}

Vector3d belt_at(const NodesOfBlock& x, double s) {
  Vector3d place = Vector3d::Zero();
  for (std::size_t m = 0; m < 4; ++m) place += weights_at(s)[m] * x[m].head<3>();
  return place;
}

/// Returns the tip (10) of a tread block at the relative position s of its segment. The frame of
/// the block follows the belt.
Vector3d tip_of(const NodesOfBlock& x, double s, double H, double y, const Vector3d& a) {
  const double r = 1.0 - s;
  const double d[4] = {-0.5 * r * r, -2.0 * s + 1.5 * s * s, 2.0 * r - 1.5 * r * r, 0.5 * s * s};
  Eigen::Vector4d p = Eigen::Vector4d::Zero(), slope = Eigen::Vector4d::Zero();
  for (std::size_t m = 0; m < 4; ++m) {
    p += weights_at(s)[m] * x[m];
    slope += d[m] * x[m];
  }
  const Vector3d along = slope.head<3>(), flat = along - a * a.dot(along);
  const Vector3d t = flat.normalized(), n = a.cross(t);
  const double lean = a.dot(along) / flat.norm();
  return p.head<3>() + H * (n + p[3] * a) + y * (a - lean * t - p[3] * n);
}

/// The fourth entry of a tip is half the height difference between the ends of its cell. This
/// function returns the share of the cell below z = 0, the next one the mean over the cell of the
/// squared depth.
double share_below(const Eigen::Vector4d& tip) {
  const double low = tip[2] - std::abs(tip[3]), high = tip[2] + std::abs(tip[3]);
  return high <= 0.0 ? 1.0 : low >= 0.0 ? 0.0 : low / (low - high);
}
double mean_square_below(const Eigen::Vector4d& tip) {
  const double low = tip[2] - std::abs(tip[3]), high = tip[2] + std::abs(tip[3]);
  if (low >= 0.0) return 0.0;
  if (high <= 0.0) return (low * low + low * high + high * high) / 3.0;
  return low * low * low / (3.0 * (low - high));
}

/// Returns the energy of a neo-Hookean block of height b minus that of a linear spring, evaluated
/// at two points of the cell: 1/6 (λ² + 2/λ - 3) b² - δ²/2.
double beyond_linear_below(const Eigen::Vector4d& tip, double b) {
  if (b == 0.0) return 0.0;
  double sum = 0.0;
  for (const double xi : {-1.0, 1.0}) {
    const double depth = std::max(0.0, -(tip[2] + xi / std::sqrt(3.0) * tip[3])),
                 l = 1.0 - depth / b;
    sum += 0.5 * (b * b / 6.0 * (l * l + 2.0 / l - 3.0) - 0.5 * depth * depth);
  }
  return sum;
}

/// Returns the stiffness of a sticking block on the road z = 0 by second differences of its energy.
Eigen::Matrix<double, 16, 16> block_stiffness(
    const NodesOfBlock& at,
    const std::function<double(const Eigen::Vector4d&)>& energy,
    const std::function<Eigen::Vector4d(const NodesOfBlock&)>& tip) {
  constexpr double h = 1e-5;
  const auto moved = [&](int i, double by_i, int j, double by_j) {
    NodesOfBlock x = at;
    x[static_cast<std::size_t>(i / 4)][i % 4] += by_i;
    x[static_cast<std::size_t>(j / 4)][j % 4] += by_j;
    return energy(tip(x));
  };
  Eigen::Matrix<double, 16, 16> K;
  for (int i = 0; i < 16; ++i)
    for (int j = 0; j < 16; ++j)
      K(i, j) =
          (moved(i, h, j, h) - moved(i, h, j, -h) - moved(i, -h, j, h) + moved(i, -h, j, -h)) /
          (4.0 * h * h);
  return K;
}

/// Returns the mass matrix of masses at the belt's knots. The motion of a knot is one sixth, four
/// sixths and one sixth of those of three nodes.
MatrixXd consistent_mass(const RingTire& tire) {
  const int N = tire.parameters().nodes;
  MatrixXd knots = MatrixXd::Zero(4 * N, 4 * N);
  for (int k = 0; k < N; ++k)
    for (const auto& [other, share] :
         {std::pair{k, 4.0}, {(k + 1) % N, 1.0}, {(k + N - 1) % N, 1.0}})
      knots.block<4, 4>(4 * k, 4 * other).diagonal().setConstant(share / 6.0);
  return knots.transpose() * tire.knot_mass().replicate(N, 1).asDiagonal() * knots;
}

/// Returns the stiffness for all unknowns by differences of the belt's and the sidewall's forces
/// and of the blocks' energy.
MatrixXd stiffness_by_differences(const RingTire& tire) {
  const RingParameters& ring = tire.parameters();
  const int N = ring.nodes;
  const BeltForces belt(ring.belt, N);
  const SidewallForces wall(ring.sidewall, ring.belt.radius, N);
  const auto force = [&](const NodeValues& q) {
    const NodeValues f =
        force_of(belt, q, tire.rim()) + at_knots(force_of(wall, at_knots(q), tire.rim()));
    return Eigen::VectorXd(f.reshaped());
  };
  MatrixXd K(4 * N, 4 * N);
  constexpr double h = 1e-6;
  for (int i = 0; i < 4 * N; ++i) {
    NodeValues more = tire.positions(), less = more;
    more.data()[i] += h;
    less.data()[i] -= h;
    K.col(i) = (force(less) - force(more)) / (2.0 * h);
  }
  const auto contacts = tire.contacts();
  const double area = contacts.front().area, H = ring.tread.height;
  const double normal = ring.tread.positive * ring.tread.young_modulus * area / H;
  const double tangential = ring.tread.shear_ratio * normal;
  const Vector3d a = tire.rim().a;
  std::size_t touching = 0;
  for (int segment = 0; segment < N; ++segment)
    for (int line = 0; line < ring.tread.lines; ++line)
      for (int j = 0; j < ring.tread.blocks; ++j) {
        const double s = (j + 0.5) / ring.tread.blocks;
        const double y = ring.tread.width * ((line + 0.5) / ring.tread.lines - 0.5);
        NodesOfBlock at;
        for (int m = 0; m < 4; ++m)
          at[static_cast<std::size_t>(m)] = tire.positions().col((segment + m - 1 + N) % N);
        const double cell = 0.5 / ring.tread.blocks;
        // Position of the tip. The fourth entry is half the height difference of the belt between
        // the ends of the cell.
        const auto tip = [&](const NodesOfBlock& x) {
          const double rise = 0.5 * (belt_at(x, s + cell) - belt_at(x, s - cell)).z();
          return (Eigen::Vector4d() << tip_of(x, s, H, y, a), rise).finished();
        };
        const Eigen::Vector4d T = tip(at);
        const double share = share_below(T);
        if (share == 0.0) continue;
        ++touching;
        const BlockContact* own = &contacts.front();
        for (const BlockContact& contact : contacts)
          if ((contact.root - T.head<3>()).head<2>().norm() <
              (own->root - T.head<3>()).head<2>().norm())
            own = &contact;
        const auto energy = [&](const Eigen::Vector4d& now) {
          const Eigen::Vector2d gone = (now - T).head<2>();
          return 0.5 * normal * mean_square_below(now) +
                 normal * beyond_linear_below(now, ring.tread.bottoming * H) +
                 0.5 * tangential * share * gone.squaredNorm() - own->force.head<2>().dot(gone);
        };
        const auto block = block_stiffness(at, energy, tip);
        for (int m = 0; m < 4; ++m)
          for (int o = 0; o < 4; ++o)
            K.block<4, 4>(4 * ((segment + m - 1 + N) % N), 4 * ((segment + o - 1 + N) % N)) +=
                block.block<4, 4>(4 * m, 4 * o);
      }
  EXPECT_EQ(touching, contacts.size());
  return K;
}

// The reference is a dense generalized eigenvalue problem with matrices from finite differences: of
// the forces of belt and sidewall, and of an energy of the blocks that this test computes
// independently. Differences with steps of 1e-5 m of an energy of up to 1 J have an error of 4e-6
// of a block's stiffness.
TEST(StandingModes, AreThoseOfADenseMatrixOfDifferences) {
  RingParameters ring = passenger_ring();
  ring.sidewall.progressivity = 1.2;
  for (const auto& [depth, bottoming] : {std::pair{0.004, 0.0}, {0.025, 0.0}, {0.025, 0.35}}) {
    ring.tread.bottoming = bottoming;
    const RingTire tire = standing(ring, depth);
    const MatrixXd K = stiffness_by_differences(tire);
    const MatrixXd M = consistent_mass(tire);
    const Eigen::VectorXd squares =
        numerics::generalized_eigenvalues(MatrixXd(0.5 * (K + K.transpose())), M);
    const auto modes = standing_modes(tire, 24);
    ASSERT_TRUE(modes) << modes.failure().reason;
    for (int i = 0; i < 24; ++i) {
      const double expected = std::sqrt(squares[i]) / (2.0 * std::numbers::pi);
      EXPECT_NEAR((*modes)[static_cast<std::size_t>(i)].frequency / expected, 1.0, 2e-6)
          << depth << " m, mode " << i;
    }
  }
}

// Off the road the modes must be those of the ring at rest, where every mode with n > 0 occurs
// twice.
TEST(StandingModes, OfATireInTheAirAreTheUnloadedOnes) {
  RingParameters ring = passenger_ring();
  ring.sidewall.radial.dynamic_stiffening = 0.2;
  ring.belt.damping_time = 1e-4;
  const RingTire tire = standing(ring, -0.01);
  const auto modes = standing_modes(tire, 24);
  ASSERT_TRUE(modes) << modes.failure().reason;
  std::vector<RingMode> expected;
  for (const RingMode& mode : unloaded_modes(ring, 14))
    expected.insert(expected.end(), mode.n == 0 ? 1 : 2, mode);
  std::sort(expected.begin(), expected.end(), [](const RingMode& a, const RingMode& b) {
    return a.frequency < b.frequency;
  });
  for (std::size_t i = 0; i < modes->size(); ++i) {
    const StandingMode& mode = (*modes)[i];
    EXPECT_EQ(mode.n, expected[i].n) << i;
    EXPECT_EQ(mode.lateral, expected[i].lateral) << i;
    EXPECT_NEAR(mode.share, 1.0, 1e-9) << i;
    EXPECT_NEAR(mode.frequency / expected[i].frequency, 1.0, 1e-7) << i;
    EXPECT_NEAR(mode.damping / expected[i].damping, 1.0, 1e-6) << i;
  }
}

/// Modes in the plane of the rim that are symmetric to φ = 0: their ω², and the downward motion of
/// a block's tip that depends on the nodes at φ = -3, -1, 1, 3 half segments.
struct Poles {
  std::vector<double> squared, moved;
};
Poles symmetric_poles(const RingParameters& ring) {
  Poles poles;
  const double x = 2.0 * std::numbers::pi / ring.nodes;
  // Returns the motion of the belt's curve in the middle of a segment, for a wave m of the knots
  // with amplitude 1.
  const auto middle = [&](int m) {
    const double knots = (4.0 + 2.0 * std::cos(m * x)) / 6.0;
    return (23.0 * std::cos(0.5 * m * x) + std::cos(1.5 * m * x)) / 24.0 / knots;
  };
  for (const RingMode& mode : unloaded_modes(ring, ring.nodes / 2)) {
    if (mode.lateral) continue;
    // The shapes are u_r = A cos n φ, u_t = -+B sin n φ. In the lower one of two modes the belt
    // keeps its length, u_r + u_t' = 0, which requires the minus sign; in the upper one the sign is
    // plus, by orthogonality.
    const double sign = mode.order == 1 ? -1.0 : 1.0;
    // The downward motion u_r cos φ - u_t sin φ consists of the waves n + 1 and n - 1.
    const double u_r = mode.shape[0], u_t = sign * mode.shape[1];
    const double down = 0.5 * ((u_r + u_t) * middle(mode.n + 1) + (u_r - u_t) * middle(mode.n - 1));
    const bool single = mode.n == 0 || 2 * mode.n == ring.nodes;
    poles.squared.push_back(std::pow(2.0 * std::numbers::pi * mode.frequency, 2));
    poles.moved.push_back((single ? 1.0 : 2.0) / ring.nodes * down * down);
  }
  return poles;
}

// A single block without shear stiffness touches the road and acts as a spring of stiffness c
// between road and ring. The frequencies of modes symmetric to it are roots of the secular equation
//   1/c + Σ φ_i²/(ω_i² - ω²) = 0
// over the unloaded modes, where φ_i is the motion of the tip in mode i. At the depth of 1 µm, 3e-6
// of the radius, the block carries one newton.
TEST(StandingModes, OnOneBlockSolveTheSecularEquation) {
  RingParameters ring = passenger_ring();
  ring.tread.lines = ring.tread.blocks = 1;
  ring.tread.shear_ratio = 1e-9;
  RingTire tire(ring);
  WheelMotion motion;
  motion.center.z() = tire.free_radius() - 1e-6;
  // Puts the block of the first segment at the lowest point.
  motion.spin = std::numbers::pi / ring.nodes;
  ASSERT_TRUE(tire.settle(motion, road::PlaneRoad(), 0.0));
  ASSERT_EQ(tire.contacts().size(), 1u);
  const double c =
      ring.tread.positive * ring.tread.young_modulus * tire.contacts()[0].area / ring.tread.height;
  const Poles poles = symmetric_poles(ring);
  const auto secular = [&](double squared) {
    double sum = 1.0 / c;
    for (std::size_t i = 0; i < poles.squared.size(); ++i)
      sum += poles.moved[i] / (poles.squared[i] - squared);
    return sum;
  };
  std::vector<double> sorted = poles.squared;
  std::sort(sorted.begin(), sorted.end());
  const auto modes = standing_modes(tire, 40);
  ASSERT_TRUE(modes) << modes.failure().reason;
  for (std::size_t i = 0; i < 6; ++i) {
    double low = sorted[i] * (1.0 + 1e-12), high = sorted[i + 1] * (1.0 - 1e-12);
    if (secular(low) * secular(high) > 0.0) continue;  // no root: this mode does not move the tip
    for (int k = 0; k < 60; ++k) {
      const double middle = 0.5 * (low + high);
      (secular(low) * secular(middle) > 0.0 ? low : high) = middle;
    }
    const double expected = std::sqrt(low) / (2.0 * std::numbers::pi);
    double nearest = 1.0;
    for (const StandingMode& mode : *modes)
      nearest = std::min(nearest, std::abs(mode.frequency / expected - 1.0));
    EXPECT_LT(nearest, 3e-6) << expected << " Hz";
  }
}

// The contact splits every pair of modes; one mode of each pair is symmetric to it.
TEST(StandingModes, ComeSymmetricAndAntisymmetric) {
  const RingTire tire = standing(passenger_ring(), 0.02);
  const auto modes = standing_modes(tire, 10);
  ASSERT_TRUE(modes);
  for (const StandingMode& mode : *modes) EXPECT_NE(mode.phase, ' ') << mode.frequency;
}

}  // namespace
}  // namespace latsch::ring_tire
