// SPDX-License-Identifier: Apache-2.0
#include "models/ring_tire/ring/ring_tire.h"

#include <fmt/format.h>

#include <cassert>
#include <cmath>
#include <limits>
#include <numbers>

#include "models/ring_tire/step/newmark.h"
#include "models/ring_tire/step/wheel_motions.h"

namespace latsch::ring_tire {
namespace {

using Eigen::Vector3d;

Eigen::Vector4d mass_of_node(const RingParameters& p) {
  const double m = p.belt.mass / p.nodes;
  const double J = p.belt.torsion_inertia * 2.0 * std::numbers::pi * p.belt.radius / p.nodes;
  assert(m > 0.0 && J > 0.0);
  return {m, m, m, J};
}

// In the factorized tangent, couplings around the ring that have decayed to this share are omitted
// (cyclic_band.h). It is the relative error of a Newton correction. A larger value saves work.
constexpr double kFaded = 1e-6;
// If a Newton correction leaves more than this share of the residual, the tangent is computed
// again.
constexpr double kSlow = 0.2;

/// Returns true if a correction is certain to leave less than the tolerance. `left` is the residual
/// before this correction, `last` the residual before the preceding one, which used the same
/// tangent. If the equations are smooth, about 2 left²/last remains. Blocks that begin to touch or
/// to slip leave more, and their stored results belong to the state before the correction, so the
/// test uses a safety factor of ten and at most twenty tolerances.
bool known_to_end(double left, double last, double tolerance) {
  return left <= tolerance / kSlow ||
         (left <= 20.0 * tolerance && 10.0 * left * left <= tolerance * last);
}

}  // namespace

RingTire::RingTire(const RingParameters& parameters, const RingSettings& settings)
    : parameters_(parameters),
      settings_(settings),
      angles_(parameters.nodes),
      inner_forces_(parameters),
      tread_(parameters.tread,
             parameters.belt.radius,
             parameters.nodes,
             parameters.uniformity.radial_runout),
      section_(parameters.belt,
               parameters.tread.width,
               inner_forces_.belt().segment(),
               inner_forces_.belt().tension(),
               parameters.nodes),
      mass_(mass_of_node(parameters)),
      imbalance_(parameters.uniformity, parameters.nodes),
      rim_(RimFrame::of(WheelMotion())),
      factor_(parameters.nodes),
      free_rows_(parameters, 1.0 - settings.dissipation) {
  for (NodeValues* values : {&q_,
                             &v_,
                             &force_,
                             &q1_,
                             &v1_,
                             &q_predicted_,
                             &v_predicted_,
                             &a_,
                             &a1_,
                             &inner_,
                             &total_,
                             &inertia_,
                             &residual_})
    *values = NodeValues::Zero(4, parameters.nodes);
  place_at_rest();
}

double RingTire::free_radius() const { return parameters_.belt.radius + parameters_.tread.height; }

void RingTire::place_at_rest() {
  const double radius = parameters_.belt.radius * node_radius_over_knot_radius(angles_.nodes());
  for (int k = 0; k < angles_.nodes(); ++k)
    q_.col(k) << rim_.center + radius * angles_.radial(rim_, k), parameters_.belt.conicity;
  const std::vector<double>& rest = inner_forces_.lateral_rest();
  for (std::size_t k = 0; k < rest.size(); ++k)
    q_.col(static_cast<Eigen::Index>(k)).head<3>() += rest[k] * rim_.a;
  v_.setZero();
  a_.setZero();
  inner_forces_.sidewall().reset();
  tread_.reset();
  section_.reset();
  tread_.bend(section_);
}

void RingTire::evaluate(const NodeValues& q, const NodeValues& v) {
  ++counts_.evaluations;
  inner_forces_.find_force(q, v, rim_, rule_, inner_);
  total_ = inner_;
  total_.row(2).array() -= mass_[0] * parameters_.belt.gravity;
  imbalance_.add_weight(parameters_.belt.gravity, total_);
  if (section_.on()) tread_.bend(section_);
  tread_.add_force(q, v, total_);
  if (section_.on()) section_.set_forces(tread_.section_forces(section_, q));
}

double RingTire::left_at_a_node(double of_nodes) {
  double left = of_nodes;
  if (free_) left = std::max(left, free_->find_left(q1_, inner_, tread_.moment_on_rim()));
  if (!section_.on() || section_.unknowns() == 0) return left;
  return std::max(left, section_.residual().cwiseAbs().maxCoeff());
}

double RingTire::left_together() const {
  return section_.on() ? std::hypot(total_.norm(), section_.residual().norm()) : total_.norm();
}

void RingTire::solve() {
  if (section_.on())
    section_.solve(factor_, residual_);
  else
    factor_.solve(residual_);
}

bool RingTire::factorize(const NodeValues& q,
                         double mass_factor,
                         double scale,
                         const StepRule& rule) {
  ++counts_.factorizations;
  StiffnessRows& K = inner_forces_.find_stiffness(q, rim_, rule, scale);
  K.add_at_knots((mass_factor * mass_).asDiagonal());
  factor_.start(K, rim_.axes());
  imbalance_.add_mass(mass_factor, factor_);
  tread_.add_stiffness(scale, rim_.axes(), factor_);
  if (!factor_.factorize(mass_factor > 0.0 ? kFaded : 0.0)) return false;
  if (!section_.on()) return true;
  Eigen::MatrixXd B, A;
  tread_.section_border(section_, q, false, B, A);
  return section_.border(factor_, B, A, scale);
}

CyclicBand RingTire::stiffness() {
  CyclicBand K(angles_.nodes());
  inner_forces_.find_stiffness(q_, rim_, {}, 1.0).turn_back(rim_, K);
  tread_.add_stiffness(1.0, K);
  return K;
}

void RingTire::times_mass(const NodeValues& a, NodeValues& force) const {
  at_knots_and_back(mass_, a, force);
  imbalance_.add_inertia(a, force);
}

double RingTire::energy() const { return inner_energy() + tread_.energy(q_); }

double RingTire::inner_energy() const {
  NodeValues momentum;
  times_mass(v_, momentum);
  const double weight = mass_[0] * parameters_.belt.gravity;
  const NodeValues from_rest = inner_forces_.from_rest(q_, rim_);
  return 0.5 * (v_.array() * momentum.array()).sum() + weight * q_.row(2).sum() +
         imbalance_.height_energy(parameters_.belt.gravity, q_) +
         inner_forces_.belt().energy(from_rest, rim_) +
         inner_forces_.sidewall().energy(at_knots(from_rest), rim_) + section_.energy();
}

NodeValues RingTire::road_forces() const {
  NodeValues of_road = force_ - inner_;
  of_road.row(2).array() += mass_[0] * parameters_.belt.gravity;
  imbalance_.add_weight(-parameters_.belt.gravity, of_road);
  return of_road;
}

Eigen::Matrix3Xd RingTire::outline() const { return at_knots(q_).topRows<3>(); }

std::optional<Footprint> RingTire::footprint() const {
  const Vector3d forward = last_motion_.carrier.col(0);
  const Vector3d heading = Vector3d(forward.x(), forward.y(), 0.0).normalized();
  return tread_.footprint(q_, rim_.center, heading);
}

HubForces RingTire::hub_forces(const Eigen::Matrix3d& carrier) const {
  Vector3d force = Vector3d::Zero(), moment = tread_.moment_on_rim();
  for (int k = 0; k < angles_.nodes(); ++k) {
    const Vector3d f = inner_.col(k).head<3>();
    force -= f;
    moment -= (q_.col(k).head<3>() - rim_.center).cross(f);
  }
  return {carrier.transpose() * force, carrier.transpose() * moment};  // (18)
}

/// Sets velocities and accelerations of steady rolling. The shape X(χ) over the angle χ = φ - spin
/// is fixed in the carrier, and node k moves along it: x' = c' + ω × (x - c) - spin' dX/dχ,  x'' =
/// spin'^2 d²X/dχ². The derivatives of X are finite differences of fourth order.
void RingTire::roll_on(const WheelMotion& motion) {
  const int N = angles_.nodes();
  const double step = 2.0 * std::numbers::pi / N, rate = motion.spin_rate;
  for (int k = 0; k < N; ++k) {
    const auto x = [&](int offset) { return q_.col((k + offset + N) % N); };
    const Eigen::Vector4d slope = (8.0 * (x(1) - x(-1)) - (x(2) - x(-2))) / (12.0 * step);
    const Eigen::Vector4d bend =
        (16.0 * (x(1) + x(-1)) - (x(2) + x(-2)) - 30.0 * x(0)) / (12.0 * step * step);
    v_.col(k) = -rate * slope;
    v_.col(k).head<3>() +=
        motion.velocity + motion.angular_velocity.cross(x(0).head<3>() - motion.center);
    a_.col(k) = rate * rate * bend;
  }
  times_mass(a_, force_);
}

Result<HubForces> RingTire::advance(const WheelMotion& motion,
                                    const road::Road& road,
                                    double time,
                                    double step) {
  assert(settled_);
  if (const Status fit = check_step(motion, step); !fit) return fit.failure();
  const Status done = advance_in_parts(motion, road, time, step);
  if (!done) return done.failure();
  last_motion_ = motion;
  return hub_forces(motion.carrier);
}

/// Advances in parts if the step is long. A Failure leaves the tire in its state before the step.
Status RingTire::advance_in_parts(const WheelMotion& motion,
                                  const road::Road& road,
                                  double time,
                                  double step) {
  const int parts = std::max(1, static_cast<int>(std::ceil(step / settings_.largest_step - 1e-9)));
  if (parts == 1) {
    if (const Status done = step_forward(motion, road, time, step); done.ok()) return done;
  }
  const RingState before = state();
  for (int i = 1; i <= parts; ++i) {
    const WheelMotion from =
        i == 1 ? last_motion_ : between(last_motion_, motion, (i - 1.0) / parts);
    const WheelMotion to =
        i == parts ? motion : between(last_motion_, motion, static_cast<double>(i) / parts);
    const double then = time - step * (1.0 - static_cast<double>(i) / parts);
    const Status done = substep(from, to, road, then, step / parts, settings_.halvings);
    if (done.ok()) continue;
    restore(before);
    return done;
  }
  return {};
}

RingState RingTire::state() const {
  return {.motion = last_motion_,
          .place = q_,
          .rate = v_,
          .acceleration = a_,
          .force = force_,
          .sidewall = inner_forces_.sidewall().memory(),
          .tread = tread_.memory(),
          .section = section_.kept()};
}

void RingTire::restore(const RingState& state) {
  assert(state.place.cols() == q_.cols());
  last_motion_ = state.motion;
  rim_ = RimFrame::of(state.motion);
  q_ = state.place;
  v_ = state.rate;
  a_ = state.acceleration;
  force_ = state.force;
  inner_forces_.sidewall().remember(state.sidewall);
  tread_.remember(state.tread);
  section_.keep(state.section);
  reuse_.forget();
  settled_ = true;
}

Result<RingTrial> RingTire::trial(const RingState& from,
                                  const WheelMotion& motion,
                                  const road::Road& road,
                                  double time,
                                  double step,
                                  bool with_slopes) {
  restore(from);
  std::vector<StepTaken> taken;
  if (with_slopes) taken_ = &taken;
  const Result<HubForces> hub = advance(motion, road, time, step);
  taken_ = nullptr;
  if (!hub) return hub.failure();
  RingTrial trial{*hub, state(), std::nullopt};
  if (!with_slopes) return trial;
  trial.slopes = slopes_.over(*this, from, motion, road, time, step, taken);
  restore(trial.state);
  return trial;
}

/// Takes a step. If it has no solution, takes two steps of half the length.
Status RingTire::substep(const WheelMotion& from,
                         const WheelMotion& to,
                         const road::Road& road,
                         double time,
                         double step,
                         int halvings) {
  const Status whole = step_forward(to, road, time, step);
  if (whole.ok() || halvings == 0) return whole;
  const WheelMotion middle = between(from, to, 0.5);
  const Status first = substep(from, middle, road, time - 0.5 * step, 0.5 * step, halvings - 1);
  return first.ok() ? substep(middle, to, road, time, 0.5 * step, halvings - 1) : first;
}

/// Sets the initial guess of Newton's method. In a rolling tire, accelerations are constant at a
/// position in space rather than at a node, which moves through them by the angle `turn` in the
/// step.
void RingTire::guess_end(double turn) {
  const int N = angles_.nodes();
  const double segments = turn * N / (2.0 * std::numbers::pi), whole = std::floor(segments);
  const double part = segments - whole;
  const int shift = static_cast<int>(whole) % N;
  for (int k = 0; k < N; ++k) {
    const auto a = [&](int back) { return a_.col((k - shift - back + 2 * N) % N); };
    const Eigen::Vector4d more = (1.0 - part) * a(0) + part * a(1) - a_.col(k);
    q1_.col(k) = q_predicted_.col(k) + more / rule_.acceleration;
  }
}

/// Computes the terms of (16) that do not depend on the end of the step, and evaluates the road
/// there.
void RingTire::predict(const WheelMotion& motion, const road::Road& road, double time, double h) {
  const double theta = settings_.dissipation, gamma = 0.5 + theta;
  const double beta = 0.25 * (1.0 + theta) * (1.0 + theta);
  rim_ = RimFrame::of(motion);
  rule_ = {.step = h, .velocity = gamma / (beta * h), .acceleration = 1.0 / (beta * h * h)};
  q_predicted_ = q_ + h * v_ + 0.5 * h * h * a_;
  v_predicted_ = v_ + h * a_;
  guess_end(motion.spin_rate * h);
  if (section_.on()) {
    section_.restart();
    section_.flow(motion.spin_rate * h * angles_.nodes() / (2.0 * std::numbers::pi));
    tread_.bend(section_);
  }
  tread_.approach(q_predicted_, rim_, road, time, rule_, {&q_, &v_});
  if (section_.on()) section_.touch(tread_.nodes_near_road());
}

/// Computes the velocities v1_ and accelerations a1_ of (16) for the positions q1_.
void RingTire::follow() { ring_tire::follow(rule_, q1_, q_predicted_, v_predicted_, a_, v1_, a1_); }

/// Computes the tangent at q1_ again. If it would not be positive definite, the mass is increased.
bool RingTire::renew_tangent() {
  constexpr double kMostMass = 64.0;  // largest factor by which the mass is increased
  for (double more = 1.0; more <= kMostMass; more *= 2.0) {
    if (!factorize(q1_, more * rule_.acceleration, 1.0 - settings_.dissipation, rule_)) continue;
    reuse_.made(more * rule_.acceleration);
    if (free_)
      free_->take_tangent(inner_forces_, rim_, q1_, rule_.acceleration, counts_.factorizations);
    return true;
  }
  return false;
}

/// Updates the forces after a correction that is certain to leave less than the tolerance: belt and
/// sidewall are evaluated, and the total follows from (17). The tread blocks, which are most of the
/// work, are not evaluated again.
void RingTire::balance() {
  const double theta = settings_.dissipation;
  follow();
  inner_forces_.find_force(q1_, v1_, rim_, rule_, inner_);
  times_mass(a1_, inertia_);
  total_ = (inertia_ - theta * force_) / (1.0 - theta);
}

/// Accepts the state at the end of the step.
void RingTire::accept() {
  q_.swap(q1_);
  v_.swap(v1_);
  a_.swap(a1_);
  force_.swap(total_);
  inner_forces_.commit(q_, rim_, rule_);
  tread_.commit();
  if (section_.on()) section_.accept();
}

/// Takes one step of the time integration (16), (17).
Status RingTire::step_forward(const WheelMotion& motion,
                              const road::Road& road,
                              double time,
                              double h) {
  predict(free_ ? free_->begin(motion, time, h) : motion, road, time, h);
  ++counts_.steps;
  if (!tread_.knows_road()) return no_solution(time, kNoRoad);
  // A tangent of an earlier step can be rotated with the wheel, but not the border that bending
  // sections add to it.
  const bool held = reuse_.serves(rule_.acceleration) && !section_.on() &&
                    (!free_ || free_->knows_tangent(counts_.factorizations));
  const int age = reuse_.age();
  const long before = counts_.evaluations;
  Status done = solve_step(held, time);
  if (done.ok()) done = check_belt(q1_, time);
  if (!done) {
    reuse_.forget();
    return done;
  }
  const int evaluations = static_cast<int>(counts_.evaluations - before);
  if (held)
    reuse_.took_with_held(evaluations, age);
  else
    reuse_.took_with_own(evaluations);
  accept();
  if (free_) free_->accept(q_, inner_, tread_.moment_on_rim());
  if (taken_) taken_->push_back({time, h, state()});
  return {};
}

/// Solves (17) by Newton's method. If `held`, it begins with the tangent of an earlier step.
Status RingTire::solve_step(bool held, double time) {
  const double theta = settings_.dissipation;
  // If a correction leaves more than this share of the residual, Newton's method converges slowly,
  // and the following correction is lengthened.
  constexpr double kCrawling = 0.5;
  // Residual at a node of the initial guess above which the tolerance grows in proportion to it, N.
  constexpr double kViolent = 1000.0;
  if (held) factor_.turn_to(rim_.axes());
  double last = std::numeric_limits<double>::infinity();
  // Error of the inertia forces caused by the rounding of positions. It matters in very short steps
  // far from the origin.
  const double rounding = 16.0 * std::numeric_limits<double>::epsilon() * rule_.acceleration *
                          mass_.maxCoeff() * q1_.cwiseAbs().maxCoeff();
  double tolerance = std::max(settings_.tolerance, rounding);
  for (int iteration = 0; iteration < settings_.most_iterations; ++iteration) {
    follow();
    evaluate(q1_, v1_);
    times_mass(a1_, inertia_);
    const double left = left_at_a_node(find_residual(theta, total_, force_, inertia_, residual_));
    if (!std::isfinite(left)) break;
    if (iteration == 0) tolerance *= std::max(1.0, left / kViolent);
    if (left <= tolerance) return {};
    const bool reduces = iteration > 0 && left <= kSlow * last;
    const bool crawls = iteration > 1 && left > kCrawling * last;
    if (!reduces && !(held && iteration == 0)) {
      held = false;
      if (!renew_tangent()) return no_solution(time, "its tangent is not definite");
    }
    const bool ends = reduces && known_to_end(left, last, tolerance);
    last = left;
    solve();
    if (free_ && !correct_wheel())
      return no_solution(time,
                         "the torque on the wheel grows "
                         "faster than the wheel can follow");
    const double by = crawls ? repeated_.lengthening(residual_, section_.direction()) : 1.0;
    if (!crawls) repeated_.start();
    q1_ += by * residual_;
    if (section_.on()) section_.set_values(section_.values() + by * section_.direction());
    if (ends) {
      balance();
      return {};
    }
  }
  return no_solution(time, fmt::format("{:.3g} N are left at a node", last));
}

/// Returns a Failure if the belt is so near the axle, or so far from it, that results are
/// meaningless.
Status RingTire::check_belt(const NodeValues& q, double time) const {
  // Distances from the axle as shares of the belt's radius.
  constexpr double kNearest = 0.3, kFarthest = 2.0;
  const double R = parameters_.belt.radius;
  for (int k = 0; k < angles_.nodes(); ++k) {
    const double distance = (q.col(k).head<3>() - rim_.center).norm();
    if (distance >= kNearest * R && distance <= kFarthest * R) continue;
    return Failure{fmt::format(
        "the ring's belt is {:.0f} mm from the axle at {:.5f} s, at rest {:.0f} mm: the wheel "
        "moved too far in a step or stands in the road; sidewall.rim says where belt and rim meet",
        1e3 * distance,
        time,
        1e3 * R)};
  }
  return {};
}

Failure RingTire::no_solution(double time, const std::string& why) const {
  return {fmt::format(
      "the ring's step to {:.5f} s has no solution: {}; a shorter step may help", time, why)};
}

}  // namespace latsch::ring_tire
