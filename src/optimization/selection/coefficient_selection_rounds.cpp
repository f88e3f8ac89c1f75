// SPDX-License-Identifier: Apache-2.0
// The rounds of coefficient_selection.h: what is dropped or tested next.
#include <algorithm>
#include <cmath>

#include "numerics/dense/cholesky.h"
#include "optimization/problem/infinity.h"
#include "optimization/selection/coefficient_selection.h"
#include "optimization/selection/drop_set.h"

namespace latsch {
namespace {

// Distance of BIC above its least at which the path ends. A smaller value ends it before all useful
// candidates have been tried, a larger one costs a refit for each of them.
constexpr double kPastTheLeast = 60.0;
// A set whose rise exceeds this multiple of the limit of a set is halved.
constexpr double kTooMuch = 2.0;
// Fall of -2 log L without candidates from which on the model with them was not at its minimum.
constexpr double kOvertakes = 0.5;
// Distance to a bound, as a share of the range, within which a variable counts as on the bound.
constexpr double kAtItsBound = 1e-6;
// A candidate counts as already dropped if it is this close to its value.
constexpr double kAtValue = 1e-12;
// Curvature, relative to the largest, that is added for variables which no value determines.
constexpr double kFlatCurvature = 1e-12;

/// Returns the covariance of the variables `inside`, with the weak prior.
Eigen::MatrixXd covariance_of(const Linearization& at,
                              const std::vector<int>& inside,
                              double variance) {
  const auto k = std::ssize(inside);
  if (k == 0) return {};
  const Eigen::MatrixXd J = at.J(Eigen::all, inside);
  Eigen::MatrixXd M = J.transpose() * J;
  M.diagonal().array() += kFlatCurvature * M.diagonal().maxCoeff();
  return variance *
         numerics::PivotedCholesky(M).solve(Eigen::MatrixXd(Eigen::MatrixXd::Identity(k, k)));
}

}  // namespace

bool CoefficientSelection::is_held(const Linearization& at, int variable) const {
  const double gradient = at.J.col(variable).dot(at.r), u = at.u[variable];
  return (u <= kAtItsBound && gradient > 0.0) || (u >= 1.0 - kAtItsBound && gradient < 0.0);
}

/// Rates dropping each unit of the model alone, by the covariance at the present fit.
void CoefficientSelection::rate_units(SelectedModel& model) {
  std::vector<int> inside, place(static_cast<std::size_t>(present_.u.size()), -1);
  for (const int i : free_of(model.units)) {
    if (is_held(present_, i)) continue;
    place[static_cast<std::size_t>(i)] = static_cast<int>(inside.size());
    inside.push_back(i);
  }
  const Eigen::MatrixXd C = covariance_of(present_, inside, noise_variance(model));
  const Eigen::VectorXd b = (present_.u - problem_.toward)(inside);
  for (const int unit : model.units) {
    std::vector<int> own;
    bool held = false;
    for (const int i : problem_.units[static_cast<std::size_t>(unit)]) {
      const int at = place[static_cast<std::size_t>(i)];
      if (at >= 0)
        own.push_back(at);
      else
        held = held || std::abs(present_.u[i] - problem_.toward[i]) > kAtValue;
    }
    UnitFate& fate = fates_[static_cast<std::size_t>(unit)];
    fate.rise = held ? std::numeric_limits<double>::quiet_NaN() : single_rises(b, C, {own})[0];
    fate.alike = -1;
    fate.correlation = 0.0;
    for (const int other : model.units) {
      if (other == unit || own.size() != 1) continue;
      for (const int i : problem_.units[static_cast<std::size_t>(other)]) {
        const int at = place[static_cast<std::size_t>(i)];
        if (at < 0) continue;
        const double c = C(own[0], at) / std::sqrt(C(own[0], own[0]) * C(at, at));
        if (std::abs(c) <= std::abs(fate.correlation)) continue;
        fate.correlation = c;
        fate.alike = other;
      }
    }
    model.rises.push_back(fate.rise);
  }
}

void CoefficientSelection::plan_round() {
  const SelectedModel& model = path_.back();
  double least = kInfinity;
  for (const SelectedModel& one : path_) least = std::min(least, one.bic);
  std::vector<int> inside, place(static_cast<std::size_t>(present_.u.size()), -1);
  std::vector<int> at_value, held, regular;
  std::vector<std::vector<int>> regular_places;
  for (const int i : free_of(model.units)) {
    if (is_held(present_, i)) continue;
    place[static_cast<std::size_t>(i)] = static_cast<int>(inside.size());
    inside.push_back(i);
  }
  for (std::size_t k = 0; k < model.units.size(); ++k) {
    const int unit = model.units[k];
    if (fates_[static_cast<std::size_t>(unit)].cannot_be_dropped) continue;
    std::vector<int> own;
    for (const int i : problem_.units[static_cast<std::size_t>(unit)])
      if (place[static_cast<std::size_t>(i)] >= 0)
        own.push_back(place[static_cast<std::size_t>(i)]);
    if (std::isnan(model.rises[k])) {
      held.push_back(unit);
    } else if (own.empty()) {
      at_value.push_back(unit);
    } else {
      regular.push_back(unit);
      regular_places.push_back(own);
    }
  }
  ending_ = SelectionEnd::least_passed;
  if (model.bic > least + kPastTheLeast) return begin_restarts();
  ending_ = SelectionEnd::nothing_left;
  const DropSet set = largest_drop_set((present_.u - problem_.toward)(inside),
                                       covariance_of(present_, inside, noise_variance(model)),
                                       regular_places,
                                       std::log(rows_->counted().independent));
  std::vector<int> drops = at_value;
  if (set.stays_below || at_value.empty()) {
    const bool tests_first = !set.stays_below && at_value.empty();
    std::vector<int> untested;
    for (const int unit : held)
      if (!fates_[static_cast<std::size_t>(unit)].tested) untested.push_back(unit);
    if (tests_first && !untested.empty()) return begin_tests(untested);
    for (const int one : set.units) drops.push_back(regular[static_cast<std::size_t>(one)]);
  }
  if (drops.empty()) return begin_restarts();
  begin_drop(drops, set.stays_below || at_value.empty() ? set.rise : 0.0);
}

void CoefficientSelection::begin_drop(const std::vector<int>& units, double expected_rise) {
  if (!has_refits_left()) {
    ending_ = SelectionEnd::refits;
    return begin_restarts();
  }
  phase_ = Phase::dropping;
  ++refits_;
  std::vector<int> kept;
  for (const int unit : path_.back().units)
    if (std::find(units.begin(), units.end(), unit) == units.end()) kept.push_back(unit);
  const std::vector<int> free = free_of(kept);
  running_.clear();
  run(BroydenFit(
          present_, free, fit_options(present_, free.size()), dropped_from(present_.u, kept)),
      kept,
      units)
      .expected_rise = expected_rise;
}

/// Fits the last model of the path anew, from a better point that a smaller model has found.
void CoefficientSelection::mend(const Linearization& better) {
  ++refits_;
  const SelectedModel& model = path_.back();
  const std::vector<int> free = free_of(model.units);
  running_.clear();
  Running& running =
      run(BroydenFit(better, free, fit_options(better, free.size())), model.units, model.dropped);
  running.expected_rise = model.expected_rise;
  running.mends = true;
}

void CoefficientSelection::drop_done() {
  const Running running = running_.front();
  const std::vector<int>& dropped = running.dropped;
  if (running.mends) {
    path_.pop_back();
    // the model before contains this one, so it cannot end higher
    const bool overtakes =
        !path_.empty() && rated(running).minus_two_log < path_.back().minus_two_log - kOvertakes;
    if (overtakes && has_refits_left()) {
      for (const int unit : dropped) fates_[static_cast<std::size_t>(unit)].round = 0;
      return mend(running.fit.best());
    }
    add_to_path(running);
    return plan_round();
  }
  int coefficients = 0;
  for (const int unit : dropped)
    coefficients += static_cast<int>(problem_.units[static_cast<std::size_t>(unit)].size());
  const bool fitted = running.fit.fitted();
  const double rise =
      fitted ? rated(running).minus_two_log - path_.back().minus_two_log : kInfinity;
  const double expected = std::max(kRiseOfADrop * coefficients, running.expected_rise);
  if (rise < -kOvertakes && has_refits_left()) return mend(running.fit.best());
  if (dropped.size() > 1 && rise > kTooMuch * expected) {
    const auto half = static_cast<std::ptrdiff_t>(dropped.size() / 2);
    return begin_drop({dropped.begin(), dropped.begin() + half}, running.expected_rise);
  }
  if (!fitted) {
    fates_[static_cast<std::size_t>(dropped.front())].cannot_be_dropped = true;
  } else {
    add_to_path(running);
  }
  plan_round();
}

void CoefficientSelection::begin_tests(const std::vector<int>& units) {
  phase_ = Phase::testing;
  running_.clear();
  for (const int unit : units) {
    if (!has_refits_left()) break;
    ++refits_;
    fates_[static_cast<std::size_t>(unit)].tested = true;
    std::vector<int> kept = path_.back().units;
    std::erase(kept, unit);
    const std::vector<int> free = free_of(kept);
    run(BroydenFit(
            present_, free, fit_options(present_, free.size()), dropped_from(present_.u, kept)),
        kept,
        {unit});
  }
  if (!running_.empty()) return;
  ending_ = SelectionEnd::refits;
  begin_restarts();
}

void CoefficientSelection::tests_done() {
  const Running* least = nullptr;
  double least_criterion = path_.back().bic;
  for (const Running& running : running_) {
    UnitFate& fate = fates_[static_cast<std::size_t>(running.dropped.front())];
    fate.cannot_be_dropped = !running.fit.fitted();
    if (fate.cannot_be_dropped) continue;
    const SelectedModel model = rated(running);
    fate.tested_rise = model.minus_two_log - path_.back().minus_two_log;
    if (!(model.bic < least_criterion)) continue;
    least_criterion = model.bic;
    least = &running;
  }
  if (least) {
    const Running adopted = *least;
    // the others were tested beside this one, and are tested again without it
    for (const Running& running : running_)
      if (running.dropped != adopted.dropped)
        fates_[static_cast<std::size_t>(running.dropped.front())].tested = false;
    add_to_path(adopted);
  }
  plan_round();
}

}  // namespace latsch
