// SPDX-License-Identifier: Apache-2.0
#include "models/suspension/kinematic_outputs.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <numbers>

namespace latsch::suspension {
namespace {

using Eigen::Vector3d;
using W = WheelKinematics;
using enum Sense;
using Group = KinematicOutput::Group;

constexpr double kGravity = 9.80665;  // m/s²
// Step of wheel travel, m, in the finite differences for second derivatives.
constexpr double kStep = 1e-4;
// Smallest rotation of the wheel per rack travel, rad/m, at which the rack is considered to steer
// it.
constexpr double kNoSteer = 1e-3;

constexpr std::array kOutputs = {
    KinematicOutput{"toe", "rad", "toe angle, positive toe-in", &W::toe},
    KinematicOutput{"steer", "rad", "steer angle, positive to the left", &W::steer, about_z},
    KinematicOutput{"camber", "rad", "camber to the chassis, positive top outboard", &W::camber},
    KinematicOutput{"caster", "rad", "caster, positive top of the kingpin rearward", &W::caster},
    KinematicOutput{"kpi", "rad", "kingpin inclination, positive top inboard", &W::kpi},
    KinematicOutput{"mechanical_trail",
                    "m",
                    "kingpin to contact point in side view at right angles to the kingpin, "
                    "positive contact point behind",
                    &W::mechanical_trail},
    KinematicOutput{"caster_offset",
                    "m",
                    "the same along the ground, positive contact point behind",
                    &W::caster_offset},
    KinematicOutput{"caster_trail_hub",
                    "m",
                    "kingpin to wheel center at its height, positive wheel center ahead",
                    &W::caster_trail_hub},
    KinematicOutput{"scrub_radius",
                    "m",
                    "kingpin to contact point across the wheel on the ground, positive contact "
                    "point outboard",
                    &W::scrub_radius},
    KinematicOutput{"kingpin_offset",
                    "m",
                    "kingpin to wheel center across the wheel, positive wheel center outboard",
                    &W::kingpin_offset},
    KinematicOutput{
        "bump_steer", "rad/m", "toe per travel, positive toe-in in bump", &W::bump_steer},
    KinematicOutput{"bump_camber",
                    "rad/m",
                    "camber per travel, positive top outboard in bump",
                    &W::bump_camber},
    KinematicOutput{"steer_by_rack",
                    "rad/m",
                    "steer per rack travel, positive to the left for a rack "
                    "that moves to the left",
                    &W::steer_by_rack,
                    about_z,
                    along_y},
    KinematicOutput{"camber_by_rack",
                    "rad/m",
                    "camber per rack travel, positive top outboard for a rack "
                    "that moves to the left",
                    &W::camber_by_rack,
                    same,
                    along_y},
    KinematicOutput{"roll_center_height",
                    "m",
                    "where the normal to the path of the contact point meets the center plane of "
                    "the car, above the contact point",
                    &W::roll_center_height},
    KinematicOutput{"roll_center_by_travel",
                    "1",
                    "change of the height of the wheel's own roll center per "
                    "travel, positive upward in bump",
                    &W::roll_center_by_travel},
    KinematicOutput{"contact_x", "m", "contact point, forward", &W::contact_x, along_x},
    KinematicOutput{"contact_y", "m", "contact point, to the left", &W::contact_y, along_y},
    KinematicOutput{"contact_z", "m", "contact point, upward", &W::contact_z, along_z},
    KinematicOutput{"center_x", "m", "wheel center, forward", &W::center_x, along_x},
    KinematicOutput{"center_y", "m", "wheel center, to the left", &W::center_y, along_y},
    KinematicOutput{"center_z", "m", "wheel center, upward", &W::center_z, along_z},
    KinematicOutput{"contact_x_by_travel",
                    "1",
                    "forward in bump, of the upright at the contact "
                    "point",
                    &W::contact_x_by_travel,
                    along_x},
    KinematicOutput{
        "contact_y_by_travel", "1", "to the left in bump", &W::contact_y_by_travel, along_y},
    KinematicOutput{"center_x_by_travel",
                    "1",
                    "wheel center, forward in bump",
                    &W::center_x_by_travel,
                    along_x},
    KinematicOutput{"center_y_by_travel",
                    "1",
                    "wheel center, to the left in bump",
                    &W::center_y_by_travel,
                    along_y},
    KinematicOutput{"spring_length",
                    "m",
                    "between the ends of spring and damper",
                    &W::spring_length,
                    same,
                    same,
                    Group::spring},
    KinematicOutput{"motion_ratio",
                    "1",
                    "compression of the spring per rise of the contact point, "
                    "positive compressed in bump",
                    &W::motion_ratio,
                    same,
                    same,
                    Group::spring},
    KinematicOutput{"motion_ratio_by_travel",
                    "1/m",
                    "positive: progressive",
                    &W::motion_ratio_by_travel,
                    same,
                    same,
                    Group::spring},
    KinematicOutput{"arb_angle",
                    "rad",
                    "turn of the anti-roll bar's blade about y, positive its "
                    "top forward",
                    &W::arb_angle,
                    about_y,
                    same,
                    Group::bar},
    KinematicOutput{"arb_ratio",
                    "rad/m",
                    "the same angle per travel",
                    &W::arb_ratio,
                    about_y,
                    same,
                    Group::bar},
    KinematicOutput{"wheel_rate",
                    "N/m",
                    "force at the contact point per rise against the "
                    "chassis, tire rigid",
                    &W::wheel_rate,
                    same,
                    same,
                    Group::rates},
    KinematicOutput{"ride_rate",
                    "N/m",
                    "wheel rate and tire in series",
                    &W::ride_rate,
                    same,
                    same,
                    Group::rates},
    KinematicOutput{"ride_frequency",
                    "Hz",
                    "of the sprung mass on the ride rate",
                    &W::ride_frequency,
                    same,
                    same,
                    Group::rates},
};

struct Axis {
  Vector3d direction, point;
};

Result<Axis> steering_axis(const CornerGeometry& geometry,
                           const MovingLinkage& moving,
                           const SpringState& spring) {
  const Pose& upright = moving.upright();
  const Vector3d center_at_rest = geometry.linkage.wheel.center;
  if (geometry.kingpin) {
    const auto& [lower, upper] = *geometry.kingpin;
    return Axis{upright.turn * (upper - lower).normalized(), upright.at(lower - center_at_rest)};
  }
  const Twists& twists = moving.twists();
  const Vector6d held =
      twists.by_rack - spring.length_slopes[1] / spring.length_slopes[0] * twists.by_travel;
  const Vector3d rotation = held.tail<3>();
  if (!(std::abs(rotation.z()) > kNoSteer))
    return Failure{fmt::format(
        "{} does not steer the wheel: it has no kingpin",
        geometry.linkage.links[static_cast<std::size_t>(geometry.linkage.trackrod)].name)};
  const Vector3d velocity = held.head<3>();
  return Axis{rotation.normalized() * (rotation.z() > 0.0 ? 1.0 : -1.0),
              upright.place + rotation.cross(velocity) / rotation.squaredNorm()};
}

void set_kingpin(const Axis& axis,
                 double outboard,
                 const Vector3d& contact,
                 const Vector3d& center,
                 double steer,
                 W& w) {
  const Vector3d& k = axis.direction;
  const Vector3d forward(std::cos(steer), std::sin(steer), 0.0);
  const Vector3d across = outboard * Vector3d(-std::sin(steer), std::cos(steer), 0.0);
  const auto at_height = [&](double z) -> Vector3d {
    return axis.point + (z - axis.point.z()) / k.z() * k;
  };
  const Vector3d to_contact = contact - at_height(contact.z());
  const Vector3d to_center = center - at_height(center.z());
  w.caster = std::atan2(-k.x(), k.z());
  w.kpi = std::atan2(-outboard * k.y(), k.z());
  w.caster_offset = -to_contact.dot(forward);
  w.mechanical_trail = w.caster_offset * std::cos(w.caster);
  w.caster_trail_hub = to_center.dot(forward);
  w.scrub_radius = to_contact.dot(across);
  w.kingpin_offset = to_center.dot(across);
}

void set_angles(const MovingLinkage& moving, double outboard, W& w) {
  const Vector3d a = moving.spin_axis();
  const double flat = a.x() * a.x() + a.y() * a.y();
  w.steer = std::atan2(-a.x(), a.y());
  w.toe = -outboard * w.steer;
  w.camber = -outboard * std::asin(a.z());
  const auto steer_by = [&](const Vector6d& twist) {
    const Vector3d da = twist.tail<3>().cross(a);
    return (a.x() * da.y() - a.y() * da.x()) / flat;
  };
  const auto camber_by = [&](const Vector6d& twist) {
    return -outboard * twist.tail<3>().cross(a).z() / std::sqrt(flat);
  };
  const Twists& twists = moving.twists();
  w.bump_steer = -outboard * steer_by(twists.by_travel);
  w.bump_camber = camber_by(twists.by_travel);
  w.steer_by_rack = steer_by(twists.by_rack);
  w.camber_by_rack = camber_by(twists.by_rack);
}

void set_path(const MovingLinkage& moving, W& w) {
  const Vector3d down = moving.to_contact(), center = moving.upright().place;
  const Vector3d contact = center + down;
  const Vector6d& twist = moving.twists().by_travel;
  const Vector3d v = Twists::at(twist, down), u = twist.head<3>();
  w.contact_x = contact.x(), w.contact_y = contact.y(), w.contact_z = contact.z();
  w.center_x = center.x(), w.center_y = center.y(), w.center_z = center.z();
  w.contact_x_by_travel = v.x(), w.contact_y_by_travel = v.y(), w.contact_z_by_travel = v.z();
  w.center_x_by_travel = u.x(), w.center_y_by_travel = u.y(), w.center_z_by_travel = u.z();
  w.roll_center_height = v.y() / v.z() * contact.y();  // (5)
}

/// Computes all outputs that follow from one pose, without neighboring poses.
Result<W> standing(const CornerGeometry& geometry, const MovingLinkage& moving) {
  const Wheel& wheel = geometry.linkage.wheel;
  const double outboard = wheel.side == Side::left ? 1.0 : -1.0;
  const auto spring =
      spring_state(geometry.spring, wheel.center, moving.upright(), moving.twists());
  if (!spring) return spring.failure();
  const auto axis = steering_axis(geometry, moving, *spring);
  if (!axis) return axis.failure();
  W w = {};
  set_angles(moving, outboard, w);
  set_path(moving, w);
  const Vector3d contact(w.contact_x, w.contact_y, w.contact_z);
  const Vector3d center(w.center_x, w.center_y, w.center_z);
  set_kingpin(*axis, outboard, contact, center, w.steer, w);
  w.spring_length = spring->length;
  w.motion_ratio = -spring->length_slopes[0] / w.contact_z_by_travel;  // (6)
  w.arb_angle = spring->blade_angle;
  w.arb_ratio = spring->blade_slopes[0];
  return w;
}

}  // namespace

std::string CornerGeometry::fault() const {
  if (std::string fault = linkage.fault(); !fault.empty()) return fault;
  return spring.fault();
}

std::span<const KinematicOutput> kinematic_outputs() { return kOutputs; }

KinematicCorner::KinematicCorner(const CornerGeometry& geometry, TravelOf of)
    : geometry_(&geometry), moving_(geometry.linkage, of) {
  const auto rest = standing(geometry, moving_);
  if (!rest) {
    rest_ = rest.failure();
    return;
  }
  length_at_rest_ = rest->spring_length;
  ratio_at_rest_ = rest->motion_ratio;
}

Result<WheelKinematics> KinematicCorner::move_to(double travel, double rack) {
  if (!rest_) return rest_.failure();
  if (const auto there = moving_.move_to(travel, rack); !there) return there.failure();
  auto found = standing(*geometry_, moving_);
  if (!found) return found;
  W& w = *found;
  // Second derivatives are central differences of first ones, or one-sided differences at the end
  // of the linkage's range.
  const auto neighbor = [&](double at) -> Result<W> {
    MovingLinkage there = moving_;
    if (const auto moved = there.move_to(at, rack); !moved) return moved.failure();
    return standing(*geometry_, there);
  };
  const auto up = neighbor(travel + kStep), down = neighbor(travel - kStep);
  if (!up && !down) return up.failure();
  const W& a = down ? *down : w;
  const W& b = up ? *up : w;
  const double way = up && down ? 2.0 * kStep : kStep;
  w.roll_center_by_travel = (b.roll_center_height - a.roll_center_height) / way;
  w.motion_ratio_by_travel = (b.motion_ratio - a.motion_ratio) / way;
  if (!geometry_->rates) return found;
  const auto& [k, mass, tire] = *geometry_->rates;
  const double force = mass * kGravity / ratio_at_rest_ + k * (length_at_rest_ - w.spring_length);
  w.wheel_rate = k * w.motion_ratio * w.motion_ratio +
                 force * w.motion_ratio_by_travel / w.contact_z_by_travel;  // (7)
  w.ride_rate = w.wheel_rate * tire / (w.wheel_rate + tire);                // (8)
  w.ride_frequency = std::sqrt(std::max(0.0, w.ride_rate / mass)) / (2.0 * std::numbers::pi);
  return found;
}

WheelKinematics mirrored(const WheelKinematics& wheel) {
  WheelKinematics image = wheel;
  for (const KinematicOutput& output : kOutputs)
    image.*output.value *= sign(kMirror, output.of) * sign(kMirror, output.by);
  return image;
}

}  // namespace latsch::suspension
