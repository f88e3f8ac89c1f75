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
template <class Values>
Values turned_by(const Vector3d& omega, const Values& x) {
  Values to = Values::Zero(x.rows(), x.cols());
  for (Eigen::Index k = 0; k + 3 < x.rows(); k += 4) {
    to.row(k) = omega.y() * x.row(k + 2) - omega.z() * x.row(k + 1);
    to.row(k + 1) = omega.z() * x.row(k) - omega.x() * x.row(k + 2);
    to.row(k + 2) = omega.x() * x.row(k + 1) - omega.y() * x.row(k);
  }
  return to;
}

/// Unit rotations: e_j × x of all nodes in three columns.
CyclicBandFactor::Columns unit_turns(const NodeValues& x) {
  CyclicBandFactor::Columns to = CyclicBandFactor::Columns::Zero(x.size(), 3);
  for (Eigen::Index k = 0; k < x.cols(); ++k)
    to.middleRows<3>(4 * k) << 0.0, x(2, k), -x(1, k), -x(2, k), 0.0, x(0, k), x(1, k), -x(0, k),
        0.0;
  return to;
}

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
    find_rim_motion();
    find_held_forces();
    if (!find_tread_slopes()) return std::nullopt;
    find_right_sides();
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

/// What dampers at the knots hold against velocities of the nodes.
MotionSlopes::Columns MotionSlopes::damping(const Columns& rate) const {
  const Eigen::Index N = q1_.cols();
  Columns at(4 * N, rate.cols()), force(4 * N, rate.cols());
  const auto mean = [N](const Columns& x, Eigen::Index k) {
    return (1.0 / 6.0) * (x.middleRows<4>(4 * ((k + N - 1) % N)) +
                          4.0 * x.middleRows<4>(4 * k) + x.middleRows<4>(4 * ((k + 1) % N)));
  };
  for (Eigen::Index k = 0; k < N; ++k)
    at.middleRows<4>(4 * k) =
        dampers_[static_cast<std::size_t>(k)].lazyProduct(mean(rate, k).eval());
  for (Eigen::Index k = 0; k < N; ++k) force.middleRows<4>(4 * k) = mean(at, k);
  return force;
}

void MotionSlopes::find_rigid_fields() {
  RingTire& t = tire_;
  const int N = t.angles_.nodes();
  const Eigen::Vector4d d = t.inner_forces_.sidewall().losses().damping;
  dampers_.assign(static_cast<std::size_t>(N), Eigen::Matrix4d::Zero());
  const double tilted = node_radius_over_knot_radius(N);
  NodeValues arms = q1_;
  arms.topRows<3>().colwise() -= rim_.center;
  fields_.setZero(4 * N, 9);
  fields_.middleCols<3>(3) = fields_.rightCols<3>() = unit_turns(arms);
  for (int k = 0; k < N; ++k) {
    const Vector3d r = t.angles_.radial(rim_, k), along = t.angles_.tangential(rim_, k);
    Eigen::Matrix4d& D = dampers_[static_cast<std::size_t>(k)];
    D.topLeftCorner<3, 3>() = d[0] * r * r.transpose() + d[1] * along * along.transpose() +
                              d[2] * rim_.a * rim_.a.transpose();
    D(3, 3) = d[3];
    fields_.block<3, 3>(4 * k, 0).setIdentity();
    fields_.block<1, 3>(4 * k + 3, 6) = tilted * along.transpose();
  }
  CyclicBand stiffness(N);
  t.inner_forces_.find_stiffness(q1_, rim_, rule_, 1.0).turn_back(rim_, stiffness);
  stiff_.resize(4 * N, 9);
  for (int i = 0; i < 9; ++i)
    stiff_.col(i) = stiffness.multiply(fields_.col(i).reshaped(4, N)).reshaped();
}

