// SPDX-License-Identifier: Apache-2.0
#include "models/ring_tire/tread/tread_contact.h"

#include <gtest/gtest.h>

#include <cmath>

#include "models/ring_tire/description/ring_parameters_testing.h"
#include "models/ring_tire/tread/touching_blocks.h"
#include "models/road/plane_road.h"

#define LATSCH_KERNELS_IN "models/ring_tire/tread/friction_testing.h"
#include "numerics/kernels/for_each_kernel_set.h"

namespace latsch::ring_tire {
namespace {

TEST(FrictionLaw, GoesThroughItsTable) {
  const TreadFriction table;
  const FrictionLaw law(table);
  for (std::size_t i = 0; i < 3; ++i) {
    const double p = table.pressure[i];
    EXPECT_NEAR(law.mu(0.0, p), table.adhesion[i], 1e-14);
    EXPECT_NEAR(law.mu(table.maximum_speed, p), table.maximum[i], 1e-14);
    EXPECT_NEAR(law.mu(table.sliding_speed, p), table.sliding[i], 1e-14);
    EXPECT_NEAR(law.mu(100.0, p), table.blocking[i], 1e-14);
  }
  EXPECT_DOUBLE_EQ(law.mu(1.0, 0.0), law.mu(1.0, table.pressure[0]));
}

// (14) holds at the computed speed, which is 0 only if the tip sticks.
TEST(FrictionLaw, SlidingTipIsInBalance) {
  const FrictionLaw law{TreadFriction{}};
  const double slope = 2.0, Fn = 10.0, p = 1.5e5;
  for (const KernelSet set : kernel_sets()) {
    const WithKernelSet with(set);
    const auto speed = [&](double T) {
      return LATSCH_KERNEL(sliding_speed_of)(law, T, slope, Fn, p);
    };
    EXPECT_EQ(speed(0.99 * law.mu(0.0, p) * Fn), 0.0);
    for (double T : {12.0, 13.0, 20.0, 40.0, 90.0}) {
      const double v = speed(T);
      EXPECT_GT(v, 0.0);
      EXPECT_NEAR(T - slope * v, law.mu(v, p) * Fn, 1e-12 * T);
    }
  }
}

struct Pressed {
  RingParameters ring = passenger_ring();
  RingTreadContact tread{ring.tread, ring.belt.radius, ring.nodes};
  NodeAngles angles{ring.nodes};
  RimFrame rim;
  NodeValues q{4, 80}, v = NodeValues::Zero(4, 80);
  road::PlaneRoad road{{.grade = 0.05, .bank = 0.02}};
  StepRule rule{.step = 1e-3, .velocity = 2.0e3};

  explicit Pressed(int blocks = 10, double bottoming = 0.0) {
    ring.tread.blocks = blocks;
    ring.tread.bottoming = bottoming;
    ring.tread.damping_time = 1e-4;
    tread = RingTreadContact(ring.tread, ring.belt.radius, ring.nodes);
    WheelMotion motion;
    motion.center.z() = ring.belt.radius + ring.tread.height - 0.006;
    rim = RimFrame::of(motion);
    for (int k = 0; k < ring.nodes; ++k) {
      q.col(k) << rim.center + ring.belt.radius * angles.radial(rim, k), 0.01 * std::sin(k);
      q(1, k) += 0.003 * std::cos(2.0 * k);  // a slope and a twist everywhere
    }
    tread.approach(q, rim, road, 0.0, rule, {&q, &v});
    NodeValues force = NodeValues::Zero(4, ring.nodes);
    tread.add_force(q, v, force);
    tread.commit();  // all touching blocks get a tip on the road
    tread.approach(q, rim, road, 0.0, rule, {&q, &v});
  }

  /// Returns the forces if the unknowns move by dq within the step.
  NodeValues force_at(const NodeValues& dq) {
    NodeValues force = NodeValues::Zero(4, ring.nodes);
    tread.add_force(q + dq, v + rule.velocity * dq, force);
    return force;
  }
};

/// Returns the largest deviation of the stiffness from the derivative of the force in some columns.
double error_of_stiffness(int blocks, double bottoming) {
  Pressed pressed(blocks, bottoming);
  const NodeValues none = NodeValues::Zero(4, pressed.ring.nodes);
  pressed.force_at(none);
  CyclicBand K(pressed.ring.nodes);
  pressed.tread.add_stiffness(1.0, K);
  EXPECT_GT(pressed.tread.contacts(pressed.q).size(), 50u);
  double error = 0.0;
  for (int k : {79, 0, 1})
    for (int i = 0; i < 4; ++i) {
      NodeValues dq = none;
      dq(i, k) = 1e-8;
      const NodeValues slope = (pressed.force_at(-dq) - pressed.force_at(dq)) / 2e-8;
      const NodeValues column = K.multiply(dq) / 1e-8;
      error = std::max(error, (slope - column).norm() / column.norm());
    }
  return error;
}

// The stiffness omits the change of the cells' slopes, which falls with the square of their length.
TEST(RingTreadContact, StiffnessIsTheDerivativeOfTheForceOfNarrowCellsWhileTipsStick) {
  for (const double bottoming : {0.0, 1.0}) {
    const double wide = error_of_stiffness(5, bottoming),
                 narrow = error_of_stiffness(20, bottoming);
    EXPECT_LT(narrow, 5e-4) << bottoming;
    EXPECT_GT(wide, 12.0 * narrow) << bottoming;
  }
}

// The results agree with the closed forms of a cell that is half on the road.
TEST(RingTreadContact, CellsAreTheMeanOfThinBlocks) {
  const double a = 3e-4;
  for (const double depth : {-4e-4, -2e-4, -5e-5, 1e-4, 5e-4})
    for (const double g : {a, -a, 0.0}) {
      constexpr int kThin = 20000;
      double mean = 0.0, share = 0.0, both = 0.0, half = 0.0;
      for (int i = 0; i < kThin; ++i) {
        const double xi = (2.0 * i + 1.0) / kThin - 1.0, at = depth + g * xi;
        if (at <= 0.0) continue;
        mean += at * at / kThin;
        share += 1.0 / kThin;
        both += xi / kThin;
        half += xi * xi / kThin;
      }
      const CellSquares cell(depth, g, 0.0);
      EXPECT_NEAR(cell.mean, mean, 1e-11) << depth << " " << g;
      EXPECT_NEAR(cell.by_depth, share, 1e-4) << depth << " " << g;
      if (g == 0.0) continue;
      EXPECT_NEAR(cell.by_both, both, 1e-4) << depth << " " << g;
      EXPECT_NEAR(cell.by_half, half, 1e-4) << depth << " " << g;
    }
}

TEST(RingTreadContact, ForcesOfTheNodesAreThoseOfTheBlocks) {
  Pressed pressed;
  NodeValues dq = NodeValues::Zero(4, pressed.ring.nodes);
  dq.row(0).setConstant(2e-4);
  const NodeValues force = pressed.force_at(dq);
  Eigen::Vector3d of_blocks = Eigen::Vector3d::Zero();
  for (const BlockContact& block : pressed.tread.contacts(pressed.q + dq)) of_blocks += block.force;
  const Eigen::Vector3d of_nodes = force.topRows<3>().rowwise().sum();
  EXPECT_LT((of_nodes - of_blocks).norm(), 1e-10 * of_blocks.norm());
  EXPECT_LT(of_nodes.x(), -50.0);  // shear holds the tire back
}

}  // namespace
}  // namespace latsch::ring_tire
