// SPDX-License-Identifier: Apache-2.0
#include "optimization/trust_region/lost_variable_trials.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "optimization/trust_region/flat_directions.h"

namespace latsch {
namespace {

// Length of the moves that test which variables are lost, as a share of the initial radius.
constexpr double kTest = 0.1;
/// Number of evaluations of each trial, in units of n + 1. One unit is needed for the probes, so
/// two are left for steps.
constexpr int kAllotment = 3;
// Share of the former value below which the trials count as an improvement.
constexpr double kWorthIt = 0.9;

}  // namespace

const PendingPoints<Wanted>& LostVariableTrials::wanted() const {
  if (!look_.empty()) return look_;
  return allotted_ > 0 ? trials_.back().wanted() : run_.wanted();
}

void LostVariableTrials::observe(const DesignPoint& point,
                                 const Eigen::VectorXd& u,
                                 const std::optional<ResidualSample>& sample) {
  if (look_.contains(point)) {
    take_look(point, sample);
  } else if (allotted_ > 0 && wanted().contains(point)) {
    trials_.back().observe(point, u, sample);
    --allotted_;
  } else {
    run_.observe(point, u, sample);
  }
  if (allotted_ > 0 && trials_.back().wanted().empty()) allotted_ = 0;
  if (allotted_ == 0 && look_.empty()) look_further();
}

/// When the run settles, first tests which variables are lost. Then tries one point after the other
/// at which they may have an effect, as long as restarts are left for the trials.
void LostVariableTrials::look_further() {
  while (run_.has_settled()) {
    TrustBox& box = run_.box();
    if (!lost_) {
      r_settled_ = run_.best().r;
      const Eigen::VectorXd slopes = box.slopes().colwise().norm().transpose();
      const Eigen::VectorXd test = kTest * run_.options().initial_radius * box.draw();
      lost_.emplace(box.space, box.region, run_.best().u, slopes, test);
    }
    const bool may_go_on = std::ssize(trials_) < run_.restarts_left();
    if (lost_->has_next() && may_go_on) {
      look_ = {box.at(lost_->next(), Wanted::Kind::start)};
      return;
    }
    choose();
  }
}

/// Processes the outcome of a point at which lost variables may have an effect again, and begins a
/// trial if they have one.
void LostVariableTrials::take_look(const DesignPoint& point,
                                   const std::optional<ResidualSample>& sample) {
  const bool was_test = lost_->is_testing();
  const double factor = lost_->factor();
  const bool is_felt = !sample || !is_same(sample->r, r_settled_);
  lost_->observe(is_felt);
  look_.clear();
  if (!is_felt || !sample) return;
  if (was_test) {
    run_.observe(point, sample->u, sample);
  } else {
    start_trial(point, *sample, factor);
  }
}

void LostVariableTrials::start_trial(const DesignPoint& point,
                                     const ResidualSample& sample,
                                     double factor) {
  ResidualTrustRegionOptions options = run_.options();
  options.restarts = 0;
  // Variables with an effect need steps as long as before, and lost ones steps shorter by the
  // factor, so the radius is multiplied by the geometric mean of both.
  options.initial_radius =
      std::max(options.step_tolerance, std::sqrt(std::min(1.0, factor)) * options.initial_radius);
  trials_.emplace_back(run_.box().space.starting_at(point), options);
  trials_.back().set_tests_end(false);
  trials_.back().observe(point, sample.u, sample);
  if (!trials_.back().box().has_center()) return trials_.pop_back();
  allotted_ = kAllotment * (run_.box().n() + 1) + options.outstanding - 1;
}

/// Continues with the best of the main run and the trials.
void LostVariableTrials::choose() {
  const int restarts_left = run_.restarts_left();
  const double f_before = run_.best().f;
  const bool run_tests_end = run_.tests_end();
  for (const TrustRegionRun& trial : trials_) {
    if (trial.best().f < run_.best().f) run_ = trial;
  }
  run_.set_tests_end(run_tests_end);
  const bool was_in_vain = run_.best().f > kWorthIt * f_before;
  run_.go_on(restarts_left - (was_in_vain ? static_cast<int>(std::ssize(trials_)) : 0));
  trials_.clear();
  lost_.reset();
}

ResidualSample LostVariableTrials::expected(const DesignPoint& point) const {
  if (!look_.empty()) return run_.best();
  return (allotted_ > 0 ? trials_.back() : run_).box().expected(point);
}

}  // namespace latsch
