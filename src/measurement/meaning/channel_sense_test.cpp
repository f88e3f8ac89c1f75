// SPDX-License-Identifier: Apache-2.0
// Checks the signs of channels with vectors in space, which Eigen rotates into the axes of each
// convention.
#include "measurement/meaning/channel_sense.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

namespace latsch {
namespace {

using Eigen::AngleAxisd;
using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr AxisConvention kConventions[] = {
    AxisConvention::iso, AxisConvention::adapted_sae, AxisConvention::sae, AxisConvention::adams};

/// Returns the axes of a convention: half a turn about the forward axis turns left and up into
/// right and down, and half a turn about the upward axis turns forward and left into rearward and
/// right, as in car models of Adams.
Matrix3d turned_axes(AxisConvention convention) {
  if (convention == AxisConvention::iso) return Matrix3d::Identity();
  if (convention == AxisConvention::adams)
    return AngleAxisd(M_PI, Vector3d::UnitZ()).toRotationMatrix();
  return AngleAxisd(M_PI, Vector3d::UnitX()).toRotationMatrix();
}

double sign(const char* name, AxisConvention from) {
  return sign_to_iso(channel_senses(name), from);
}

/// Expects that the components of a vector in a convention, multiplied by the signs, are those in
/// iso.
void expect_components(const std::array<const char*, 3>& names,
                       const Vector3d& iso,
                       const Vector3d& written,
                       AxisConvention convention) {
  for (int i = 0; i < 3; ++i)
    EXPECT_NEAR(sign(names[static_cast<std::size_t>(i)], convention) * written[i], iso[i], 1e-12)
        << names[static_cast<std::size_t>(i)];
}

TEST(ChannelSense, DisplacementsVelocitiesAndForcesAreArrows) {
  const Vector3d arrow(1.0, 2.0, 3.0);
  for (const AxisConvention convention : kConventions) {
    const Vector3d written = turned_axes(convention).transpose() * arrow;
    expect_components({"dx", "dy", "dz"}, arrow, written, convention);
    expect_components({"dx_L", "dy_R", "dz_FL"}, arrow, written, convention);
    expect_components({"x", "y", "z"}, arrow, written, convention);
    expect_components({"Vx", "Vy", "Vz"}, arrow, written, convention);
    EXPECT_NEAR(sign("FY", convention) * written.y(), arrow.y(), 1e-12);
    EXPECT_NEAR(sign("Seitenkraft", convention) * written.y(), arrow.y(), 1e-12);
  }
}

// A small rotation moves a point p by θ x p; θ is computed in the axes of the convention.
TEST(ChannelSense, MomentsAndTurnsAreArrowsAboutTheAxes) {
  const Vector3d turn(0.01, 0.02, 0.03);
  for (const AxisConvention convention : kConventions) {
    const Matrix3d R = turned_axes(convention).transpose();
    const Vector3d p(0.3, -0.4, 0.5), q = R * p, moved = R * turn.cross(p);
    // The equation θ x q = moved is solved for θ with two further points.
    Matrix3d cross;
    cross << 0.0, q.z(), -q.y(), -q.z(), 0.0, q.x(), q.y(), -q.x(), 0.0;
    const Vector3d p2(1.0, 0.2, -0.7), q2 = R * p2, moved2 = R * turn.cross(p2);
    Matrix3d cross2;
    cross2 << 0.0, q2.z(), -q2.y(), -q2.z(), 0.0, q2.x(), q2.y(), -q2.x(), 0.0;
    Eigen::Matrix<double, 6, 3> A;
    A << cross, cross2;
    Eigen::Matrix<double, 6, 1> b;
    b << moved, moved2;
    const Matrix3d normal = A.transpose() * A;
    const Vector3d written = normal.inverse() * (A.transpose() * b);
    expect_components({"roll", "pitch", "yaw"}, turn, written, convention);
    expect_components({"about_x", "about_y", "about_z"}, turn, written, convention);
    expect_components({"Mx", "My", "Mz"}, turn, written, convention);
    EXPECT_NEAR(sign("steer", convention) * written.z(), turn.z(), 1e-12);
    EXPECT_NEAR(sign("inclination angle", convention) * written.x(), turn.x(), 1e-12);
  }
}

// Tables of a K&C rig contain slopes of one quantity over another.
TEST(ChannelSense, SlopesHaveTheSignsOfBothQuantities) {
  for (const AxisConvention convention : kConventions) {
    const Matrix3d R = turned_axes(convention).transpose();
    const Vector3d force = R * Vector3d(1, 1, 1), moved = R * Vector3d(0.1, 0.2, 0.3);
    const double load = convention == AxisConvention::adapted_sae ? -force.z() : force.z();
    EXPECT_NEAR(sign("dy_by_Fy", convention) * moved.y() / force.y(), 0.2, 1e-12);
    EXPECT_NEAR(sign("dz_by_Fz", convention) * moved.z() / load, 0.3, 1e-12);
    EXPECT_NEAR(sign("dz_L_by_Fy_R", convention) * moved.z() / force.y(), 0.3, 1e-12);
    EXPECT_NEAR(sign("dx_by_Fz", convention) * moved.x() / load, 0.1, 1e-12);
    // Toe-in and camber are defined without axes, so their slopes change sign with the force alone.
    EXPECT_NEAR(sign("toe_by_Fy", convention) * 0.05 / force.y(), 0.05, 1e-12);
  }
}

// A wheel on a path that bends to the left has the yaw rate ψ' > 0 about the upward axis. Pacejka's
// book defines φt = -ψ' / V about the downward axis.
TEST(ChannelSense, TurnSlipFollowsFromItsDefinition) {
  const double yaw_rate = 0.2, V = 10.0;
  for (const AxisConvention convention : kConventions) {
    if (convention == AxisConvention::adams) continue;  // it defines no turn slip
    const double about_z = (turned_axes(convention).transpose() * Vector3d(0, 0, yaw_rate)).z();
    const double written = (convention == AxisConvention::adapted_sae ? -about_z : about_z) / V;
    EXPECT_NEAR(sign("phit", convention) * written, yaw_rate / V, 1e-12);
  }
}

TEST(ChannelSense, WhatIsDefinedWithoutAxesIsKnownAndStays) {
  for (const char* name : {"toe",
                           "camber_L",
                           "Camber",
                           "Camber L",
                           "camber_right",
                           "caster",
                           "travel_R",
                           "post_FL",
                           "omega",
                           "WHROTSPD",
                           "kappa",
                           "RL",
                           "P",
                           "TSTC",
                           "other_toe"}) {
    EXPECT_TRUE(channel_senses(name).is_known()) << name;
    for (const AxisConvention convention : kConventions)
      EXPECT_EQ(sign(name, convention), 1.0) << name;
  }
}

TEST(ChannelSense, AForceOverTheLoadIsTurnedAsBoth) {
  // The tire test consortium writes FX/FZ and FY/FZ in the axes of SAE, with a load below 0.
  EXPECT_EQ(sign("NFX", AxisConvention::sae), -1.0);
  EXPECT_EQ(sign("NFY", AxisConvention::sae), 1.0);
  EXPECT_EQ(sign("NFX", AxisConvention::adapted_sae), 1.0);
  EXPECT_EQ(sign("NFY", AxisConvention::adapted_sae), -1.0);
  for (const AxisConvention convention : kConventions)
    EXPECT_EQ(sign("NFY", convention), sign("Fy", convention) * sign("Fz", convention));
}

TEST(ChannelSense, AnUnknownNameIsNotTurnedAndSaysSo) {
  for (const char* name : {"left_pad", "dy_by_nothing", "FREQ"}) {
    EXPECT_FALSE(channel_senses(name).is_known()) << name;
    EXPECT_EQ(sign(name, AxisConvention::sae), 1.0) << name;
  }
}

}  // namespace
}  // namespace latsch
