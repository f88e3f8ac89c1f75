// SPDX-License-Identifier: Apache-2.0
#include "optimization/selection/selection_rows.h"

#include <algorithm>
#include <cmath>

#include "optimization/problem/point_vector.h"

namespace latsch {
namespace {

/// 1 / standard deviation of a number anywhere in its range.
const double kOfARange = std::sqrt(12.0);

// Spread of the rows below which they are rounding errors, in which no neighbors share noise: as a
// share of stated noise, and relative to the data without it.
constexpr double kNoNoiseBesideStated = 1e-3, kNoNoiseOfAnyLaboratory = 1e-5;

/// Returns the columns of J that may move.
Eigen::MatrixXd moving_columns(const Eigen::MatrixXd& J, const std::vector<int>& free) {
  if (free.empty()) return J;
  return J(Eigen::all, free);
}

}  // namespace

SelectionRows::SelectionRows(const SelectionProblem& problem, const Linearization& start)
    : problem_(problem) {
  const auto counts = [&](Eigen::Index row) {
    if (!std::isfinite(start.r[row]) || !start.J.row(row).allFinite()) return false;
    if (problem.recordings.empty() || problem.fitted.empty()) return true;
    int own = problem.recordings[static_cast<std::size_t>(row)];
    if (own < -1) own = -2 - own;
    return own < 0 ||
           std::find(problem.fitted.begin(), problem.fitted.end(), own) != problem.fitted.end();
  };
  for (Eigen::Index row = 0; row < start.r.size(); ++row)
    if (counts(row)) rows_.push_back(row);
  traits_ = problem.traits.of(rows_);
  deviations_ = Eigen::VectorXd::Ones(size());
  if (!traits_.deviations.empty()) deviations_ = to_vector(traits_.deviations);
  deviations_ *= problem.sigma.value_or(1.0);
  traits_.deviations.clear();
  for (const auto& unit : problem.units)
    candidates_.insert(candidates_.end(), unit.begin(), unit.end());
  std::sort(candidates_.begin(), candidates_.end());
  const std::vector<int> own = recordings();
  counted_.values =
      static_cast<double>(std::count_if(own.begin(), own.end(), [](int r) { return r >= 0; }));
  counted_.independent = counted_.values;
  counted_.noise_known = problem.sigma.has_value();
  // the part of the residuals that no variable explains, so a start far off does not count as noise
  const double spread =
      ResidualNoise(whitened(start.r(rows_)),
                    moving_columns(whitened(start.J(rows_, Eigen::all)), problem.free),
                    {.solved = traits_.solved})
          .sigma();
  prior_scale_ = kOfARange * (problem.sigma ? 1.0 : spread);
}

double SelectionRows::variance() const {
  return counted_.noise_known ? 1.0 : std::pow(prior_scale_ / kOfARange, 2);
}

bool SelectionRows::is_determined() const { return std::isfinite(prior_scale_); }

Linearization SelectionRows::take_noise(const Linearization& fit) {
  const Linearization own_rows = without_prior(fit);
  noise_.emplace(own_rows.r,
                 moving_columns(own_rows.J, problem_.free),
                 traits_,
                 problem_.sigma ? kNoNoiseBesideStated : kNoNoiseOfAnyLaboratory);
  const double nu = noise_->freedom(), seen = noise_->sigma();
  if (problem_.sigma && nu > 0.0 && seen * seen > rare_ratio(nu)) {
    excess_ = seen;
    counted_.noise_known = false;
  }
  if (!counted_.noise_known) prior_scale_ = kOfARange * seen;
  const Eigen::VectorXd shared = noise_->effective_deviations();
  const std::vector<int> own = recordings();
  counted_.independent = 0.0;
  for (std::size_t k = 0; k < rows_.size(); ++k)
    if (own[k] >= 0)
      counted_.independent += 1.0 / std::pow(shared[static_cast<Eigen::Index>(k)], 2);
  const Evaluated rows =
      with_prior(fit.u, noise_->whitened(own_rows.r), noise_->whitened(own_rows.J));
  return {fit.u, rows.r, rows.J, fit.is_exact};
}

std::vector<int> SelectionRows::recordings() const {
  std::vector<int> own;
  for (const Eigen::Index row : rows_)
    own.push_back(problem_.recordings.empty() ? 0
                                              : problem_.recordings[static_cast<std::size_t>(row)]);
  return own;
}

Eigen::MatrixXd SelectionRows::whitened(const Eigen::MatrixXd& rows) const {
  const Eigen::MatrixXd own = deviations_.cwiseInverse().asDiagonal() * rows;
  return noise_ ? noise_->whitened(own) : own;
}

Evaluated SelectionRows::with_prior(const Eigen::VectorXd& u,
                                    const Eigen::VectorXd& r,
                                    const Eigen::MatrixXd& J) const {
  const auto priors = std::ssize(candidates_);
  Eigen::VectorXd all(size() + priors);
  all << r, prior_scale_ * (u - problem_.toward)(candidates_);
  if (J.size() == 0) return {all};
  Eigen::MatrixXd slopes = Eigen::MatrixXd::Zero(all.size(), J.cols());
  slopes.topRows(size()) = J;
  for (Eigen::Index k = 0; k < priors; ++k)
    slopes(size() + k, candidates_[static_cast<std::size_t>(k)]) = prior_scale_;
  return {all, slopes};
}

std::optional<Evaluated> SelectionRows::of(const Eigen::VectorXd& u, const Evaluated& raw) const {
  const Eigen::VectorXd own = raw.r(rows_);
  if (!own.allFinite()) return std::nullopt;
  if (!raw.has_slopes()) return with_prior(u, whitened(own), {});
  return with_prior(u, whitened(own), whitened(raw.J(rows_, Eigen::all)));
}

Linearization SelectionRows::of(const Linearization& raw) const {
  const auto rows = of(raw.u, Evaluated(raw.r, raw.J));
  return {raw.u, rows->r, rows->J, raw.is_exact};
}

Linearization SelectionRows::with_prior_rows(const Linearization& at) const {
  const Evaluated rows = with_prior(at.u, at.r, at.J);
  return {at.u, rows.r, rows.J, at.is_exact};
}

Linearization SelectionRows::without_prior(const Linearization& at) const {
  return {at.u, at.r.head(size()), at.J.topRows(size()), at.is_exact};
}

}  // namespace latsch
