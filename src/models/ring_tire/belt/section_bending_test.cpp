// SPDX-License-Identifier: Apache-2.0
#include "models/ring_tire/belt/section_bending.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <cmath>
#include <functional>
#include <vector>

#include "models/ring_tire/description/ring_parameters_testing.h"
#include "models/ring_tire/ring/ring_tire.h"
#include "models/ring_tire/ring/standing_modes.h"
#include "models/road/kerb.h"
#include "models/road/plane_road.h"
#include "models/road/profile_road.h"
#include "numerics/dense/self_adjoint_eigen.h"

namespace latsch::ring_tire {
namespace {

constexpr double kWidth = 0.16, kChord = 0.024, kTension = 5800.0;
constexpr int kBendingNodes = 80;

SectionBending section_of(double bending, double coupling) {
  Belt belt;
  belt.bending_across = bending;
  belt.section_coupling = coupling;
  return {belt, kWidth, kChord, kTension, kBendingNodes};
}

/// Returns the integral of f over the width by Simpson's rule.
template <class Function>
double over_width(const Function& f) {
  constexpr int kParts = 2000;
  double sum = 0.0;
  for (int i = 0; i <= kParts; ++i) {
    const double y = kWidth * (static_cast<double>(i) / kParts - 0.5);
    sum += f(y) * (i == 0 || i == kParts ? 1.0 : i % 2 == 1 ? 4.0 : 2.0);
  }
  return sum * kWidth / (3.0 * kParts);
}

// Modes of a free beam are orthogonal to each other and to rigid motions.
TEST(SectionBending, ShapesAreModesOfAFreeBeam) {
  const SectionBending section = section_of(10.0, 1.0);
  for (int i = 0; i < SectionBending::kModes; ++i) {
    EXPECT_NEAR(over_width([&](double y) { return section.shape(i, y); }), 0.0, 1e-12);
    EXPECT_NEAR(over_width([&](double y) { return y * section.shape(i, y); }), 0.0, 1e-12);
    for (int j = 0; j <= i; ++j)
      EXPECT_NEAR(over_width([&](double y) { return section.shape(i, y) * section.shape(j, y); }),
                  i == j ? kWidth : 0.0,
                  1e-10);
  }
}

// D u'''' = p of a free beam is integrated twice by hand: M'' = p from a free end, u'' = M/D, for
// loads without resultant and moment. The beam is the same all around the ring, so there is no
// coupling.
TEST(SectionBending, BendsAsABeamUnderLineLoads) {
  constexpr double kBending = 12.0;
  const SectionBending section = section_of(kBending, 1.0);
  const auto even = [](double y) { return std::cos(2.0 * M_PI * y / kWidth) * 1e5; };
  const auto odd = [](double y) {  // y³ minus its linear part
    return 1e5 * (std::pow(2.0 * y / kWidth, 3) - 0.6 * 2.0 * y / kWidth);
  };
  for (const auto& load : std::vector<std::function<double(double)>>{even, odd}) {
    constexpr int kParts = 20000;
    const double step = kWidth / kParts;
    std::vector<double> u(kParts + 1);
    double shear = 0.0, moment = 0.0, slope = 0.0, place = 0.0;
    for (int i = 0; i <= kParts; ++i) {  // midpoint rule, of second order
      u[static_cast<std::size_t>(i)] = place;
      const double p = load(kWidth * ((i + 0.5) / kParts - 0.5));
      const double moment_then = moment + step * shear + 0.5 * step * step * p;
      const double slope_then = slope + 0.5 * step * (moment + moment_then) / kBending;
      place += 0.5 * step * (slope + slope_then);
      shear += step * p;
      moment = moment_then;
      slope = slope_then;
    }
    SectionBending::Field f(SectionBending::kModes, kBendingNodes);
    for (int i = 0; i < SectionBending::kModes; ++i)
      f.row(i).setConstant(kChord *
                           over_width([&](double y) { return load(y) * section.shape(i, y); }));
    const SectionBending::Field bent = section.bent_by(f);
    for (int i = 0; i < SectionBending::kModes; ++i) {
      double share = 0.0;
      for (int j = 0; j <= kParts; ++j)
        share += (j == 0 || j == kParts ? 0.5 : 1.0) * u[static_cast<std::size_t>(j)] *
                 section.shape(i, kWidth * (static_cast<double>(j) / kParts - 0.5)) / kParts;
      EXPECT_NEAR(bent(i, 7), share, 1e-6 * bent.col(7).cwiseAbs().maxCoeff()) << i;
    }
  }
}

// The closed form of the inverse is inserted into (25).
TEST(SectionBending, IsSmoothedAlongTheRingByACyclicTridiagonalSystem) {
  for (const double coupling : {0.0, 1.0, 20.0}) {
    const SectionBending section = section_of(8.0, coupling);
    SectionBending::Field f = SectionBending::Field::Zero(SectionBending::kModes, kBendingNodes);
    f.col(0) << 100.0, -50.0, 20.0;
    f.col(kBendingNodes - 1) << 30.0, 10.0, 0.0;
    const SectionBending::Field bent = section.bent_by(f);
    const double beta[] = {4.730040744862704, 7.853204624095838, 10.995607838001671};
    for (int i = 0; i < SectionBending::kModes; ++i) {
      const double own = 8.0 * std::pow(beta[i], 4) / std::pow(kWidth, 3) * kChord;
      const double next = coupling * kTension / kChord;
      for (int k = 0; k < kBendingNodes; ++k) {
        const double neighbors =
            bent(i, (k + 1) % kBendingNodes) + bent(i, (k + kBendingNodes - 1) % kBendingNodes);
        EXPECT_NEAR((own + 2.0 * next) * bent(i, k) - next * neighbors, f(i, k), 1e-9);
      }
    }
  }
}

RingParameters crowned(double bending) {
  RingParameters ring = passenger_ring();
  ring.tread.lines = 10;
  ring.tread.crown_radius = 0.7;
  ring.belt.bending_across = bending;
  return ring;
}

WheelMotion standing(const RingTire& tire, double depth, double camber = 0.0) {
  WheelMotion motion;
  motion.center.z() = tire.free_radius() - depth;
  motion.carrier = Eigen::AngleAxisd(camber, Eigen::Vector3d::UnitX()).toRotationMatrix();
  return motion;
}

Eigen::Vector3d of_road(const RingTire& tire) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const BlockContact& block : tire.contacts()) sum += block.force;
  return sum;
}

