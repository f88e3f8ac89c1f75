// SPDX-License-Identifier: Apache-2.0
#include "ring_balance.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "models/ring_tire/belt/belt_curve.h"
#include "models/ring_tire/ring/motion_slopes_testing.h"
#include "models/ring_tire/ring/ring_tire.h"
#include "models/ring_tire/step/newmark.h"
#include "models/road/profile_road.h"
#include "ring_kerb.h"

namespace latsch::benchmarks {

using namespace ring_tire;
using Eigen::Vector3d;

namespace {

constexpr double kSpeed = 60.0 / 3.6;

road::ProfileRoad cleat() { return road::cleat_road(0.3, 0.015, 0.03, 0.005); }

WheelMotion rolling(double camber, double steer, double slip, double time) {
  WheelMotion motion;
  motion.center = {kSpeed * time, 0.0, 0.294};
  motion.velocity.x() = kSpeed;
  motion.carrier =
      (Eigen::AngleAxisd(steer, Vector3d::UnitZ()) * Eigen::AngleAxisd(camber, Vector3d::UnitX()))
          .toRotationMatrix();
  motion.spin_rate = (1.0 + slip) * kSpeed / 0.306;
  motion.spin = motion.spin_rate * time;
  return motion;
}

RingParameters without_losses() {
  RingParameters ring = ring_of(60, 8, 6);
  for (SidewallElement* element :
       {&ring.sidewall.radial, &ring.sidewall.tangential, &ring.sidewall.lateral})
    *element = {.stiffness = element->stiffness};
  ring.sidewall.torsion_damping = 0.0;
  ring.tread.damping_time = 0.0;
  TreadFriction& mu = ring.tread.friction;
  mu.adhesion = mu.maximum = mu.sliding = mu.blocking = {0.0, 0.0, 0.0};
  return ring;
}

struct Drift {
  double most;  // J
  double work;  // J, sum of the magnitudes of the work that the road does on the belt
};

/// Returns the energy drift of a ring that rolls over the cleat in steps of h. The drift is the
/// change of the kinetic energy and of the energy in belt and sidewall, minus the work of road and
/// rim, which is integrated by the trapezoidal rule like the time steps. The springs of the tread
/// blocks count as part of the road.
std::optional<Drift> drift_of(double h) {
  RingSettings settings = kUntilRounding;
  settings.dissipation = 0.0;
  RingTire tire(without_losses(), settings);
  const road::ProfileRoad road = cleat();
  WheelMotion before = rolling(0.0, 0.0, 0.0, 0.0);
  if (!tire.settle(before, road, 0.0)) return std::nullopt;
  HubForces last;
  NodeValues place, force;
  Drift drift{0.0, 0.0};
  double balance = 0.0;
  for (int i = 1; i <= std::lround(0.04 / h); ++i) {
    const WheelMotion motion = rolling(0.0, 0.0, 0.0, i * h);
    const auto hub = tire.advance(motion, road, i * h, h);
    if (!hub) return std::nullopt;
    const NodeValues of_road = tire.road_forces();
    if (i == 1) {
      balance = tire.inner_energy();
    } else {
      const double by_road =
          0.5 * ((force + of_road).array() * (tire.positions() - place).array()).sum();
      const double by_rim =
          -0.5 * ((last.force + hub->force).dot(motion.center - before.center) +
                  (last.moment.y() + hub->moment.y()) * (motion.spin - before.spin));
      balance += by_road + by_rim;
      drift.work += std::abs(by_road);
      drift.most = std::max(drift.most, std::abs(tire.inner_energy() - balance));
    }
    last = *hub;
    place = tire.positions();
    force = of_road;
    before = motion;
  }
  return drift;
}

}  // namespace

void momentum_row(Table& table) {
  const RingParameters ring = ring_of(60, 8, 6);
  RingSettings settings = kUntilRounding;
  settings.dissipation = 0.0;
  RingTire tire(ring, settings);
  const road::ProfileRoad road = cleat();
  const auto at = [](double time) { return rolling(0.05, 0.04, 0.02, time); };
  bool runs = static_cast<bool>(tire.settle(at(0.0), road, 0.0));
  constexpr double kStep = 2e-4;
  double force = 0.0, moment = 0.0;
  for (int i = 1; runs && i <= 200; ++i) {
    const WheelMotion motion = at(i * kStep);
    const auto hub = tire.advance(motion, road, i * kStep, kStep);
    runs = static_cast<bool>(hub);
    if (!runs) break;
    Vector3d F = -motion.carrier * hub->force, M = -motion.carrier * hub->moment;
    double of_road = 0.0;
    for (const BlockContact& block : tire.contacts()) {
      F += block.force;
      M += (block.unloaded - motion.center).cross(block.force) + block.moment;
      of_road += block.force.norm();
    }
    NodeValues M_a;
    const RingState state = tire.state();
    at_knots_and_back(Eigen::Vector4d::Ones(), state.acceleration, M_a);
    M_a *= ring.belt.mass / ring.nodes;
    for (Eigen::Index k = 0; k < M_a.cols(); ++k) {
      const Vector3d f = M_a.col(k).head<3>();
      F -= f;
      M -= (state.place.col(k).head<3>() - motion.center).cross(f);
    }
    force = std::max(force, F.norm() / of_road);
    moment = std::max(moment, M.norm() / (of_road * ring.belt.radius));
  }
  table.row(
      "momentum, angular momentum: road less hub less belt, camber, steer and slip over a cleat",
      fmt::format("{:.0e}, {:.0e} of the road's", force, moment),
      "<= 1e-9",
      runs && force <= 1e-9 && moment <= 1e-9);
}

void energy_rows(Table& table) {
  std::vector<double> share;
  for (const double h : {2e-4, 1e-4, 5e-5, 2.5e-5}) {
    const auto drift = drift_of(h);
    if (!drift) return table.row("energy over a cleat", "no state found", "runs", false);
    share.push_back(drift->most / drift->work);
  }
  const double order = std::log2(share[1] / share[3]) / 2.0;
  table.row("energy over a cleat at 60 km/h without friction, drift in steps of 0.025 ms",
            fmt::format("{:.1e} of the contact's work", share[3]),
            "<= 1e-4",
            share[3] <= 1e-4);
  table.row("its order in the step; 0.2, 0.1, 0.05 ms",
            fmt::format("{:.2f}; {:.1e}, {:.1e}, {:.1e}", order, share[0], share[1], share[2]),
            ">= 1.9",
            order >= 1.9);
}

}  // namespace latsch::benchmarks
