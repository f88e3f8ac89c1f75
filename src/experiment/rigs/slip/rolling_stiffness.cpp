// SPDX-License-Identifier: Apache-2.0
#include "experiment/rigs/slip/rolling_stiffness.h"

#include <cmath>
#include <numbers>
#include <numeric>

#include "experiment/rigs/slip/flat_track.h"

namespace latsch::experiment {
namespace {

constexpr double kFree = 2.0,
                 // Least distance, m, rolled freely, and then with the slip, before the force is
    // averaged.
    kSettled = 2.0;

struct Steady {
  double Fx, Fy, Mz;  // mean force and moment over a turn of the wheel, in the frame W
};

Result<Steady> steady(Tire& tire, const RollingStiffnessTest& test, SlipSweep sweep) {
  const double turn = 2.0 * std::numbers::pi * tire.free_radius();
  sweep.speed = test.speed;
  sweep.load = test.load;
  sweep.step = test.step;
  sweep.run_in = kFree / test.speed;
  sweep.duration = (kSettled + turn) / test.speed;
  const auto channels = run(tire, sweep);
  if (!channels) return channels.failure();
  const auto mean = [&](const char* name) {
    const std::vector<double>& all = (*channels)[name];
    const auto count = std::lround(turn / test.speed / test.step);
    return std::accumulate(all.end() - count, all.end(), 0.0) / static_cast<double>(count);
  };
  return Steady{mean("Fx"), mean("Fy"), mean("Mz")};
}

/// Returns half the difference between the forces at a value and at its negative.
template <class Sweep>
Result<Steady> odd_part(Tire& tire, const RollingStiffnessTest& test, const Sweep& at) {
  const auto plus = steady(tire, test, at(1.0));
  if (!plus) return plus;
  const auto minus = steady(tire, test, at(-1.0));
  if (!minus) return minus;
  return Steady{
      0.5 * (plus->Fx - minus->Fx), 0.5 * (plus->Fy - minus->Fy), 0.5 * (plus->Mz - minus->Mz)};
}

}  // namespace

Result<double> slip_stiffness(Tire& tire, const RollingStiffnessTest& test) {
  const auto found = odd_part(tire, test, [&](double sign) {
    const double kappa = sign * test.slip;
    return SlipSweep{.kappa_from = kappa, .kappa_to = kappa, .steady = {"Fx"}};
  });
  if (!found) return found.failure();
  return found->Fx / test.slip;
}

Result<Cornering> cornering(Tire& tire, const RollingStiffnessTest& test) {
  const auto found = odd_part(tire, test, [&](double sign) {
    const double alpha = sign * test.angle;
    return SlipSweep{.alpha_from = alpha, .alpha_to = alpha, .steady = {"Fy", "Mz"}};
  });
  if (!found) return found.failure();
  if (found->Fy == 0.0)
    return Failure{
        "slip angle makes no side force: there is no trail to "
        "compute"};
  return Cornering{-found->Fy / test.angle, -found->Mz / found->Fy};
}

Result<double> camber_stiffness(Tire& tire, const RollingStiffnessTest& test) {
  const auto found = odd_part(tire, test, [&](double sign) {
    return SlipSweep{.camber = sign * test.camber, .steady = {"Fy"}};
  });
  if (!found) return found.failure();
  return 0.0 - found->Fy / test.camber;
}

}  // namespace latsch::experiment
