// SPDX-License-Identifier: Apache-2.0
// Checks the signs with a wheel whose motion and forces are given as vectors in space.
#include "measurement/axes.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "base/error.h"

namespace latsch {
namespace {

using Eigen::Vector3d;

// Returns the axes of a convention as rows. Vectors in space have the components forward, left and
// up.
Eigen::Matrix3d axes_of(AxisConvention convention) {
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();
  if (convention != AxisConvention::iso) axes.diagonal() = Vector3d(1, -1, -1);
  return axes;
}

constexpr AxisConvention kAll[] = {
    AxisConvention::iso, AxisConvention::adapted_sae, AxisConvention::sae};

TEST(Axes, ForcesAndMomentsAreTheComponentsOfOneArrowInSpace) {
  const Vector3d force(1, 2, 3), moment(4, 5, 6);  // components forward, left, up
  for (const AxisConvention convention : kAll) {
    Wrench written{axes_of(convention) * force, axes_of(convention) * moment};
    // In the convention "adapted SAE" the load is positive.
    if (convention == AxisConvention::adapted_sae) written.force.z() *= -1;
    EXPECT_EQ(to_iso(written, convention), (Wrench{force, moment}));
    EXPECT_EQ(to_iso(to_iso(written, convention), convention), written);
  }
}

TEST(Axes, AngleOfAWheelThatDriftsToTheLeftFollowsFromItsDefinition) {
  const Vector3d velocity(20, 1.5, 0);  // components forward, left, up
  const double iso = std::atan(1.5 / 20);
  for (const AxisConvention convention : kAll) {
    const Vector3d v = axes_of(convention) * velocity;
    const double sign = convention == AxisConvention::adapted_sae ? -1.0 : 1.0;
    const WheelSlip written{std::atan(sign * v.y() / std::abs(v.x())), 0.02, -0.1};
    EXPECT_EQ(to_iso(written, convention), (WheelSlip{iso, 0.02, -0.1}));
    // The ground pushes to the right. In each convention this is the sign of the side force that
    // belongs to alpha > 0.
    const Vector3d push = axes_of(convention) * Vector3d(0, -1, 0);
    const bool positive_pair = (written.alpha > 0) == (push.y() > 0);
    EXPECT_EQ(positive_pair, convention == AxisConvention::adapted_sae);
  }
}

TEST(Axes, CamberIsARightHandedTurnAboutForwardInAll) {
  for (const AxisConvention convention : kAll) {
    // Position of the top of a wheel that is rotated by gamma > 0 about the x axis of the
    // convention, in components forward, left and up.
    const Vector3d top =
        axes_of(convention).transpose() *
        (Eigen::AngleAxisd(0.1, Vector3d::UnitX()) * (axes_of(convention) * Vector3d(0, 0, 1)));
    EXPECT_LT(top.y(), 0.0);  // the top leans to the right
    EXPECT_EQ(to_iso(WheelSlip{0, 0.1, 0}, convention).gamma, 0.1);
  }
}

TEST(Axes, FramesHaveTheSameForceAndMomentsAboutTheirOrigins) {
  constexpr double gamma = 0.05, radius = 0.3;
  const Wrench in_W{{100, -2000, 4000}, {50, -20, 30}};
  const Wrench in_H = in_frame(in_W, AxisFrame::W, AxisFrame::H, gamma, radius);
  EXPECT_EQ(in_H.force, in_W.force);
  // A wheel that leans to the right stands on a point to the left of its center.
  EXPECT_NEAR(in_H.moment.x(),
              50 + radius * (std::sin(gamma) * 4000 + std::cos(gamma) * -2000),
              1e-12 * 4000);
  EXPECT_NEAR(in_H.moment.y(), -20 - radius * std::cos(gamma) * 100, 1e-12 * 4000);
  const Wrench in_C = in_frame(in_W, AxisFrame::W, AxisFrame::C, gamma, radius);
  // The y axis of frame C is the spin axis; its left end is raised by the angle gamma.
  EXPECT_NEAR(in_C.force.y(), std::cos(gamma) * -2000 + std::sin(gamma) * 4000, 1e-12 * 4000);
  for (const AxisFrame to : {AxisFrame::W, AxisFrame::H, AxisFrame::C}) {
    const Wrench back =
        in_frame(in_frame(in_W, AxisFrame::W, to, gamma, radius), to, AxisFrame::W, gamma, radius);
    EXPECT_LT((back.force - in_W.force).norm() + (back.moment - in_W.moment).norm(), 1e-11);
  }
}

TEST(Axes, ChannelsAreKnownByName) {
  Channels sae;
  for (const char* name : {"FYW", "FZ", "MXH", "mz", "SLIPANGL", "INCLANGL", "FREQ"}) {
    sae.add({name, "1", {2.0}});
  }
  const Channels iso = to_iso(sae, axis_convention_of("sae"));
  for (const char* turned : {"FYW", "FZ", "mz", "SLIPANGL"}) EXPECT_EQ(iso[turned][0], -2.0);
  for (const char* same : {"MXH", "INCLANGL", "FREQ"}) EXPECT_EQ(iso[same][0], 2.0);
  EXPECT_THROW(axis_convention_of("din"), InputError);
}

}  // namespace
}  // namespace latsch
