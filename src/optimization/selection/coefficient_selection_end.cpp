// SPDX-License-Identifier: Apache-2.0
// The end of coefficient_selection.h: fits from the start, recordings left out, and the choice.
#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>

#include "optimization/problem/infinity.h"
#include "optimization/selection/coefficient_selection.h"

namespace latsch {
namespace {

// Number of models that are fitted once more, from the start.
constexpr std::size_t kFromStart = 3;
// Fall of -2 log L by which a fit from the start has to be better: fits end within a tenth of it.
constexpr double kBetterFromStart = 0.1;
// Fall from which on the path counts as that of another minimum, and largest number of passes.
constexpr double kOtherMinimum = 0.5;
constexpr int kMostPasses = 3;

}  // namespace

void CoefficientSelection::begin_restarts() {
  phase_ = Phase::restart_points;
  running_.clear();
  restarted_ = rivals(kInfinity);
  restarted_.resize(std::min(restarted_.size(), kFromStart));
}

/// Begins a fit of each of the best models at the place of the restart, with the slopes there or,
/// if the model computes none, with those of its first fit.
void CoefficientSelection::restart_points_observed(
    const std::vector<Result<Evaluated>>& evaluated) {
  phase_ = Phase::restarts;
  for (std::size_t k = 0; k < restarted_.size(); ++k) {
    const SelectedModel& model = path_[restarted_[k]];
    std::optional<Evaluated> rows;
    if (evaluated[k]) rows = rows_->of(wanted_[k], *evaluated[k]);
    if (!rows) continue;
    const Eigen::MatrixXd J = rows->has_slopes() ? rows->J : rows_->with_prior_rows(model.at).J;
    const Linearization from{wanted_[k], rows->r, J, rows->has_slopes()};
    const std::vector<int> free = free_of(model.units);
    Running& running =
        run(BroydenFit(from, free, fit_options(from, free.size())), model.units, model.dropped);
    running.expected_rise = model.expected_rise;
    running.model = restarted_[k];
  }
  ask();
}

void CoefficientSelection::restarts_done() {
  double most = kOtherMinimum;
  Eigen::VectorXd better;
  for (const Running& running : running_) {
    if (!running.fit.fitted() || passes_ >= kMostPasses) continue;
    const double fall = path_[running.model].minus_two_log - rated(running).minus_two_log;
    if (!(fall > most)) continue;
    most = fall;
    better = running.fit.best().u;
  }
  if (better.size() > 0) return begin_again(better);
  for (const Running& running : running_) {
    if (!running.fit.fitted()) continue;
    SelectedModel model = rated(running);
    SelectedModel& before = path_[running.model];
    if (!(model.minus_two_log < before.minus_two_log - kBetterFromStart)) continue;
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
  std::set<int> names;
  for (const int name : recordings)
    if (name >= 0) names.insert(name);
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
      const BroydenFitOptions options = fit_options(whole, free.size());
      fold.fit = BroydenFit(without, free, options);
      fold.most_evaluations = options.most_evaluations;
      running_.push_back(std::move(fold));
    }
  }
}

void CoefficientSelection::leaving_out_done() {
  for (SelectedModel& model : path_) model.left_out = 0.0;
  for (const Running& running : running_) {
    double& sum = path_[running.model].left_out;
    const bool ended = running.fit.fitted() && running.fit.evaluations() < running.most_evaluations;
    sum = ended ? sum + running.left_out : std::numeric_limits<double>::quiet_NaN();
  }
  running_.clear();
  phase_ = Phase::done;
  if (std::all_of(path_.begin(), path_.end(), [](const auto& m) { return std::isnan(m.left_out); }))
    status_ = Failure{
        "no model could be fitted without each of the recordings in turn, so nothing tells how "
        "well one predicts: use the criterion \"bic\""};
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
