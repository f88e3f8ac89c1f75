// SPDX-License-Identifier: Apache-2.0
#include "optimization/selection/coefficient_selection.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace latsch {
namespace {

// Length of the differences at the start, in the unit cube.
constexpr double kFirstDifference = 0.01;
// Most evaluations of a fit, to which two for each variable are added if no slopes are computed.
constexpr int kEvaluationsOfASelection = 40;
// Tolerance of a fit in -2 log L. Differences of criteria are read to about one.
constexpr double kToleranceOfASelection = 0.01;
// Residuals of this size, relative to the data, are rounding errors and tell no noise.
constexpr double kNoNoiseAtAll = 1e-6;

std::vector<int> counted_to(std::size_t n) {
  std::vector<int> all(n);
  std::iota(all.begin(), all.end(), 0);
  return all;
}

}  // namespace

CoefficientSelection::CoefficientSelection(SelectionProblem problem,
                                           const SelectionOptions& options)
    : problem_(std::move(problem)), options_(options), fates_(problem_.units.size()) {
  const Eigen::Index n = problem_.start.size();
  if (problem_.free.empty()) problem_.free = counted_to(static_cast<std::size_t>(n));
  if (problem_.restart.size() == 0) problem_.restart = problem_.start;
  ask_start();
}

void CoefficientSelection::ask_start() {
  phase_ = Phase::start;
  wanted_ = {problem_.start};
  for (const int i : problem_.free) {
    Eigen::VectorXd moved = problem_.start;
    moved[i] += moved[i] + kFirstDifference <= 1.0 ? kFirstDifference : -kFirstDifference;
    wanted_.push_back(moved);
  }
}

/// Forgets the path and begins anew at a better fit.
void CoefficientSelection::begin_again(const Eigen::VectorXd& start) {
  ++passes_;
  earlier_refits_ = refits_;
  problem_.start = start;
  rows_.reset();
  noise_taken_ = false;
  path_.clear();
  running_.clear();
  fates_.assign(problem_.units.size(), {});
  ask_start();
}

/// Returns the variables that may move if these units are kept.
std::vector<int> CoefficientSelection::free_of(const std::vector<int>& units) const {
  std::vector<bool> held(static_cast<std::size_t>(problem_.start.size()), false);
  for (const auto& unit : problem_.units)
    for (const int i : unit) held[static_cast<std::size_t>(i)] = true;
  for (const int unit : units)
    for (const int i : problem_.units[static_cast<std::size_t>(unit)])
      held[static_cast<std::size_t>(i)] = false;
  std::vector<int> free;
  for (const int i : problem_.free)
    if (!held[static_cast<std::size_t>(i)]) free.push_back(i);
  return free;
}

/// Returns u with all units but the given ones at their values as dropped.
Eigen::VectorXd CoefficientSelection::dropped_from(Eigen::VectorXd u,
                                                   const std::vector<int>& units) const {
  for (std::size_t unit = 0; unit < problem_.units.size(); ++unit) {
    if (std::binary_search(units.begin(), units.end(), static_cast<int>(unit))) continue;
    for (const int i : problem_.units[unit]) u[i] = problem_.toward[i];
  }
  return u;
}

BroydenFitOptions CoefficientSelection::fit_options(const Linearization& at,
                                                    std::size_t variables) const {
  return {.tolerance = kToleranceOfASelection * rows_->variance(),
          .most_evaluations =
              kEvaluationsOfASelection + (at.is_exact ? 0 : 2 * static_cast<int>(variables))};
}

void CoefficientSelection::observe(const std::vector<Result<Evaluated>>& evaluated) {
  if (phase_ == Phase::start) {
    start_observed(evaluated);
  } else if (phase_ == Phase::restart_points) {
    restart_points_observed(evaluated);
  } else {
    running_observed(evaluated);
  }
}

void CoefficientSelection::start_observed(const std::vector<Result<Evaluated>>& evaluated) {
  const auto fail = [&](const std::string& reason) {
    status_ = Failure{reason};
    phase_ = Phase::done;
    wanted_.clear();
  };
  if (!evaluated.front())
    return fail("at the start the evaluation failed: " + evaluated.front().failure().reason);
  const Eigen::VectorXd r = evaluated.front()->r;
  raw_start_ = {problem_.start, r, evaluated.front()->J, evaluated.front()->has_slopes()};
  if (!raw_start_.is_exact) {
    raw_start_.J = Eigen::MatrixXd::Zero(r.size(), problem_.start.size());
    for (std::size_t k = 0; k < problem_.free.size(); ++k) {
      const int i = problem_.free[k];
      if (!evaluated[k + 1])
        return fail("beside the start the evaluation failed: " + evaluated[k + 1].failure().reason);
      raw_start_.J.col(i) = (evaluated[k + 1]->r - r) / (wanted_[k + 1][i] - problem_.start[i]);
    }
  }
  rows_.emplace(problem_, raw_start_);
  if (!rows_->is_determined())
    return fail(
        "there are no more measured values than variables, so nothing tells how large their noise "
        "is: state the noise of the experiments");
  begin_full_fit();
  ask();
}

