// SPDX-License-Identifier: Apache-2.0
#include "correlation/target/tire_trials.h"

#include <cmath>
#include <numeric>
#include <optional>

#include "correlation/study/variables.h"
#include "correlation/target/predictions.h"
#include "experiment/rigs/tire_rig.h"

namespace latsch::correlation {

using fe_tire::FeTire;

TireTrials::TireTrials(const Study& study) : study_(study) {}

FeTire& TireTrials::tire_at(const DesignPoint& point) {
  const auto description = fe_tire::read_tire(at(study_.model, study_.space, point).root());
  fe_tire::Materials materials = fe_tire::build_materials(description);
  if (tire_ && fe_tire::same_mesh(*description_, description)) {
    tire_->set(std::move(materials));
  } else {
    fe_tire::SolverSettings settings;
    settings.element = description.element;
    tire_.emplace(fe_tire::build_mesh(description), std::move(materials), settings);
  }
  description_ = description;
  return *tire_;
}

Result<Channels> TireTrials::run(const DesignPoint& point, bool predicted) {
  std::vector<const StudyExperiment*> experiments;
  std::vector<experiment::LoadCase> cases;
  for (const StudyExperiment& experiment : study_.experiments) {
    if (!experiment.fitted && !predicted) continue;
    experiments.push_back(&experiment);
    cases.push_back(experiment.load_case);
  }
  std::vector<Result<Channels>> results;
  try {
    results = experiment::run(tire_at(point), cases);
  } catch (const InputError& error) {  // the bounds were checked one by one, not every combination
    return Failure{std::string("the model does not accept this point: ") + error.what()};
  }
  Channels all;
  for (size_t e = 0; e < results.size(); ++e) {
    if (!results[e]) return results[e].failure();
    for (Channel channel : results[e]->all()) {
      channel.name = experiments[e]->name + "/" + channel.name;
      all.add(std::move(channel));
    }
  }
  return all;
}

namespace {

/// A trial that leaves too little behind for an experiment has failed.
Result<Channels> checked(Result<Channels> channels,
                         const std::vector<StudyExperiment>& experiments) {
  for (const StudyExperiment& experiment : experiments) {
    if (!channels) break;
    const auto simulated = simulated_curve(*experiment.curve, *channels);
    if (!simulated) channels = Failure(simulated.failure());
  }
  return channels;
}

Evaluator simulator_trials(const Study& study) {
  const Evaluator program = evaluator(*study.simulator, study.space);
  return [program, experiments = study.experiments](const DesignPoint& point) {
    return checked(program(point), experiments);
  };
}

Evaluator rolling_trials(const Study& study) {
  std::vector<StudyExperiment> fitted;
  for (const StudyExperiment& experiment : study.experiments) {
    if (experiment.fitted) fitted.push_back(experiment);
  }
  return [study, fitted, tests = tests_asked_for(study)](
             const DesignPoint& point) -> Result<Channels> {
    try {
      return checked(correlation::run(*study.rolling, at(study.model, study.space, point), tests),
                     fitted);
    } catch (const InputError& error) {  // as of a tire of finite elements
      return Failure{std::string("the model does not accept this point: ") + error.what()};
    }
  };
}

}  // namespace

Evaluator evaluator(const Study& study) {
  if (study.simulator) return simulator_trials(study);
  if (study.rolling) return rolling_trials(study);
  return [trials = std::make_shared<TireTrials>(study)](const DesignPoint& point) {
    return trials->run(point);
  };
}

Result<Channels> simulate_all(const Study& study, const DesignPoint& point) {
  if (study.has_fe_tire()) return TireTrials(study).run(point, /*predicted=*/true);
  return evaluate(evaluator(study.rolling ? with_predictions(study) : study), point).result;
}

Channels channels_of(const StudyExperiment& experiment, const Channels& trial) {
  if (experiment.curve) return trial;
  const std::string prefix = experiment.name + "/";
  Channels own;
  for (Channel channel : trial.all()) {
    if (!channel.name.starts_with(prefix)) continue;
    channel.name.erase(0, prefix.size());
    own.add(std::move(channel));
  }
  return own;
}

namespace {

/// The deviation that all values together have in the mean of their weights 1 / sigma^2; nullopt
/// where noise is not stated.
std::optional<double> common_deviation(const std::vector<StudyExperiment>& fitted) {
  double weights = 0.0, count = 0.0;
  for (const StudyExperiment& experiment : fitted) {
    if (!(experiment.objective.weight > 0.0)) continue;
    if (!experiment.noise) return std::nullopt;
    for (const double sigma : stated_deviations(experiment)) {
      weights += 1.0 / (sigma * sigma);
      count += 1.0;
    }
  }
  return std::sqrt(count / weights);
}

/// Differences as the fit counts them: by their noise, so that one of common deviation keeps its
/// size, and less where a robust loss finds them far off.
void weigh(const StudyExperiment& experiment,
           const std::optional<double>& common,
           Comparison& comparison) {
  if (!common && experiment.loss.loss == Loss::squares) return;
  const std::vector<double> sigma = stated_deviations(experiment);
  comparison.value = 0.0;
  for (size_t k = 0; k < comparison.differences.size(); ++k) {
    double& d = comparison.differences[k];
    d = common && !sigma.empty() ? *common * experiment.loss(d / sigma[k]) : experiment.loss(d);
    comparison.value += std::pow(std::abs(d), experiment.objective.exponent);
  }
  comparison.value /= static_cast<double>(comparison.differences.size());
}

/// Each as one value more.
void add_priors(const DesignSpace& space,
                const DesignPoint& point,
                double common,
                const std::vector<double>& weights,
                double exponent,
                Score& score) {
  const double total = std::accumulate(weights.begin(), weights.end(), 0.0);
  for (int i = 0; i < space.size(); ++i) {
    if (!space[i].prior) continue;
    const double d = common * space[i].prior->residual(point.values[static_cast<size_t>(i)]);
    score.value += std::pow(std::abs(d), exponent) / total;
    score.residuals.push_back(d / std::sqrt(total));
  }
}

std::vector<StudyExperiment> fitted_of(const Study& study) {
  std::vector<StudyExperiment> fitted;
  for (const StudyExperiment& experiment : study.experiments) {
    if (experiment.fitted) fitted.push_back(experiment);
  }
  return fitted;
}

}  // namespace

double noise_alone(const Study& study) {
  const std::vector<StudyExperiment> fitted = fitted_of(study);
  const auto common = common_deviation(fitted);
  if (!common) return 0.0;
  double mean = 0.0, variance = 0.0;
  for (const StudyExperiment& experiment : fitted) {
    const double w = experiment.objective.weight, N = static_cast<double>(experiment.values());
    if (w > 0.0 && experiment.loss.loss != Loss::squares) return 0.0;
    mean += w * N;
    variance += 2.0 * w * w * N;
  }
  return mean > 0.0 ? *common * *common * (1.0 + 2.0 * std::sqrt(variance) / mean) : 0.0;
}

Objective objective(const Study& study) {
  const std::vector<StudyExperiment> fitted = fitted_of(study);
  const auto common = common_deviation(fitted);
  std::vector<double> weights;  // with noise every value counts, not every experiment
  for (const StudyExperiment& experiment : fitted) {
    const double values = common ? static_cast<double>(experiment.values()) : 1.0;
    weights.push_back(experiment.objective.weight * values);
  }
  return Objective::OfTrial(
      [fitted, weights, common, space = study.space, constraints = study.constraints](
          const DesignPoint& point, const Channels& channels) -> Result<Score> {
        std::vector<Comparison> comparisons;
        Score score;
        for (const StudyExperiment& experiment : fitted) {
          if (experiment.curve) {  // a measurement may have grown since the trial
            const auto simulated = simulated_curve(*experiment.curve, channels);
            if (!simulated) return simulated.failure();
          }
          comparisons.push_back(compare(experiment, channels_of(experiment, channels)));
          weigh(experiment, common, comparisons.back());
        }
        score.value = target(comparisons, weights);
        score.residuals = weighted_residuals(comparisons, weights);
        if (common)
          add_priors(space, point, *common, weights, fitted.front().objective.exponent, score);
        for (const Comparison& comparison : comparisons) {
          score.stand_ins += static_cast<int>(comparison.pairing.missing.size());
        }
        for (const ChannelConstraint& constraint : constraints) {
          if (auto failure = apply(constraint, channels, score)) return *failure;
        }
        return score;
      });
}

}  // namespace latsch::correlation
