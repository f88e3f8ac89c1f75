// SPDX-License-Identifier: Apache-2.0
#include "models/ring_tire/ring/free_rows.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include "models/ring_tire/ring/ring_tire.h"
#include "models/ring_tire/step/wheel_motions.h"

namespace latsch::ring_tire {

using Eigen::Vector3d;

FreeRows::FreeRows(const RingParameters& parameters, double share)
    : share_(share),
      radius_(parameters.belt.radius),
      inertia_{parameters.belt.mass * radius_ * radius_, parameters.belt.mass},
      rows_(kWays, RimRows(parameters.nodes)) {}

const WheelMotion& FreeRows::begin(const WheelMotion& motion, double time, double step) {
  time_ = time;
  step_ = step;
  rates_ = wheel_.guess(step);
  motion_ = wheel_.moved(motion, step, rates_);
  return motion_;
}

/// (18)
FreeWheel::Pair FreeRows::forces(const NodeValues& q,
                                 const NodeValues& inner,
                                 const Vector3d& on_rim) const {
  FreeWheel::Pair sum(motion_.carrier.col(1).dot(on_rim), 0.0);
  for (Eigen::Index k = 0; k < q.cols(); ++k) {
    sum[kSpin] -= with_rim(kSpin, q.col(k).head<3>()).dot(inner.col(k).head<3>());
    sum[kHeight] -= inner(2, k);
  }
  return sum;
}

double FreeRows::find_left(const NodeValues& q, const NodeValues& inner, const Vector3d& on_rim) {
  forces_ = forces(q, inner, on_rim);
  const FreeWheel::Pair left = wheel_.left(time_, step_, rates_, forces_);
  if (!left.allFinite()) return std::numeric_limits<double>::infinity();
  return std::max(std::abs(left[kSpin]) / radius_, std::abs(left[kHeight]));
}

void FreeRows::take_tangent(InnerForces& forces,
                            const RimFrame& rim,
                            const NodeValues& q,
                            double acceleration,
                            long which) {
  const Eigen::Matrix3d axes = rim.axes();
  if (is_free(kSpin)) forces.find_turned_rim(share_, rows_[kSpin]);
  if (is_free(kHeight))
    forces.find_moved_rim(axes.transpose() * Vector3d::UnitZ(), share_, rows_[kHeight]);
  stiffness_.setZero();
  for (int i = 0; i < kWays; ++i) {
    tangent_[i] = is_free(i) ? which : 0;
    if (!is_free(i)) continue;
    const RimRows& g = rows_[static_cast<std::size_t>(i)];
    for (Eigen::Index k = 0; k < q.cols(); ++k) {
      const Vector3d at =
          axes * Vector3d(g.row(RimRows::kX)[k], g.row(RimRows::kY)[k], g.row(RimRows::kZ)[k]);
      for (int j = 0; j < kWays; ++j)
        if (is_free(j)) stiffness_(i, j) += at.dot(with_rim(j, q.col(k).head<3>()));
    }
  }
  for (int j = 0; j < kWays; ++j) {
    if (!is_free(j)) continue;
    follows_[j] = stiffness_(j, j) / (acceleration * inertia_[j] + share_ * stiffness_(j, j));
    stiffness_.col(j) *= 1.0 - share_ * follows_[j];
  }
}

bool FreeRows::knows_tangent(long which) const {
  return (!is_free(kSpin) || tangent_[kSpin] == which) &&
         (!is_free(kHeight) || tangent_[kHeight] == which);
}

bool FreeRows::correct(const RimFrame& rim, const NodeValues& q, NodeValues& p) {
  FreeWheel::Pair T = forces_;
  for (int i = 0; i < kWays; ++i) {
    if (!is_free(i)) continue;
    const RimRows& g = rows_[static_cast<std::size_t>(i)];
    const double *x = g.row(RimRows::kX), *y = g.row(RimRows::kY), *z = g.row(RimRows::kZ),
                 *psi = g.row(RimRows::kTorsion);
    for (Eigen::Index k = 0; k < p.cols(); ++k) {
      const Vector3d way = p.col(k).head<3>();
      T[i] +=
          x[k] * rim.X.dot(way) + y[k] * rim.a.dot(way) + z[k] * rim.Z.dot(way) + psi[k] * p(3, k);
    }
  }
  const auto rates = wheel_.balanced(time_, step_, rates_, T, stiffness_);
  if (!rates || !rates->allFinite()) return false;
  for (int i = 0; i < kWays; ++i) {
    if (!is_free(i)) continue;
    const double way = share_ * follows_[i] * 0.5 * step_ * ((*rates)[i] - rates_[i]);
    for (Eigen::Index k = 0; k < p.cols(); ++k)
      p.col(k).head<3>() += way * with_rim(i, q.col(k).head<3>());
  }
  rates_ = *rates;
  motion_ = wheel_.moved(motion_, step_, rates_);
  return true;
}

void FreeRows::accept(const NodeValues& q, const NodeValues& inner, const Vector3d& on_rim) {
  wheel_ = wheel_.after(time_, step_, rates_, forces(q, inner, on_rim));
}

Result<HubForces> RingTire::advance_free(
    WheelMotion& motion, FreeWheel& wheel, const road::Road& road, double time, double step) {
  assert(settled_);
  if (const Status fit = check_step(motion, step); !fit) return fit.failure();
  struct WhileFree {
    FreeRows*& of;
    ~WhileFree() { of = nullptr; }
  };
  free_rows_.start(wheel);
  Status done;
  {
    const WhileFree until{free_ = &free_rows_};
    done = advance_in_parts(motion, road, time, step);
  }
  if (!done) return done.failure();
  motion = last_motion_ = free_rows_.motion();
  wheel = free_rows_.wheel();
  return hub_forces(motion.carrier);
}

/// Extends Newton's step of the belt to the step of belt and free wheel.
bool RingTire::correct_wheel() {
  if (!free_->correct(rim_, q1_, residual_)) return false;
  rim_ = RimFrame::of(free_->motion());
  return true;
}

}  // namespace latsch::ring_tire
