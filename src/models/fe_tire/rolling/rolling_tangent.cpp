// SPDX-License-Identifier: Apache-2.0
#include "models/fe_tire/rolling/rolling_tangent.h"

#include "models/fe_tire/rolling/rolling_forces.h"

namespace latsch::fe_tire {
namespace {

constexpr int kCorrections = 2;  // a solution is corrected so often by its residual

}  // namespace

RollingTangent::RollingTangent(LinearRoller& roller,
                               const numerics::SymmetricMatrix& K,
                               const RollingCase& of,
                               const Eigen::VectorXd& x,
                               const GripState& states)
    : roller_(roller),
      K_(K),
      of_(of),
      surface_(of.curvature, -motion_of(of).velocity.normalized()),
      body_(roller.tread_,
            roller.nodes_.lines_,
            PosedGround({}, {.height = of.height, .camber = of.camber}),
            surface_,
            kNormalPenalty,
            motion_of(of),
            roller.tread_.displacements(x),
            kNearPatch),
      states_(listed(states, body_.points())) {
  body_.ask(0.0, 0.0);  // rise and spin are unknowns, whether they are held or not
  roller_.nodes_.nodes_ = Eigen::VectorXd::Zero(3 * roller_.tread_.nodes());
  roller_.nodes_.condense_for(body_);
  const Eigen::VectorXd still = Eigen::VectorXd::Zero(body_.size());
  const RollingContactState now = contact(still, of.friction, true);
  Eigen::MatrixXd J = body_.jacobian(still, now.input, now.tractions);
  const Eigen::Index rows = std::ssize(body_.rows());
  forces_by_ = J.topRows(rows);
  if (!of.load) J.row(rows) = Eigen::RowVectorXd::Unit(J.cols(), rows);
  if (!of.drive) J.row(rows + 1) = Eigen::RowVectorXd::Unit(J.cols(), rows + 1);
  J_.compute(J);
}

RollingContactState RollingTangent::contact(const Eigen::VectorXd& q,
                                            const RollingFriction& friction,
                                            bool with_links) const {
  const RollingGrip grip(body_.lines(), friction, kAlongPenalty);
  RollingContactState contact;
  contact.q = q;
  contact.input = body_.input(q);
  contact.state = states_;
  contact.tractions =
      grip.tractions(contact.input, states_, RollingGrip::Directions::of_trial, with_links);
  return contact;
}

/// Returns forces at all `size` unknowns from those at the body's rows.
Eigen::VectorXd RollingTangent::at_unknowns(const Eigen::VectorXd& c, Eigen::Index size) const {
  Eigen::VectorXd at = Eigen::VectorXd::Zero(3 * roller_.tread_.nodes());
  at(body_.rows()) = c;
  return roller_.at_unknowns(at, size);
}

Eigen::VectorXd RollingTangent::motion(const Eigen::VectorXd& residual,
                                       const Eigen::VectorXd& of_ground,
                                       double spin) {
  const Eigen::Index rows = std::ssize(body_.rows());
  Eigen::VectorXd border = of_ground.tail(body_.size() - rows);
  if (!of_.load) border[0] = 0.0;
  if (!of_.drive) border[1] = -spin;
  const Eigen::VectorXd of_patch =
      at_unknowns(body_.to_nodes(of_ground.head(rows)), residual.size());
  Eigen::VectorXd q = Eigen::VectorXd::Zero(body_.size());
  Eigen::VectorXd moved = Eigen::VectorXd::Zero(residual.size()), Kx(residual.size());
  Eigen::VectorXd left = residual + of_patch;
  for (int k = 0; k <= kCorrections; ++k) {
    TreadRoller& nodes = roller_.nodes_;
    Eigen::VectorXd d = roller_.reduced(left, nodes.nodes_), at = nodes.nodes_;
    Eigen::VectorXd right(body_.size());
    right << body_.to_ground(nodes.condensed_.reduce(at)), border;
    border.setZero();
    const Eigen::VectorXd step = -J_.solve(right);
    roller_.expand(nodes.expand(body_, step), d);
    q += step;
    moved -= d;
    // The elements' forces less those of the ground are left of (R.3).
    K_.multiply(moved.data(), Kx.data());
    const Eigen::VectorXd ground = body_.stiffness() * q.head(rows) - forces_by_ * q;
    left = residual + of_patch + Kx - at_unknowns(body_.to_nodes(ground), residual.size());
  }
  return q;
}

Eigen::VectorXd RollingTangent::residual_with(const RollingFriction& friction) const {
  const Eigen::VectorXd still = Eigen::VectorXd::Zero(body_.size());
  const RollingContactState now = contact(still, friction, false);
  return body_.residual(still, now.input, now.tractions);
}

RollingForces RollingTangent::forces(const Eigen::VectorXd& q,
                                     const RollingFriction& friction) const {
  RollingContactState now = contact(q, friction, false);
  RollingCase of = of_;
  of.height += rise(q);
  of.spin *= 1.0 + spin_change(q);
  now.tractions.w *= 1.0 + spin_change(q);  // the times of the lines are those of the spin before
  RollingForces found;
  std::vector<RollingPatchPoint> patch;
  measure(body_, now, of, found, patch);
  return found;
}

}  // namespace latsch::fe_tire
