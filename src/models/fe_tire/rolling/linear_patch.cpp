// SPDX-License-Identifier: Apache-2.0
#include "models/fe_tire/rolling/linear_patch.h"

#include <Eigen/Geometry>
#include <cmath>

#include "models/fe_tire/motion/spin.h"
#include "models/fe_tire/ring/ring.h"
#include "models/fe_tire/rolling/linear_roller.h"
#include "models/fe_tire/rolling/rolling_forces.h"
#include "numerics/sparse/elimination.h"

namespace latsch::fe_tire {

using Complex = std::complex<double>;

Eigen::Vector3cd complex_cross(const Eigen::Vector3cd& a, const Eigen::Vector3cd& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

LinearPatch::LinearPatch(const RingElements& elements, TreadShape shape)
    : elements_(elements),
      unknowns_(elements.ring(), RingSymmetry::none, {}),
      tread_(unknowns_, shape, kTouchingAngle),
      assembly_(unknowns_, &tread_),
      lines_(tread_, elements.ring().mesh()),
      K_(*assembly_.pattern()),
      factor_(*assembly_.pattern(),
              numerics::Precision::full,
              std::make_shared<const numerics::Elimination>(
                  numerics::eliminate(*assembly_.pattern(), tread_.block_rows()))) {}

Status LinearPatch::evaluate(const RollingState& state, RollingHistory* history) {
  of_ = state.of;
  AssembledState at{unknowns_.compress(state.u), state.alpha};
  Eigen::VectorXd f;
  int worst = 0;
  if (history != nullptr) history->update(unknowns_, at, of_.spin);
  const RingElements& by = history != nullptr ? history->elements() : elements_;
  if (!assembly_.assemble(by, at, state.pressure, f, &K_, &worst))
    return Failure{"an element is inverted, " + elements_.ring().place(worst)};
  K_.add(-of_.spin * of_.spin, flow_stiffness(assembly_, elements_));
  if (!factor_.condense(K_).definite())
    return Failure{"the tangent of the rolling tire is not positive definite: the tire buckles"};
  const PosedGround ground({}, {.height = of_.height, .camber = of_.camber});
  const GroundMotion motion = motion_of(of_);
  const RollingSurface surface(of_.curvature, -motion.velocity.normalized());
  body_.emplace(tread_,
                lines_,
                ground,
                surface,
                kNormalPenalty,
                motion,
                tread_.displacements(at.x),
                kNearPatch);
  const Eigen::Index rows = std::ssize(body_->rows());
  T_.setZero(rows, rows);
  by_spin_.setZero(rows);
  if (rows > 0) {
    if (!condensed_.set(factor_.condensed(), body_->rows()))
      return Failure{"the tangent of the tread is not positive definite"};
    body_->set(condensed_.stiffness(), Eigen::VectorXd::Zero(rows));
    T_ = body_->stiffness();
    by_spin_ = condensed(-2.0 * of_.spin * of_.spin * flow_forces(unknowns_, elements_, state.u));
  }

  const Eigen::VectorXd still = Eigen::VectorXd::Zero(body_->size());
  input_ = body_->input(still);
  const RollingGrip grip(body_->lines(), of_.friction, kAlongPenalty);
  tractions_ = grip.tractions(
      input_, listed(state.grip, body_->points()), RollingGrip::Directions::of_trial, true);
  x_ = body_->positions(still);
  c_.setZero(3, x_.cols());
  for (int k = 0; k < x_.cols(); ++k)
    if (touches(k)) c_.col(k) = body_->force(k, input_, tractions_);
  hub_ = ground.in_ground(Eigen::Vector3d::Zero());
  const Eigen::Vector3d down = ground.in_ground(-Eigen::Vector3d::UnitZ()) - hub_;
  center_ = hub_ + hub_.z() / -down.z() * down;
  for (int k = 0; k < 3; ++k) to_wheel_.col(k) = ground.to_wheel(Eigen::Vector3d::Unit(k));
  find_leaning(at.x, ground);
  return {};
}

/// The wheel center moves along the ground alone. The offset of a mean (T.1) turns with the wheel,
/// and its part along the ground does not count (tread_body.h).
void LinearPatch::find_leaning(const Eigen::VectorXd& unknowns, const PosedGround& ground) {
  const Eigen::Vector3d aside(0.0, hub_.z() / std::pow(std::cos(of_.camber), 2), 0.0);
  const Eigen::Matrix3Xd points =
      tread_.points_at(tread_.positions(tread_.displacements(unknowns)));
  leaning_.resize(3, x_.cols());
  for (int k = 0; k < x_.cols(); ++k) {
    const int point = body_->points()[k];
    const Eigen::Vector3d whole = ground.in_ground(points.col(point)) - hub_;
    const Eigen::Vector3d offset = ground.in_ground(tread_.points()[point].offset) - hub_;
    Eigen::Vector3d turned = Eigen::Vector3d::UnitX().cross(offset);
    turned.z() = 0.0;
    leaning_.col(k) = Eigen::Vector3d::UnitX().cross(whole) - aside - turned;
  }
}

Eigen::VectorXd LinearPatch::condensed(Eigen::VectorXd forces) const {
  factor_.reduce(forces);
  Eigen::VectorXd at_nodes(3 * tread_.nodes());
  for (int a = 0; a < tread_.nodes(); ++a)
    at_nodes.segment<3>(3 * a) = forces.segment<3>(3 * tread_.block_rows()[a]);
  return body_->to_ground(condensed_.reduce(at_nodes));
}

Eigen::VectorXd LinearPatch::at_unknowns(const Eigen::VectorXd& forces) const {
  const Eigen::VectorXd c = body_->to_nodes(forces);
  Eigen::VectorXd all = Eigen::VectorXd::Zero(unknowns_.size());
  const std::vector<int>& rows = body_->rows();
  for (std::size_t k = 0; k < rows.size(); ++k)
    all[3 * tread_.block_rows()[rows[k] / 3] + rows[k] % 3] = c[static_cast<Eigen::Index>(k)];
  return all;
}

Eigen::VectorXd LinearPatch::at_rows(const Eigen::VectorXd& displacements) const {
  const std::vector<int>& rows = body_->rows();
  Eigen::VectorXd at(std::ssize(rows));
  for (std::size_t k = 0; k < rows.size(); ++k)
    at[static_cast<Eigen::Index>(k)] =
        displacements[3 * tread_.block_rows()[rows[k] / 3] + rows[k] % 3];
  return body_->to_ground(at);
}

Eigen::Vector3d LinearPatch::center_by_rise() const {
  return (center_ - hub_) / hub_.z() + Eigen::Vector3d::UnitZ();
}

PointMotion LinearPatch::motion_along(const Eigen::Vector3d& d) const {
  PointMotion by = PointMotion::none(points());
  by.moved.colwise() = d.cast<Complex>();
  return by;
}

PointMotion LinearPatch::motion_by(SlipInput slip) const {
  PointMotion by = PointMotion::none(points());
  // Velocity of the ground at a place, seen from the wheel center, for a turn of 1 rad/s.
  const auto turning = [](const Eigen::Vector3d& from) -> Eigen::Vector2d {
    return {-from.y(), from.x()};
  };
  for (Eigen::Index k = 0; k < points(); ++k) {
    const Eigen::Vector3d from = x_.col(k) - hub_;
    Eigen::Vector2d velocity;
    switch (slip) {
      case SlipInput::angle: {
        // A turn slip is a turn for each meter, and the wheel moves faster with its angle.
        const double turn = of_.turn_slip * of_.speed * std::tan(of_.slip_angle);
        velocity =
            Eigen::Vector2d(0.0, of_.speed / std::cos(of_.slip_angle)) - turn * turning(from);
        break;
      }
      case SlipInput::spin:
        velocity = input_.V_g.col(k);
        break;
      case SlipInput::turn:
        velocity = -of_.speed * turning(from);
        break;
      case SlipInput::camber: {
        // Points move relative to the wheel center by what they and it move over the ground.
        const double aside = hub_.z() / std::pow(std::cos(of_.camber), 2);
        by.moved.col(k) = leaning_.col(k).cast<Complex>();
        velocity = -of_.turn_slip * of_.speed *
                   turning(leaning_.col(k) + Eigen::Vector3d(0.0, aside, 0.0));
        break;
      }
    }
    by.velocity.col(k) = velocity.cast<Complex>();
  }
  return by;
}

Eigen::VectorXcd LinearPatch::residual_by(SlipInput slip) const {
  if (slip == SlipInput::spin) return by_spin_.cast<Complex>();
  if (slip != SlipInput::camber) return Eigen::VectorXcd::Zero(T_.rows());
  Eigen::Matrix3Xcd turned(3, c_.cols());
  for (Eigen::Index k = 0; k < c_.cols(); ++k)
    turned.col(k) = Eigen::Vector3d::UnitX().cross(Eigen::Vector3d(c_.col(k))).cast<Complex>();
  return contact().at_rows(turned);
}

SlipResponse LinearPatch::measured(double omega,
                                   const Eigen::VectorXcd& q,
                                   const PointMotion& besides,
                                   const Eigen::Vector3d& center) const {
  const HarmonicContact contact = this->contact();
  const Eigen::Matrix3Xcd forces = contact.point_forces(omega, q, besides);
  const Eigen::Matrix3Xcd moved = contact.displacements(q) + besides.moved;
  SlipResponse sum{Eigen::Vector3cd::Zero(), Eigen::Vector3cd::Zero()};
  for (Eigen::Index k = 0; k < forces.cols(); ++k) {
    if (!touches(k)) continue;
    const Eigen::Vector3d from = body_->place(static_cast<int>(k), input_) - center_;
    Eigen::Vector3cd carried = moved.col(k) - center.cast<Complex>();
    carried.z() = 0.0;  // forces act in the plane of the ground
    const Eigen::Vector3cd force = forces.col(k), held = c_.col(k).cast<Complex>();
    sum.force += force;
    sum.moment += complex_cross(from.cast<Complex>(), force) + complex_cross(carried, held);
  }
  return sum;
}

}  // namespace latsch::fe_tire
