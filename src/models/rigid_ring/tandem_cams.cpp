// SPDX-License-Identifier: Apache-2.0
#include "models/rigid_ring/tandem_cams.h"

#include <Eigen/Geometry>
#include <algorithm>

#include "models/rigid_ring/cam_contact.h"

namespace latsch::rigid_ring {
namespace {

constexpr double kLeastShift = 0.004;  // m: a patch about to lift off still has a slope
constexpr int kMostTracks = 10;

}  // namespace

TandemCams::TandemCams(const magic_formula::Parameters& p)
    : cam_{p.ELLIPS_LENGTH * p.UNLOADED_RADIUS,
           p.ELLIPS_HEIGHT * p.UNLOADED_RADIUS,
           p.ELLIPS_ORDER},
      shift_(p.ELLIPS_SHIFT),
      tracks_(std::clamp(static_cast<int>(p.ELLIPS_NWIDTH), 1, kMostTracks)) {}

magic_formula::RoadPlane TandemCams::plane(const Eigen::Vector3d& center,
                                           const Eigen::Vector3d& forward,
                                           double a,
                                           double b,
                                           const road::Road& road,
                                           double time) const {
  const Eigen::Vector2d heading = forward.head<2>().normalized();
  const Eigen::Vector2d left(-heading.y(), heading.x());
  const double l_s = std::max(shift_ * 2.0 * a, kLeastShift);
  double w = 0.0, slope = 0.0, moment = 0.0, squares = 0.0;
  for (int track = 0; track < tracks_; ++track) {
    const double across = tracks_ == 1 ? 0.0 : b * (2.0 * track / (tracks_ - 1) - 1.0);
    const Eigen::Vector2d at = center.head<2>() + across * left;
    const double Z_f = CamContact(cam_, at + 0.5 * l_s * heading, heading, road, time).height();
    const double Z_r = CamContact(cam_, at - 0.5 * l_s * heading, heading, road, time).height();
    const double height = 0.5 * (Z_f + Z_r) - cam_.b;
    w += height / tracks_;
    slope += (Z_f - Z_r) / l_s / tracks_;
    moment += across * height;
    squares += across * across;
  }
  const double bank = squares > 0.0 ? moment / squares : 0.0;
  const road::GroundPoint ground = road.at(center.x(), center.y(), time);
  magic_formula::RoadPlane plane;
  plane.point = {center.x(), center.y(), w};
  plane.normal =
      Eigen::Vector3d(
          -slope * heading.x() - bank * left.x(), -slope * heading.y() - bank * left.y(), 1.0)
          .normalized();
  // The velocity is that of ground at the effective height, so over a cleat on a drum it changes as
  // smoothly as this height.
  plane.velocity =
      ground.velocity + ground.turning.cross(Eigen::Vector3d(0.0, 0.0, w - ground.height));
  plane.friction = ground.friction;
  return plane;
}

}  // namespace latsch::rigid_ring
