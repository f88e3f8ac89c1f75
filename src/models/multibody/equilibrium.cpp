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
    : mechanism_(mechanism),
      settings_(settings),
      J_(static_cast<int>(mechanism.bodies().size()), mechanism.pairs()),
      rest_(6 * static_cast<Eigen::Index>(mechanism.bodies().size())) {}

const Pose& Equilibrium::pose(const Poses& poses, int body) const {
  return body == kGround ? ground_ : poses[static_cast<std::size_t>(body)];
}

Result<Poses> Equilibrium::solve(std::span<const Load> loads, const Poses* start) {
  iterations_ = 0;
  Poses reached = start ? *start : mechanism_.at_rest();
  double share = 0.0, more = 1.0;
  std::string trouble;
  for (int halvings = 0; share < 1.0;) {
    Poses next = reached;
    trouble = newton(next, loads, share + more);
    if (trouble.empty()) {
      reached = std::move(next);
      share += more;
      more = std::min(more, 1.0 - share);
    } else if (++halvings > settings_.halvings) {
      return Failure{fmt::format("no equilibrium beyond {:.3g} of the load: {}", share, trouble)};
    } else {
      more *= 0.5;
    }
  }
  return reached;
}

std::string Equilibrium::newton(Poses& poses, std::span<const Load> loads, double share) {
  const double enough = std::max(settings_.force, rounding());
  for (int i = 0; i <= settings_.iterations; ++i) {
    assemble(poses, loads, share);
    left_ = rest_.lpNorm<Eigen::Infinity>();
    if (left_ <= enough)
      return turned_ <= settings_.most ? "" : most_turned(poses) + ": it would be torn off";
    if (!std::isfinite(left_) || i == settings_.iterations) break;
    if (!J_.factorize())
      return fmt::format(
          "nothing holds {}: a direction of it meets no stiffness (a rod whose bushings have no "
          "rotational stiffness spins freely)",
          mechanism_.bodies()[static_cast<std::size_t>(J_.singular_body())].name);
    ++iterations_;
    J_.solve(rest_);
    double turn = 0.0;
    for (Eigen::Index k = 0; k < rest_.size(); k += 6)
      turn = std::max(turn, rest_.segment<3>(k + 3).norm());
    const double scale = turn > settings_.turn ? settings_.turn / turn : 1.0;
    for (std::size_t k = 0; k < poses.size(); ++k)
      poses[k].move(-scale * rest_.segment<6>(6 * static_cast<Eigen::Index>(k)));
  }
  return fmt::format("{:.3g} N are left after {} corrections, {}",
                     left_,
                     settings_.iterations,
                     most_turned(poses));
}

double Equilibrium::rounding() const {
  double stiffest = 0.0, far = 0.0;
  for (const Joint& joint : mechanism_.joints()) {
    stiffest = std::max(stiffest, joint.bushing.stiffness.maxCoeff());
    far = std::max(far, joint.point.lpNorm<Eigen::Infinity>());
  }
  return 4.0 * std::numeric_limits<double>::epsilon() * stiffest * far;
}

std::string Equilibrium::most_turned(const Poses& poses) const {
  double most = -1.0;
  std::string name;
  for (std::size_t i = 0; i < mechanism_.joints().size(); ++i) {
    const Joint& joint = mechanism_.joints()[i];
    const double turn =
        strain_of(mechanism_.place(static_cast<int>(i)), pose(poses, joint.a), pose(poses, joint.b))
            .q.norm();
    if (!(turn <= most)) {
      most = turn;
      name = joint.name;
    }
  }
  return fmt::format("{} is turned most, by {:.3g} deg", name, most * 180.0 / std::numbers::pi);
}

void Equilibrium::assemble(const Poses& poses, std::span<const Load> loads, double share) {
  J_.clear();
  rest_.setZero();
  turned_ = 0.0;
  for (std::size_t i = 0; i < mechanism_.joints().size(); ++i) {
    const Joint& joint = mechanism_.joints()[i];
    const BushingStrain strain = strain_of(
        mechanism_.place(static_cast<int>(i)), pose(poses, joint.a), pose(poses, joint.b));
    turned_ = std::max(turned_, strain.q.lpNorm<Eigen::Infinity>());
    const BushingWrenches w = wrenches(strain, joint.bushing);
    const BushingTangent K = tangent(strain, joint.bushing);
    if (joint.a != kGround) {
      rest_.segment<6>(6 * joint.a) += w.on_a;
      J_.block(joint.a, joint.a) += K.aa;
    }
    if (joint.b != kGround) {
      rest_.segment<6>(6 * joint.b) += w.on_b;
      J_.block(joint.b, joint.b) += K.bb;
    }
    if (joint.a != kGround && joint.b != kGround) {
      J_.block(joint.a, joint.b) += K.ab;
      J_.block(joint.b, joint.a) += K.ba;
    }
  }
  for (const Load& load : loads) {
    const Vector3d F = share * load.force;
    const Vector3d arm =
        pose(poses, load.body).turn *
        (load.point - mechanism_.bodies()[static_cast<std::size_t>(load.body)].origin);
    rest_.segment<3>(6 * load.body) += F;
    rest_.segment<3>(6 * load.body + 3) += arm.cross(F) + share * load.moment;
    J_.block(load.body, load.body).bottomRightCorner<3, 3>() += cross(F) * cross(arm);
  }
}

std::string Equilibrium::linearize(const Poses& poses, std::span<const Load> loads) {
  assemble(poses, loads, 1.0);
  if (J_.factorize()) return {};
  return fmt::format("nothing holds {}",
                     mechanism_.bodies()[static_cast<std::size_t>(J_.singular_body())].name);
}

Matrix6d Equilibrium::compliance(int of, int by, const Vector3d& arm) const {
  Matrix6d wrench = Matrix6d::Identity();
  wrench.bottomLeftCorner<3, 3>() = cross(arm);
  return -(J_.inverse_block(of, by) * wrench);
}

Eigen::MatrixXd Equilibrium::by_stiffness(const Poses& poses,
                                          const Eigen::MatrixXd& by_pose) const {
  Eigen::MatrixXd lambda = by_pose;
  J_.solve_transposed(lambda);
  const std::size_t joints = mechanism_.joints().size();
  Eigen::MatrixXd slopes(by_pose.cols(), 6 * static_cast<Eigen::Index>(joints));
  for (std::size_t i = 0; i < joints; ++i) {
    const Joint& joint = mechanism_.joints()[i];
    const BushingStrain s = strain_of(
        mechanism_.place(static_cast<int>(i)), pose(poses, joint.a), pose(poses, joint.b));
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
