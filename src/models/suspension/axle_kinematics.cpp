// SPDX-License-Identifier: Apache-2.0
#include "models/suspension/axle_kinematics.h"

#include <cmath>

namespace latsch::suspension {
namespace {

// Smallest difference of the slopes of two normals at which they intersect.
constexpr double kParallel = 1e-9;

/// Returns the slope v_y / v_z of the path of the contact point.
double slope(const WheelKinematics& w) { return w.contact_y_by_travel / w.contact_z_by_travel; }

double height_at(const WheelKinematics& w, double y) {
  return w.contact_z + slope(w) * (w.contact_y - y);
}

/// Converts a derivative by wheel travel to one by the rise of the contact point.
double by_rise(const WheelKinematics& w, double by_travel) {
  return by_travel / w.contact_z_by_travel;
}

}  // namespace

AxleKinematics axle_of(const WheelKinematics& left,
                       const WheelKinematics& right,
                       double outer_share) {
  AxleKinematics axle{left, right, 0.0, 0.0, 0.0, 0.0, 0.0};
  const double across = left.contact_y - right.contact_y, up = left.contact_z - right.contact_z;
  axle.roll = -std::atan2(up, across);  // (1)
  axle.track = std::hypot(across, up);
  const auto above_ground = [&](double y, double z) {
    const double ground = right.contact_z + up / across * (y - right.contact_y);
    return (z - ground) * std::cos(axle.roll);
  };
  const double turn = slope(left) - slope(right);
  if (std::abs(turn) > kParallel)  // (2)
    axle.roll_center_y = (height_at(left, 0.0) - height_at(right, 0.0)) / turn;
  axle.roll_center_height = above_ground(
      axle.roll_center_y,
      0.5 * (height_at(left, axle.roll_center_y) + height_at(right, axle.roll_center_y)));
  const double of_left = up > 0.0 ? outer_share : 1.0 - outer_share;
  axle.force_roll_center_height = above_ground(
      0.0, of_left * height_at(left, 0.0) + (1.0 - of_left) * height_at(right, 0.0));  // (3)
  return axle;
}

double roll_steer(const WheelKinematics& wheel, double track) {
  return 0.5 * track * by_rise(wheel, wheel.bump_steer);  // (4)
}

double roll_camber(const WheelKinematics& wheel, double track) {
  return 1.0 + 0.5 * track * by_rise(wheel, wheel.bump_camber);  // (4)
}

AntiFeatures anti_features(const WheelKinematics& w, const VehicleData& vehicle) {
  const double contact = w.contact_x_by_travel / w.contact_z_by_travel;
  const double center = w.center_x_by_travel / w.center_z_by_travel;
  const double arm = vehicle.wheelbase / vehicle.cg_height * (vehicle.is_front ? 1.0 : -1.0);
  return {.braking = vehicle.brake_share * (vehicle.has_outboard_brakes ? contact : center) * arm,
          .driving = vehicle.drive_share * center * arm};  // (6)
}

double ackermann(double left, double right, double track, double wheelbase) {
  const bool turns_left = left + right > 0.0;
  const double inner = turns_left ? left : -right, outer = turns_left ? right : -left;
  const double ideal =
      std::atan2(std::sin(outer), std::cos(outer) - std::sin(outer) * track / wheelbase);
  return (inner - outer) / (ideal - outer);  // (5)
}

Result<KinematicAxle::Wheels> KinematicAxle::move_to(double left, double right, double rack) {
  const bool is_left = side_ == Side::left;
  const auto own = own_.move_to(is_left ? left : right, rack);
  if (!own) return own.failure();
  const auto image = image_.move_to(is_left ? right : left, -rack);
  if (!image)
    return Failure{"the other wheel, as its mirror image, whose rack moves to the other side: " +
                   image.failure().reason};
  if (is_left) return Wheels{*own, mirrored(*image)};
  return Wheels{mirrored(*image), *own};
}

}  // namespace latsch::suspension
