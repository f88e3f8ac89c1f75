// SPDX-License-Identifier: Apache-2.0
#include "models/car/car_linear.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "models/car/wheel_index.h"

namespace latsch::car {

using Eigen::Index;
using Eigen::Matrix3d;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using multibody::BodyForce;
using multibody::Matrix6d;
using multibody::Motion;

namespace {

/// Force of a tire during motion at constant velocity: the changes -c v (at once, N) and -k v (per
/// second, N/s) of F(t) - F(0).
struct EvenMotion {
  Vector3d at_once = Vector3d::Zero(), by_time = Vector3d::Zero();
};

Result<EvenMotion> move_evenly(const WheelState& wheel,
                               const road::Road& road,
                               double time,
                               const Vector3d& velocity,
                               const TireProbe& settings) {
  const auto tire = wheel.tire->clone();
  const Vector3d start = wheel.motion.carrier * wheel.hub.force;
  const long count = std::lround(settings.lasting / settings.step);
  double n = 0.0, sum_t = 0.0, sum_tt = 0.0;
  Vector3d sum_f = Vector3d::Zero(), sum_tf = Vector3d::Zero();
  WheelMotion motion = wheel.motion;
  motion.velocity = velocity;
  for (long i = 1; i <= count; ++i) {
    const double t = static_cast<double>(i) * settings.step;
    motion.center = wheel.motion.center + t * velocity;
    const auto hub = tire->advance(motion, road, time + t, settings.step);
    if (!hub) return hub.failure();
    if (t < settings.starting) continue;
    const Vector3d f = motion.carrier * hub->force - start;
    n += 1.0;
    sum_t += t;
    sum_tt += t * t;
    sum_f += f;
    sum_tf += t * f;
  }
  EvenMotion line;
  line.by_time = (n * sum_tf - sum_t * sum_f) / (n * sum_tt - sum_t * sum_t);
  line.at_once = (sum_f - sum_t * line.by_time) / n;
  return line;
}

/// Returns the derivative of the wheel center's displacement with respect to the displacement and
/// rotation of the upright.
Eigen::Matrix<double, 3, 6> center_by_upright(const Vector3d& arm) {
  Eigen::Matrix<double, 3, 6> G;
  G << Matrix3d::Identity(), -multibody::cross(arm);
  return G;
}

struct Wheels {
  std::array<TireStiffness, kCorners> slopes;
  std::array<Vector3d, kCorners> forces, arms;
};

void add_tires(const Car& car,
               const Wheels& wheels,
               const Motion& motion,
               std::vector<BodyForce>& wrenches) {
  for (std::size_t i = 0; i < kCorners; ++i) {
    const Vector3d &arm = wheels.arms[i], &force = wheels.forces[i];
    const auto G = center_by_upright(arm);
    BodyForce wrench{.body = car.parts().corners[i].upright};
    wrench.value << force, arm.cross(force);
    const TireStiffness& tire = wheels.slopes[i];
    wrench.slopes = -G.transpose() * (tire.stiffness + motion.share * tire.damping) * G;
    wrench.slopes.bottomRightCorner<3, 3>() += multibody::cross(force) * multibody::cross(arm);
    wrenches.push_back(wrench);
  }
}

multibody::LinearOutputs sensors_of(const Car& car,
                                    const multibody::Rest& rest,
                                    const multibody::RestSettings& standing,
                                    const Wheels& wheels) {
  const Index size = 6 * std::ssize(rest.poses), count = 2 * kCorners + 1;
  multibody::LinearOutputs y{
      MatrixXd::Zero(count, size), MatrixXd::Zero(count, size), MatrixXd::Zero(count, size)};
  for (int corner = 0; corner < kCorners; ++corner) {
    const CornerParts& parts = car.parts().corners[at(corner)];
    const Vector3d along = rest.poses[at(parts.pushrod)].turn *
                           (parts.pushrod_outer - parts.pushrod_inner).normalized();
    const multibody::JointRow row = multibody::joint_force_row(
        car.mechanism(), rest, standing, parts.pushrod_joint, along, parts.pushrod);
    y.A.row(corner) = row.by_x;
    y.B.row(corner) = row.by_v;
    y.D.row(kCorners + corner).segment<6>(6 * parts.upright) =
        center_by_upright(wheels.arms[at(corner)]).row(2);
  }
  y.D(2 * kCorners, 6 * car.parts().chassis + 2) = 1.0;
  return y;
}

}  // namespace

Result<TireStiffness> probe(const WheelState& wheel,
                            const road::Road& road,
                            double time,
                            const TireProbe& settings) {
  TireStiffness slopes;
  for (const int axis : {1, 2}) {
    const Vector3d v = settings.speed * Vector3d::Unit(axis);
    const auto one = move_evenly(wheel, road, time, v, settings),
               other = move_evenly(wheel, road, time, -v, settings);
    if (!one) return one.failure();
    if (!other) return other.failure();
    slopes.damping.col(axis) = (other->at_once - one->at_once) / (2.0 * settings.speed);
    slopes.stiffness.col(axis) = (other->by_time - one->by_time) / (2.0 * settings.speed);
  }
  slopes.damping.row(0).setZero();
  slopes.stiffness.row(0).setZero();
  return slopes;
}

Eigen::MatrixXcd LinearCar::response(double frequency) const {
  return frequency_response(model, heights, sensors, 2.0 * std::numbers::pi * frequency);
}

Result<LinearCar> linearize(const Car& car,
                            const CarState& state,
                            const road::Road& road,
                            const CarInputs& inputs) {
  Wheels wheels;
  for (int corner = 0; corner < kCorners; ++corner) {
    const WheelState& wheel = state.wheels[at(corner)];
    const auto slopes = probe(wheel, road, state.time());
    if (!slopes)
      return Failure{fmt::format("tire {}: {}", kCornerNames[at(corner)], slopes.failure().reason)};
    wheels.slopes[at(corner)] = *slopes;
    wheels.forces[at(corner)] = wheel.motion.carrier * wheel.hub.force;
    const int upright = car.parts().corners[at(corner)].upright;
    wheels.arms[at(corner)] = wheel.motion.center - state.bodies.poses[at(upright)].place;
  }
  const GuidePoint start = inputs.guide.value_or(GuidePoint{0.0, 0.0, 0.0});
  const multibody::Outside outside = [&](const Motion& motion, std::vector<BodyForce>& wrenches) {
    add_tires(car, wheels, motion, wrenches);
    car.add_guide(motion, start, wrenches);
    car.add_air(motion, state.speed, wrenches);
  };
  const std::array<double, kDrivers> drivers = {inputs.rack};
  const multibody::Rest rest{state.bodies.poses, state.bodies.memories};
  const multibody::RestSettings standing{
      .loads = inputs.loads, .drivers = drivers, .outside = &outside};
  LinearCar linear;
  linear.model = linear_model(car.mechanism(), rest, standing);
  const Index size = linear.model.K.rows();
  linear.heights = {MatrixXd::Zero(size, kCorners), MatrixXd::Zero(size, kCorners)};
  for (int corner = 0; corner < kCorners; ++corner) {
    const int upright = 6 * car.parts().corners[at(corner)].upright;
    const auto G = center_by_upright(wheels.arms[at(corner)]);
    const TireStiffness& tire = wheels.slopes[at(corner)];
    linear.heights.P.col(corner).segment<6>(upright) = G.transpose() * tire.stiffness.col(2);
    linear.heights.Q.col(corner).segment<6>(upright) = G.transpose() * tire.damping.col(2);
  }
  linear.sensors = sensors_of(car, rest, standing, wheels);
  for (const char* name : {"pushrod", "hub"})
    for (const char* corner : kCornerNames)
      linear.names.push_back(fmt::format("{}_{}", name, corner));
  linear.names.push_back("body_z");
  return linear;
}

}  // namespace latsch::car
