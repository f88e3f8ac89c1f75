// SPDX-License-Identifier: Apache-2.0
#include "models/fe_tire/rolling/tread_roller.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "models/fe_tire/rolling/rolling_forces.h"

namespace latsch::fe_tire {
namespace {

/// Speed of rotation of a locked wheel, relative to rolling: (F.1) needs a flow, however slow.
constexpr double kLocked = 1e-6;
/// Residual of the contact, relative to the accepted one of an iteration.
constexpr double kInside = 1e-1;
/// If the accepted residual is above this value, a solution counts as found although up to a
/// hundredth of the points still change between sticking and sliding.
constexpr double kUnsettled = 1e-4;
constexpr int kShareLeft = 100;

}  // namespace

GripState listed(const GripState& all, const std::vector<int>& points) {
  GripState part(static_cast<int>(points.size()));
  for (std::size_t k = 0; k < points.size(); ++k) {
    const auto i = static_cast<Eigen::Index>(k);
    part.grip[k] = all.grip[points[k]];
    part.direction.col(i) = all.direction.col(points[k]);
  }
  return part;
}

void put_back(const RollingContactState& found, const std::vector<int>& points, GripState& all) {
  std::ranges::fill(all.grip, Grip::none);
  for (std::size_t k = 0; k < points.size(); ++k) {
    const auto i = static_cast<Eigen::Index>(k);
    all.grip[points[k]] = found.state.grip[k];
    all.direction.col(points[k]) = found.state.direction.col(i);
  }
}

RollingContactState off_ground(const TreadBody& body) {
  RollingContactState contact;
  contact.q = Eigen::VectorXd::Zero(body.size());
  contact.input = body.input(contact.q);
  contact.tractions.t.setZero(2, contact.input.p.size());
  return contact;
}

TreadPast::Instant instant_of(const TreadBody& body,
                              const Eigen::Matrix3Xd& x,
                              const Eigen::Matrix2Xd& t) {
  TreadPast::Instant now{body.all_positions(),
                         Eigen::Matrix2Xd::Zero(2, body.all_positions().cols())};
  for (std::size_t k = 0; k < body.points().size(); ++k) {
    now.x.col(body.points()[k]) = x.col(static_cast<Eigen::Index>(k));
    now.t.col(body.points()[k]) = t.col(static_cast<Eigen::Index>(k));
  }
  return now;
}

RollingContactOptions search_limits(double enough, int points) {
  return {.tolerance = std::max(1e-10, kInside * enough),
          .most_left = enough > kUnsettled ? points / kShareLeft : 0,
          .most_passes = 50,
          .most_iterations = 15,
          .most_returns = 6};
}

GroundMotion motion_of(const RollingCase& of) {
  const Eigen::Vector2d heading(std::cos(of.slip_angle), std::sin(of.slip_angle));
  const double least = kLocked * of.speed / of.height;
  return {-of.speed * heading, of.turn_slip * of.speed, std::max(of.spin, least)};
}

void TreadRoller::set(Eigen::MatrixXd S) {
  S_ = std::move(S);
  rows_.clear();
}

/// Eliminates the nodes beyond the body's reach. Returns false if they buckle.
bool TreadRoller::condense_for(TreadBody& body) {
  if (rows_ != body.rows() || rows_.empty()) {
    if (!condensed_.set(S_, body.rows())) return false;
    rows_ = body.rows();
  }
  Eigen::VectorXd at = nodes_;
  Eigen::VectorXd r = condensed_.reduce(at);
  body.set(condensed_.stiffness(), std::move(r));
  return true;
}

Result<TreadRoller::Found> TreadRoller::solve(const RollingCase& of,
                                              const Eigen::Matrix3Xd& u,
                                              Eigen::VectorXd g,
                                              double load,
                                              double enough,
                                              GripState& states,
                                              int& passes,
                                              const PassingMoment* moment) {
  if (is_spent())
    return Failure{
        fmt::format("no steady state after {} solutions of sticking and sliding points", spent_)};
  Found found;
  found.of = of;
  nodes_ = std::move(g);
  const PosedGround ground({}, {.height = of.height, .camber = of.camber});
  const GroundMotion motion = motion_of(of);
  RollingSurface surface(of.curvature, -motion.velocity.normalized());
  if (moment != nullptr && moment->ground != nullptr)
    surface.set_ground(*moment->ground, moment->wheel);
  TreadBody body(tread_, lines_, ground, surface, kNormalPenalty, motion, u, near_);
  if (moment != nullptr)
    body.set_upstream(moment->past.upstream(body.points(), body.lines(), moment->step));
  if (body.rows().empty() && (moment == nullptr || of.load))
    return Failure{fmt::format("the tread is off the ground, {:.4g} mm below the wheel center",
                               1e3 * of.height)};
  body.ask(of.load, of.drive);
  if (!condense_for(body)) return Failure{"the tangent of the tread is not positive definite"};
  body.set_force_scale(load);
  const Eigen::VectorXd start = body.touching(Eigen::VectorXd::Zero(body.size()));
  const RollingGrip grip(body.lines(), of.friction, kAlongPenalty);
  const auto points = static_cast<int>(std::ssize(body.points()));
  RollingContactOptions limits = search_limits(enough, points);
  limits.is_careful = is_careful_;
  auto contact = body.rows().empty()
                     ? Result<RollingContactState>(off_ground(body))
                     : fe_tire::roll(body, grip, start, listed(states, body.points()), limits);
  if (!contact) {
    spent_ += 2 * limits.most_passes;  // both starts, at least
    return contact.failure();
  }
  passes += contact->solves;
  spent_ += contact->solves;
  const double change = body.spin_change(contact->q);
  found.of.height += body.rise(contact->q);
  found.of.spin *= 1.0 + change;
  contact->tractions.w *= 1.0 + change;  // the times of the lines are those of the spin before
  put_back(*contact, body.points(), states);
  measure(body, *contact, found.of, found.forces, found.patch);
  if (moment != nullptr)
    found.instant = instant_of(body, body.positions(contact->q), contact->tractions.t);
  found.d = expand(body, contact->q);
  const Eigen::VectorXd c = body.forces(contact->input, contact->tractions);
  found.c.setZero(nodes_.size());
  for (std::size_t k = 0; k < body.rows().size(); ++k)
    found.c[body.rows()[k]] = c[static_cast<Eigen::Index>(k)];
  return found;
}

TreadPast::Instant TreadRoller::instant(const RollingCase& of, const Eigen::Matrix3Xd& u) const {
  const PosedGround ground({}, {.height = of.height, .camber = of.camber});
  const GroundMotion motion = motion_of(of);
  const RollingSurface surface(of.curvature, -motion.velocity.normalized());
  const TreadBody body(tread_, lines_, ground, surface, kNormalPenalty, motion, u, near_);
  const Eigen::VectorXd still = Eigen::VectorXd::Zero(body.size());
  const RollingGrip grip(body.lines(), of.friction, kAlongPenalty);
  GripState states(static_cast<int>(std::ssize(body.points())));
  return instant_of(
      body, body.positions(still), grip.explicit_tractions(body.input(still), states).t);
}

/// Returns the decrease of all nodes' displacements from the displacements q of the body's rows.
Eigen::VectorXd TreadRoller::expand(const TreadBody& body, const Eigen::VectorXd& q) const {
  Eigen::VectorXd at = nodes_;
  condensed_.reduce(at);
  condensed_.expand(-body.to_nodes(q), at);
  return at;
}

}  // namespace latsch::fe_tire