// A crown pushes the middle of the section inward: more lines touch, with less pressure in the
// middle. The forces on the hub equal those of the road.
TEST(SectionBending, FlattensTheCrownInBalance) {
  RingTire stiff(crowned(0.0)), soft(crowned(8.0));
  for (const double camber : {0.0, 0.05}) {
    const auto straight = stiff.settle(standing(stiff, 0.015, camber), road::PlaneRoad(), 0.0);
    const WheelMotion motion = standing(soft, 0.015, camber);
    const auto bent = soft.settle(motion, road::PlaneRoad(), 0.0);
    ASSERT_TRUE(straight);
    ASSERT_TRUE(bent) << bent.failure().reason;
    EXPECT_LT((motion.carrier * bent->force - of_road(soft)).norm(), 0.013);
    EXPECT_LT(bent->force.z(), straight->force.z());
    EXPECT_GE(soft.footprint()->width, stiff.footprint()->width);
    EXPECT_LT(soft.footprint()->mean_pressure(), stiff.footprint()->mean_pressure());
    EXPECT_GT(soft.section().field().row(0).maxCoeff(), 1e-5);  // edges out, middle in
  }
}

// A tire with rigid sections equals one without the parameter in statics, modes and rolling.
TEST(SectionBending, OfAStiffSectionChangesNothing) {
  RingTire without(crowned(0.0)), rigid(crowned(1e9));
  const road::ProfileRoad road = road::cleat_road(0.2, 0.015, 0.03, 0.005, 0.4);
  HubForces forces[2];
  std::vector<double> modes[2];
  for (const int i : {0, 1}) {
    RingTire& tire = i == 0 ? without : rigid;
    WheelMotion motion = standing(tire, 0.02);
    ASSERT_TRUE(tire.settle(motion, road, 0.0));
    const auto found = standing_modes(tire, 10);
    ASSERT_TRUE(found) << found.failure().reason;
    for (const auto& mode : *found) modes[i].push_back(mode.frequency);
    motion.velocity.x() = 10.0;
    motion.spin_rate = 10.0 / 0.31;
    ASSERT_TRUE(tire.settle(motion, road, 0.0));
    for (int step = 1; step <= 60; ++step) {
      motion.center += 5e-4 * motion.velocity;
      motion.spin += 5e-4 * motion.spin_rate;
      const auto hub = tire.advance(motion, road, step * 5e-4, 5e-4);
      ASSERT_TRUE(hub) << hub.failure().reason;
      forces[i] = *hub;
    }
  }
  // Steps end within 0.1 N at a node.
  EXPECT_LT((forces[0].force - forces[1].force).norm(), 2.0);
  for (std::size_t k = 0; k < modes[0].size(); ++k)
    EXPECT_NEAR(modes[1][k] / modes[0][k], 1.0, 1e-5) << k;
}

