// SPDX-License-Identifier: Apache-2.0
#include "models/fe_tire/grip/rolling_grip.h"

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
  double now;    // weight of the present traction of the point before
  Pair earlier;  // Pa, earlier part of that traction
  double share;  // part of it that counts
  bool carries;  // the point before is in contact
  double time;   // s, of the part that counts; 0: there is no step
};

/// Traction of a sliding point by (F.2).
struct RollingGrip::Slide {
  double t;               // Pa
  double by_along = 0.0;  // derivative by the trial traction along, 0 if mu is that at rest
  double by_p = 0.0;      // derivative by the pressure
  double by_time = 0.0;   // Pa/s, derivative by the time of the step
};

RollingGrip::Slide RollingGrip::slide(double p, double along, double time) const {
  constexpr int kMostSteps = 60;
  constexpr double kEnough = 1e-14;  // relative to the trial traction
  const double at_rest = friction_.at(p, 0.0) * p, drag = stiffness_ * time;
  if (!friction_.depends_on_speed() || along <= at_rest || !(drag > 0.0))
    return {at_rest, 0.0, friction_.limit_slope(p, 0.0)};
  // mu p + drag w - along is below 0 at rest and not below 0 where mu p would be 0. Up to the peak
  // it rises, so a root there is the one that the point comes to as it begins to slide. Newton's
  // method finds it, and halves the bracket where a step leaves that.
  const auto excess = [&](double w) { return friction_.at(p, w) * p + drag * w - along; };
  double low = 0.0, high = along / drag;
  const double peak = friction_.peak_speed;
  if (peak < high) (excess(peak) < 0.0 ? low : high) = peak;
  double w = 0.5 * (low + high);
  for (int k = 0; k < kMostSteps; ++k) {
    const double f = excess(w);
    if (std::abs(f) <= kEnough * along) break;
    (f < 0.0 ? low : high) = w;
    const double next = w - f / (friction_.speed_slope(p, w) * p + drag);
    w = next > low && next < high ? next : 0.5 * (low + high);
  }
  const double slope = friction_.speed_slope(p, w) * p, whole = slope + drag;
  return {friction_.at(p, w) * p,
          slope / whole,
          friction_.limit_slope(p, w) * drag / whole,
          -slope * stiffness_ * w / whole};
}

RollingGrip::Step RollingGrip::step_to(const RollingInput& input,
                                       const RollingLines::Line& line,
                                       int k) const {
  if (k == line.first) return {Pair::Zero(), 1.0, Pair::Zero(), 0.0, false, 0.0};
  const Upstream& upstream = input.upstream;
  const bool carries = input.carries(k);
  const double share = carries ? 1.0 : input.share[k], time = share * lines_.time[k];
  const Pair passed = input.x.col(k) - input.V_g.col(k) * lines_.time[k];
  if (!upstream.is_past())
    return {passed - input.x.col(k - 1), 1.0, Pair::Zero(), share, carries, time};
  const double now = upstream.now[k];
  const Pair before = now * input.x.col(k - 1) + upstream.x.col(k).head<2>();
  return {passed - before, now, upstream.t.col(k), share, carries, time};
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
      if (step.carries) trial += step.now * found.t.col(k - 1) + step.earlier;
      found.trial.col(k) = trial;
      const bool slides = state.grip[k] == Grip::slides;
      const Pair kept = state.direction.col(k);
      const bool turned = slides && directions == Directions::of_trial && turns(trial, kept);
      const Pair direction = turned ? Pair(trial.normalized()) : kept;
      const Slide slide = this->slide(input.p[k], slides ? trial.dot(direction) : 0.0, step.time);
      found.limit[k] = slide.t;
      found.t.col(k) = slides ? Pair(slide.t * direction) : trial;
      if (!with_derivatives) continue;
      // The traction follows the trial as a whole, or across its direction, or not at all; along
      // its direction it follows as far as mu depends on the speed.
      Eigen::Matrix2d follows = Eigen::Matrix2d::Zero();
      if (!slides) follows.setIdentity();
      if (turned)
        follows = slide.t / trial.norm() *
                  (Eigen::Matrix2d::Identity() - direction * direction.transpose());
      if (slides && slide.by_along != 0.0)
        follows += slide.by_along * direction * direction.transpose();
      GripLink& link = found.links[k];
      link.now = step.now;
      if (step.carries) link.by_before = step.now * follows;
      if (k > line.first) link.by_step = -stiffness_ * step.share * follows;
      if (k > line.first && !step.carries) link.by_share = -stiffness_ * (follows * step.full);
      if (!slides) continue;
      link.by_p = slide.by_p * direction;
      if (k > line.first && !step.carries)
        link.by_share += slide.by_time * lines_.time[k] * direction;
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
      if (step.carries) trial += step.now * before + step.earlier;
      if (grip == Grip::none) {
        const double size = trial.norm(), limit = friction_.at(input.p[k], 0.0) * input.p[k];
        grip = size <= limit && friction_.at_rest > 0.0 ? Grip::sticks : Grip::slides;
        if (grip == Grip::slides)
          state.direction.col(k) = size > 0.0 ? Pair(trial / size) : Pair(Pair::Zero());
      }
      before = trial;
      if (grip != Grip::slides) continue;
      const Pair direction = state.direction.col(k);
      before = slide(input.p[k], trial.dot(direction), step.time).t * direction;
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
      if (step.carries) trial += step.now * found.t.col(k - 1) + step.earlier;
      found.trial.col(k) = trial;
      const double size = trial.norm();
      found.limit[k] = slide(input.p[k], size, step.time).t;
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
      const double time = lines_.time[k] * (input.carries(k) ? 1.0 : input.share[k]);
      if (input.p[k] > 0.0 && state.grip[k] == Grip::slides && time > 0.0)
        found.w.col(k) = (found.t.col(k) - found.trial.col(k)) / (stiffness_ * time);
    }
  }
}

}  // namespace latsch::fe_tire
