// SPDX-License-Identifier: Apache-2.0
#include "optimization/selection/coefficient_selection.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>

#include "numerics/dense/cholesky.h"
#include "optimization/problem/infinity.h"
#include "optimization/selection/drop_set.h"

namespace latsch {
namespace {

// Length of the differences at the start, in the unit cube.
constexpr double kFirstDifference = 0.01;
// Most evaluations of a fit, to which two for each variable are added if no slopes are computed.
constexpr int kEvaluationsOfASelection = 40;
// Tolerance of a fit in -2 log L. Differences of criteria are read to about one.
constexpr double kToleranceOfASelection = 0.01;
// Distance of BIC above its least at which the path ends. A smaller value ends it before all useful
// candidates have been tried, a larger one costs a refit for each of them.
constexpr double kPastTheLeast = 60.0;
// A set whose rise exceeds this multiple of the limit of a set is halved.
constexpr double kTooMuch = 2.0;
// Number of models that are refitted from the start.
constexpr std::size_t kFromStart = 3;
// Distance to a bound, as a share of the range, within which a variable counts as on the bound.
constexpr double kAtItsBound = 1e-6;
// Residuals of this size, relative to the data, are rounding errors and tell no noise.
constexpr double kNoNoiseAtAll = 1e-9;
// A dropped candidate counts as already dropped if it is this close to its value.
constexpr double kAtValue = 1e-12;
// Curvature, relative to the largest, that is added for variables which no value determines.
constexpr double kFlatCurvature = 1e-12;

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
  wanted_.push_back(problem_.start);
  for (const int i : problem_.free) {
    Eigen::VectorXd moved = problem_.start;
    moved[i] += moved[i] + kFirstDifference <= 1.0 ? kFirstDifference : -kFirstDifference;
    wanted_.push_back(moved);
  }
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
  const double variance =
      rows_->counted().noise_known
          ? 1.0
          : rows_->without_prior(path_.empty() ? at : present_).sum_of_squares() /
                rows_->counted().values;
  return {.tolerance = kToleranceOfASelection * variance,
          .most_evaluations =
              kEvaluationsOfASelection + (at.is_exact ? 0 : 2 * static_cast<int>(variables))};
}

void CoefficientSelection::observe(const std::vector<Result<Evaluated>>& evaluated) {
  if (phase_ == Phase::start) {
    start_observed(evaluated);
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
        return fail("beside the start the evaluation failed: " +
                    evaluated[k + 1].failure().reason);
      raw_start_.J.col(i) =
          (evaluated[k + 1]->r - r) / (wanted_[k + 1][i] - problem_.start[i]);
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
  running_ = {{BroydenFit(from, free, options), all, {}}};
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
    for (std::size_t k = 0; k < running_.size(); ++k) {
      if (!running_[k].fit.wanted()) continue;
      asked_.push_back(k);
      wanted_.push_back(*running_[k].fit.wanted());
    }
    if (!wanted_.empty()) return;
    next();
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
    case Phase::done:
      phase_ = Phase::done;
  }
}

void CoefficientSelection::full_fit_done() {
  if (!noise_taken_) {
    const Linearization at = running_.front().fit.best();
    if (at.r.head(rows_->size()).norm() <=
        kNoNoiseAtAll * std::sqrt(static_cast<double>(rows_->size()))) {
      status_ = Failure{
          "the model fits to rounding errors, which are no noise of a measurement: every "
          "coefficient would count as carried"};
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

bool CoefficientSelection::is_held(const Linearization& at, int variable) const {
  const double gradient = at.J.col(variable).dot(at.r), u = at.u[variable];
  return (u <= kAtItsBound && gradient > 0.0) || (u >= 1.0 - kAtItsBound && gradient < 0.0);
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
  model.converged = running.fit.converged();
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

/// Returns the covariance of the variables `inside`, with the weak prior.
namespace {

Eigen::MatrixXd covariance_of(const Linearization& at,
                              const std::vector<int>& inside,
                              double variance) {
  const auto k = std::ssize(inside);
  if (k == 0) return {};
  const Eigen::MatrixXd J = at.J(Eigen::all, inside);
  Eigen::MatrixXd M = J.transpose() * J;
  M.diagonal().array() += kFlatCurvature * M.diagonal().maxCoeff();
  return variance * numerics::PivotedCholesky(M).solve(
                        Eigen::MatrixXd(Eigen::MatrixXd::Identity(k, k)));
}

}  // namespace

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
      if (place[static_cast<std::size_t>(i)] >= 0) own.push_back(place[static_cast<std::size_t>(i)]);
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
                                       regular_places);
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
  if (refits_ >= options_.refits) {
    ending_ = SelectionEnd::refits;
    return begin_restarts();
  }
  phase_ = Phase::dropping;
  ++refits_;
  std::vector<int> kept;
  for (const int unit : path_.back().units)
    if (std::find(units.begin(), units.end(), unit) == units.end()) kept.push_back(unit);
  const std::vector<int> free = free_of(kept);
  running_ = {{BroydenFit(present_,
                          free,
                          fit_options(present_, free.size()),
                          dropped_from(present_.u, kept)),
               kept,
               units,
               expected_rise}};
}

void CoefficientSelection::drop_done() {
  const Running running = running_.front();
  const std::vector<int>& dropped = running.dropped;
  int coefficients = 0;
  for (const int unit : dropped)
    coefficients += static_cast<int>(problem_.units[static_cast<std::size_t>(unit)].size());
  const bool fitted = running.fit.fitted();
  const double rise = fitted ? rated(running).minus_two_log - path_.back().minus_two_log : kInfinity;
  if (dropped.size() > 1 && rise > kTooMuch * kRiseOfADrop * coefficients) {
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
    if (refits_ >= options_.refits) break;
    ++refits_;
    fates_[static_cast<std::size_t>(unit)].tested = true;
    std::vector<int> kept = path_.back().units;
    std::erase(kept, unit);
    const std::vector<int> free = free_of(kept);
    running_.push_back({BroydenFit(present_,
                                   free,
                                   fit_options(present_, free.size()),
                                   dropped_from(present_.u, kept)),
                        kept,
                        {unit}});
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

void CoefficientSelection::begin_restarts() {
  phase_ = Phase::restarts;
  running_.clear();
  std::vector<std::size_t> models = rivals(kInfinity);
  models.resize(std::min(models.size(), kFromStart));
  const Linearization from = rows_->of(raw_start_);
  for (const std::size_t k : models) {
    const std::vector<int> free = free_of(path_[k].units);
    running_.push_back({BroydenFit(from,
                                   free,
                                   fit_options(from, free.size()),
                                   dropped_from(from.u, path_[k].units)),
                        path_[k].units,
                        path_[k].dropped,
                        path_[k].expected_rise,
                        k});
  }
}

void CoefficientSelection::restarts_done() {
  for (const Running& running : running_) {
    if (!running.fit.fitted()) continue;
    SelectedModel model = rated(running);
    SelectedModel& before = path_[running.model];
    if (!(model.minus_two_log < before.minus_two_log - 10.0 * kToleranceOfASelection)) continue;
    model.round = before.round;
    model.is_from_start = true;
    model.rises = before.rises;
    before = std::move(model);
  }
  running_.clear();
  if (options_.criterion == SelectionCriterion::cross_validation) return begin_leaving_out();
  phase_ = Phase::done;
}

void CoefficientSelection::begin_leaving_out() {
  phase_ = Phase::leaving_out;
  running_.clear();
  const std::vector<int> recordings = rows_->recordings();
  std::set<int> names(recordings.begin(), recordings.end());
  names.erase(-1);
  for (std::size_t k = 0; names.size() > 1 && k < path_.size(); ++k) {
    const Linearization at = path_[k].at;
    const std::vector<int> free = free_of(path_[k].units);
    for (const int name : names) {
      Running fold{BroydenFit(at, {}, {}), path_[k].units, {}, 0.0, k};
      for (std::size_t row = 0; row < recordings.size(); ++row)
        (recordings[row] == name ? fold.out : fold.rest).push_back(static_cast<Eigen::Index>(row));
      // rows of the weak prior stay, because without a recording some candidate may be free
      const auto priors = rows_->of(raw_start_).r.size() - rows_->size();
      for (Eigen::Index p = 0; p < priors; ++p) fold.rest.push_back(rows_->size() + p);
      const Linearization whole = rows_->with_prior_rows(at);
      const Linearization without{
          whole.u, whole.r(fold.rest), whole.J(fold.rest, Eigen::all), whole.is_exact};
      fold.left_out = at.r(fold.out).squaredNorm();
      fold.fit = BroydenFit(without, free, fit_options(whole, free.size()));
      running_.push_back(std::move(fold));
    }
  }
}

void CoefficientSelection::leaving_out_done() {
  for (SelectedModel& model : path_) model.left_out = 0.0;
  for (const Running& running : running_) {
    double& sum = path_[running.model].left_out;
    sum = running.fit.converged() ? sum + running.left_out
                                  : std::numeric_limits<double>::quiet_NaN();
  }
  running_.clear();
  phase_ = Phase::done;
}

double CoefficientSelection::criterion(const SelectedModel& model) const {
  switch (options_.criterion) {
    case SelectionCriterion::bic:
      return model.bic;
    case SelectionCriterion::aicc:
      return model.aicc;
    case SelectionCriterion::cross_validation:
      break;
  }
  if (phase_ != Phase::done) return model.bic;  // recordings are left out at the end
  return std::isnan(model.left_out) ? kInfinity : model.left_out / noise_variance(path_.front());
}

std::size_t CoefficientSelection::best() const { return rivals(kInfinity).front(); }

std::vector<std::size_t> CoefficientSelection::rivals(double distance) const {
  std::vector<std::size_t> order(path_.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return criterion(path_[a]) < criterion(path_[b]);
  });
  if (order.empty()) return order;
  const double most = criterion(path_[order.front()]) + distance;
  std::erase_if(order, [&](std::size_t k) { return !(criterion(path_[k]) <= most); });
  return order;
}

Confidence CoefficientSelection::confidence_of(const SelectedModel& model) const {
  const std::vector<int> free = free_of(model.units);
  const Linearization part{
      model.at.u(free), model.at.r, model.at.J(Eigen::all, free), model.at.is_exact};
  ConfidenceOptions options;
  if (rows_->counted().noise_known) options.sigma = 1.0;
  return of_all_variables(latsch::confidence(part, options), free, model.at.u);
}

}  // namespace latsch
