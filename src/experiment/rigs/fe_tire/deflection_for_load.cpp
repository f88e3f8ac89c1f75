// SPDX-License-Identifier: Apache-2.0
#include "experiment/rigs/fe_tire/deflection_for_load.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

namespace latsch::experiment {
namespace {

using fe_tire::FeTire;
using fe_tire::GroundPose;
using fe_tire::TireState;

constexpr double kForceTolerance = 1e-7;  // relative; slopes then agree with the values to 1e-6
constexpr double kForceNoise = 1e-5;      // relative; accepted if friction prevents kForceTolerance
// Number of attempts before kForceNoise is accepted: the secant method needs four or five.
constexpr int kPatience = 8;
constexpr int kMaxAttempts = 25;
constexpr int kFirstSteps = 3;
constexpr double kLargestChange = 2.0;  // greatest factor of the deflection between attempts

GroundPose pose_at(const fe_tire::Inflated& inflated, double deflection, double camber) {
  GroundPose pose = FeTire::below(inflated, deflection);
  pose.camber = camber;
  return pose;
}

/// Returns a state of the cambered tire above the ground from which it can be pressed down.
TireState start_over(FeTire& tire,
                     const fe_tire::Inflated& inflated,
                     const fe_tire::Ground& ground,
                     const StandingPose& standing) {
  TireState start = tire.over(inflated, ground, standing.poses);
  start.pose.camber = standing.camber;
  // If a shoulder is lower than the crown, the tire would begin inside the ground.
  start.pose.height += inflated.radius * std::abs(std::sin(standing.camber));
  return start;
}

/// An equilibrium that was computed during the search for the deflection.
struct Pressed {
  double deflection, force;
  TireState state;
};

/// Returns the deflection at which F = c d^p carries Fz. The curve goes through two equilibria, or
/// through one with p a little above 1.
double deflection_for(double Fz, const Pressed& last, const std::optional<Pressed>& other) {
  double p = 1.1;
  if (other && other->force > 0.0 && other->deflection > 0.0 && other->force != last.force) {
    p = std::clamp(
        std::log(last.force / other->force) / std::log(last.deflection / other->deflection),
        0.5,
        4.0);
  }
  const double change = last.force > 0.0 ? std::pow(Fz / last.force, 1.0 / p) : kLargestChange;
  return last.deflection * std::clamp(change, 1.0 / kLargestChange, kLargestChange);
}

}  // namespace

Result<std::vector<TireState>> press_down(FeTire& tire,
                                          const fe_tire::Inflated& inflated,
                                          const fe_tire::Ground& ground,
                                          const StandingPose& standing,
                                          const std::vector<double>& deflections) {
  std::vector<GroundPose> poses;
  for (const double deflection : deflections)
    poses.push_back(pose_at(inflated, deflection, standing.camber));
  return tire.advance(start_over(tire, inflated, ground, standing), poses);
}

Result<TireState> load_to_force(FeTire& tire,
                                const fe_tire::Inflated& inflated,
                                double Fz,
                                double guess,
                                const fe_tire::Ground& ground,
                                const StandingPose& standing) {
  std::vector<double> first;
  for (int k = 1; k <= kFirstSteps; ++k) first.push_back(guess * k / kFirstSteps);
  auto states = press_down(tire, inflated, ground, standing, first);
  if (!states) return states.failure();
  // The deepest state that carries less than Fz, from which every attempt starts, and the state of
  // the last attempt.
  Pressed below{0.0, 0.0, start_over(tire, inflated, ground, standing)};
  std::optional<Pressed> last, before;
  for (std::size_t k = 0; k < first.size(); ++k) {
    const double force = tire.stand((*states)[k]).force.z();
    before = std::exchange(last, Pressed{first[k], force, std::move((*states)[k])});
    if (force < Fz) below = *last;
    if (force >= Fz) break;
  }
  for (int attempt = 0; attempt < kMaxAttempts; ++attempt) {
    const double off = std::abs(last->force - Fz);
    const double allowed = attempt < kPatience ? kForceTolerance : kForceNoise;
    if (off <= allowed * Fz) return std::move(last->state);
    const double d = std::max(deflection_for(Fz, *last, before), below.deflection * (1.0 + 1e-9));
    const auto next = tire.advance(below.state, {pose_at(inflated, d, standing.camber)});
    if (!next) return next.failure();
    const double force = tire.stand(next->front()).force.z();
    before = std::exchange(last, Pressed{d, force, next->front()});
    if (force < Fz && d > below.deflection) below = *last;
  }
  return Failure{fmt::format(
      "no deflection carries {:.6g} N: at {:.4g} mm the tire carries {:.6g} N; check the load",
      Fz,
      last->deflection * 1e3,
      last->force)};
}

}  // namespace latsch::experiment
