// SPDX-License-Identifier: Apache-2.0
#include "models/fe_tire/passage/tread_in_time.h"

#include <fmt/format.h>

#include <optional>
#include <utility>

#include "models/fe_tire/passage/tread_flexibility.h"
#include "models/fe_tire/rolling/rolling_forces.h"
#include "models/fe_tire/rolling/tread_roller.h"

namespace latsch::fe_tire {
namespace {

/// Residual, relative to the load, below which the single precision of the flexibility does not let
/// it fall for a change of the forces as large as the load.
constexpr double kRoundingOfFlexibility = 1e-6;

/// Returns the contact at the start of a search if friction (F.5) at its places leaves an accepted
/// residual, N.
std::optional<RollingContactState> settled_at(const FlexibleTread& tread,
                                              const RollingGrip& grip,
                                              GripState states,
                                              double accepted) {
  RollingContactState contact;
  contact.q = tread.start();
  contact.state = std::move(states);
  contact.input = tread.input(contact.q);
  contact.tractions = grip.explicit_tractions(contact.input, contact.state);
  if (tread.residual(contact.q, contact.input, contact.tractions).norm() > accepted) return {};
  return contact;
}

}  // namespace

Result<TreadInTime::Found> TreadInTime::solve(const RollingCase& of,
                                              const Eigen::Matrix3Xd& u,
                                              const Eigen::VectorXd& g,
                                              double load,
                                              double enough,
                                              GripState& states,
                                              int& passes,
                                              const PassingMoment& moment,
                                              double settled) {
  if (spent_ > kMostSets)
    return Failure{
        fmt::format("no contact after {} solutions of sticking and sliding points", spent_)};
  const PosedGround ground({}, {.height = of.height, .camber = of.camber});
  const GroundMotion motion = motion_of(of);
  RollingSurface surface(of.curvature, -motion.velocity.normalized());
  if (moment.ground != nullptr) surface.set_ground(*moment.ground, moment.wheel);
  TreadBody body(tread_, lines_, ground, surface, kNormalPenalty, motion, u, kNearPatch);
  body.set_upstream(moment.past.upstream(body.points(), body.lines(), moment.step));
  body.set_force_scale(load);
  FlexibleTread tread(body, F_, g, of.load);
  const RollingGrip grip(body.lines(), of.friction, kAlongPenalty);
  RollingContactOptions limits = search_limits(enough, static_cast<int>(std::ssize(body.points())));
  limits.rounding = kRoundingOfFlexibility;
  if (body.rows().empty() && of.load)
    return Failure{fmt::format("the tread is off the ground, {:.4g} mm below the wheel center",
                               1e3 * of.height)};
  const auto find = [&]() -> Result<RollingContactState> {
    if (body.rows().empty()) return off_ground(body);
    const GripState from = listed(states, body.points());
    if (settled > 0.0)
      if (auto start = settled_at(tread, grip, from, settled * load)) return *std::move(start);
    return fe_tire::roll(tread, grip, tread.start(), from, limits);
  };
  const auto contact = find();
  if (!contact) {
    spent_ += 2 * limits.most_passes;  // both starts, at least
    return contact.failure();
  }
  passes += contact->solves;
  spent_ += contact->solves;
  put_back(*contact, body.points(), states);
  Found found;
  found.of = of;
  if (!body.rows().empty()) found.of.height += tread.rise(contact->q);
  measure(body, *contact, found.of, found.forces, found.patch);
  found.d = -tread.moved(contact->q);
  found.instant =
      instant_of(body, body.positions(tread.moved_rows(contact->q)), contact->tractions.t);
  found.c.setZero(g.size());
  found.c(body.rows()) = body.forces(contact->input, contact->tractions);
  return found;
}

}  // namespace latsch::fe_tire
