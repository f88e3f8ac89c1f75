// SPDX-License-Identifier: Apache-2.0
#include "models/ring_tire/ring/motion_slopes.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "models/ring_tire/belt/belt_curve.h"
#include "models/ring_tire/ring/exact_tangent.h"

namespace latsch::ring_tire {
namespace {

using Eigen::Vector3d;

constexpr int kPadded = (kMotionColumns + 7) / 8 * 8;
// The ends of a difference are as far away as moves nodes by that.
constexpr double kNear = 1e-7;  // m

/// In units of the column, in a step of that length.
double nudge(int column, double step) {
  constexpr double kRadius = 0.3;  // m
  const bool turns = (column >= kByRotation && column < kByVelocity) || column >= kByAngularVelocity;
  const bool rate = (column >= kByVelocity && column < kBySpin) || column == kBySpinRate;
  return kNear / (turns ? kRadius : 1.0) / (rate ? step : 1.0);
}

WheelMotion turned(const WheelMotion& motion, const Vector3d& about, double by) {
  WheelMotion to = motion;
  to.carrier = Eigen::AngleAxisd(by, about) * motion.carrier;
  return to;
}

Vector3d rotation_between(const Eigen::Matrix3d& from, const Eigen::Matrix3d& to) {
  const Eigen::AngleAxisd turn(to * from.transpose());
  return turn.angle() * turn.axis();
}

/// A state further along its slopes; those of memory alone: q, v, a and f are added by `also`.
RingState along(const RingState& state, const RingState& slope, double by) {
  RingState to = state;
  to.place += by * slope.place;
  to.rate += by * slope.rate;
  to.acceleration += by * slope.acceleration;
  to.force += by * slope.force;
  to.sidewall.travel += by * slope.sidewall.travel;
  to.sidewall.maxwell += by * slope.sidewall.maxwell;
  to.sidewall.slip += by * slope.sidewall.slip;
  to.section += by * slope.section;
  if (!state.tread.tips()) return to;
  auto tips = std::make_shared<TreadTips>(*state.tread.tips());
  for (std::size_t i = 0; i < tips->columns.size(); ++i)
    tips->columns[i] += by * slope.tread.tips()->columns[i];
  to.tread = TreadMemory(std::move(tips));
  return to;
}

/// What is remembered, not the nodes: false where patches differ.
bool memory_slope(const RingState& more, const RingState& less, double over, RingState& to) {
  to.sidewall.travel = (more.sidewall.travel - less.sidewall.travel) / over;
  to.sidewall.maxwell = (more.sidewall.maxwell - less.sidewall.maxwell) / over;
  to.sidewall.slip = (more.sidewall.slip - less.sidewall.slip) / over;
  to.section = (more.section - less.section) / over;
  const TreadTips &a = *more.tread.tips(), &b = *less.tread.tips();
  if (a.segments != b.segments) return false;
  auto tips = std::make_shared<TreadTips>(a);
  for (std::size_t i = 0; i < a.columns.size(); ++i)
    tips->columns[i] = (a.columns[i] - b.columns[i]) / over;
  to.tread = TreadMemory(std::move(tips));
  return true;
}

/// ω × x of all nodes.
NodeValues turned_by(const Vector3d& omega, const NodeValues& x) {
  NodeValues to = NodeValues::Zero(4, x.cols());
  for (Eigen::Index k = 0; k < x.cols(); ++k) to.col(k).head<3>() = omega.cross(x.col(k).head<3>());
  return to;
}

double product(const NodeValues& a, const NodeValues& b) { return a.cwiseProduct(b).sum(); }

}  // namespace

std::optional<HubSlopes> MotionSlopes::over(const std::vector<Step>& parts) {
  begin_ = &from_;
  for (const Step& part : parts) {
    if (!begin_part(part)) return std::nullopt;
    const std::vector<PatchSlopes> blocks = tire_.tread_.patch_slopes(tire_.section_, q1_, v1_);
    const double scale = 1.0 - tire_.settings_.dissipation;
    CyclicBand tread(tire_.angles_.nodes());
    tire_.tread_.add_stiffness(scale, tread);
    Eigen::MatrixXd B, A;
    if (tire_.section_.on()) tire_.tread_.section_border(tire_.section_, q1_, false, B, A);
    const ExactTangent tangent(tire_.factor_, tire_.section_, blocks, tread, B, A, scale);
    find_rigid_fields();
    directions_.clear();
    for (int column = 0; column < kMotionColumns; ++column) find_direction(column);
    if (!find_right_sides()) return std::nullopt;
    solve(tangent);
    if (&part == &parts.back()) break;
    if (!follow_state(part)) return std::nullopt;
    begin_ = &part.end;
  }
  return hub_slopes();
}

/// The motion at the end of the part, where that of the step is `by` more of a column.
WheelMotion MotionSlopes::part_motion(int column, double by) const {
  const WheelMotion to = moved(to_, column, by);
  return share_ == 1.0 ? to : between(from_.motion, to, share_);
}

/// The tire at the end of the part, with the tangent there. False: it is not definite.
bool MotionSlopes::begin_part(const Step& part) {
  part_time_ = part.time;
  part_step_ = part.step;
  const double left = (time_ - part.time) / step_;
  share_ = left < 1e-9 ? 1.0 : 1.0 - left;
  motion_ = share_ == 1.0 ? to_ : between(from_.motion, to_, share_);
  q1_ = part.end.place;
  RingTire& t = tire_;
  t.restore(*begin_);
  t.predict(motion_, road_, part_time_, part_step_);
  if (t.section_.on()) {
    const auto& contact = t.section_.contact();
    gamma_.resize(t.section_.unknowns());
    for (std::size_t c = 0; c < contact.size(); ++c)
      gamma_.segment<SectionBending::kModes>(SectionBending::kModes *
                                             static_cast<Eigen::Index>(c)) =
          part.end.section.col(contact[c]);
    t.section_.set_values(gamma_);
  }
  t.q1_ = q1_;
  t.follow();
  v1_ = t.v1_;
  t.evaluate(q1_, v1_);
  inner_ = t.inner_;
  rim_ = t.rim_;
  rule_ = t.rule_;
  return t.factorize(q1_, rule_.acceleration, 1.0 - t.settings_.dissipation, rule_);
}

/// The tire at the end of a part that begins and moves otherwise, with nodes and sections as they
/// are. False where others may touch.
bool MotionSlopes::place(const RingState& begin, const WheelMotion& motion) {
  tire_.restore(begin);
  tire_.predict(motion, road_, part_time_, part_step_);
  if (tire_.section_.on()) {
    if (tire_.section_.unknowns() != gamma_.size()) return false;
    tire_.section_.set_values(gamma_);
  }
  tire_.q1_ = q1_;
  tire_.follow();
  return true;
}

/// Of the blocks on nodes and sections.
Eigen::VectorXd MotionSlopes::tread_forces() {
  RingTire& t = tire_;
  if (t.section_.on()) t.tread_.bend(t.section_);
  NodeValues force = NodeValues::Zero(4, q1_.cols());
  t.tread_.add_force(t.q1_, t.v1_, force);
  Eigen::VectorXd all(4 * q1_.cols() + (t.section_.on() ? t.section_.unknowns() : 0));
  all.head(force.size()) = force.reshaped();
  if (t.section_.on())
    all.tail(t.section_.unknowns()) = t.tread_.section_forces(t.section_, t.q1_);
  return all;
}

std::optional<Eigen::VectorXd> MotionSlopes::tread_slope(const RingState& more,
                                                         const RingState& less,
                                                         const WheelMotion& further,
                                                         const WheelMotion& back,
                                                         double over) {
  if (!place(more, further)) return std::nullopt;
  const Eigen::VectorXd at_more = tread_forces();
  if (!place(less, back)) return std::nullopt;
  return (at_more - tread_forces()) / over;
}

NodeValues MotionSlopes::damping(const NodeValues& rate) const {
  NodeValues at = at_knots(rate);
  for (Eigen::Index k = 0; k < at.cols(); ++k)
    at.col(k) = (dampers_[static_cast<std::size_t>(k)] * at.col(k)).eval();
  return at_knots(at);
}

/// Forces of dampers by places, as the rim's turning has it.
NodeValues MotionSlopes::dampers_turn(const NodeValues& place) const {
  return damping(turned_by(rim_.angular_velocity, place));
}

void MotionSlopes::find_rigid_fields() {
  RingTire& t = tire_;
  const int N = t.angles_.nodes();
  const Eigen::Vector4d d = t.inner_forces_.sidewall().losses().damping;
  dampers_.assign(static_cast<std::size_t>(N), Eigen::Matrix4d::Zero());
  for (int k = 0; k < N; ++k) {
    Eigen::Matrix4d& D = dampers_[static_cast<std::size_t>(k)];
    const Vector3d r = t.angles_.radial(rim_, k), along = t.angles_.tangential(rim_, k);
    D.topLeftCorner<3, 3>() = d[0] * r * r.transpose() + d[1] * along * along.transpose() +
                              d[2] * rim_.a * rim_.a.transpose();
    D(3, 3) = d[3];
  }
  CyclicBand stiffness(N);
  t.inner_forces_.find_stiffness(q1_, rim_, rule_, 1.0).turn_back(rim_, stiffness);
  const double tilted = node_radius_over_knot_radius(N);
  for (int i = 0; i < 9; ++i) {
    const Vector3d e = Vector3d::Unit(i % 3);
    fields_[i] = NodeValues::Zero(4, N);
    for (int k = 0; k < N; ++k) {
      fields_[i].col(k).head<3>() =
          i < 3 ? e : Vector3d(e.cross(q1_.col(k).head<3>() - rim_.center));
      if (i >= 6) fields_[i](3, k) = tilted * t.angles_.tangential(rim_, k)[i % 3];
    }
    stiff_[i] = stiffness.multiply(fields_[i]);
    damped_[i] = damping(fields_[i]);
  }
}

void MotionSlopes::find_direction(int column) {
  Direction d;
  const double by = nudge(column, step_);
  const WheelMotion more = part_motion(column, by), less = part_motion(column, -by);
  d.center = (more.center - less.center) / (2.0 * by);
  d.velocity = (more.velocity - less.velocity) / (2.0 * by);
  d.carrier = rotation_between(less.carrier, more.carrier) / (2.0 * by);
  d.turn = d.carrier + (more.spin - less.spin) / (2.0 * by) * rim_.a;
  d.rate = (more.angular_velocity - less.angular_velocity) / (2.0 * by) +
           (more.spin_rate - less.spin_rate) / (2.0 * by) * rim_.a +
           motion_.spin_rate * d.carrier.cross(rim_.a);
  const Eigen::Index N = q1_.cols();
  d.rigid = d.damped = NodeValues::Zero(4, N);
  for (Eigen::Index k = 0; k < N; ++k) {
    const Vector3d arm = q1_.col(k).head<3>() - rim_.center;
    const Vector3d against = v1_.col(k).head<3>() - rim_.velocity_at(q1_.col(k).head<3>());
    const Vector3d rigid = -d.center - d.turn.cross(arm);
    d.rigid.col(k).head<3>() = rigid;
    d.damped.col(k).head<3>() = -d.velocity - d.rate.cross(arm) +
                                rim_.angular_velocity.cross(d.center) - d.turn.cross(against) -
                                rule_.velocity * rigid;
  }
  d.velocities = d.accelerations = d.memory = NodeValues::Zero(4, N);
  if (!slopes_.empty()) {
    const RingState& slope = slopes_[static_cast<std::size_t>(column)];
    const double h = part_step_;
    const NodeValues predicted = slope.place + h * slope.rate + 0.5 * h * h * slope.acceleration;
    d.velocities = slope.rate + h * slope.acceleration - rule_.velocity * predicted;
    d.accelerations = slope.acceleration - rule_.acceleration * predicted;
    d.damped += d.velocities;
    SidewallForces& sidewall = tire_.inner_forces_.sidewall();
    NodeValues at_more, at_less;
    at_more = at_less = NodeValues::Zero(4, N);
    sidewall.remember(along(*begin_, slope, by).sidewall);
    tire_.inner_forces_.find_force(q1_, v1_, rim_, rule_, at_more);
    sidewall.remember(along(*begin_, slope, -by).sidewall);
    tire_.inner_forces_.find_force(q1_, v1_, rim_, rule_, at_less);
    sidewall.remember(begin_->sidewall);
    d.memory = (at_more - at_less) / (2.0 * by);
  }
  directions_.push_back(std::move(d));
}

/// dr/dm. The blocks, where they feel it.
bool MotionSlopes::find_right_sides() {
  const Eigen::Index belt = q1_.size(), all = belt + gamma_.size();
  const double theta = tire_.settings_.dissipation, scale = 1.0 - theta;
  Eigen::MatrixXd tread = Eigen::MatrixXd::Zero(all, kMotionColumns);
  const auto find = [&](int column) {
    const double by = nudge(column, step_);
    const bool held = slopes_.empty();
    const RingState* slope = held ? nullptr : &slopes_[static_cast<std::size_t>(column)];
    const auto of = tread_slope(held ? *begin_ : along(*begin_, *slope, by),
                                held ? *begin_ : along(*begin_, *slope, -by),
                                part_motion(column, by),
                                part_motion(column, -by),
                                2.0 * by);
    if (of) tread.col(column) = *of;
    return of.has_value();
  };
  if (!slopes_.empty()) {
    for (int column = 0; column < kMotionColumns; ++column)
      if (!find(column)) return false;
  } else {
    // The spin axis alone counts, and where sections flow the spin rate.
    if (gamma_.size() > 0 && !find(kBySpinRate)) return false;
    for (const Vector3d& about : {rim_.X, rim_.Z}) {
      const double by = nudge(kByRotation, step_);
      const auto of = tread_slope(
          *begin_, *begin_, turned(motion_, about, by), turned(motion_, about, -by), 2.0 * by);
      if (!of) return false;
      for (int column = 0; column < kMotionColumns; ++column)
        tread.col(column) += directions_[static_cast<std::size_t>(column)].carrier.dot(about) * *of;
    }
  }
  x_.setZero(all, kPadded);
  NodeValues inertia;
  for (int column = 0; column < kMotionColumns; ++column) {
    const Direction& d = directions_[static_cast<std::size_t>(column)];
    NodeValues force = turned_by(d.turn, inner_) - damping(d.damped) + d.memory;
    for (int i = 0; i < 3; ++i)
      force += d.center[i] * stiff_[i] + d.turn[i] * stiff_[3 + i];
    NodeValues r = scale * force;
    if (!slopes_.empty()) {
      tire_.times_mass(d.accelerations, inertia);
      r += theta * slopes_[static_cast<std::size_t>(column)].force - inertia;
    }
    x_.col(column).head(belt) = r.reshaped();
    x_.col(column) += scale * tread.col(column);
  }
  return true;
}

/// (29), the dampers' turning by iteration: a thousandth of the tangent in common steps.
void MotionSlopes::solve(const ExactTangent& tangent) {
  constexpr double kEnough = 1e-7;
  constexpr int kMost = 20;
  tangent.solve(x_);
  const double scale = 1.0 - tire_.settings_.dissipation;
  Columns step = x_;
  for (int i = 0; i < kMost; ++i) {
    Columns next = Columns::Zero(x_.rows(), x_.cols());
    for (int column = 0; column < kMotionColumns; ++column)
      next.col(column).head(q1_.size()) =
          scale *
          dampers_turn(step.col(column).head(q1_.size()).reshaped(4, q1_.cols())).reshaped();
    tangent.solve(next);
    x_ += next;
    step = next;
    const auto size = [](const Columns& x) { return x.cwiseAbs().colwise().maxCoeff().eval(); };
    if ((size(step).array() <= kEnough * size(x_).array()).all()) break;
  }
}

NodeValues MotionSlopes::slope_of_place(int column) const {
  return x_.col(column).head(q1_.size()).reshaped(4, q1_.cols());
}

/// dF/dm of (18), turned into the carrier's axes, which turn too.
HubSlopes MotionSlopes::hub_slopes() const {
  HubSlopes hub;
  const double tilted = node_radius_over_knot_radius(tire_.angles_.nodes());
  Vector3d force = Vector3d::Zero(), moment = Vector3d::Zero();
  for (Eigen::Index k = 0; k < q1_.cols(); ++k) {
    force -= inner_.col(k).head<3>();
    moment -= (q1_.col(k).head<3>() - rim_.center).cross(inner_.col(k).head<3>()) +
              tilted * inner_(3, k) * tire_.angles_.tangential(rim_, static_cast<int>(k));
  }
  for (int column = 0; column < kMotionColumns; ++column) {
    const Direction& d = directions_[static_cast<std::size_t>(column)];
    const NodeValues dq = slope_of_place(column);
    const NodeValues held = turned_by(d.turn, inner_) + d.memory;
    const NodeValues rate = d.damped - turned_by(rim_.angular_velocity, dq);
    const NodeValues place = d.rigid + dq;
    const auto sum = [&](int field) {
      return product(fields_[field], held) - product(stiff_[field], place) -
             product(damped_[field], rate);
    };
    Vector3d dF, dM;
    for (int i = 0; i < 3; ++i) {
      dF[i] = -sum(i);
      dM[i] = -sum(6 + i);
    }
    for (Eigen::Index k = 0; k < q1_.cols(); ++k)
      dM -= (dq.col(k).head<3>() - d.center).cross(inner_.col(k).head<3>()) +
            tilted * inner_(3, k) *
                d.turn.cross(tire_.angles_.tangential(rim_, static_cast<int>(k)));
    hub.col(column) << motion_.carrier.transpose() * (dF - d.carrier.cross(force)),
        motion_.carrier.transpose() * (dM - d.carrier.cross(moment));
  }
  return hub;
}

/// Slopes of the state that the part leaves: nodes by (16), (17), memory by differences.
bool MotionSlopes::follow_state(const Step& part) {
  const double theta = tire_.settings_.dissipation;
  std::vector<RingState> after;
  for (int column = 0; column < kMotionColumns; ++column) {
    const Direction& d = directions_[static_cast<std::size_t>(column)];
    const std::size_t at = static_cast<std::size_t>(column);
    RingState to;
    to.place = slope_of_place(column);
    to.rate = d.velocities + rule_.velocity * to.place;
    to.acceleration = d.accelerations + rule_.acceleration * to.place;
    tire_.times_mass(to.acceleration, to.force);
    if (!slopes_.empty()) to.force -= theta * slopes_[at].force;
    to.force /= 1.0 - theta;
    const double by = nudge(column, step_);
    const auto end = [&](double way) -> std::optional<RingState> {
      if (!place(slopes_.empty() ? *begin_ : along(*begin_, slopes_[at], way),
                 part_motion(column, way)))
        return std::nullopt;
      tire_.q1_ += way * to.place;
      tire_.follow();
      if (tire_.section_.on())
        tire_.section_.set_values(gamma_ + way * x_.col(column).tail(gamma_.size()));
      tread_forces();
      tire_.accept();
      return tire_.state();
    };
    const auto more = end(by), less = end(-by);
    if (!more || !less || !memory_slope(*more, *less, 2.0 * by, to)) return false;
    if (to.tread.tips()->segments != part.end.tread.tips()->segments) return false;
    after.push_back(std::move(to));
  }
  slopes_ = std::move(after);
  return true;
}

}  // namespace latsch::ring_tire
