// SPDX-License-Identifier: Apache-2.0
#include "optimization/direct_search/gss_nlc.h"

#include <algorithm>
#include <cmath>

#include "optimization/problem/option_check.h"

namespace latsch {
namespace {

constexpr double kRhoGrowth = 10.0;
constexpr double kAlphaDecay = 0.1;
// Smallest smoothing width alpha; it is less than the violation that still counts as fulfilled.
constexpr double kLeastAlpha = 1e-5;
constexpr double kDeltaDecay = 0.25;
constexpr double kNextStep = 4.0;  // first step of the next search, as a multiple of delta

void check(const GssNlcOptions& options) {
  const OptionCheck check("GSS-NLC");
  check.require(options.rho > 0.0, "rho", options.rho, "above 0");
  check.require(
      options.largest_rho >= options.rho, "largest rho", options.largest_rho, "rho or more");
  check.require(options.alpha > 0.0, "alpha", options.alpha, "above 0");
}

bool is_finite(const Score& score) {
  const auto finite = [](double value) { return std::isfinite(value); };
  return finite(score.value) &&
         std::all_of(score.constraints.begin(), score.constraints.end(), finite) &&
         std::all_of(score.equations.begin(), score.equations.end(), finite);
}

}  // namespace

GssNlc::GssNlc(const DesignSpace& space, const GssNlcOptions& options)
    : space_(space),
      options_(options),
      rho_(options.rho),
      alpha_(options.alpha),
      delta_(std::max(kDeltaDecay * options.gss.initial_step, options.gss.step_tolerance)) {
  check(options);
  search_ = std::make_unique<Gss>(space_, options_.gss);  // Gss checks its own options
  begin_search(options_.gss.initial_step);
}

Result<Score> GssNlc::penalized(const Result<Score>& outcome) const {
  if (!outcome) return outcome;
  if (!is_finite(*outcome)) return Failure{"a constraint is not finite"};
  return Score{outcome->value + rho_ * penalty(options_.penalty, *outcome, alpha_)};
}

const GssNlc::Known* GssNlc::best() const {
  const Known* best = nullptr;
  double least = 0.0;
  for (const Known& known : known_) {
    const Result<Score> score = penalized(known.outcome);
    if (!score || !space_.contains(known.point)) continue;
    if (best && score->value >= least) continue;
    best = &known;
    least = score->value;
  }
  return best;
}

void GssNlc::begin_search(double initial_step) {
  const Known* start = best();
  GssOptions options = options_.gss;
  options.initial_step = initial_step;
  options.step_tolerance = std::min(delta_, 0.5 * initial_step);
  search_ = std::make_unique<Gss>(start ? space_.starting_at(start->point) : space_, options);
  // The best point is observed first. Otherwise the search would move from one known point to a
  // better one until it reached the best.
  if (start) search_->observe(start->point, penalized(start->outcome));
  for (const Known& known : known_) {
    if (&known != start) search_->observe(known.point, penalized(known.outcome));
  }
}

void GssNlc::end_search() {
  const Known* found = best();
  if (!found) return;
  const bool is_fulfilled = violation(*found->outcome) <= kFulfilled;
  const bool is_fine = delta_ <= options_.gss.step_tolerance;
  const bool is_sharp = !is_smoothed(options_.penalty) || alpha_ <= kLeastAlpha;
  if ((is_fulfilled && is_fine && is_sharp) || rho_ >= options_.largest_rho) return;
  if (!is_fulfilled) rho_ = std::min(kRhoGrowth * rho_, options_.largest_rho);
  alpha_ = std::max(kAlphaDecay * alpha_, kLeastAlpha);
  const double step = std::min(kNextStep * delta_, options_.gss.initial_step);
  delta_ = std::max(kDeltaDecay * delta_, options_.gss.step_tolerance);
  begin_search(step);
}

std::vector<DesignPoint> GssNlc::propose(int count) const { return search_->propose(count); }

void GssNlc::observe(const DesignPoint& point, const Result<Score>& outcome) {
  known_.push_back({point, outcome});
  search_->observe(point, penalized(outcome));
  // A new search may converge at once, because it observes the points known from earlier searches.
  double rho = 0.0, delta = 0.0, alpha = 0.0;
  while (search_->converged() && (rho != rho_ || delta != delta_ || alpha != alpha_)) {
    rho = rho_, delta = delta_, alpha = alpha_;
    end_search();
  }
}

}  // namespace latsch
