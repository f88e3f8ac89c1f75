// SPDX-License-Identifier: Apache-2.0
#include "experiment/rigs/deflection_for_load.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace latsch::experiment {
namespace {

constexpr double kForceTolerance = 1e-5;  // relative; frequencies then move by less than 1e-5
constexpr int kMaxAttempts = 12;
constexpr int kSteps = 5;
constexpr double kLargestChange = 2.0;  // of the deflection from one attempt to the next

std::vector<double> steps_to(double deflection) {
  std::vector<double> steps;
  for (int i = 1; i <= kSteps; ++i) steps.push_back(deflection * i / kSteps);
  return steps;
}

}  // namespace

Result<fe_tire::TireState> load_to_force(fe_tire::FeTire& tire,
                                      const fe_tire::Inflated& inflated,
                                      double Fz,
                                      double guess,
                                      const fe_tire::Ground& ground) {
  double d = guess, p = 1.1;          // F = c d^p
  double last_d = 0.0, last_F = 0.0;  // 0: no attempt before
  double F = 0.0;
  for (int attempt = 0; attempt < kMaxAttempts; ++attempt) {
    auto pressed = tire.press(inflated, ground, steps_to(d));
    if (!pressed) return pressed.failure();
    F = tire.stand(pressed->back()).force.z();
    if (std::abs(F - Fz) <= kForceTolerance * Fz) return std::move(pressed->back());

    if (F > 0.0 && last_F > 0.0 && F != last_F && d != last_d) {
      p = std::clamp(std::log(F / last_F) / std::log(d / last_d), 0.5, 4.0);
    }
    last_d = d;
    last_F = F;
    const double change = F > 0.0 ? std::pow(Fz / F, 1.0 / p) : kLargestChange;
    d *= std::clamp(change, 1.0 / kLargestChange, kLargestChange);
  }
  return Failure{"no deflection carries " + std::to_string(Fz) + " N: at " +
                 std::to_string(last_d * 1e3) + " mm the tire carries " + std::to_string(F) +
                 " N; check the load"};
}

}  // namespace latsch::experiment
