// SPDX-License-Identifier: Apache-2.0
// Friction of rolling on finite-element rings against Carter's line contact and the brush model.
#include <gtest/gtest.h>

#include <cmath>

#include "rolling_rings.h"

namespace latsch::verification {
namespace {

using fe_tire::RollingForces;
using fe_tire::RollingState;

/// Returns the least x of a point that sticks on the middle line, m.
double stick_border(const RollingState& state) {
  double least = 1.0;
  for (const auto& point : state.patch)
    if (point.line == 2 && point.sticks) least = std::min(least, point.x);
  return least;
}

/// Slips of a ring on the drum of this radius (m; 0: flat ground) have Carter's forces, 2 %, and
/// borders of sticking, one place.
void expect_carter(double drum) {
  constexpr int kAcross = 40;
  CarterRing carter(kAcross, drum);
  const double a = fit_hertz(carter.ring().free_wheel()).a;
  const double place = 2.0 * CarterRing::kHalf / kAcross;
  for (const bool lateral : {false, true}) {
    for (const CarterRing::Slip& slip : CarterRing::kSlips) {
      const double share = slip.share, force = lateral ? slip.lateral : slip.along;
      const double along =
          CarterRing::kMu * a / CarterRing::radius(drum) * (1.0 - std::sqrt(1.0 - share));
      const RollingState state =
          lateral ? carter.ring().slipping(0.0, std::atan(along / (1.0 - CarterRing::kNu)))
                  : carter.ring().slipping(along, 0.0);
      const Eigen::Vector3d& F = state.forces.force;
      const double Q = (lateral ? -F.y() : F.x()) / (CarterRing::kMu * F.z());
      EXPECT_NEAR(Q, force, 0.02 * force) << lateral;
      // A ring that is steered on a drum touches along a slanted line.
      if (drum > 0.0 && lateral) continue;
      EXPECT_NEAR(stick_border(state), a * (1.0 - 2.0 * std::sqrt(1.0 - share)), place) << lateral;
    }
  }
}

// Half width and pressure are those of the ring itself, so its finite thickness hardly matters: by
// line_contact.py, an independent program, Carter's force with this half width is within 0.2 % of
// that of the layer. By the same program the ring's Poisson's ratio of 0.48 adds up to 1.0 % along.
TEST(RollingFriction, ThickRingHasCartersForceAndStickBorder) { expect_carter(0.0); }

// Two cylinders touch as one on a plane does whose curvature is the sum of both.
TEST(RollingFriction, ThickRingOnADrumHasCartersForceAndStickBorder) { expect_carter(0.6); }

// The columns' ends are averaged over two elements by (T.1) and their pressure lowers their shear
// stiffness by 0.2 %; forces are up to 2.0 % off those of the brush model on 40 elements.
TEST(RollingFriction, ColumnsOnARigidRimAreABrush) {
  BrushRing brush(40);
  const HertzFit fit = fit_parabola(brush.ring().free_wheel());
  const double full = BrushRing::kMu * 2.0 * fit.p_0 / (fit.a * BrushRing::stiffness());
  for (const double s : {0.2, 0.4, 0.6}) {
    const RollingState state = brush.ring().slipping(0.0, std::atan(s * full));
    const Eigen::Vector3d& F = state.forces.force;
    const double share = s * (3.0 - 3.0 * s + s * s);
    EXPECT_NEAR(-F.y() / (BrushRing::kMu * F.z()), share, 0.03 * share) << s;
    const double trail = -state.forces.moment.z() / F.y() / fit.a;
    EXPECT_NEAR(trail, std::pow(1.0 - s, 3) / (3.0 - 3.0 * s + s * s), 0.012) << s;
  }
}

/// Returns the side force of a ring of columns in a wide turn, as a share of the closed form's.
/// Columns that enter at x = a and stick are sheared by phi (a^2 - x^2)/2, a parabola as their
/// pressure is, so the force is to mu Fz as the turn slip is to 2 mu p_0/(c a^2).
double force_in_a_turn(int across, double share) {
  BrushRing brush(across);
  const HertzFit fit = fit_parabola(brush.ring().free_wheel());
  const double full = BrushRing::kMu * 2.0 * fit.p_0 / (fit.a * fit.a * BrushRing::stiffness());
  const Eigen::Vector3d force = brush.ring().turning(share * full).forces.force;
  return force.y() / (BrushRing::kMu * force.z() * share);
}

// The turn is so wide that both ends of the columns hardly move along. The forces are 5.5 % below
// the closed form on 40 elements and 3.7 % on 80; those of a slip angle are 2.5 and 2.1 % below.
TEST(RollingFriction, ColumnsInATurnTendToTheForceOfAParabola) {
  for (const double share : {-0.04, 0.02}) {
    const double coarse = force_in_a_turn(40, share), fine = force_in_a_turn(80, share);
    EXPECT_NEAR(fine, 1.0, 0.05) << share;
    EXPECT_LT(1.0 - fine, 0.8 * (1.0 - coarse)) << share;
  }
}

}  // namespace
}  // namespace latsch::verification
