// SPDX-License-Identifier: Apache-2.0
// A double-wishbone corner: five bodies on ten bushings. The inboard end of the push-rod is held,
// as on a rig that replaces the springs by rigid bars.
//
//   chassis ─ uca_front, uca_rear ─ upper wishbone ─ ubj ─┐
//   chassis ─ pushrod_inner ─ push-rod ─ pushrod_outer ─ upper or lower wishbone, or upright
//   chassis ─ trackrod_inner ─ track-rod ─ trackrod_outer ─ upright
//   chassis ─ lca_front, lca_rear ─ lower wishbone ─ lbj ─┘
#pragma once

#include <Eigen/Core>
#include <array>

#include "models/multibody/mechanism.h"
#include "models/suspension/wheel_position.h"

namespace latsch::suspension {

using multibody::BushingParameters;

struct DoubleWishbone {
  enum Joint {
    kUcaFront,
    kUcaRear,
    kLcaFront,
    kLcaRear,
    kUbj,
    kLbj,
    kPushrodInner,
    kPushrodOuter,
    kTrackrodInner,
    kTrackrodOuter,
    kJoints
  };
  static constexpr std::array<const char*, kJoints> kNames = {"uca_front",
                                                              "uca_rear",
                                                              "lca_front",
                                                              "lca_rear",
                                                              "ubj",
                                                              "lbj",
                                                              "pushrod_inner",
                                                              "pushrod_outer",
                                                              "trackrod_inner",
                                                              "trackrod_outer"};
  enum Body { kUpper, kLower, kUpright, kPushrod, kTrackrod, kBodies };

  std::array<Eigen::Vector3d, kJoints> points;  // m
  std::array<BushingParameters, kJoints> bushings;
  Eigen::Vector3d wheel_center, contact;  // m
  Side side = Side::left;
  Body pushrod_on = kUpper;

  /// Returns an empty text if the points form a valid corner. Otherwise returns a message that
  /// names them: coincident ends of a rod, joints of a wishbone that coincide or lie in one line,
  /// coordinates that look like millimeters.
  std::string fault() const;
  std::vector<multibody::Body> bodies() const;
  std::vector<multibody::Joint> joints() const;
  WheelPoints wheel() const;
};

}  // namespace latsch::suspension
