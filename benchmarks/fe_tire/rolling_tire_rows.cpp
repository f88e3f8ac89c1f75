// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "free_wheel.h"
#include "rolling_rows.h"
#include "shipped_tires.h"

namespace latsch::benchmarks {

using namespace fe_tire;

namespace {

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr double kSpeed = 60.0 / 3.6;  // m/s

std::string relative(double value) { return fmt::format("{:.1e}", value); }

/// A wheel that is locked slides with mu Fz against its motion, at any slip angle.
void slide(const std::string& name, FreeWheel& wheel, Table& table) {
  double size = 0.0, angle = 0.0;
  for (const double alpha : {0.0, 45.0, 89.0}) {
    RollingCase of = wheel.at(-1.0, alpha * kDegree);
    of.speed = kSpeed;
    const RollingState state = value_of(wheel.rolling.roll(wheel.state, of));
    const Eigen::Vector2d F = state.forces.force.head<2>();
    const Eigen::Vector2d against =
        -Eigen::Vector2d(std::cos(of.slip_angle), std::sin(of.slip_angle));
    const double mu = of.friction.at_rest;
    size = std::max(size, std::abs(F.norm() / (mu * state.forces.force.z()) - 1.0));
    angle = std::max(angle, (F.normalized() - against).norm());
  }
  table.row(name + ", locked at 0, 45 and 89 deg: |Ft|/(mu Fz) - 1",
            relative(size),
            "<= 1e-6",
            size <= 1e-6);
  table.row(name + ", locked: direction against the sliding",
            relative(angle) + " rad",
            "<= 1e-3 rad",
            angle <= 1e-3);
}

/// An elastic tire without friction has neither drag nor moment, and its load depends on the square
/// of the spin.
void roll_without_friction(const std::string& name, FreeWheel& wheel, Table& table) {
  RollingCase of = wheel.state.of;
  of.friction.at_rest = 0.0;
  of.drive.reset();
  of.load.reset();
  const auto at = [&](double spin) {
    of.spin = spin;
    return value_of(wheel.rolling.roll(wheel.state, of)).forces;
  };
  const double spin = wheel.state.of.spin;
  const RollingForces none = at(0.0), quarter = at(0.25 * spin), half = at(0.5 * spin),
                      full = at(spin);
  const double load = full.force.z();
  table.row(name + ", frictionless: |Fx|/Fz",
            relative(std::abs(full.force.x()) / load),
            "<= 1e-6",
            std::abs(full.force.x()) <= 1e-6 * load);
  const double moment = std::abs(full.moment.y()) / of.height;
  table.row(name + ", frictionless: |My|/(R Fz)",
            relative(moment / load),
            "<= 1e-6",
            moment <= 1e-6 * load);
  // Fz - Fz(0) = D w + A w^2 + B w^4 with w as the share of the spin, solved from w = 1/4, 1/2
  // and 1: belts that grow make A and B; only an error of the transport around makes D.
  const double a = 16.0 * (quarter.force.z() - none.force.z()),
               b = 4.0 * (half.force.z() - none.force.z()), c = load - none.force.z();
  const double odd = (c - b - 4.0 * (b - a)) / 7.0;
  table.row(name + ", frictionless: share of the gain of Fz that is odd in the spin",
            fmt::format("{:.3f} %", 1e2 * odd / c),
            "<= 0.5 %",
            std::abs(odd) <= 0.005 * c);
}

}  // namespace

void roll_tires(const Options& options, Table& table) {
  struct Case {
    const char* name;
    double load;  // N
  };
  std::vector<Case> cases = {{"passenger_225_50R16", 4800.0},
                             {"passenger_205_55R16", 4000.0},
                             {"race_16x7.5-10", 1200.0},
                             {"passenger_235_45R20", 5000.0}};
  if (options.is_smoke()) cases.resize(1);
  for (const Case& of : cases) {
    FreeWheel wheel(tire_for(options, of.name), {1, 1, 1}, of.load, kSpeed, 1.0);
    slide(of.name, wheel, table);
    roll_without_friction(of.name, wheel, table);
  }
}

}  // namespace latsch::benchmarks
