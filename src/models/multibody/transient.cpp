// SPDX-License-Identifier: Apache-2.0
#include "models/multibody/transient.h"

#include <fmt/format.h>

#include <cassert>
#include <cmath>

namespace latsch::multibody {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using Eigen::VectorXd;

namespace {

const Outside kNothing;

constexpr double kWild = 10.0;  // m: largest plausible displacement of a body in a step

const Outside& outside_of(const RestSettings& standing) {
  return standing.outside ? *standing.outside : kNothing;
}

}  // namespace

Transient::Transient(const Mechanism& mechanism, const TransientSettings& settings)
    : mechanism_(mechanism),
      settings_(settings),
      assembly_(mechanism),
      beta_(0.25 * (1.0 + settings.dissipation) * (1.0 + settings.dissipation)),
      gamma_(0.5 + settings.dissipation) {
  assert(Mechanism::fault_in_motion(mechanism.bodies()).empty());
}

void Transient::add_mass(double scale) {
  for (std::size_t i = 0; i < mechanism_.bodies().size(); ++i) {
    const Body& body = mechanism_.bodies()[i];
    Matrix6d& block = assembly_.J().at(static_cast<int>(i));
    block.diagonal().head<3>().array() -= scale * body.mass;
    block.bottomRightCorner<3, 3>() -= scale * assembly_.inertia(static_cast<int>(i));
  }
}

void Transient::subtract_inertia(const VectorXd& accelerations) {
  VectorXd& f = assembly_.forces();
  for (std::size_t i = 0; i < mechanism_.bodies().size(); ++i) {
    const Body& body = mechanism_.bodies()[i];
    const Eigen::Index k = 6 * static_cast<Eigen::Index>(i);
    f.segment<3>(k) -= body.mass * accelerations.segment<3>(k);
    f.segment<3>(k + 3) -= assembly_.inertia(static_cast<int>(i)) * accelerations.segment<3>(k + 3);
  }
}

Motion Transient::motion_of(const MechanismState& state, std::span<const double> drivers) const {
  return {.poses = state.poses,
          .rates = &state.rates,
          .accelerations = &state.accelerations,
          .memories = &state.memories,
          .drivers = drivers,
          .time = state.time,
          .step = 0.0};
}

Result<MechanismState> Transient::start(const Rest& rest,
                                        const RestSettings& standing,
                                        double time,
                                        const VectorXd* rates) {
  MechanismState state;
  state.time = time;
  state.poses = rest.poses;
  state.memories = rest.memories;
  const auto size = 6 * static_cast<Eigen::Index>(rest.poses.size());
  state.rates = rates ? *rates : VectorXd::Zero(size);
  state.accelerations = VectorXd::Zero(size);
  // A deflection that the memories do not contain acts as a sudden one.
  if (!state.memories.empty()) {
    const Memories before = state.memories;
    Motion motion = motion_of(state, standing.drivers);
    motion.memories = &before;
    assembly_.remember(motion, state.memories);
  }
  // The equation M g = f is solved twice: with inerters, e'' contains a term from velocities in
  // addition to the accelerations.
  for (int i = 0; i < 2; ++i) {
    Motion motion = motion_of(state, standing.drivers);
    motion.acceleration_share = 1.0;
    assembly_.evaluate(motion, standing.loads, 1.0, outside_of(standing));
    subtract_inertia(state.accelerations);
    correction_ = assembly_.forces();
    // The mass matrix of the inerters is the difference of J with and without them.
    assembly_.evaluate(motion, standing.loads, 1.0, kNothing);
    const BlockElimination with = assembly_.J();
    motion.acceleration_share = 0.0;
    assembly_.evaluate(motion, standing.loads, 1.0, kNothing);
    for (int p = 0; p < with.size(); ++p) assembly_.J().at(p) = with.at(p) - assembly_.J().at(p);
    add_mass(1.0);
    if (!assembly_.J().factorize()) return Failure{"a body without mass cannot move"};
    assembly_.J().solve(correction_);
    state.accelerations -= correction_;
  }
  state.algorithmic = state.accelerations;
  if (!state.accelerations.allFinite()) return Failure{"the start has forces that are not numbers"};
  return state;
}

void Transient::place(const MechanismState& from, double h, MechanismState& to) const {
  const double theta = settings_.dissipation;
  const double of_a0 = h * h * (0.5 - beta_), of_a1 = h * h * beta_;
  to.rates = from.rates + h * ((1.0 - gamma_) * from.algorithmic + gamma_ * to.algorithmic);
  to.accelerations = (to.algorithmic - theta * from.accelerations) / (1.0 - theta);
  for (std::size_t i = 0; i < from.poses.size(); ++i) {
    const Eigen::Index k = 6 * static_cast<Eigen::Index>(i);
    const double* const v0 = from.rates.data() + k;
    const double* const a0 = from.algorithmic.data() + k;
    const double* const a1 = to.algorithmic.data() + k;
    Vector6d way;
    for (int e = 0; e < 6; ++e) way[e] = h * v0[e] + (of_a0 * a0[e] + of_a1 * a1[e]);
    to.poses[i] = from.poses[i];
    to.poses[i].move(way);
  }
}

Status Transient::advance(MechanismState& state, double h, const RestSettings& standing) {
  assert(h > 0.0);
  next_.time = state.time + h;
  next_.poses.resize(state.poses.size());
  next_.algorithmic = state.algorithmic;
  place(state, h, next_);
  const double by_x = 1.0 / (beta_ * h * h), of_mass = by_x / (1.0 - settings_.dissipation);
  for (int i = 0; i < settings_.corrections; ++i) {
    assembly_.evaluate({.poses = next_.poses,
                        .rates = &next_.rates,
                        .accelerations = &next_.accelerations,
                        .memories = &state.memories,
                        .drivers = standing.drivers,
                        .time = next_.time,
                        .step = h,
                        .share = gamma_ / (beta_ * h),
                        .acceleration_share = of_mass},
                       standing.loads,
                       1.0,
                       outside_of(standing));
    subtract_inertia(next_.accelerations);
    add_mass(of_mass);
    if (!assembly_.J().factorize())
      return Failure{fmt::format(
          "at {:.5f} s the equations of {} have no solution",
          next_.time,
          mechanism_.bodies()[static_cast<std::size_t>(assembly_.J().singular_body())].name)};
    correction_ = assembly_.forces();
    assembly_.J().solve(correction_);
    next_.algorithmic -= by_x * correction_;
    place(state, h, next_);
  }
  for (std::size_t i = 0; i < next_.poses.size(); ++i)
    if (!((next_.poses[i].place - state.poses[i].place).norm() < kWild))
      return Failure{fmt::format("at {:.5f} s {} flies away: a shorter step may help, {}",
                                 next_.time,
                                 mechanism_.bodies()[i].name,
                                 assembly_.most_turned(state.poses))};
  if (!state.memories.empty())
    assembly_.remember({.poses = next_.poses,
                        .rates = &next_.rates,
                        .memories = &state.memories,
                        .drivers = standing.drivers,
                        .time = next_.time,
                        .step = h},
                       next_.memories);
  std::swap(state, next_);
  return {};
}

}  // namespace latsch::multibody