void MotionSlopes::find_rim_motion() {
  for (int column = 0; column < kMotionColumns; ++column) {
    const double by = nudge(column, step_), over = 0.5 / by;
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

/// Forces of belt and sidewall turn with the rim; nodes that stay move against it by -c - φ × x,
/// with velocities -v_c - ω × x + Ω × c - φ × (their own against the rim), of which the stiffness
/// has the rule's share of their places.
void MotionSlopes::find_held_forces() {
  const Eigen::Index N = q1_.cols();
  NodeValues against = v1_;
  for (Eigen::Index k = 0; k < N; ++k)
    against.col(k).head<3>() -= rim_.velocity_at(q1_.col(k).head<3>());
  Eigen::Matrix<double, 3, kMotionColumns> even = rule_.velocity * center_ - velocity_;
  for (int column = 0; column < kMotionColumns; ++column)
    even.col(column) += rim_.angular_velocity.cross(Vector3d(center_.col(column)));
  Columns rates(4 * N, kMotionColumns);
  rates.noalias() = fields_.leftCols<3>() * even;
  rates.noalias() += fields_.middleCols<3>(3) * (rule_.velocity * turn_ - rate_);
  rates.noalias() -= unit_turns(against) * turn_;
  held_.resize(4 * N, kMotionColumns);
  held_.noalias() = unit_turns(inner_) * turn_;
  held_.noalias() += stiff_.leftCols<3>() * center_;
  held_.noalias() += stiff_.middleCols<3>(3) * turn_;
  if (!slopes_.empty()) {
    velocities_.resize(4 * N, kMotionColumns);
    accelerations_.resize(4 * N, kMotionColumns);
    for (int column = 0; column < kMotionColumns; ++column) add_state(column);
    rates += velocities_;
  }
  held_ -= damping(rates);
}

/// What the state at the beginning does to velocities, accelerations and the sidewall's memory.
void MotionSlopes::add_state(int column) {
  const RingState& slope = slopes_[static_cast<std::size_t>(column)];
  const double h = part_step_, by = nudge(column, step_);
  const NodeValues predicted = slope.place + h * slope.rate + 0.5 * h * h * slope.acceleration;
  velocities_.col(column) =
      (slope.rate + h * slope.acceleration - rule_.velocity * predicted).reshaped();
  accelerations_.col(column) =
      (slope.acceleration - rule_.acceleration * predicted).reshaped();
  SidewallForces& sidewall = tire_.inner_forces_.sidewall();
  NodeValues forces[2] = {inner_, inner_};
  for (const int i : {0, 1}) {
    sidewall.remember(along(*begin_, slope, i == 0 ? by : -by).sidewall);
    tire_.inner_forces_.find_force(q1_, v1_, rim_, rule_, forces[i]);
  }
  sidewall.remember(begin_->sidewall);
  held_.col(column) += ((forces[0] - forces[1]) / (2.0 * by)).reshaped();
}

/// The blocks, where they feel it: the spin axis at first, and where sections flow the spin rate;
/// later the state at the beginning as well.
bool MotionSlopes::find_tread_slopes() {
  tread_.setZero(q1_.size() + gamma_.size(), kMotionColumns);
  const auto find = [&](int column, const RingState& more, const RingState& less) {
    const double by = nudge(column, step_);
    const auto of = tread_slope(
        more, less, part_motion(column, by), part_motion(column, -by), 2.0 * by);
    if (of) tread_.col(column) = *of;
    return of.has_value();
  };
  for (int column = 0; !slopes_.empty() && column < kMotionColumns; ++column) {
    const RingState& slope = slopes_[static_cast<std::size_t>(column)];
    const double by = nudge(column, step_);
    if (!find(column, along(*begin_, slope, by), along(*begin_, slope, -by))) return false;
  }
  if (!slopes_.empty()) return true;
  if (gamma_.size() > 0 && !find(kBySpinRate, *begin_, *begin_)) return false;
  for (const Vector3d& about : {rim_.X, rim_.Z}) {
    const double by = nudge(kByRotation, step_);
    const auto of = tread_slope(
        *begin_, *begin_, turned(motion_, about, by), turned(motion_, about, -by), 2.0 * by);
    if (!of) return false;
    tread_ += *of * (about.transpose() * carrier_);
  }
  return true;
}

/// dr/dm.
void MotionSlopes::find_right_sides() {
  const double theta = tire_.settings_.dissipation, scale = 1.0 - theta;
  x_.setZero(tread_.rows(), kPadded);
  x_.leftCols<kMotionColumns>() = scale * tread_;
  x_.topLeftCorner(q1_.size(), kMotionColumns) += scale * held_;
  NodeValues inertia;
  for (std::size_t i = 0; i < slopes_.size(); ++i) {
    const Eigen::Index column = static_cast<Eigen::Index>(i);
    tire_.times_mass(accelerations_.col(column).reshaped(4, q1_.cols()), inertia);
    x_.col(column).head(q1_.size()) += (theta * slopes_[i].force - inertia).reshaped();
  }
}

/// (29), the dampers' turning by iteration: 1e-4 of the tangent in steps of 0.2 ms at 60 m/s.
void MotionSlopes::solve(const ExactTangent& tangent) {
  constexpr double kEnough = 1e-7;
  constexpr int kMost = 20;
  tangent.solve(x_);
  const double scale = 1.0 - tire_.settings_.dissipation;
  const auto size = [](const Columns& x) { return x.cwiseAbs().colwise().maxCoeff().eval(); };
  Columns step = x_, next(x_.rows(), x_.cols());
  for (int i = 0; i < kMost; ++i) {
    next.topRows(q1_.size()) = scale * damping(turned_by(rim_.angular_velocity, step));
    next.bottomRows(gamma_.size()).setZero();
    tangent.solve(next);
    x_ += next;
    // What is still to come, as a geometric series.
    const double ratio =
        (size(next).array() / size(step).array().max(1e-300)).leftCols(kMotionColumns).maxCoeff();
    if ((ratio * size(next).array() <= kEnough * size(x_).array()).all()) break;
    step = next;
  }
}

/// dF/dm of (18), turned into the carrier's axes, which turn too.
HubSlopes MotionSlopes::hub_slopes() const {
  const int N = tire_.angles_.nodes();
  const double tilted = node_radius_over_knot_radius(N);
  Vector3d sum = Vector3d::Zero(), torsions = sum, moment = sum;
  for (int k = 0; k < N; ++k) {
    const Vector3d f = inner_.col(k).head<3>();
    sum += f;
    torsions += tilted * inner_(3, k) * tire_.angles_.tangential(rim_, k);
    moment -= (q1_.col(k).head<3>() - rim_.center).cross(f);
  }
  moment -= torsions;
  const std::vector<int> chosen = {0, 1, 2, 6, 7, 8};
  const Columns weights = fields_(Eigen::all, chosen);
  // Of dq1/dm: by stiffness and dampers, and by the arms of the forces.
  Columns of_place = stiff_(Eigen::all, chosen) +
                     turned_by(rim_.angular_velocity, damping(weights));
  of_place.rightCols<3>() += unit_turns(inner_);
  HubSlopes hub = -(weights.transpose() * held_);
  hub += of_place.transpose() * x_.topLeftCorner(q1_.size(), kMotionColumns);
  const Eigen::Matrix3d to_carrier = motion_.carrier.transpose();
  for (int column = 0; column < kMotionColumns; ++column) {
    const Vector3d turn = carrier_.col(column);
    hub.col(column).tail<3>() += Vector3d(center_.col(column)).cross(sum) -
                                 Vector3d(turn_.col(column)).cross(torsions);
    hub.col(column) << to_carrier * (hub.col(column).head<3>() + turn.cross(sum)),
        to_carrier * (hub.col(column).tail<3>() - turn.cross(moment));
  }
  return hub;
}

/// Slopes of the state that the part leaves: nodes by (16), (17), memory by differences.
bool MotionSlopes::follow_state(const Step& part) {
  const double theta = tire_.settings_.dissipation;
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
