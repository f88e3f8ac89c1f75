// SPDX-License-Identifier: Apache-2.0
#include "models/multibody/linear_model.h"

#include <algorithm>
#include <cassert>
#include <numbers>

#include "numerics/dense/general_eigen.h"
#include "numerics/dense/lu.h"

namespace latsch::multibody {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

namespace {

const Outside kNothingOutside;

MatrixXd dense(const BlockElimination& J) {
  MatrixXd all = MatrixXd::Zero(6 * J.bodies(), 6 * J.bodies());
  for (int row = 0; row < J.bodies(); ++row)
    for (int column = 0; column < J.bodies(); ++column)
      if (const int place = J.place(row, column); place >= 0)
        all.block<6, 6>(6 * row, 6 * column) = J.at(place);
  return all;
}

/// Evaluates the forces of a mechanism and their derivatives at rest, with the force laws that hold
/// in motion.
class Resting {
 public:
  Resting(const Mechanism& mechanism, const Rest& rest, const RestSettings& standing)
      : rest_(rest),
        standing_(standing),
        assembly_(mechanism),
        still_(VectorXd::Zero(6 * std::ssize(rest.poses))) {}

  MatrixXd J(double share, double acceleration_share) {
    assembly_.evaluate(motion(share, acceleration_share),
                       standing_.loads,
                       1.0,
                       standing_.outside ? *standing_.outside : kNothingOutside);
    return dense(assembly_.J());
  }

 private:
  Motion motion(double share, double acceleration_share) const {
    return {.poses = rest_.poses,
            .rates = &still_,
            .memories = rest_.memories.empty() ? nullptr : &rest_.memories,
            .drivers = standing_.drivers,
            .share = share,
            .acceleration_share = acceleration_share};
  }

  const Rest& rest_;
  const RestSettings& standing_;
  Assembly assembly_;
  VectorXd still_;
};

MatrixXd masses(const Mechanism& mechanism, const Poses& poses) {
  MatrixXd M = MatrixXd::Zero(6 * std::ssize(poses), 6 * std::ssize(poses));
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const Body& body = mechanism.bodies()[i];
    const Index k = 6 * static_cast<Index>(i);
    M.diagonal().segment<3>(k).setConstant(body.mass);
    M.block<3, 3>(k + 3, k + 3) = turned_inertia(body, poses[i]);
  }
  return M;
}

}  // namespace

LinearModel linear_model(const Mechanism& mechanism,
                         const Rest& rest,
                         const RestSettings& standing) {
  Resting resting(mechanism, rest, standing);
  const MatrixXd J = resting.J(0.0, 0.0);
  LinearModel model;
  model.K = -J;
  model.C = J - resting.J(1.0, 0.0);
  model.M = masses(mechanism, rest.poses) + (J - resting.J(0.0, 1.0));
  return model;
}

JointRow joint_force_row(const Mechanism& mechanism,
                         const Rest& rest,
                         const RestSettings& standing,
                         int which,
                         const Vector3d& direction,
                         int direction_body) {
  const Joint& joint = mechanism.joints()[static_cast<std::size_t>(which)];
  const Pose ground;
  const auto pose = [&](int body) -> const Pose& {
    return body == kGround ? ground : rest.poses[static_cast<std::size_t>(body)];
  };
  BushingPlace place = mechanism.place(which);
  if (joint.driver >= 0 && !standing.drivers.empty())
    place.in_a += standing.drivers[static_cast<std::size_t>(joint.driver)] * joint.along;
  const BushingStrain strain = strain_of(place, pose(joint.a), pose(joint.b));
  const Memories none = mechanism.no_memories();
  const Memories& memories = rest.memories.empty() ? none : rest.memories;
  const auto at_share = [&](double share) {
    return forces_in_motion(strain,
                            Vector6d::Zero(),
                            joint.bushing,
                            share,
                            memories.data() + mechanism.memory_of_joint(which),
                            kStatics,
                            nullptr);
  };
  const Index size = 6 * std::ssize(rest.poses);
  JointRow row{Eigen::RowVectorXd::Zero(size), Eigen::RowVectorXd::Zero(size)};
  const BushingForces forces = at_share(0.0);
  const BushingTangent K = tangent(strain, forces), KC = tangent(strain, at_share(1.0));
  const auto add = [&](int body, const Matrix6d& k, const Matrix6d& kc) {
    if (body == kGround) return;
    row.by_x.segment<6>(6 * body) += direction.transpose() * k.topRows<3>();
    row.by_v.segment<6>(6 * body) += direction.transpose() * (kc - k).topRows<3>();
  };
  add(joint.a, K.ba, KC.ba);
  add(joint.b, K.bb, KC.bb);
  // The direction of the joint's line turns with its body, so the force along it changes: (θ × n) F
  // = θ (n × F).
  const Vector3d force = wrenches(strain, forces).on_b.head<3>();
  if (direction_body != kGround)
    row.by_x.segment<3>(6 * direction_body + 3) += direction.cross(force).transpose();
  return row;
}

std::vector<LinearMode> natural_modes(const LinearModel& model) {
  const Index n = model.K.rows();
  numerics::Lu mass;
  mass.factorize(model.M);
  MatrixXd right(n, 2 * n);
  right << -model.K, -model.C;
  mass.solve(right);
  MatrixXd state = MatrixXd::Zero(2 * n, 2 * n);
  state.topRightCorner(n, n).setIdentity();
  state.bottomRows(n) = right;
  // Velocities are scaled so that the blocks for displacements and velocities have entries of the
  // same size.
  const double unit = std::sqrt(std::max(right.leftCols(n).cwiseAbs().maxCoeff(), 1.0));
  state.topRightCorner(n, n) *= unit;
  state.bottomLeftCorner(n, n) /= unit;
  const auto found = numerics::general_eigen(state);
  assert(found);
  std::vector<LinearMode> modes;
  for (Index i = 0; i < 2 * n; ++i) {
    const std::complex<double> lambda = found->values[i];
    // Rounding turns a double real eigenvalue into a pair with imaginary parts of about √ε of its
    // size. Such pairs are no vibrations.
    if (!(lambda.imag() > 1e-7 * std::abs(lambda))) continue;
    modes.push_back({std::abs(lambda) / (2.0 * std::numbers::pi),
                     -lambda.real() / std::abs(lambda),
                     found->vectors.col(i).head(n).normalized()});
  }
  std::sort(modes.begin(), modes.end(), [](const LinearMode& a, const LinearMode& b) {
    return a.frequency < b.frequency;
  });
  return modes;
}

Eigen::MatrixXcd frequency_response(const LinearModel& model,
                                    const LinearInputs& inputs,
                                    const LinearOutputs& outputs,
                                    double omega) {
  const Index n = model.K.rows(), m = inputs.P.cols();
  const MatrixXd real = model.K - omega * omega * model.M, imaginary = omega * model.C;
  MatrixXd system(2 * n, 2 * n);
  system << real, -imaginary, imaginary, real;
  MatrixXd x(2 * n, m);
  x << inputs.P, omega * inputs.Q;
  numerics::Lu lu;
  lu.factorize(system);
  lu.solve(x);
  const MatrixXd of_x = outputs.A - omega * omega * outputs.D, of_v = omega * outputs.B;
  Eigen::MatrixXcd response(outputs.A.rows(), m);
  response.real() = of_x * x.topRows(n) - of_v * x.bottomRows(n);
  response.imag() = of_x * x.bottomRows(n) + of_v * x.topRows(n);
  return response;
}

}  // namespace latsch::multibody
