// SPDX-License-Identifier: Apache-2.0
#include "models/ring_tire/ring/motion_slopes.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "models/ring_tire/belt/belt_curve.h"
#include "models/ring_tire/ring/ring_tire.h"
#include "models/ring_tire/ring/state_slopes.h"

namespace latsch::ring_tire {
namespace {

using Eigen::Vector3d;

WheelMotion turned(const WheelMotion& motion, const Vector3d& about, double by) {
  WheelMotion to = motion;
  to.carrier = Eigen::AngleAxisd(by, about) * motion.carrier;
  return to;
}

Vector3d rotation_between(const Eigen::Matrix3d& from, const Eigen::Matrix3d& to) {
  const Eigen::AngleAxisd turn(to * from.transpose());
  return turn.angle() * turn.axis();
}

/// Returns the motions of all nodes for unit rotations about the three axes: e_j × x in column j.
Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor> unit_turns(const NodeValues& x) {
  Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor> to;
  to.setZero(x.size(), 3);
  for (Eigen::Index k = 0; k < x.cols(); ++k)
    to.middleRows<3>(4 * k) << 0.0, x(2, k), -x(1, k), -x(2, k), 0.0, x(0, k), x(1, k), -x(0, k),
        0.0;
  return to;
}

}  // namespace

std::optional<HubSlopes> MotionSlopes::over(RingTire& tire,
                                            const RingState& from,
                                            const WheelMotion& to,
                                            const road::Road& road,
                                            double time,
                                            double step,
                                            const std::vector<StepTaken>& parts) {
  tire_ = &tire;
  from_ = begin_ = &from;
  to_ = &to;
  road_ = &road;
  time_ = time;
  step_ = step;
  slopes_.clear();
  for (const StepTaken& part : parts) {
    if (!begin_part(part)) return std::nullopt;
    find_tangent();
    find_rigid_fields();
    find_rim_motion();
    find_held_forces();
    if (!find_tread_slopes()) return std::nullopt;
    find_right_sides();
    solve();
    if (&part == &parts.back()) break;
    if (!follow_state(part)) return std::nullopt;
    begin_ = &part.end;
  }
  return hub_slopes();
}

/// Returns the motion at the end of the current part of a step, if the component `column` of the
/// step's motion is increased by `by`.
WheelMotion MotionSlopes::part_motion(int column, double by) const {
  const WheelMotion to = moved(*to_, column, by);
  return share_ == 1.0 ? to : between(from_->motion, to, share_);
}

/// Sets the tire to the end of a part of the step and computes the tangent there. Returns false if
/// the tangent is not positive definite.
bool MotionSlopes::begin_part(const StepTaken& part) {
  part_time_ = part.time;
  part_step_ = part.step;
  const double left = (time_ - part.time) / step_;
  share_ = left < 1e-9 ? 1.0 : 1.0 - left;
  motion_ = share_ == 1.0 ? *to_ : between(from_->motion, *to_, share_);
  q1_ = part.end.place;
  RingTire& t = *tire_;
  t.restore(*begin_);
  t.predict(motion_, *road_, part_time_, part_step_);
  if (t.section_.on()) {
    const auto& contact = t.section_.contact();
    gamma_.resize(t.section_.unknowns());
    for (std::size_t c = 0; c < contact.size(); ++c)
      gamma_.segment<SectionBending::kModes>(
          SectionBending::kModes * static_cast<Eigen::Index>(c)) = part.end.section.col(contact[c]);
    t.section_.set_values(gamma_);
  }
  t.q1_ = q1_;
  t.follow();
  v1_ = t.v1_;
  t.evaluate(q1_, v1_);
  inner_ = t.inner_;
  moment_on_rim_ = t.tread_.moment_on_rim();
  rim_ = t.rim_;
  rule_ = t.rule_;
  return t.factorize(q1_, rule_.acceleration, 1.0 - t.settings_.dissipation, rule_);
}

/// Moves the rim of the tire, which was reset to the start of a partial step, to the end of that
/// partial step under another motion. Nodes and sections keep their state. Returns false if other
/// nodes may touch the road.
bool MotionSlopes::place(const WheelMotion& motion) {
  tire_->predict(motion, *road_, part_time_, part_step_);
  if (tire_->section_.on()) {
    if (tire_->section_.unknowns() != gamma_.size()) return false;
    tire_->section_.set_values(gamma_);
  }
  tire_->q1_ = q1_;
  tire_->follow();
  return true;
}

/// Returns the forces of the tread blocks on nodes and sections, and their moment on the rim.
Eigen::VectorXd MotionSlopes::tread_forces() {
  RingTire& t = *tire_;
  if (t.section_.on()) t.tread_.bend(t.section_);
  NodeValues force = NodeValues::Zero(4, q1_.cols());
  t.tread_.add_force(t.q1_, t.v1_, force);
  const Eigen::Index sections = t.section_.on() ? t.section_.unknowns() : 0;
  Eigen::VectorXd all(force.size() + sections + 3);
  all.head(force.size()) = force.reshaped();
  if (sections > 0)
    all.segment(force.size(), sections) = t.tread_.section_forces(t.section_, t.q1_);
  all.tail<3>() = t.tread_.moment_on_rim();
  return all;
}

/// Returns the derivative of the tread's forces as a central difference with the step `by`. If
/// `slope` is given, the state at the beginning of the part changes along it, too.
std::optional<Eigen::VectorXd> MotionSlopes::tread_slope(const RingState* slope,
                                                         const WheelMotion& further,
                                                         const WheelMotion& back,
                                                         double by) {
  if (slope) tire_->restore(along(*begin_, *slope, by));
  if (!place(further)) return std::nullopt;
  const Eigen::VectorXd more = tread_forces();
  if (slope) tire_->restore(along(*begin_, *slope, -by));
  if (!place(back)) return std::nullopt;
  return (more - tread_forces()) / (2.0 * by);
}

/// Computes the cross products ω × x for the positions x of all nodes.
void MotionSlopes::turn_by(const Vector3d& omega, const Columns& x, Columns& to) const {
  to.resize(4 * q1_.cols(), kPadded);
  for (Eigen::Index k = 0; k < 4 * q1_.cols(); k += 4) {
    to.row(k) = omega.y() * x.row(k + 2) - omega.z() * x.row(k + 1);
    to.row(k + 1) = omega.z() * x.row(k) - omega.x() * x.row(k + 2);
    to.row(k + 2) = omega.x() * x.row(k + 1) - omega.y() * x.row(k);
    to.row(k + 3).setZero();
  }
}

/// Subtracts the forces of the dampers at the belt's knots and of the belt's own damping, for given
/// velocities of the nodes.
void MotionSlopes::damp(const Columns& rate, Columns& force) {
  const Eigen::Index N = q1_.cols();
  const auto mean = [N](const Columns& x, Eigen::Index k, auto&& to) {
    to = (4.0 / 6.0) * x.middleRows<4>(4 * k) +
         (1.0 / 6.0) * (x.middleRows<4>(4 * (k > 0 ? k - 1 : N - 1)) +
                        x.middleRows<4>(4 * (k + 1 < N ? k + 1 : 0)));
  };
  knots_.resize(4 * N, kPadded);
  force.resize(4 * N, kPadded);
  Eigen::Matrix<double, 4, kPadded, Eigen::RowMajor> at;
  for (Eigen::Index k = 0; k < N; ++k) {
    mean(rate, k, at);
    const Eigen::Matrix4d& D = dampers_[static_cast<std::size_t>(k)];
    for (int i = 0; i < 3; ++i)
      knots_.row(4 * k + i) = D(i, 0) * at.row(0) + D(i, 1) * at.row(1) + D(i, 2) * at.row(2);
    knots_.row(4 * k + 3) = D(3, 3) * at.row(3);
  }
  for (Eigen::Index k = 0; k < N; ++k) mean(knots_, k, force.middleRows<4>(4 * k));
  if (belt_damping_) force += belt_damping_->multiply_columns(rate);
}

/// Computes the tangent at the end of the part, with the tire's factorization there.
void MotionSlopes::find_tangent() {
  RingTire& t = *tire_;
  const double scale = 1.0 - t.settings_.dissipation;
  blocks_ = t.tread_.patch_slopes(t.section_, q1_, v1_);
  CyclicBand tread(t.angles_.nodes());
  t.tread_.add_stiffness(scale, tread);
  Eigen::MatrixXd B, A;
  if (t.section_.on()) t.tread_.section_border(t.section_, q1_, false, B, A);
  tangent_.find(t.factor_, t.section_, blocks_, tread, B, A, scale);
}

void MotionSlopes::find_rigid_fields() {
  RingTire& t = *tire_;
  const int N = t.angles_.nodes();
  const Eigen::Vector4d d = t.inner_forces_.sidewall().losses().damping;
  dampers_.assign(static_cast<std::size_t>(N), Eigen::Matrix4d::Zero());
  NodeValues arms = q1_;
  arms.topRows<3>().colwise() -= rim_.center;
  fields_.setZero(4 * N, kPadded);
  fields_.middleCols<3>(3) = unit_turns(arms);
  for (int k = 0; k < N; ++k) {
    const Vector3d r = t.angles_.radial(rim_, k), along = t.angles_.tangential(rim_, k);
    Eigen::Matrix4d& D = dampers_[static_cast<std::size_t>(k)];
    D.topLeftCorner<3, 3>() = d[0] * r * r.transpose() + d[1] * along * along.transpose() +
                              d[2] * rim_.a * rim_.a.transpose();
    D(3, 3) = d[3];
    fields_.block<3, 3>(4 * k, 0).setIdentity();
  }
  CyclicBand stiffness(N);
  t.inner_forces_.find_stiffness(q1_, rim_, rule_, 1.0).turn_back(rim_, stiffness);
  stiff_ = stiff_transposed_ = stiffness.multiply_columns(SideBySide(fields_));
  belt_damping_.reset();
  belt_turning_.reset();
  if (!t.inner_forces_.belt().damped()) return;
  belt_damping_.emplace(N);
  t.inner_forces_.find_belt_damping(q1_, rim_).turn_back(rim_, *belt_damping_);
  belt_turning_ = t.inner_forces_.belt_damping_by_places(q1_, v1_, rim_);
  stiff_ += belt_turning_->multiply(fields_);
  stiff_transposed_ += belt_turning_->multiply_transposed(fields_);
}

void MotionSlopes::find_rim_motion() {
  for (Vectors* of : {&center_, &turn_, &velocity_, &rate_, &carrier_}) of->setZero();
  for (int column = 0; column < kMotionColumns; ++column) {
    const double by = difference_step(column, step_), over = 0.5 / by;
    const WheelMotion more = part_motion(column, by), less = part_motion(column, -by);
    center_.col(column) = over * (more.center - less.center);
    velocity_.col(column) = over * (more.velocity - less.velocity);
    carrier_.col(column) = over * rotation_between(less.carrier, more.carrier);
    turn_.col(column) = carrier_.col(column) + over * (more.spin - less.spin) * rim_.a;
    rate_.col(column) = over * (more.angular_velocity - less.angular_velocity) +
                        over * (more.spin_rate - less.spin_rate) * rim_.a +
                        motion_.spin_rate * Vector3d(carrier_.col(column)).cross(rim_.a);
  }
}

/// Computes the derivatives with the nodes kept in place. The forces of belt and sidewall rotate
/// with the rim. Relative to the rim, the fixed nodes move by -c - φ × x, with velocities -v_c - ω
/// × x + Ω × c - φ × (their velocities relative to the rim). The stiffness contains the derivatives
/// by these velocities, multiplied by the factor of the time integration.
void MotionSlopes::find_held_forces() {
  const Eigen::Index N = q1_.cols();
  NodeValues against = v1_;
  for (Eigen::Index k = 0; k < N; ++k)
    against.col(k).head<3>() -= rim_.velocity_at(q1_.col(k).head<3>());
  Vectors even = rule_.velocity * center_ - velocity_;
  for (int column = 0; column < kMotionColumns; ++column)
    even.col(column) += rim_.angular_velocity.cross(Vector3d(center_.col(column)));
  rates_ = fields_.leftCols<3>().lazyProduct(even);
  rates_ += fields_.middleCols<3>(3).lazyProduct((rule_.velocity * turn_ - rate_).eval());
  rates_ -= unit_turns(against).lazyProduct(turn_);
  held_ = unit_turns(inner_).lazyProduct(turn_);
  held_ += stiff_.leftCols<3>().lazyProduct(center_);
  held_ += stiff_.middleCols<3>(3).lazyProduct(turn_);
  if (!slopes_.empty()) {
    velocities_.setZero(4 * N, kPadded);
    accelerations_.setZero(4 * N, kPadded);
    for (int column = 0; column < kMotionColumns; ++column) add_state(column);
    rates_ += velocities_;
  }
  damp(rates_, more_);
  held_ -= more_;
}

/// Adds the effect of a changed state at the beginning of the part on velocities, accelerations and
/// the memory of the sidewall.
void MotionSlopes::add_state(int column) {
  const RingState& slope = slopes_[static_cast<std::size_t>(column)];
  const double h = part_step_, by = difference_step(column, step_);
  const NodeValues predicted = slope.place + h * slope.rate + 0.5 * h * h * slope.acceleration;
  velocities_.col(column) =
      (slope.rate + h * slope.acceleration - rule_.velocity * predicted).reshaped();
  accelerations_.col(column) = (slope.acceleration - rule_.acceleration * predicted).reshaped();
  SidewallForces& sidewall = tire_->inner_forces_.sidewall();
  NodeValues forces[2] = {inner_, inner_};
  for (const int i : {0, 1}) {
    sidewall.remember(along(*begin_, slope, i == 0 ? by : -by).sidewall);
    tire_->inner_forces_.find_force(q1_, v1_, rim_, rule_, forces[i]);
  }
  sidewall.remember(begin_->sidewall);
  held_.col(column) += ((forces[0] - forces[1]) / (2.0 * by)).reshaped();
}

/// Computes the derivatives of the tread blocks' forces for the columns that affect them: first
/// those of the spin axis and, if sections bend, of the spin rate; in later parts also those of the
/// state at the beginning.
bool MotionSlopes::find_tread_slopes() {
  tread_.setZero(q1_.size() + gamma_.size() + 3, kPadded);
  const auto find = [&](int column) {
    const double by = difference_step(column, step_);
    const auto of =
        tread_slope(slopes_.empty() ? nullptr : &slopes_[static_cast<std::size_t>(column)],
                    part_motion(column, by),
                    part_motion(column, -by),
                    by);
    if (of) tread_.col(column) = *of;
    return of.has_value();
  };
  if (!slopes_.empty()) {
    for (int column = 0; column < kMotionColumns; ++column)
      if (!find(column)) return false;
    return true;
  }
  if (gamma_.size() > 0 && !find(kBySpinRate)) return false;
  for (const Vector3d& about : {rim_.X, rim_.Z}) {
    const double by = difference_step(kByRotation, step_);
    const auto of =
        tread_slope(nullptr, turned(motion_, about, by), turned(motion_, about, -by), by);
    if (!of) return false;
    tread_ += *of * (about.transpose() * carrier_);
  }
  return true;
}

/// Computes the right-hand sides dr/dm of (29).
void MotionSlopes::find_right_sides() {
  const double theta = tire_->settings_.dissipation, scale = 1.0 - theta;
  x_ = scale * tread_.topRows(q1_.size() + gamma_.size());
  x_.topRows(q1_.size()) += scale * held_;
  NodeValues inertia;
  for (std::size_t i = 0; i < slopes_.size(); ++i) {
    const Eigen::Index column = static_cast<Eigen::Index>(i);
    tire_->times_mass(accelerations_.col(column).reshaped(4, q1_.cols()), inertia);
    x_.col(column).head(q1_.size()) += (theta * slopes_[i].force - inertia).reshaped();
  }
}

/// Solves (29). The rotation of dampers and (31) are not contained in the tangent and are included
/// by iteration. They are 1e-4 of the tangent in steps of 0.2 ms at 60 m/s, for a belt without
/// damping.
void MotionSlopes::solve() {
  constexpr double kEnough = 1e-7;  // relative error at which the iteration ends
  constexpr int kMost = 20;
  const double scale = 1.0 - tire_->settings_.dissipation;
  const auto size = [](const Columns& x) { return x.cwiseAbs().colwise().maxCoeff().eval(); };
  tangent_.solve(tire_->factor_, tire_->section_, x_);
  next_ = x_;
  auto before = size(next_);
  for (int i = 0; i < kMost; ++i) {
    turn_by(rim_.angular_velocity, next_, turned_);
    damp(turned_, more_);
    if (belt_turning_) more_ -= belt_turning_->multiply(next_.topRows(q1_.size()));
    next_.topRows(q1_.size()) = scale * more_;
    next_.bottomRows(gamma_.size()).setZero();
    tangent_.solve(tire_->factor_, tire_->section_, next_);
    x_ += next_;
    // The corrections still to come are estimated as a geometric series.
    const auto now = size(next_);
    const double ratio = (now.array() / before.array().max(1e-300)).maxCoeff();
    if ((ratio * now.array() <= kEnough * size(x_).array()).all()) break;
    before = now;
  }
}

/// Computes the derivatives dF/dm of the hub force (18) in the axes of the carrier, whose rotation
/// is included.
HubSlopes MotionSlopes::hub_slopes() {
  const int N = tire_->angles_.nodes();
  Vector3d sum = Vector3d::Zero(), moment = moment_on_rim_;
  for (int k = 0; k < N; ++k) {
    const Vector3d f = inner_.col(k).head<3>();
    sum += f;
    moment -= (q1_.col(k).head<3>() - rim_.center).cross(f);
  }
  // Terms by the motion dq1/dm of the nodes: through stiffness and dampers, and through the arms of
  // the forces.
  damp(fields_, more_);
  turn_by(rim_.angular_velocity, more_, turned_);
  turned_ += stiff_transposed_;
  turned_.middleCols<3>(3) += unit_turns(inner_);
  HubSlopes hub;
  for (const int field : {0, 3}) {
    const Vectors of = turned_.middleCols<3>(field).transpose() * x_.topRows(q1_.size()) -
                       fields_.middleCols<3>(field).transpose() * held_;
    hub.middleRows<3>(field) = of.leftCols<kMotionColumns>();
  }
  Vectors on_rim = tread_.bottomRows<3>();
  for (const PatchSlopes& patch : blocks_) {
    const int all = gamma_.size() > 0 ? PatchSlopes::kAll : PatchSlopes::kNodes;
    for (int entry = 0; entry < all; ++entry)
      on_rim +=
          patch.moment_on_rim.col(entry) * x_.row(patch_row(patch, entry, tire_->section_, N));
  }
  hub.bottomRows<3>() += on_rim.leftCols<kMotionColumns>();
  const Eigen::Matrix3d to_carrier = motion_.carrier.transpose();
  for (int column = 0; column < kMotionColumns; ++column) {
    const Vector3d turn = carrier_.col(column);
    hub.col(column).tail<3>() += Vector3d(center_.col(column)).cross(sum);
    hub.col(column) << to_carrier * (hub.col(column).head<3>() + turn.cross(sum)),
        to_carrier * (hub.col(column).tail<3>() - turn.cross(moment));
  }
  return hub;
}

/// Computes the derivatives of the state at the end of the part: those of the nodes by (16) and
/// (17), those of the memories by differences.
bool MotionSlopes::follow_state(const StepTaken& part) {
  const double theta = tire_->settings_.dissipation;
  std::vector<RingState> after;
  for (int column = 0; column < kMotionColumns; ++column) {
    const std::size_t at = static_cast<std::size_t>(column);
    RingState to;
    to.place = x_.col(column).head(q1_.size()).reshaped(4, q1_.cols());
    to.rate = rule_.velocity * to.place;
    to.acceleration = rule_.acceleration * to.place;
    if (!slopes_.empty()) {
      to.rate += velocities_.col(column).reshaped(4, q1_.cols());
      to.acceleration += accelerations_.col(column).reshaped(4, q1_.cols());
    }
    tire_->times_mass(to.acceleration, to.force);
    if (!slopes_.empty()) to.force -= theta * slopes_[at].force;
    to.force /= 1.0 - theta;
    const double by = difference_step(column, step_);
    const auto end = [&](double way) -> std::optional<RingState> {
      tire_->restore(slopes_.empty() ? *begin_ : along(*begin_, slopes_[at], way));
      if (!place(part_motion(column, way))) return std::nullopt;
      tire_->q1_ += way * to.place;
      tire_->follow();
      if (tire_->section_.on())
        tire_->section_.set_values(gamma_ + way * x_.col(column).tail(gamma_.size()));
      tread_forces();
      tire_->accept();
      return tire_->state();
    };
    const auto more = end(by), less = end(-by);
    if (!more || !less || !find_memory_slope(*more, *less, 2.0 * by, to)) return false;
    if (to.tread.tips()->segments != part.end.tread.tips()->segments) return false;
    after.push_back(std::move(to));
  }
  slopes_ = std::move(after);
  return true;
}

}  // namespace latsch::ring_tire
