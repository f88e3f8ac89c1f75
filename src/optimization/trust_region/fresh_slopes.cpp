// SPDX-License-Identifier: Apache-2.0
#include "optimization/trust_region/fresh_slopes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <utility>

#include "optimization/least_squares/open_variables.h"

namespace latsch {
namespace {

// Longest step, in units of the axes of the frame.
constexpr double kSlopeReach = 2.0;
// Factor by which the longest step is shortened after a disappointing step.
constexpr double kShorterSlope = 0.3;
/// Error of the value predicted for a bad step, as a share of the target, from which on slopes are
/// not believed, whatever the last model predicts: a model that passes through a ripple finds a
/// minimum of the ripple. A larger share would call such a point a minimum, a smaller one would
/// doubt minima of curved simulations.
constexpr double kContradiction = 1e-3;
// A bad step is outweighed by a later one that promises at least this share of its error, and whose
// gain is at most this factor off the promise.
constexpr double kSimilar = 0.5;
constexpr double kMatch = 2.0;
/// Lengths of the trials that check the last model, in units of the axes. The second one follows if
/// the first one differs from the model, because curvature matters less over a shorter move, and
/// noise and ripple matter more.
constexpr std::array kCheckLengths{0.3, 0.1};
/// Largest error of the residuals that the model predicts for a check, as a share of their change.
/// A larger share would call a minimum of a ripple a minimum, a smaller one would doubt minima of
/// curved simulations.
constexpr double kChecked = 0.1;
constexpr int kMostMisses = 3;  // number of steps in a row without success that end a round
// Factor by which moves are lengthened if the residuals are at noise level.
constexpr double kFarther = 3.0;
/// Smallest predicted gain of a step that shows whether slopes are wrong, as a share of the
/// target's standard deviation due to noise. A disappointing step with a smaller predicted gain
/// tells nothing about slopes. With a smaller share every such step counts, with a larger one only
/// steps far above noise.
constexpr double kTelling = 0.5;
// Another round follows only if the value falls below this share of that at the beginning of the
// round.
constexpr double kWorthARound = 1.0 - 1e-5;
/// Largest change of the residuals over a move, as a multiple of their norm, from which slopes are
/// computed. A move that changes them by more is too long.
constexpr double kTooBlunt = 100.0;
/// Length of an axis, as a share of the ranges, below which the range of a variable counts as too
/// wide if the residuals are still as large as at the start. For smaller residuals it is shorter in
/// proportion. A larger value would call exact fits of noisy simulations too wide, a smaller one
/// would call steep simulations noisy.
constexpr double kSteep = 0.01;
constexpr int kMostSharpened = 4;  // largest number of axes shortened in a round
/// Share of `f_least` below which no step looks for variables that are still open.
constexpr double kFarBelow = 1e-4;
/// Slope along an axis, as a share of the largest, below which the curvature of others may account
/// for it, if nothing is left of the residuals.
constexpr double kWeak = 0.01;
// Largest number of steps of a round; further steps would gain too little.
constexpr int kMostStepsOfARound = 20;

}  // namespace

FreshSlopes::FreshSlopes(TrustBox& box, const Options& options)
    : options_(options), change_(options.change) {
  begin_round(box, box.slopes());
}

void FreshSlopes::begin_round(const TrustBox& box, const Eigen::MatrixXd& J) {
  frame_ = box.natural_frame(J, change_, options_.shortest);
  axis_ = 0;
  misses_ = 0;
  has_failed_ = false;
  has_disappointed_ = false;
  is_blind_ = false;
  steps_ = 0;
  sharpened_ = 0;
  mirrored_ = 0;
  checks_ = 0;
  is_unlike_model_ = false;
  reach_ = kSlopeReach;
  f_begin_ = box.f();
  ++rounds_;
}

std::optional<Wanted> FreshSlopes::next(TrustBox& box, const PendingPoints<Wanted>& wanted) {
  while (true) {
    while (axis_ < frame_.axes()) {
      const int axis = axis_++;
      if (auto probe = box.probe_by(frame_.T.col(axis), wanted)) return probe;
      is_blind_ |= box.memory.failures() > 0 && !box.has_moved_along(axis, frame_);
    }
    if (!wanted.empty()) return std::nullopt;
    if (check_) judge_check(box);
    double noise = 0.0;
    const ResidualKriging m = box.natural_model(frame_, noise);
    deviation_ = m.target_deviation();
    has_seen_noise_ |= noise > 0.0;
    if (noise > 0.0) noise_ = {m.noise_norm(), slopes_of(m), frame_};
    const Wanted step = box.natural_step(m, frame_, reach_, wanted);
    if (options_.asks_what_is_open && box.f() <= options_.f_least) {
      const bool is_far_below = box.f() <= kFarBelow * options_.f_least;
      if (leaves_nothing_open(m, box) || is_far_below) {
        if (auto mirrored = mirror_weak_axis(m, box)) return mirrored;
        end(m, step, noise, box);
        return std::nullopt;
      }
    }
    const bool is_promising = step.length > 0.0;
    const bool crawls = steps_ >= kMostStepsOfARound;
    if (is_promising && misses_ < kMostMisses && !crawls) {
      ++steps_;
      return step;
    }
    if (sharpen(box)) continue;
    const bool goes_farther = !pays_another_round(box) && noise > 0.0 && change_ == 1.0;
    if (!pays_another_round(box) && !goes_farther) {
      if (!(is_blind_ || is_promising || noise > 0.0 || is_contradicted())) {
        if (auto point = check(m, box)) return point;
      }
      end(m, step, noise, box);
      return std::nullopt;
    }
    if (goes_farther) change_ = kFarther;
    begin_round(box, m.jacobian(Eigen::VectorXd::Zero(frame_.axes())) * frame_.inverse);
  }
}

/// True if vanishing residuals determine all variables.
bool FreshSlopes::leaves_nothing_open(const ResidualKriging& m, const TrustBox& box) const {
  return open_variables(box.space, box.c(), slopes_of(m), std::sqrt(box.f())).empty();
}

/// Returns a probe on the other side of an axis with little effect, so that its slope is not taken
/// for curvature; nullopt if there is none left.
std::optional<Wanted> FreshSlopes::mirror_weak_axis(const ResidualKriging& m, const TrustBox& box) {
  const Eigen::MatrixXd J = m.jacobian(Eigen::VectorXd::Zero(frame_.axes()));
  const Eigen::VectorXd slopes = J.colwise().norm().transpose().cwiseQuotient(
      (box.widths().cwiseInverse().asDiagonal() * frame_.T).colwise().norm().transpose());
  for (; mirrored_ < frame_.axes(); ++mirrored_) {
    if (!(slopes[mirrored_] < kWeak * slopes.maxCoeff())) continue;
    if (auto probe = box.probe_by(-frame_.T.col(mirrored_++), {})) return probe;
  }
  return std::nullopt;
}

/// Returns the slopes of the model at the center.
PointSlopes FreshSlopes::slopes_of(const ResidualKriging& m) const {
  const Eigen::VectorXd origin = Eigen::VectorXd::Zero(frame_.axes());
  const Eigen::MatrixXd& to_axes = frame_.inverse;
  return {m.jacobian(origin) * to_axes, to_axes.transpose() * m.variance_hessian(origin) * to_axes};
}

/// Concludes from the last model and its step how the search ended.
void FreshSlopes::end(const ResidualKriging& m,
                      const Wanted& step,
                      double noise,
                      const TrustBox& box) {
  const bool is_promising = step.length > 0.0;
  ending_ = is_blind_ && box.f() <= options_.f_least ? Ending::explained
            : is_blind_                              ? Ending::blind
            : is_promising && has_failed_            ? Ending::edge
            : noise > 0.0 || (is_doubtful() && has_seen_noise_)
                ? (is_wide(box) ? Ending::wide : Ending::noise)
            : is_promising || is_doubtful() ? Ending::rough
                                            : Ending::verified;
  slopes_ = slopes_of(m);
  const Eigen::VectorXd lengths = frame_.T.colwise().lpNorm<Eigen::Infinity>().transpose();
  evidence_.promise = std::max(0.0, 1.0 - step.predicted / box.f());
  evidence_.least_promise = TrustBox::kFlat;
  evidence_.deviation = deviation_ / box.f();
  evidence_.contradiction = contradiction_;
  evidence_.most_contradiction = kContradiction;
  evidence_.most_model_error = kChecked;
  evidence_.shortest = lengths.minCoeff();
  evidence_.longest = lengths.maxCoeff();
  evidence_.failed_steps = has_failed_ ? misses_ : 0;
}

/// True if a step showed that slopes around the best point are wrong, and none showed later that
/// they are right.
bool FreshSlopes::is_contradicted() const { return contradiction_ > kContradiction; }

/// True unless the last model and its slopes have proved right.
bool FreshSlopes::is_doubtful() const { return is_contradicted() || is_unlike_model_; }

/// Returns a trial away from the axes of the frame, whose residuals show whether the model is
/// right; nullopt if it is known already or if there is no room.
std::optional<Wanted> FreshSlopes::check(const ResidualKriging& m, TrustBox& box) {
  const bool is_needed = checks_ == 0 || is_unlike_model_;
  if (!is_needed || checks_ >= std::ssize(kCheckLengths)) return std::nullopt;
  const double length = kCheckLengths[checks_++] / std::sqrt(frame_.axes());
  Eigen::VectorXd y(frame_.axes());
  const Eigen::VectorXd drawn = box.draw();
  for (int k = 0; k < frame_.axes(); ++k) y[k] = drawn[k] < 0.0 ? -length : length;
  const auto point = box.probe_by(frame_.T * y, {});
  if (!point) return std::nullopt;
  check_ = Check{
      point->u, box.memory[box.center()].r, m.residuals(frame_.inverse * (point->u - box.c()))};
  return point;
}

/// Compares the residuals of the check with the model. A failed trial says nothing about the model.
void FreshSlopes::judge_check(const TrustBox& box) {
  const Check check = *std::exchange(check_, std::nullopt);
  int i = box.memory.size() - 1;
  while (i >= 0 && box.memory[i].u != check.u) --i;
  if (i < 0) return;
  const ResidualSample& found = box.memory[i];
  const double change = (found.r - check.r_center).norm();
  const double error = (found.r - check.r_expected).norm();
  evidence_.model_error = change > 0.0 ? error / change : 0.0;
  is_unlike_model_ = error > kChecked * change;
}

/// True if residuals that scatter around their model need not be noisy: a move by a tiny share of
/// the ranges already changes them by their size, or their scatter exceeds the target itself.
bool FreshSlopes::is_wide(const TrustBox& box) const {
  const double left = std::sqrt(box.f() / options_.f_first);
  return frame_.T.colwise().norm().minCoeff() < kSteep * left || deviation_ > box.f();
}

void FreshSlopes::shorten(int axis, double factor) {
  frame_.T.col(axis) *= factor;
  frame_.inverse.row(axis) /= factor;
  is_sharp_ = true;
  ++sharpened_;
}

/// Shortens the axes along which moves are too long for slopes, so that they are probed again.
/// Returns false if there are none.
bool FreshSlopes::sharpen(const TrustBox& box) {
  const Eigen::VectorXd changes = box.changes_along(frame_);
  if (!(changes.maxCoeff() > kTooBlunt)) return false;
  is_blind_ |= sharpened_ >= kMostSharpened;
  if (is_blind_) return false;
  for (int k = 0; k < frame_.axes(); ++k)
    if (changes[k] > kTooBlunt) shorten(k, 1.0 / changes[k]);
  axis_ = 0;
  steps_ = 0;
  misses_ = 0;
  reach_ = kSlopeReach;
  return true;
}

void FreshSlopes::observe_failed_probe(double change) {
  if (std::isfinite(change) && change > kTooBlunt && sharpened_ < kMostSharpened) {
    --axis_;
    return shorten(axis_, 1.0 / change);
  }
  is_blind_ = true;
}

bool FreshSlopes::pays_another_round(const TrustBox& box) const {
  const bool has_gained = box.f() < kWorthARound * f_begin_ && box.f() > options_.f_least;
  const bool was_wrong = has_disappointed_ && !box.is_down_to(options_.noise_alone);
  if (options_.asks_what_is_open && box.f() <= options_.f_least) return false;
  return (has_gained || was_wrong) && rounds_ < options_.most_rounds;
}

void FreshSlopes::observe_failed_step() {
  ++misses_;
  has_failed_ = true;
}

void FreshSlopes::observe_step(double gain, bool is_bad, double promise) {
  const double promised = promise / f_begin_;
  if (is_bad) contradiction_ = std::max(contradiction_, std::abs(1.0 - gain) * promised);
  const bool matches = gain > 1.0 / kMatch && gain < kMatch;
  if (matches && promised >= kSimilar * contradiction_) contradiction_ = 0.0;
  misses_ = is_bad ? misses_ + 1 : 0;
  has_failed_ = false;
  if (!is_bad) return;
  has_disappointed_ |= promise >= kTelling * deviation_;
  reach_ *= kShorterSlope;
}

}  // namespace latsch
