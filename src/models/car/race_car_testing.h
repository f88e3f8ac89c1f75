// SPDX-License-Identifier: Apache-2.0
// A student race car: published hardpoints of both axles (set "fsae_parametrica": push-rod at the
// front, toe-link at the rear) with assumed masses. With locked springs it is the car of
// verification/simbody.
#pragma once

#include "models/car/car.h"
#include "models/car/spring_tire.h"
#include "models/suspension/corner_testing.h"

namespace latsch::car {

inline suspension::DoubleWishbone rear_corner() {
  suspension::DoubleWishbone corner;
  corner.points = {{{0.125161, 0.318339, 0.314902},
                    {-0.160644, 0.318236, 0.310835},
                    {0.088707, 0.307596, 0.143145},
                    {-0.169595, 0.307096, 0.119973},
                    {-0.025600, 0.530800, 0.350000},
                    {-0.006400, 0.569500, 0.130400},
                    {-0.067290, 0.303410, 0.460910},
                    {-0.030415, 0.504540, 0.362808},
                    {0.084331, 0.356843, 0.141969},
                    {0.065785, 0.570499, 0.136865}}};
  corner.bushings.fill({Eigen::Vector3d::Constant(3e7), Eigen::Vector3d::Constant(200.0)});
  corner.wheel_center = {0.0, 0.6125, 0.235};
  corner.contact = {0.0, 0.6125, 0.0};
  return corner;
}

inline CarParameters race_car(bool locked) {
  CarParameters car;
  car.chassis.body = {180.0, {0.75, 0.0, 0.28}, Eigen::Vector3d(25.0, 90.0, 100.0).asDiagonal()};
  car.front.corner = suspension::race_corner();
  car.rear.corner = rear_corner();
  car.front.steered = true;
  for (Axle* axle : {&car.front, &car.rear}) {
    for (multibody::BushingParameters& bushing : axle->corner.bushings) {
      bushing.damping = 1e-4 * bushing.stiffness;
      bushing.rotational_damping = 1e-3 * bushing.rotational;
    }
    axle->masses.upright = {
        4.0, Eigen::Vector3d::Zero(), Eigen::Vector3d(0.03, 0.03, 0.02).asDiagonal()};
    axle->masses.wheel = 8.0;
    axle->masses.wheel_spin = 0.25;
    axle->masses.wheel_across = 0.14;
  }
  if (locked) return car;
  Inboard front, rear;
  front.pivot = {1.461665, 0.180000, 0.550794};
  front.damper = {1.453373, 0.117078, 0.587122};
  front.damper_on_chassis = {1.272050, 0.135000, 0.576775};
  rear.pivot = {-0.024834, 0.290000, 0.467446};
  rear.damper = {-0.004470, 0.225640, 0.498840};
  rear.damper_on_chassis = {0.171069, 0.270500, 0.476957};
  car.front.inboard = front;
  car.rear.inboard = rear;
  for (Axle* axle : {&car.front, &car.rear}) {
    Inboard& inboard = *axle->inboard;
    // The axis of a rocker is perpendicular to its arms to the push-rod and to the damper.
    const Eigen::Vector3d rod = axle->corner.points[suspension::DoubleWishbone::kPushrodInner];
    inboard.axis = (rod - inboard.pivot).cross(inboard.damper - inboard.pivot).normalized();
    inboard.unit.stiffness = 52538.0;
    inboard.unit.damping = 2500.0;
  }
  return car;
}

inline Tires spring_tires(double damping = 300.0) {
  Tires tires;
  for (auto& tire : tires)
    tire = std::make_unique<SpringTire>(SpringTireParameters{0.235, 117e3, damping});
  return tires;
}

}  // namespace latsch::car