void CoefficientSelection::begin_full_fit() {
  phase_ = Phase::full_fit;
  const std::vector<int> all = counted_to(problem_.units.size());
  const Linearization from = noise_taken_ ? present_ : rows_->of(raw_start_);
  const std::vector<int> free = free_of(all);
  BroydenFitOptions options = fit_options(from, free.size());
  if (!from.is_exact && !noise_taken_) options.refresh = free;
  running_.clear();
  run(BroydenFit(from, free, options), all, {});
}

/// Begins a fit of the units that are kept.
CoefficientSelection::Running& CoefficientSelection::run(BroydenFit fit,
                                                         const std::vector<int>& units,
                                                         const std::vector<int>& dropped) {
  const int most = fit_options(fit.best(), free_of(units).size()).most_evaluations;
  running_.push_back({std::move(fit), units, dropped});
  running_.back().most_evaluations = most;
  return running_.back();
}

void CoefficientSelection::running_observed(const std::vector<Result<Evaluated>>& evaluated) {
  for (std::size_t k = 0; k < asked_.size(); ++k) {
    Running& one = running_[asked_[k]];
    const Eigen::VectorXd u = *one.fit.wanted();
    std::optional<Evaluated> rows;
    if (evaluated[k]) rows = rows_->of(u, *evaluated[k]);
    if (one.rest.empty()) {
      one.fit.observe(rows);
      continue;
    }
    one.fit.observe(rows ? std::optional(rows->of(one.rest)) : std::nullopt);
    if (rows && one.fit.best().u == u) one.left_out = rows->r(one.out).squaredNorm();
  }
  ask();
}

/// Asks for the next points of all running fits, and continues with the next phase once they end.
void CoefficientSelection::ask() {
  while (phase_ != Phase::done) {
    wanted_.clear();
    asked_.clear();
    if (phase_ == Phase::restart_points) {
      const Eigen::VectorXd& from = problem_.restart.size() > 0 ? problem_.restart : problem_.start;
      for (const std::size_t k : restarted_) wanted_.push_back(dropped_from(from, path_[k].units));
      return;
    }
    for (std::size_t k = 0; k < running_.size(); ++k) {
      if (!running_[k].fit.wanted()) continue;
      asked_.push_back(k);
      wanted_.push_back(*running_[k].fit.wanted());
    }
    if (!wanted_.empty()) return;
    next();
    if (phase_ == Phase::start) return;  // a new pass
  }
  wanted_.clear();
}

void CoefficientSelection::next() {
  switch (phase_) {
    case Phase::full_fit:
      full_fit_done();
      break;
    case Phase::dropping:
      drop_done();
      break;
    case Phase::testing:
      tests_done();
      break;
    case Phase::restarts:
      restarts_done();
      break;
    case Phase::leaving_out:
      leaving_out_done();
      break;
    case Phase::start:
    case Phase::restart_points:
    case Phase::done:
      phase_ = Phase::done;
  }
}

void CoefficientSelection::full_fit_done() {
  if (!noise_taken_) {
    const Linearization at = running_.front().fit.best();
    if (!problem_.sigma && at.r.head(rows_->size()).norm() <=
                               kNoNoiseAtAll * std::sqrt(static_cast<double>(rows_->size()))) {
      status_ = Failure{
          "the model fits to rounding errors, which are no noise of a measurement: every "
          "coefficient would count as carried; state the noise of the experiments"};
      phase_ = Phase::done;
      return;
    }
    present_ = rows_->take_noise(at);
    noise_taken_ = true;
    begin_full_fit();
    return;
  }
  add_to_path(running_.front());
  plan_round();
}

double CoefficientSelection::noise_variance(const SelectedModel& model) const {
  if (rows_->counted().noise_known) return 1.0;
  const double left = rows_->counted().values - model.coefficients;
  return model.at.sum_of_squares() / std::max(1.0, left);
}

SelectedModel CoefficientSelection::rated(const Running& running) const {
  SelectedModel model;
  model.units = running.units;
  model.dropped = running.dropped;
  model.expected_rise = running.expected_rise;
  model.coefficients = static_cast<int>(free_of(running.units).size());
  model.at = rows_->without_prior(running.fit.best());
  model.minus_two_log = minus_two_log_likelihood(model.at.sum_of_squares(), rows_->counted());
  model.bic = latsch::bic(model.minus_two_log, model.coefficients, rows_->counted());
  model.aicc = latsch::aicc(model.minus_two_log, model.coefficients, rows_->counted());
  model.converged = running.fit.fitted() && running.fit.evaluations() < running.most_evaluations;
  model.is_flat = !running.fit.converged();
  return model;
}

void CoefficientSelection::add_to_path(const Running& running) {
  SelectedModel model = rated(running);
  model.round = static_cast<int>(path_.size());
  for (const int unit : running.dropped) fates_[static_cast<std::size_t>(unit)].round = model.round;
  present_ = running.fit.best();
  rate_units(model);
  path_.push_back(std::move(model));
}

}  // namespace latsch
