// SPDX-License-Identifier: Apache-2.0
#include "models/fe_tire/rolling/rolling_grip.h"

#include <cmath>
#include <utility>

namespace latsch::fe_tire {
namespace {

using Pair = Eigen::Vector2d;

/// Turns a trial traction into that of a point which slides. Directions opposite to the kept one
/// belong to points that ought to stick; they keep theirs.
bool turns(const Pair& trial, const Pair& kept) { return trial.dot(kept) > 0.0; }

}  // namespace

RollingGrip::RollingGrip(RollingLines lines, RollingFriction friction, double stiffness)
    : lines_(std::move(lines)), friction_(friction), stiffness_(stiffness) {}

/// One step of (F.1): the creep distance, and whether a traction comes with it.
struct RollingGrip::Step {
  Pair full;     // m, (x_k - x_{k-1}) - V_g Delta t_k
  double share;  // part of it that counts
  bool carries;  // the point before is in contact
};

RollingGrip::Step RollingGrip::step_to(const RollingInput& input,
                                       const RollingLines::Line& line,
                                       int k) const {
  if (k == line.first) return {Pair::Zero(), 0.0, false};
  const bool carries = input.p[k - 1] > 0.0;
  const Pair full = input.x.col(k) - input.x.col(k - 1) - input.V_g.col(k) * lines_.time[k];
  return {full, carries ? 1.0 : input.share[k], carries};
}

GripTractions RollingGrip::tractions(const RollingInput& input,
                                     const GripState& state,
                                     Directions directions,
                                     bool with_derivatives) const {
  const int n = lines_.points();
  GripTractions found{Eigen::Matrix2Xd::Zero(2, n),
                      Eigen::Matrix2Xd::Zero(2, n),
                      Eigen::VectorXd::Zero(n),
                      Eigen::Matrix2Xd::Zero(2, n),
                      {}};
  if (with_derivatives) found.links.resize(n);
  for (const RollingLines::Line& line : lines_.lines) {
    for (int k = line.first; k < line.last; ++k) {
      if (!(input.p[k] > 0.0)) continue;
      const Step step = step_to(input, line, k);
      Pair trial = -stiffness_ * step.share * step.full;
      if (step.carries) trial += found.t.col(k - 1);
      found.trial.col(k) = trial;
      found.limit[k] = friction_.at(input.p[k], state.speed[k]) * input.p[k];
      const bool slides = state.grip[k] == Grip::slides;
      const Pair kept = state.direction.col(k);
      const bool turned = slides && directions == Directions::of_trial && turns(trial, kept);
      const Pair direction = turned ? Pair(trial.normalized()) : kept;
      found.t.col(k) = slides ? Pair(found.limit[k] * direction) : trial;
      if (!with_derivatives) continue;
      // The traction follows the trial as a whole, or across its direction, or not at all.
      Eigen::Matrix2d follows = Eigen::Matrix2d::Zero();
      if (!slides) follows.setIdentity();
      if (turned)
        follows = found.limit[k] / trial.norm() *
                  (Eigen::Matrix2d::Identity() - direction * direction.transpose());
      GripLink& link = found.links[k];
      if (step.carries) link.by_before = follows;
      if (k > line.first) link.by_step = -stiffness_ * step.share * follows;
      if (k > line.first && !step.carries) link.by_share = -stiffness_ * (follows * step.full);
      if (slides) link.by_p = friction_.limit_slope(input.p[k], state.speed[k]) * direction;
    }
  }
  find_slip(input, state, found);
  return found;
}

void RollingGrip::admit(const RollingInput& input, GripState& state) const {
  for (const RollingLines::Line& line : lines_.lines) {
    Pair before = Pair::Zero();  // traction of the point before
    for (int k = line.first; k < line.last; ++k) {
      Grip& grip = state.grip[k];
      if (!(input.p[k] > 0.0)) {
        grip = Grip::none;
        before.setZero();
        continue;
      }
      const Step step = step_to(input, line, k);
      Pair trial = -stiffness_ * step.share * step.full;
      if (step.carries) trial += before;
      const double limit = friction_.at(input.p[k], state.speed[k]) * input.p[k];
      if (grip == Grip::none) {
        const double size = trial.norm();
        grip = size <= limit && friction_.at_rest > 0.0 ? Grip::sticks : Grip::slides;
        if (grip == Grip::slides)
          state.direction.col(k) = size > 0.0 ? Pair(trial / size) : Pair(Pair::Zero());
      }
      before = grip == Grip::slides ? Pair(limit * state.direction.col(k)) : trial;
    }
  }
}

GripTractions RollingGrip::explicit_tractions(const RollingInput& input, GripState& state) const {
  const int n = lines_.points();
  GripTractions found{Eigen::Matrix2Xd::Zero(2, n),
                      Eigen::Matrix2Xd::Zero(2, n),
                      Eigen::VectorXd::Zero(n),
                      Eigen::Matrix2Xd::Zero(2, n),
                      {}};
  for (const RollingLines::Line& line : lines_.lines) {
    for (int k = line.first; k < line.last; ++k) {
      state.grip[k] = Grip::none;
      if (!(input.p[k] > 0.0)) continue;
      const Step step = step_to(input, line, k);
      Pair trial = -stiffness_ * step.share * step.full;
      if (step.carries) trial += found.t.col(k - 1);
      found.trial.col(k) = trial;
      found.limit[k] = friction_.at(input.p[k], state.speed[k]) * input.p[k];
      const double size = trial.norm();
      state.grip[k] = size <= found.limit[k] ? Grip::sticks : Grip::slides;
      if (state.grip[k] == Grip::slides) {
        state.direction.col(k) = trial / size;
        trial *= found.limit[k] / size;
      }
      found.t.col(k) = trial;
    }
  }
  find_slip(input, state, found);
  return found;
}

/// Finds the velocities with which points slide: by (F.1), (t - t')/(epsilon_t Delta t).
void RollingGrip::find_slip(const RollingInput& input,
                            const GripState& state,
                            GripTractions& found) const {
  for (const RollingLines::Line& line : lines_.lines) {
    for (int k = line.first + 1; k < line.last; ++k) {
      const double time = lines_.time[k] * (input.p[k - 1] > 0.0 ? 1.0 : input.share[k]);
      if (input.p[k] > 0.0 && state.grip[k] == Grip::slides && time > 0.0)
        found.w.col(k) = (found.t.col(k) - found.trial.col(k)) / (stiffness_ * time);
    }
  }
}

}  // namespace latsch::fe_tire
