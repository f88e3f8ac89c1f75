// SPDX-License-Identifier: Apache-2.0
#include "correlation/target/residuals.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/units.h"
#include "correlation/observable/curve.h"
#include "correlation/target/compared_trial.h"
#include "correlation/target/study_trials.h"
#include "optimization/problem/point_vector.h"

namespace latsch::correlation {
namespace {

std::vector<StudyExperiment> counting(const Study& study) {
  std::vector<StudyExperiment> experiments;
  std::copy_if(
      study.experiments.begin(), study.experiments.end(), std::back_inserter(experiments), counts);
  return experiments;
}

double mean_count(const std::vector<StudyExperiment>& experiments) {
  double sum = 0.0;
  for (const StudyExperiment& experiment : experiments)
    sum += static_cast<double>(experiment.values());
  return sum / static_cast<double>(experiments.size());
}

/// Returns the standard deviation of a residual in units of the common spread.
double spread_of(const StudyExperiment& experiment, double mean) {
  return experiment.noise ? std::sqrt(experiment.objective.weight)
                          : std::sqrt(mean / static_cast<double>(experiment.values()));
}

/// Returns the factor between a residual and d / sigma, or d if no noise is stated.
double factor_of(const StudyExperiment& experiment, double mean) {
  const double weight = std::sqrt(experiment.objective.weight);
  return experiment.noise ? weight : weight * spread_of(experiment, mean);
}

/// Returns the slopes of the measured curve over its abscissa, by differences to the neighbors.
Eigen::VectorXd measured_slopes(const Curve& curve) {
  const auto& x = curve.measured().x_compared;
  const auto& y = curve.measured().y_compared;
  Eigen::VectorXd slopes = Eigen::VectorXd::Zero(std::ssize(y));
  if (x.size() != y.size()) return slopes;
  for (std::size_t i = 0; i < y.size(); ++i) {
    const std::size_t before = i == 0 ? 0 : i - 1, after = std::min(i + 1, y.size() - 1);
    if (x[after] > x[before])
      slopes[static_cast<Eigen::Index>(i)] = (y[after] - y[before]) / (x[after] - x[before]);
  }
  return slopes;
}

/// True if the curve is compared about its mean, which every trial solves as an offset.
bool takes_means(const Curve* curve) {
  return curve && curve->measured().comparison.what == ComparedCurve::about_mean;
}

/// Returns the changes of an experiment's differences d by the nuisance numbers that every trial
/// solves, one column each. A fit follows the measured values, so these stand for the simulated
/// ones.
Eigen::MatrixXd solved_changes(const StudyExperiment& experiment) {
  if (!experiment.nuisance.held.empty()) return {};
  const auto* curve = dynamic_cast<const Curve*>(experiment.observable.get());
  const bool curve_solves_delay = curve && curve->measured().fits_delay;
  const bool removes_mean = takes_means(curve);
  const Eigen::VectorXd measured = to_vector(experiment.observable->measured_values());
  const auto& numbers = experiment.nuisance.numbers;
  Eigen::MatrixXd changes(
      measured.size(), std::ssize(numbers) + (curve_solves_delay ? 1 : 0) + (removes_mean ? 1 : 0));
  for (std::size_t k = 0; k < numbers.size(); ++k) {
    const auto column = static_cast<Eigen::Index>(k);
    switch (numbers[k].kind) {
      case NuisanceKind::offset:
        changes.col(column).setConstant(-1.0);
        break;
      case NuisanceKind::gain:
        changes.col(column) = -measured;
        break;
      case NuisanceKind::delay:
      case NuisanceKind::x_offset:
        changes.col(column) = measured_slopes(*curve);
        break;
    }
  }
  if (curve_solves_delay) changes.col(std::ssize(numbers)) = measured_slopes(*curve);
  if (removes_mean) changes.rightCols(1).setConstant(-1.0);
  return to_vector(experiment.observable->scales()).cwiseInverse().asDiagonal() * changes;
}

/// True for a spectral density whose noise is not stated.
bool is_density(const StudyExperiment& experiment) {
  const auto* curve = dynamic_cast<const Curve*>(experiment.observable.get());
  return curve && !experiment.noise && curve->measured().comparison.what == ComparedCurve::psd;
}

/// Returns the deviations of an experiment's differences relative to their root mean square. Those
/// of a spectral density S without stated noise are as sqrt(S): white noise of density N that is
/// added to a signal changes a line of the signal by some sqrt(2 S N). Neighboring lines count as
/// independent.
std::vector<double> shapes_of_deviations(const StudyExperiment& experiment) {
  std::vector<double> shapes(experiment.values(), 1.0);
  if (!is_density(experiment)) return shapes;
  constexpr double kLeast = 1e-6;  // share of the largest line, for lines that are 0
  const auto& curve = dynamic_cast<const Curve&>(*experiment.observable);
  const std::vector<double>& density = curve.measured().y_compared;
  const double largest = *std::max_element(density.begin(), density.end());
  double sum = 0.0;
  for (const double line : density) sum += std::max(line, kLeast * largest);
  for (std::size_t k = 0; k < shapes.size(); ++k)
    shapes[k] = std::sqrt(std::max(density[k], kLeast * largest) *
                          static_cast<double>(density.size()) / sum);
  return shapes;
}

/// Returns the group of residuals whose spread is estimated from them alone; -1: none, because
/// the noise is stated, or all experiments count alike and share one spread.
int group_of(const StudyExperiment& experiment, std::size_t e) {
  return experiment.estimates_noise && experiment.noise ? static_cast<int>(e) : -1;
}

/// Returns how many nuisance numbers with a prior are counted with experiment `e`.
int priors_of(const std::vector<StudyExperiment>& experiments, std::size_t e) {
  int count = 0;
  for (const std::size_t k : counted_numbers(experiments, e))
    if (!experiments[e].nuisance.numbers[k].is_free()) ++count;
  return count;
}

/// Returns the changes of all residuals by each nuisance number that every trial solves.
std::vector<Eigen::VectorXd> solved_changes(const std::vector<StudyExperiment>& experiments,
                                            double mean,
                                            std::size_t residuals) {
  std::vector<Eigen::VectorXd> all;
  std::vector<std::pair<NuisanceNumber, std::size_t>> shared;  // with their places in `all`
  Eigen::Index row = 0, prior = 0;
  for (const StudyExperiment& experiment : experiments)
    prior += static_cast<Eigen::Index>(experiment.values());
  for (std::size_t e = 0; e < experiments.size(); ++e) {
    const StudyExperiment& experiment = experiments[e];
    const std::vector<double> sigma = stated_deviations(experiment);
    Eigen::MatrixXd own = factor_of(experiment, mean) * solved_changes(experiment);
    if (!sigma.empty() && own.cols() > 0) own = to_vector(sigma).cwiseInverse().asDiagonal() * own;
    const auto& numbers = experiment.nuisance.numbers;
    for (Eigen::Index k = 0; k < own.cols(); ++k) {
      const NuisanceNumber* number =
          k < std::ssize(numbers) ? &numbers[static_cast<std::size_t>(k)] : nullptr;
      const auto known = std::find_if(shared.begin(), shared.end(), [&](const auto& one) {
        return number && one.first.is_one_with(*number);
      });
      if (known != shared.end()) {
        all[known->second].segment(row, own.rows()) = own.col(k);
        continue;
      }
      if (number && number->is_shared()) shared.emplace_back(*number, all.size());
      Eigen::VectorXd& changes = all.emplace_back(Eigen::VectorXd::Zero(residuals));
      changes.segment(row, own.rows()) = own.col(k);
      if (number && !number->is_free()) changes[prior++] = 1.0 / number->prior;
    }
    if (own.cols() == 0) prior += priors_of(experiments, e);
    row += static_cast<Eigen::Index>(experiment.values());
  }
  return all;
}

}  // namespace

int solved_numbers(const Study& study, std::size_t e) {
  const StudyExperiment& experiment = study.experiments[e];
  if (!experiment.nuisance.held.empty()) return 0;
  const auto* curve = dynamic_cast<const Curve*>(experiment.observable.get());
  return static_cast<int>(counted_numbers(study.experiments, e).size()) +
         (curve && curve->measured().fits_delay ? 1 : 0) + (takes_means(curve) ? 1 : 0);
}

ResidualTraits residual_traits(const Study& study) {
  const auto experiments = counting(study);
  const double mean = mean_count(experiments);
  ResidualTraits traits;
  for (size_t e = 0; e < experiments.size(); ++e) {
    const size_t count = experiments[e].values();
    for (const double shape : shapes_of_deviations(experiments[e]))
      traits.deviations.push_back(shape * spread_of(experiments[e], mean));
    traits.curves.insert(traits.curves.end(),
                         count,
                         experiments[e].observable->is_sweep() && !is_density(experiments[e])
                             ? static_cast<int>(e)
                             : -1);
    traits.groups.insert(traits.groups.end(), count, group_of(experiments[e], e));
    RobustLoss loss = experiments[e].loss;
    loss.scale *= factor_of(experiments[e], mean);
    traits.losses.insert(traits.losses.end(), count, loss);
  }
  int nuisance_priors = 0;
  for (std::size_t e = 0; e < experiments.size(); ++e) nuisance_priors += priors_of(experiments, e);
  for (int k = 0; k < nuisance_priors; ++k) {
    traits.deviations.push_back(1.0);
    traits.curves.push_back(-1);
    traits.losses.emplace_back();
    traits.groups.push_back(-1);
  }
  for (const DesignVariable& variable : study.space.variables()) {
    if (!variable.prior) continue;
    traits.deviations.push_back(1.0);
    traits.curves.push_back(-1);
    traits.losses.emplace_back();
    traits.groups.push_back(-1);
  }
  traits.solved = solved_changes(experiments, mean, traits.deviations.size());
  return traits;
}

std::optional<double> residual_sigma(const Study& study) {
  const bool stated =
      std::all_of(study.experiments.begin(), study.experiments.end(), [](const auto& e) {
        return !counts(e) || (e.noise && !e.estimates_noise);
      });
  return stated ? std::optional(1.0) : std::nullopt;
}

Objective residual_objective(const Study& study) {
  const auto experiments = counting(study);
  const double mean = mean_count(experiments);
  return Objective::OfTrial([experiments, mean, space = study.space](
                                const DesignPoint& point,
                                const Channels& channels) -> Result<Score> {
    auto comparisons = compare_all(experiments, channels);
    if (!comparisons) return comparisons.failure();
    Score score;
    bool has_slopes = true;
    for (std::size_t e = 0; e < experiments.size(); ++e) {
      const StudyExperiment& experiment = experiments[e];
      Comparison& comparison = (*comparisons)[e];
      for (int missing : comparison.pairing.missing) {
        comparison.differences[missing] = std::numeric_limits<double>::quiet_NaN();
      }
      scale_by_noise(
          comparison, stated_deviations(experiment), experiment.loss, factor_of(experiment, mean));
      has_slopes = has_slopes && !comparison.slopes.empty();
      for (const double r : comparison.differences) {
        score.residuals.push_back(r);
        if (std::isfinite(r)) score.value += r * r;
      }
      score.jacobian.insert(
          score.jacobian.end(), comparison.slopes.begin(), comparison.slopes.end());
    }
    for (std::size_t e = 0; e < experiments.size(); ++e) {
      for (const NuisancePrior& prior : nuisance_priors(experiments, e, (*comparisons)[e])) {
        score.residuals.push_back(prior.residual);
        score.value += prior.residual * prior.residual;
        score.jacobian.insert(score.jacobian.end(), prior.slopes.begin(), prior.slopes.end());
      }
    }
    for (const PriorResidual& prior : prior_residuals(space, point)) {
      score.residuals.push_back(prior.residual);
      score.value += prior.residual * prior.residual;
      for (int j = 0; j < space.size(); ++j)
        score.jacobian.push_back(prior.variable == j ? prior.slope : 0.0);
    }
    if (!has_slopes) score.jacobian.clear();
    return score;
  });
}

double difference_of(const Study& study, int experiment, double residual) {
  const StudyExperiment& of = study.experiments[static_cast<size_t>(experiment)];
  const double weighted = residual / std::sqrt(of.objective.weight);
  if (!of.noise) return weighted / spread_of(of, mean_count(counting(study)));
  double squares = 0.0;
  const std::vector<double> sigma = stated_deviations(of);
  for (const double one : sigma) squares += one * one;
  return weighted * std::sqrt(squares / static_cast<double>(sigma.size()));
}

std::vector<ResidualRow> residual_rows(const Study& study) {
  std::vector<ResidualRow> rows;
  const double mean = mean_count(counting(study));
  for (size_t e = 0; e < study.experiments.size(); ++e) {
    const StudyExperiment& experiment = study.experiments[e];
    if (!counts(experiment)) continue;
    const std::vector<double> sigma = stated_deviations(experiment);
    const auto names = experiment.observable->rows();
    for (size_t k = 0; k < names.size(); ++k)
      rows.push_back({static_cast<int>(e),
                      names[k],
                      (sigma.empty() ? 1.0 : sigma[k]) / factor_of(experiment, mean)});
  }
  for (size_t e = 0; e < study.experiments.size(); ++e) {
    if (!counts(study.experiments[e])) continue;
    for (const std::size_t k : counted_numbers(study.experiments, e)) {
      const NuisanceNumber& number = study.experiments[e].nuisance.numbers[k];
      if (number.is_free()) continue;
      const std::string of = number.is_shared() ? "" : " of " + study.experiments[e].name;
      rows.push_back({-1, "prior of " + number.name() + of, 1.0, static_cast<int>(e)});
    }
  }
  for (const DesignVariable& variable : study.space.variables()) {
    if (variable.prior) rows.push_back({-1, "prior of " + variable.name});
  }
  return rows;
}

std::size_t prior_count(const Study& study) {
  const auto& variables = study.space.variables();
  auto count = static_cast<std::size_t>(std::count_if(
      variables.begin(), variables.end(), [](const auto& v) { return v.prior.has_value(); }));
  for (std::size_t e = 0; e < study.experiments.size(); ++e)
    if (counts(study.experiments[e]))
      count += static_cast<std::size_t>(priors_of(study.experiments, e));
  return count;
}

}  // namespace latsch::correlation