// The modes of bent sections are compared with a dense matrix with γ eliminated separately: K - B
// (A + G^-1)^-1 B', where G is the bending under unit forces.
TEST(SectionBending, VibratesAsADenseMatrixSays) {
  RingTire tire(crowned(8.0));
  ASSERT_TRUE(tire.settle(standing(tire, 0.02), road::PlaneRoad(), 0.0));
  const auto modes = standing_modes(tire, 12);
  ASSERT_TRUE(modes) << modes.failure().reason;
  const RingTire::Linearized small = tire.linearized();
  const int N = tire.parameters().nodes, count = 4 * N;
  const SectionBending& section = tire.section();
  Eigen::MatrixXd G(section.unknowns(), section.unknowns());
  for (Eigen::Index a = 0; a < G.cols(); ++a) {
    SectionBending::Field f = SectionBending::Field::Zero(SectionBending::kModes, N);
    const auto node = [&](Eigen::Index of) {
      return section.contact()[static_cast<std::size_t>(of / SectionBending::kModes)];
    };
    f(a % SectionBending::kModes, node(a)) = 1.0;
    const SectionBending::Field bent = section.bent_by(f);
    for (Eigen::Index b = 0; b < G.rows(); ++b) G(b, a) = bent(b % SectionBending::kModes, node(b));
  }
  Eigen::MatrixXd K(count, count);
  for (int i = 0; i < count; ++i) {
    NodeValues unit = NodeValues::Zero(4, N);
    unit.data()[i] = 1.0;
    K.col(i) = small.stiffness.multiply(unit).reshaped();
  }
  const Eigen::MatrixXd own = small.section_stiffness + G.inverse();
  K -= small.section_border * own.inverse() * small.section_border.transpose();
  Eigen::MatrixXd M(count, count);
  for (int i = 0; i < count; ++i) {
    NodeValues unit = NodeValues::Zero(4, N);
    unit.data()[i] = 1.0;
    M.col(i) = small.mass.multiply(unit).reshaped();
  }
  const Eigen::VectorXd squares =
      numerics::generalized_eigenvalues(Eigen::MatrixXd(0.5 * (K + K.transpose())), M);
  for (int i = 0; i < 12; ++i) {
    const double expected = std::sqrt(squares[i]) / (2.0 * M_PI);
    EXPECT_NEAR((*modes)[static_cast<std::size_t>(i)].frequency / expected, 1.0, 1e-7) << i;
  }
}

// In steady rolling momentum is constant, so hub and road balance.
TEST(SectionBending, RollsInBalance) {
  RingTire tire(crowned(8.0));
  const road::PlaneRoad road;
  WheelMotion motion = standing(tire, 0.020);
  motion.velocity.x() = 60.0 / 3.6;
  motion.spin_rate = motion.velocity.x() / 0.309;
  ASSERT_TRUE(tire.settle(motion, road, 0.0));
  Eigen::Vector3d hub = Eigen::Vector3d::Zero(), ground = hub;
  constexpr int kRunIn = 300, kMean = 40;
  for (int i = 1; i <= kRunIn + kMean; ++i) {
    motion.center += 5e-4 * motion.velocity;
    motion.spin += 5e-4 * motion.spin_rate;
    const auto now = tire.advance(motion, road, i * 5e-4, 5e-4);
    ASSERT_TRUE(now) << now.failure().reason;
    if (i <= kRunIn) continue;
    hub += now->force / kMean;
    ground += of_road(tire) / kMean;
  }
  EXPECT_LT((hub - ground).norm(), 2e-3 * hub.z());
}

// Blocks that come down at 60 m/s have dampers that carry as much as their springs. To a section,
// which has no inertia, they are twice as stiff as in its tangent.
TEST(SectionBending, RollsOverADeepKerb) {
  const road::ProfileRoad road = road::kerb_road({.shape = road::Kerb::Shape::triangle,
                                                  .pitch = 0.8,
                                                  .width = 0.8,
                                                  .height = -0.025,
                                                  .count = 4,
                                                  .start = {1.0, -0.4}});
  for (const double bending : {4.0, 20.0}) {
    RingParameters ring = passenger_ring();
    ring.nodes = 60;
    ring.tread.blocks = 8;
    ring.tread.damping_time = 1e-4;
    ring.sidewall.radial.dynamic_stiffening = 0.2;
    ring.sidewall.tangential.dynamic_stiffening = 0.05;
    ring.belt.bending_across = bending;
    RingTire tire(ring);
    WheelMotion motion = standing(tire, 0.022);
    motion.velocity.x() = 60.0;
    motion.spin_rate = 60.0 / 0.3085;
    ASSERT_TRUE(tire.settle(motion, road, 0.0));
    constexpr double h = 2e-4;
    for (int i = 1; i <= 450; ++i) {
      motion.center += h * motion.velocity;
      motion.spin += h * motion.spin_rate;
      const auto hub = tire.advance(motion, road, i * h, h);
      ASSERT_TRUE(hub) << bending << ": " << hub.failure().reason;
    }
  }
}

// The tire, pushed sideways and held, vibrates on the ground: dampers and friction take energy,
// nothing supplies any.
TEST(SectionBending, OnTheGroundItRingsAndLosesEnergy) {
  RingTire tire(crowned(8.0), {.tolerance = 1e-6});
  WheelMotion motion = standing(tire, 0.025);
  const road::PlaneRoad road;
  ASSERT_TRUE(tire.settle(motion, road, 0.0));
  constexpr double h = 2.5e-4;
  motion.center += Eigen::Vector3d(0.004, 0.006, 0.004);
  ASSERT_TRUE(tire.advance(motion, road, h, h));
  const double first = tire.energy();
  double last = first;
  EXPECT_FALSE(tire.contacts().empty());
  for (int i = 2; i < 100; ++i) {
    ASSERT_TRUE(tire.advance(motion, road, i * h, h));
    EXPECT_LE(tire.energy(), last + 1e-6) << i;
    last = tire.energy();
  }
  EXPECT_LT(last, first - 0.5);
}

}  // namespace
}  // namespace latsch::ring_tire
