// SPDX-License-Identifier: Apache-2.0
#include "models/multibody/equilibrium.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace latsch::multibody {

using Eigen::Vector3d;

Equilibrium::Equilibrium(const Mechanism& mechanism, const EquilibriumSettings& settings)
    : mechanism_(mechanism), settings_(settings), assembly_(mechanism) {}

Result<Poses> Equilibrium::solve(std::span<const Load> loads, const Poses* start) {
  Rest before = unloaded();
  if (start) before.poses = *start;
  Result<Rest> rest = solve({.loads = loads}, before);
  if (!rest) return rest.failure();
  return std::move(rest->poses);
}

Result<Rest> Equilibrium::solve(const RestSettings& standing, const Rest& before) {
  iterations_ = 0;
  held_.resize(0);
  Rest at_once = before;
  const Status solved = newton(at_once, standing, 1.0);
  if (!solved) return follow(standing, before, solved.failure());
  at_once.drivers.assign(standing.drivers.begin(), standing.drivers.end());
  return at_once;
}

Result<Rest> Equilibrium::follow(const RestSettings& standing,
                                 const Rest& before,
                                 const Failure& at_once) {
  reached_ = before;
  share_ = 0.0;
  assemble(before, standing, 0.0);
  held_ = -assembly_.forces();
  if (!held_.allFinite())
    return Failure{"no equilibrium: the start has forces that are not numbers"};
  std::string reason = at_once.reason;
  double more = 0.5;
  for (int halvings = 1; share_ < 1.0;) {
    Rest next = reached_;
    const double share = std::min(1.0, share_ + more);
    if (const Status solved = damped_newton(next, standing, share); !solved) {
      reason = solved.failure().reason;
      if (++halvings > settings_.halvings) {
        held_.resize(0);
        return Failure{fmt::format("no equilibrium beyond {:.3g} of the load: {}", share_, reason)};
      }
      more *= 0.5;
      continue;
    }
    reached_ = std::move(next);
    share_ = share;
  }
  held_.resize(0);
  Rest found = reached_;
  found.drivers.assign(standing.drivers.begin(), standing.drivers.end());
  return found;
}

void Equilibrium::assemble(const Rest& rest, const RestSettings& standing, double share) {
  static const Outside kNothing;
  drivers_.assign(standing.drivers.begin(), standing.drivers.end());
  for (std::size_t i = 0; i < drivers_.size(); ++i) {
    const double before = rest.drivers.empty() ? 0.0 : rest.drivers[i];
    drivers_[i] = before + share * (drivers_[i] - before);
  }
  assembly_.evaluate({.poses = rest.poses, .memories = &rest.memories, .drivers = drivers_},
                     standing.loads,
                     share,
                     standing.outside ? *standing.outside : kNothing);
  if (held_.size() > 0) assembly_.forces() += (1.0 - share) * held_;
}

double Equilibrium::enough(const Poses& poses) const {
  return std::max(settings_.force, assembly_.rounding(poses));
}

Status Equilibrium::end_of_newton(Rest& rest) {
  if (!(assembly_.turned() <= settings_.most))
    return Failure{assembly_.most_turned(rest.poses) + ": it would be torn off"};
  if (!rest.memories.empty()) {
    const Memories before = rest.memories;
    assembly_.remember({.poses = rest.poses, .memories = &before, .drivers = drivers_},
                       rest.memories);
  }
  return {};
}

namespace {

/// Moves each body by `scale` times its six components of the step.
void move_all(Poses& poses, const Eigen::VectorXd& step, double scale) {
  for (std::size_t k = 0; k < poses.size(); ++k)
    poses[k].move(scale * step.segment<6>(6 * static_cast<Eigen::Index>(k)));
}

/// Returns the largest rotation of a body in a step, rad.
double turn_of(const Eigen::VectorXd& step) {
  double turn = 0.0;
  for (Eigen::Index k = 0; k < step.size(); k += 6)
    turn = std::max(turn, step.segment<3>(k + 3).norm());
  return turn;
}

Failure nothing_holds(const std::string& body) {
  return {fmt::format(
      "nothing holds {}: a direction of it meets no stiffness (a rod whose bushings have no "
      "rotational stiffness spins freely)",
      body)};
}

}  // namespace

Status Equilibrium::newton(Rest& rest, const RestSettings& standing, double share) {
  for (int i = 0; i <= settings_.iterations; ++i) {
    assemble(rest, standing, share);
    left_ = assembly_.forces().lpNorm<Eigen::Infinity>();
    if (left_ <= enough(rest.poses)) return end_of_newton(rest);
    if (!std::isfinite(left_) || i == settings_.iterations) break;
    if (!assembly_.J().factorize())
      return nothing_holds(
          mechanism_.bodies()[static_cast<std::size_t>(assembly_.J().singular_body())].name);
    ++iterations_;
    step_ = assembly_.forces();
    assembly_.J().solve(step_);
    const double turn = turn_of(step_);
    const double scale = turn > settings_.turn ? settings_.turn / turn : 1.0;
    move_all(rest.poses, step_, -scale);
  }
  return Failure{fmt::format("{:.3g} N are left after {} corrections, {}",
                             left_,
                             settings_.iterations,
                             assembly_.most_turned(rest.poses))};
}

