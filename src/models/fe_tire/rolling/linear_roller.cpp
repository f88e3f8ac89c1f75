// SPDX-License-Identifier: Apache-2.0
#include "models/fe_tire/rolling/linear_roller.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "models/fe_tire/rolling/rolling_forces.h"
#include "numerics/sparse/elimination.h"

namespace latsch::fe_tire {
namespace {

/// Speed of rotation of a locked wheel, relative to rolling: (F.1) needs a flow, however slow.
constexpr double kLocked = 1e-6;
/// Residual of the contact, relative to the accepted one of an iteration.
constexpr double kInside = 1e-1;
/// Accepted residual above which a hundredth of the points may still change their states.
constexpr double kUnsettled = 1e-4;
constexpr int kShareLeft = 100;

void put_back(const RollingContactState& found, const std::vector<int>& points, GripState& all) {
  std::ranges::fill(all.grip, Grip::none);
  for (std::size_t k = 0; k < points.size(); ++k) {
    const auto i = static_cast<Eigen::Index>(k);
    all.grip[points[k]] = found.state.grip[k];
    all.direction.col(points[k]) = found.state.direction.col(i);
  }
}

/// Returns the contact of a tread that touches nothing.
RollingContactState off_ground(const TreadBody& body) {
  RollingContactState contact;
  contact.q = Eigen::VectorXd::Zero(body.size());
  contact.input = body.input(contact.q);
  contact.tractions.t.setZero(2, contact.input.p.size());
  return contact;
}

/// Returns the instant of all points of the tread from positions and tractions of the listed ones.
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

GroundMotion motion_of(const RollingCase& of) {
  const Eigen::Vector2d heading(std::cos(of.slip_angle), std::sin(of.slip_angle));
  const double least = kLocked * of.speed / of.height;
  return {-of.speed * heading, of.turn_slip * of.speed, std::max(of.spin, least)};
}

LinearRoller::LinearRoller(const RingAssembly& assembly,
                           const TreadSurface& tread,
                           const TreadLines& lines)
    : tread_(tread),
      lines_(lines),
      factor_(*assembly.pattern(),
              numerics::Precision::single,
              std::make_shared<const numerics::Elimination>(
                  numerics::eliminate(*assembly.pattern(), tread.block_rows()))) {}

bool LinearRoller::factorize(const numerics::SymmetricMatrix& K) {
  forget();
  has_factor_ = factor_.condense(K).definite();
  if (has_factor_) S_ = factor_.condensed();
  return has_factor_;
}

void LinearRoller::forget() {
  has_factor_ = false;
  rows_.clear();
}

Eigen::VectorXd LinearRoller::at_nodes(const Eigen::VectorXd& v) const {
  Eigen::VectorXd at(3 * tread_.nodes());
  for (int a = 0; a < tread_.nodes(); ++a)
    at.segment<3>(3 * a) = v.segment<3>(3 * tread_.block_rows()[a]);
  return at;
}

/// Eliminates the nodes beyond the body's reach. Returns false if they buckle.
bool LinearRoller::condense_for(TreadBody& body) {
  if (rows_ != body.rows() || rows_.empty()) {
    if (!condensed_.set(S_, body.rows())) return false;
    rows_ = body.rows();
  }
  Eigen::VectorXd at = nodes_;
  Eigen::VectorXd r = condensed_.reduce(at);
  body.set(condensed_.stiffness(), std::move(r));
  return true;
}

Result<LinearRoller::Found> LinearRoller::solve(const RollingCase& of,
                                                const Eigen::VectorXd& x,
                                                const Eigen::VectorXd& g,
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
  found.d = reduced(g);
  const PosedGround ground({}, {.height = of.height, .camber = of.camber});
  const GroundMotion motion = motion_of(of);
  RollingSurface surface(of.curvature, -motion.velocity.normalized());
  if (moment != nullptr && moment->ground != nullptr)
    surface.set_ground(*moment->ground, moment->wheel);
  TreadBody body(
      tread_, lines_, ground, surface, kNormalPenalty, motion, tread_.displacements(x), kNearPatch);
  if (moment != nullptr)
    body.set_upstream(moment->past.upstream(body.points(), body.lines(), moment->step));
  if (body.rows().empty() && moment == nullptr)
    return Failure{fmt::format("the tread is off the ground, {:.4g} mm below the wheel center",
                               1e3 * of.height)};
  body.ask(of.load, of.drive);
  if (!condense_for(body)) return Failure{"the tangent of the tread is not positive definite"};
  body.set_force_scale(load);
  const Eigen::VectorXd start = body.touching(Eigen::VectorXd::Zero(body.size()));
  const RollingGrip grip(body.lines(), of.friction, kAlongPenalty);
  const auto points = static_cast<int>(std::ssize(body.points()));
  const RollingContactOptions limits = {.tolerance = std::max(1e-10, kInside * enough),
                                        .most_left = enough > kUnsettled ? points / kShareLeft : 0,
                                        .is_careful = is_careful_,
                                        .most_passes = 50,
                                        .most_iterations = 15,
                                        .most_returns = 6};
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
  expand(body, contact->q, found.d);
  found.c =
      forces_at_unknowns(body, body.forces(contact->input, contact->tractions), found.d.size());
  return found;
}

TreadPast::Instant LinearRoller::instant(const RollingCase& of, const Eigen::VectorXd& x) const {
  const PosedGround ground({}, {.height = of.height, .camber = of.camber});
  const GroundMotion motion = motion_of(of);
  const RollingSurface surface(of.curvature, -motion.velocity.normalized());
  const TreadBody body(
      tread_, lines_, ground, surface, kNormalPenalty, motion, tread_.displacements(x), kNearPatch);
  const Eigen::VectorXd still = Eigen::VectorXd::Zero(body.size());
  const RollingGrip grip(body.lines(), of.friction, kAlongPenalty);
  GripState states(static_cast<int>(std::ssize(body.points())));
  return instant_of(
      body, body.positions(still), grip.explicit_tractions(body.input(still), states).t);
}

/// Eliminates all nodes but those of the tread from the forces g: returns what expand() takes, and
/// sets nodes_. Forces at the tread's nodes balance those of the ground. They stay out of the
/// factor's single precision, so that rounding is relative to what is not yet balanced.
Eigen::VectorXd LinearRoller::reduced(const Eigen::VectorXd& g) {
  Eigen::VectorXd d = g;
  for (const int row : tread_.block_rows()) d.segment<3>(3 * row).setZero();
  factor_.reduce(d);
  nodes_ = at_nodes(d) + at_nodes(g);
  return d;
}

/// Finds the decrease d of all unknowns from the displacements q of the body's rows.
void LinearRoller::expand(const TreadBody& body,
                          const Eigen::VectorXd& q,
                          Eigen::VectorXd& d) const {
  Eigen::VectorXd at = nodes_;
  condensed_.reduce(at);
  condensed_.expand(-body.to_nodes(q), at);
  for (int a = 0; a < tread_.nodes(); ++a)
    d.segment<3>(3 * tread_.block_rows()[a]) = at.segment<3>(3 * a);
  factor_.expand(d);
}

/// Returns forces on all `size` unknowns from those at the body's rows, in the axes of the
/// unknowns.
Eigen::VectorXd LinearRoller::forces_at_unknowns(const TreadBody& body,
                                                 const Eigen::VectorXd& c,
                                                 Eigen::Index size) const {
  Eigen::VectorXd all = Eigen::VectorXd::Zero(size);
  const std::vector<int>& rows = body.rows();
  for (std::size_t k = 0; k < rows.size(); ++k)
    all[3 * tread_.block_rows()[rows[k] / 3] + rows[k] % 3] = c[static_cast<Eigen::Index>(k)];
  return all;
}

}  // namespace latsch::fe_tire
