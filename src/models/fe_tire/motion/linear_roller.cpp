// SPDX-License-Identifier: Apache-2.0
#include "models/fe_tire/motion/linear_roller.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "models/fe_tire/motion/rolling_forces.h"
#include "numerics/dense/lu.h"
#include "numerics/sparse/elimination.h"

namespace latsch::fe_tire {
namespace {

/// Height over the ground up to which points take part in an iteration, m. A larger one costs
/// larger dense matrices, a smaller one more iterations.
constexpr double kNear = 1.5e-3;
/// Penalty along the ground, Pa/m: stiffer than the tread (G/h is some 1e8 Pa/m) by two decades, so
/// that its spring in series takes about a percent of a slip stiffness. With 1e12 the active set
/// does not settle, because the points outnumber the nodes.
constexpr double kAlong = 1e10;
/// Speed of rotation of a locked wheel, relative to rolling: (F.1) needs a flow, however slow.
constexpr double kLocked = 1e-6;
constexpr int kMostCorrections = 15;
/// Longest corrections of the spin, relative: a tire that slides as a whole tells no slope. And
/// farthest that height, m, and spin, relative, may go on one linear tire.
constexpr double kMostTurn = 0.02, kMostSpin = 0.1, kMostSink = 2e-3;
/// Steps for the slopes: of the height, m, and of the spin, relative.
constexpr double kSinkStep = 2e-5, kSpinStep = 2e-5;

/// States of the listed points among those of all.
GripState listed(const GripState& all, const std::vector<int>& points) {
  GripState part(static_cast<int>(points.size()));
  for (std::size_t k = 0; k < points.size(); ++k) {
    const auto i = static_cast<Eigen::Index>(k);
    part.grip[k] = all.grip[points[k]];
    part.direction.col(i) = all.direction.col(points[k]);
    part.speed[i] = all.speed[points[k]];
  }
  return part;
}

void put_back(const RollingContactState& found, const std::vector<int>& points, GripState& all) {
  std::ranges::fill(all.grip, Grip::none);
  for (std::size_t k = 0; k < points.size(); ++k) {
    const auto i = static_cast<Eigen::Index>(k);
    all.grip[points[k]] = found.state.grip[k];
    all.direction.col(points[k]) = found.state.direction.col(i);
    all.speed[points[k]] = found.tractions.w.col(i).norm();
  }
}

GroundMotion motion_of(const RollingCase& of) {
  const Eigen::Vector2d heading(std::cos(of.slip_angle), std::sin(of.slip_angle));
  const double least = kLocked * of.speed / of.height;
  return {-of.speed * heading, of.turn_slip * of.speed, std::max(of.spin, least)};
}

}  // namespace

LinearRoller::LinearRoller(const RingAssembly& assembly,
                           const TreadSurface& tread,
                           const TreadLines& lines)
    : tread_(tread),
      lines_(lines),
      factor_(*assembly.pattern(),
              numerics::Precision::full,
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
  by_.resize(0, 0);
}

Eigen::VectorXd LinearRoller::at_nodes(const Eigen::VectorXd& v) const {
  Eigen::VectorXd at(3 * tread_.nodes());
  for (int a = 0; a < tread_.nodes(); ++a)
    at.segment<3>(3 * a) = v.segment<3>(3 * tread_.block_rows()[a]);
  return at;
}

/// Eliminates the nodes beyond the body's reach. Returns false if they buckle.
bool LinearRoller::condense_for(TreadBody& body) {
  if (rows_ != body.rows()) {
    if (!condensed_.set(S_, body.rows())) return false;
    rows_ = body.rows();
    q_.setZero(std::ssize(rows_));
  }
  Eigen::VectorXd at = nodes_;
  Eigen::VectorXd r = condensed_.reduce(at);
  body.set(condensed_.stiffness(), std::move(r));
  return true;
}

/// Solves the contact at a height and a spin.
Result<LinearRoller::Attempt> LinearRoller::stand(const RollingCase& of, GripState& states) {
  if (is_spent())
    return Failure{
        fmt::format("no steady state after {} sets of sticking and sliding points", spent_)};
  const PosedGround ground({}, {.height = of.height, .camber = of.camber});
  Attempt attempt;
  attempt.body =
      std::make_unique<TreadBody>(tread_, lines_, ground, kNormalPenalty, motion_of(of), u_, kNear);
  TreadBody& body = *attempt.body;
  if (body.rows().empty())
    return Failure{fmt::format("the tread is off the ground, {:.4g} mm below the wheel center",
                               1e3 * of.height)};
  if (!condense_for(body)) return Failure{"the tangent of the tread is not positive definite"};
  body.set_force_scale(load_);
  const RollingGrip grip(body.lines(), of.friction, kAlong);
  const RollingContactOptions limits = {
      .most_passes = 50, .most_iterations = 15, .most_returns = 6};
  auto found = fe_tire::roll(body, grip, q_, listed(states, body.points()), limits);
  if (!found) {
    spent_ += 2 * limits.most_passes;  // both starts, at least
    return found.failure();
  }
  passes_ += found->passes;
  spent_ += found->passes + 1;
  put_back(*found, body.points(), states);
  q_ = found->q;
  attempt.contact = *std::move(found);
  measure(body, attempt.contact, of, attempt.forces, attempt.patch);
  return attempt;
}

/// Returns the relative errors of what is asked for: load, drive.
Eigen::VectorXd LinearRoller::errors(const RollingCase& of, const RollingForces& forces) const {
  Eigen::VectorXd error(int{of.load.has_value()} + int{of.drive.has_value()});
  if (of.load) error[0] = forces.force.z() / *of.load - 1.0;
  if (of.drive) error[error.size() - 1] = (forces.drive - *of.drive) / (load_ * of.height);
  return error;
}

Eigen::MatrixXd LinearRoller::slopes(const RollingCase& of,
                                     const Eigen::VectorXd& error,
                                     GripState states) {
  Eigen::MatrixXd by(error.size(), error.size());
  for (int k = 0; k < error.size(); ++k) {
    RollingCase moved = of;
    const bool is_height = k == 0 && of.load;
    const double step = is_height ? kSinkStep : kSpinStep * of.spin;
    (is_height ? moved.height : moved.spin) += step;
    const auto there = stand(moved, states);
    if (!there) return {};
    by.col(k) = (errors(moved, there->forces) - error) / step;
  }
  return by;
}

/// Finds the height and the spin that are left open.
Result<LinearRoller::Attempt> LinearRoller::balance(RollingCase& of,
                                                    double enough,
                                                    GripState& states) {
  auto now = stand(of, states);
  if (!now || !(of.load || of.drive)) return now;
  const RollingCase start = of;
  Eigen::VectorXd error = errors(of, now->forces);
  for (int correction = 0; correction < kMostCorrections; ++correction) {
    const double before = error.norm();
    if (error.cwiseAbs().maxCoeff() <= enough) return now;
    if (by_.rows() != error.size()) by_ = slopes(of, error, states);
    if (by_.size() == 0) return Failure{"load and drive have no slopes in height and spin"};
    numerics::Lu lu;
    lu.factorize(by_);
    Eigen::MatrixXd step = -error;
    lu.solve(step);
    if (!step.allFinite()) return Failure{"load and drive have no slopes in height and spin"};
    const Eigen::Index last = error.size() - 1;
    if (of.drive) step(last) = std::clamp(step(last), -kMostTurn * of.spin, kMostTurn * of.spin);
    bool is_far = false;
    const auto move = [&](double& value, double start, double most, double& by) {
      const double next = std::clamp(value + by, start - most, start + most);
      is_far = is_far || (next != value + by && next == value);
      by = next - value;
      value = next;
    };
    if (of.load) move(of.height, start.height, kMostSink, step(0));
    if (of.drive) move(of.spin, start.spin, kMostSpin * start.spin, step(last));
    if (is_far) {
      now->is_balanced = false;
      by_.resize(0, 0);
      return now;
    }
    now = stand(of, states);
    if (!now) return now;
    const Eigen::VectorXd next = errors(of, now->forces);
    const Eigen::VectorXd change = next - error;
    by_ += (change - by_ * step) * step.transpose() / step.squaredNorm();  // Broyden
    error = next;
    if (error.norm() > 0.5 * before) by_.resize(0, 0);  // the slopes have changed
  }
  return Failure{fmt::format(
      "height and spin do not settle: load {:.6g} N, moment of the drive {:.4g} N m at a height of "
      "{:.5g} mm and {:.6g} rad/s",
      now->forces.force.z(),
      now->forces.drive,
      1e3 * of.height,
      of.spin)};
}

Result<LinearRoller::Found> LinearRoller::solve(const RollingCase& of,
                                                const Eigen::VectorXd& x,
                                                const Eigen::VectorXd& g,
                                                double load,
                                                double enough,
                                                GripState& states,
                                                int& passes) {
  Found found;
  found.of = of;
  found.d = g;
  factor_.reduce(found.d);
  nodes_ = at_nodes(found.d);
  u_ = tread_.displacements(x);
  load_ = load;
  passes_ = 0;
  rows_.clear();
  auto attempt = balance(found.of, enough, states);
  passes += passes_;
  if (!attempt) return attempt.failure();
  found.is_balanced = attempt->is_balanced;
  found.forces = attempt->forces;
  found.patch = std::move(attempt->patch);
  Eigen::VectorXd at = nodes_;
  condensed_.reduce(at);
  condensed_.expand(-attempt->contact.q, at);
  found.c.setZero(x.size());
  const Eigen::VectorXd c =
      attempt->body->forces(attempt->contact.input, attempt->contact.tractions);
  for (std::size_t k = 0; k < rows_.size(); ++k)
    found.c[3 * tread_.block_rows()[rows_[k] / 3] + rows_[k] % 3] = c[static_cast<Eigen::Index>(k)];
  for (int a = 0; a < tread_.nodes(); ++a)
    found.d.segment<3>(3 * tread_.block_rows()[a]) = at.segment<3>(3 * a);
  factor_.expand(found.d);
  return found;
}

}  // namespace latsch::fe_tire