bool Equilibrium::go_on(Rest& rest, const RestSettings& standing, double share) {
  // Smallest fraction of a Newton correction that is tried.
  constexpr double kShortest = 1.0 / 256.0;
  // J is copied, because each trial overwrites the assembly's tangent
  const BlockElimination J = assembly_.J();
  const Eigen::VectorXd correction = step_;
  const double turn = turn_of(correction), length = correction.norm();
  const Poses start = rest.poses;
  double scale = turn > settings_.turn ? settings_.turn / turn : 1.0;
  for (; scale >= kShortest; scale *= 0.5) {
    rest.poses = start;
    move_all(rest.poses, correction, -scale);
    assemble(rest, standing, share);
    left_ = assembly_.forces().lpNorm<Eigen::Infinity>();
    if (left_ <= enough(rest.poses)) return true;
    if (!std::isfinite(left_)) continue;
    Eigen::VectorXd next = assembly_.forces();
    J.solve(next);
    if (next.norm() <= (1.0 - 0.25 * scale) * length) return true;
  }
  return false;
}

Status Equilibrium::damped_newton(Rest& rest, const RestSettings& standing, double share) {
  constexpr int kIterations = 50;
  // The estimate of the rounding error is that of a single joint. On a body with several joints or
  // a long arm the error is several times as large, and no correction reduces it.
  constexpr double kRounding = 8.0;
  assemble(rest, standing, share);
  left_ = assembly_.forces().lpNorm<Eigen::Infinity>();
  double before = left_;
  for (int i = 0; i < kIterations; ++i) {
    if (left_ <= enough(rest.poses)) return end_of_newton(rest);
    if (!assembly_.J().factorize())
      return nothing_holds(
          mechanism_.bodies()[static_cast<std::size_t>(assembly_.J().singular_body())].name);
    ++iterations_;
    step_ = assembly_.forces();
    assembly_.J().solve(step_);
    if (!step_.allFinite()) break;
    if (!go_on(rest, standing, share)) {
      if (left_ <= kRounding * enough(rest.poses)) return end_of_newton(rest);
      break;
    }
    before = left_;
  }
  return Failure{fmt::format("{:.3g} N remain, no correction reduces them, {}",
                             before,
                             assembly_.most_turned(rest.poses))};
}

Status Equilibrium::linearize(const Poses& poses, std::span<const Load> loads) {
  return linearize({poses, mechanism_.no_memories()}, {.loads = loads});
}

Status Equilibrium::linearize(const Rest& rest, const RestSettings& standing) {
  assemble(rest, standing, 1.0);
  if (assembly_.J().factorize()) return {};
  return Failure{fmt::format(
      "nothing holds {}",
      mechanism_.bodies()[static_cast<std::size_t>(assembly_.J().singular_body())].name)};
}

Matrix6d Equilibrium::compliance(int of, int by, const Vector3d& arm) const {
  Matrix6d wrench = Matrix6d::Identity();
  wrench.bottomLeftCorner<3, 3>() = cross(arm);
  return -(assembly_.J().inverse_block(of, by) * wrench);
}

Eigen::MatrixXd Equilibrium::by_stiffness(const Poses& poses,
                                          const Eigen::MatrixXd& by_pose) const {
  Eigen::MatrixXd lambda = by_pose;
  assembly_.J().solve_transposed(lambda);
  const std::size_t joints = mechanism_.joints().size();
  Eigen::MatrixXd slopes(by_pose.cols(), 6 * static_cast<Eigen::Index>(joints));
  for (std::size_t i = 0; i < joints; ++i) {
    const Joint& joint = mechanism_.joints()[i];
    const auto pose = [&](int body) {
      return body == kGround ? Pose{} : poses[static_cast<std::size_t>(body)];
    };
    BushingPlace place = mechanism_.place(static_cast<int>(i));
    if (joint.driver >= 0 && !drivers_.empty())
      place.in_a += drivers_[static_cast<std::size_t>(joint.driver)] * joint.along;
    const BushingStrain s = strain_of(place, pose(joint.a), pose(joint.b));
    for (int e = 0; e < 6; ++e) {
      BushingParameters one{Vector3d::Zero(), Vector3d::Zero()};
      (e < 3 ? one.stiffness : one.rotational)[e % 3] = 1.0;
      const BushingWrenches w = wrenches(s, one);
      auto column = slopes.col(6 * static_cast<Eigen::Index>(i) + e);
      column.setZero();
      if (joint.a != kGround) column -= lambda.middleRows<6>(6 * joint.a).transpose() * w.on_a;
      if (joint.b != kGround) column -= lambda.middleRows<6>(6 * joint.b).transpose() * w.on_b;
    }
  }
  return slopes;
}

}  // namespace latsch::multibody
