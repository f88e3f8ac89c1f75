// SPDX-License-Identifier: Apache-2.0
// Corners whose kinematics are known in closed form, and the corner of a real car.
#pragma once

#include <cmath>

#include "models/suspension/corner_geometry.h"

namespace latsch::suspension {

constexpr double kArm = 0.3;  // m, length of the wishbones and of the track-rod

/// Returns a left corner with equal parallel wishbones. Their axes lie in the x-z plane at an angle
/// to x, positive with their rear ends lower; their arms are at an angle to y, positive with their
/// outer ends higher. The track-rod is parallel to the arms, so that the upright only translates.
inline CornerGeometry parallelogram(double axis_angle = 0.0, double arm_angle = 0.0) {
  const Eigen::Vector3d axis(std::cos(axis_angle), 0.0, std::sin(axis_angle));
  const Eigen::Vector3d up(-std::sin(axis_angle), 0.0, std::cos(axis_angle));
  const Eigen::Vector3d arm =
      kArm * (std::cos(arm_angle) * Eigen::Vector3d::UnitY() + std::sin(arm_angle) * up);
  const Eigen::Vector3d upper(0.0, 0.6, 0.4), lower(0.0, 0.6, 0.2), steering(0.1, 0.6, 0.3);
  CornerGeometry corner;
  corner.linkage.links = {{{"uca_front", upper - arm + 0.15 * axis, upper},
                           {"uca_rear", upper - arm - 0.15 * axis, upper},
                           {"lca_front", lower - arm + 0.15 * axis, lower},
                           {"lca_rear", lower - arm - 0.15 * axis, lower},
                           {"trackrod", steering - arm, steering}}};
  corner.linkage.wheel = {.side = Side::left, .center = {0.0, 0.7, 0.3}, .radius = 0.3};
  corner.kingpin = {lower, upper};
  corner.spring.outer = {0.0, 0.6, 0.3};
  corner.spring.inner = {0.0, 0.6, 0.8};
  return corner;
}

/// Returns the front left corner of a student race car (the published set "fsae_parametrica") with
/// push-rod, rocker and anti-roll bar.
inline CornerGeometry race_geometry() {
  using Eigen::Vector3d;
  const Vector3d ubj(1.510800, 0.527786, 0.350000), lbj(1.539399, 0.563477, 0.148512);
  CornerGeometry corner;
  corner.linkage.links = {
      {{"uca_front", {1.648347, 0.273206, 0.303434}, ubj},
       {"uca_rear", {1.406764, 0.273327, 0.309890}, ubj},
       {"lca_front", {1.698576, 0.262926, 0.126153}, lbj},
       {"lca_rear", {1.442210, 0.263181, 0.150828}, lbj},
       {"trackrod", {1.490000, 0.266310, 0.119872}, {1.490000, 0.553400, 0.118540}}}};
  corner.linkage.wheel = {.side = Side::left, .center = {1.55, 0.6125, 0.235}, .radius = 0.235};
  corner.kingpin = {lbj, ubj};
  SpringDrive& spring = corner.spring;
  spring.on = SpringDrive::On::upper_wishbone;
  spring.outer = {1.507720, 0.499027, 0.366606};
  spring.inner = {1.507720, 0.191715, 0.544030};
  spring.hinge_front = corner.linkage.links[0].inner;
  spring.hinge_rear = corner.linkage.links[1].inner;
  spring.ball = ubj;
  const Vector3d pivot(1.461665, 0.180000, 0.550794), damper(1.453373, 0.117078, 0.587122);
  spring.rocker = {{"rocker",
                    "push-rod",
                    pivot,
                    (spring.inner - pivot).cross(damper - pivot).normalized(),
                    spring.inner,
                    spring.outer},
                   damper,
                   {1.272050, 0.135000, 0.576775}};
  spring.blade = {"blade of the anti-roll bar",
                  "link of the anti-roll bar",
                  {1.523037, 0.0, 0.509594},
                  Vector3d::UnitY(),
                  {1.523023, 0.124672, 0.582738},
                  {1.473721, 0.117534, 0.586859}};
  corner.rates = {52538.0, 65.0, 117000.0};
  return corner;
}

/// Returns the mirror image of a left corner.
inline CornerGeometry right_of(CornerGeometry corner) {
  const auto turn = [](Eigen::Vector3d& point) { point.y() = -point.y(); };
  for (Link& link : corner.linkage.links) turn(link.inner), turn(link.outer);
  Wheel& wheel = corner.linkage.wheel;
  wheel.side = wheel.side == Side::left ? Side::right : Side::left;
  wheel.offset = -wheel.offset;
  turn(wheel.center);
  wheel.spin_axis.x() = -wheel.spin_axis.x(), wheel.spin_axis.z() = -wheel.spin_axis.z();
  if (corner.kingpin) turn(corner.kingpin->lower), turn(corner.kingpin->upper);
  SpringDrive& spring = corner.spring;
  for (Eigen::Vector3d* point :
       {&spring.outer, &spring.inner, &spring.hinge_front, &spring.hinge_rear, &spring.ball})
    turn(*point);
  const auto turn_lever = [&](Lever& lever) {
    turn(lever.pivot), turn(lever.own), turn(lever.driving);
    // The mirror image of an axial vector reverses its x and z.
    lever.axis.x() = -lever.axis.x(), lever.axis.z() = -lever.axis.z();
  };
  if (spring.rocker) {
    turn_lever(spring.rocker->lever);
    turn(spring.rocker->spring_end), turn(spring.rocker->spring_on_chassis);
  }
  if (spring.blade) turn_lever(*spring.blade);
  return corner;
}

}  // namespace latsch::suspension
