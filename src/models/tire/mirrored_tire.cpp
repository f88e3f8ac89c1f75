// SPDX-License-Identifier: Apache-2.0
#include "models/tire/mirrored_tire.h"

#include "models/road/mirrored_road.h"
#include "models/tire/free_wheel.h"

namespace latsch {

namespace {

Eigen::Vector3d mirrored(const Eigen::Vector3d& v) { return {v.x(), -v.y(), v.z()}; }
/// Returns the mirror image of an axial vector: an angular velocity or a moment.
Eigen::Vector3d mirrored_turning(const Eigen::Vector3d& v) { return {-v.x(), v.y(), -v.z()}; }

WheelMotion mirrored(const WheelMotion& motion) {
  WheelMotion image = motion;
  image.center = mirrored(motion.center);
  // The product S C S only changes signs of the matrix C, so that the mirror image of a mirror
  // image equals the original to the last bit.
  for (const auto& [i, j] : {std::pair{0, 1}, {1, 0}, {1, 2}, {2, 1}})
    image.carrier(i, j) = -motion.carrier(i, j);
  image.velocity = mirrored(motion.velocity);
  image.angular_velocity = mirrored_turning(motion.angular_velocity);
  return image;
}

Result<HubForces> mirrored(Result<HubForces> hub) {
  if (!hub) return hub;
  return HubForces{mirrored(hub->force), mirrored_turning(hub->moment)};
}

}  // namespace

Result<HubForces> MirroredTire::settle(const WheelMotion& motion,
                                       const road::Road& road,
                                       double time) {
  return mirrored(tire_->settle(mirrored(motion), road::MirroredRoad(road), time));
}

Result<HubForces> MirroredTire::advance(const WheelMotion& motion,
                                        const road::Road& road,
                                        double time,
                                        double step) {
  return mirrored(tire_->advance(mirrored(motion), road::MirroredRoad(road), time, step));
}

Result<HubForces> MirroredTire::advance_free(
    WheelMotion& motion, FreeWheel& wheel, const road::Road& road, double time, double step) {
  // The mirror image of a wheel has the same spin and height as the wheel.
  WheelMotion image = mirrored(motion);
  Result<HubForces> hub =
      mirrored(tire_->advance_free(image, wheel, road::MirroredRoad(road), time, step));
  motion = mirrored(image);
  return hub;
}

std::optional<Footprint> MirroredTire::footprint() const {
  std::optional<Footprint> print = tire_->footprint();
  if (!print) return print;
  for (FootprintElement& element : print->elements) {
    element.y = -element.y;
    element.shear_y = -element.shear_y;
  }
  return print;
}

Eigen::Matrix3Xd MirroredTire::outline() const {
  Eigen::Matrix3Xd points = tire_->outline();
  points.row(1) = -points.row(1);
  return points;
}

std::unique_ptr<Tire> mounted(std::unique_ptr<Tire> tire, TireSide of, TireSide on) {
  if (of == on) return tire;
  return std::make_unique<MirroredTire>(std::move(tire));
}

}  // namespace latsch
