// SPDX-License-Identifier: Apache-2.0
#include "models/suspension/double_wishbone.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <cmath>

#include "models/multibody/rod_spin.h"
#include "models/suspension/plausible_points.h"

namespace latsch::suspension {
namespace {

using Eigen::Vector3d;

/// Returns a message if a rod points at the axis about which it should hold a wishbone. However
/// stiff such a rod is, the corner can then move freely.
std::string fault_of_rods(const DoubleWishbone& corner) {
  using enum DoubleWishbone::Joint;
  const auto p = [&](int joint) { return corner.points[static_cast<std::size_t>(joint)]; };
  const auto arm = [&](int inner, int outer, int from, int to) {
    const Vector3d along = (p(outer) - p(inner)).normalized(),
                   axis = (p(to) - p(from)).normalized();
    return std::abs(along.dot(axis.cross(p(outer) - p(from))));
  };
  if (arm(kTrackrodInner, kTrackrodOuter, kLbj, kUbj) < kNear)
    return "the track-rod points at the kingpin: it has no arm to steer by";
  if (corner.pushrod_on == DoubleWishbone::kUpright) return {};
  const int front = corner.pushrod_on == DoubleWishbone::kUpper ? kUcaFront : kLcaFront,
            rear = corner.pushrod_on == DoubleWishbone::kUpper ? kUcaRear : kLcaRear;
  if (arm(kPushrodInner, kPushrodOuter, front, rear) < kNear)
    return fmt::format(
        "the push-rod points at the axis of its wishbone, {} to {}: nothing holds the wheel up",
        DoubleWishbone::kNames[static_cast<std::size_t>(front)],
        DoubleWishbone::kNames[static_cast<std::size_t>(rear)]);
  return {};
}

}  // namespace

std::string DoubleWishbone::fault() const {
  for (int i = 0; i < kJoints; ++i)
    if (!(points[static_cast<std::size_t>(i)].lpNorm<Eigen::Infinity>() < kFar))
      return fmt::format("{} is more than {} m from the origin: are its numbers millimeters?",
                         kNames[static_cast<std::size_t>(i)],
                         kFar);
  const auto together = [&](Joint i, Joint j) -> std::string {
    if ((points[i] - points[j]).norm() > kNear) return {};
    return fmt::format("{} and {} coincide", kNames[i], kNames[j]);
  };
  for (const auto& [i, j] : {std::pair{kUcaFront, kUcaRear},
                             {kLcaFront, kLcaRear},
                             {kUbj, kLbj},
                             {kPushrodInner, kPushrodOuter},
                             {kTrackrodInner, kTrackrodOuter}})
    if (std::string fault = together(i, j); !fault.empty()) return fault;
  const auto in_line = [&](Joint front, Joint rear, Joint ball) -> std::string {
    const Vector3d axis = (points[rear] - points[front]).normalized();
    if (axis.cross(points[ball] - points[front]).norm() > kNear) return {};
    return fmt::format("{}, {} and {} are in one line: the wishbone has no arm",
                       kNames[front],
                       kNames[rear],
                       kNames[ball]);
  };
  if (std::string fault = in_line(kUcaFront, kUcaRear, kUbj); !fault.empty()) return fault;
  if (std::string fault = in_line(kLcaFront, kLcaRear, kLbj); !fault.empty()) return fault;
  const Vector3d kingpin = (points[kUbj] - points[kLbj]).normalized();
  if (kingpin.cross(points[kTrackrodOuter] - points[kLbj]).norm() < kNear)
    return "trackrod_outer is on the kingpin: the track-rod has no arm to steer by";
  return fault_of_rods(*this);
}

std::vector<multibody::Body> DoubleWishbone::bodies() const {
  const auto middle = [&](Joint i, Joint j) -> Vector3d { return 0.5 * (points[i] + points[j]); };
  return {{"the upper wishbone", points[kUbj]},
          {"the lower wishbone", points[kLbj]},
          {"the upright", wheel_center},
          {"the push-rod", middle(kPushrodInner, kPushrodOuter)},
          {"the track-rod", middle(kTrackrodInner, kTrackrodOuter)}};
}

std::vector<multibody::Joint> DoubleWishbone::joints() const {
  using multibody::kGround;
  constexpr std::array<std::pair<int, int>, kJoints> kPairs = {{{kGround, kUpper},
                                                                {kGround, kUpper},
                                                                {kGround, kLower},
                                                                {kGround, kLower},
                                                                {kUpper, kUpright},
                                                                {kLower, kUpright},
                                                                {kGround, kPushrod},
                                                                {kPushrod, kUpper},
                                                                {kGround, kTrackrod},
                                                                {kTrackrod, kUpright}}};
  std::vector<multibody::Joint> joints;
  for (std::size_t i = 0; i < kJoints; ++i)
    joints.push_back({kNames[i],
                      kPairs[i].first,
                      i == kPushrodOuter ? pushrod_on : kPairs[i].second,
                      points[i],
                      bushings[i]});
  multibody::hold_spin(joints[kPushrodInner], joints[kPushrodOuter]);
  multibody::hold_spin(joints[kTrackrodInner], joints[kTrackrodOuter]);
  return joints;
}

WheelPoints DoubleWishbone::wheel() const {
  return {.contact = contact - wheel_center,
          .center = Vector3d::Zero(),
          .lower_ball_joint = points[kLbj] - wheel_center,
          .upper_ball_joint = points[kUbj] - wheel_center,
          .side = side};
}

}  // namespace latsch::suspension
