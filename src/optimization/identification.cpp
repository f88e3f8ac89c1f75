// SPDX-License-Identifier: Apache-2.0
#include "optimization/identification.h"

#include <cassert>
#include <cmath>
#include <numeric>

namespace latsch {
namespace {

// Refits and rungs need not be better than this share of the threshold.
constexpr double kTolerance = 0.02;
constexpr int kEvaluationsOfTheRefit = 30;

std::vector<double> numbers(const Eigen::VectorXd& u) { return {u.begin(), u.end()}; }

}  // namespace

Identification::Identification(const DesignSpace& space,
                               const DesignPoint& point,
                               const IdentificationOptions& options)
    : space_(space), options_(options), wanted_(difference_points(space, point, options.step)) {}

void Identification::observe(const std::vector<Result<Eigen::VectorXd>>& residuals) {
  assert(residuals.size() == wanted_.size() && !wanted_.empty());
  if (!at_) {
    differences_observed(residuals);
  } else if (refit_) {
    refit_observed(used(residuals.front()));
  } else {
    for (size_t k = 0; k < asked_.size(); ++k) branches_[asked_[k]].observe(used(residuals[k]));
    ask_branches();
  }
}

std::optional<Eigen::VectorXd> Identification::used(
    const Result<Eigen::VectorXd>& residuals) const {
  if (!residuals) return std::nullopt;
  const Eigen::VectorXd rows = (*residuals)(rows_);
  return rows.allFinite() ? std::optional(rows) : std::nullopt;
}

void Identification::differences_observed(const std::vector<Result<Eigen::VectorXd>>& residuals) {
  std::vector<Eigen::VectorXd> all;
  for (const auto& r : residuals) {
    if (!r) {
      failure_ = Failure{"beside the point the evaluation failed: " + r.failure().reason};
      wanted_.clear();
      return;
    }
    all.push_back(*r);
  }
  rows_ = known_residuals(all);
  if (rows_.empty()) {
    failure_ = Failure{"no residual is known at the point and beside it"};
    wanted_.clear();
    return;
  }
  for (Eigen::VectorXd& r : all) r = Eigen::VectorXd(r(rows_));
  options_.confidence.traits = options_.confidence.traits.of(rows_);
  at_ = differences(space_, wanted_, all);
  confidence_ = latsch::confidence(*at_, options_.confidence);
  wanted_.clear();
  if (!options_.profiles || !std::isfinite(confidence_->sigma)) return;
  std::vector<int> every(space_.size());
  std::iota(every.begin(), every.end(), 0);
  refit_.emplace(*at_,
                 every,
                 RefitOptions{.tolerance = kTolerance * confidence_->threshold(),
                              .most_evaluations = kEvaluationsOfTheRefit,
                              .region = FeasibleRegion(space_)});
  if (refit_->wanted()) {
    wanted_ = {space_.from_unit(numbers(*refit_->wanted()))};
  } else {
    begin_profiles();
  }
}

void Identification::refit_observed(const std::optional<Eigen::VectorXd>& residuals) {
  refit_->observe(residuals);
  if (refit_->wanted()) {
    wanted_ = {space_.from_unit(numbers(*refit_->wanted()))};
  } else {
    begin_profiles();
  }
}

void Identification::begin_profiles() {
  best_ = refit_->best();
  refit_.reset();
  const Confidence at_best = latsch::confidence(*best_, options_.confidence);
  thresholds_ = at_best.thresholds;
  const ProfileSettings settings{FeasibleRegion(space_), {}};
  for (int i = 0; i < space_.size(); ++i) {
    const Interval& interval = at_best.intervals[i];
    const double half = std::min(interval.upper - best_->u[i], best_->u[i] - interval.lower);
    for (int direction : {-1, +1}) {
      branches_.emplace_back(*best_, i, direction, half, thresholds_[i], settings);
    }
  }
  ask_branches();
}

void Identification::ask_branches() {
  wanted_.clear();
  asked_.clear();
  for (size_t b = 0; b < branches_.size(); ++b) {
    const auto u = branches_[b].wanted();
    if (!u) continue;
    asked_.push_back(static_cast<int>(b));
    wanted_.push_back(space_.from_unit(numbers(*u)));
  }
  if (!wanted_.empty()) return;
  for (int i = 0; i < space_.size(); ++i) {
    profiles_.push_back(judge(*best_, i, branches_[2 * i], branches_[2 * i + 1], thresholds_[i]));
  }
}

}  // namespace latsch
