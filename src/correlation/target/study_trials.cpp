// SPDX-License-Identifier: Apache-2.0
#include "correlation/target/study_trials.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <mutex>
#include <numeric>

#include "correlation/study/study_slopes.h"
#include "correlation/target/compared_trial.h"
#include "correlation/target/predictions.h"
#include "correlation/target/weighing.h"

namespace latsch::correlation {
namespace {

/// Keeps specimens of earlier points, whose work the next specimens can reuse.
class Reuse {
 public:
  std::unique_ptr<experiment::Specimen> take() {
    const std::lock_guard lock(mutex_);
    if (idle_.empty()) return nullptr;
    auto one = std::move(idle_.back());
    idle_.pop_back();
    return one;
  }
  void give_back(std::unique_ptr<experiment::Specimen> one) {
    const std::lock_guard lock(mutex_);
    idle_.push_back(std::move(one));
  }

 private:
  std::mutex mutex_;
  std::vector<std::unique_ptr<experiment::Specimen>> idle_;
};

class StudyTrials {
 public:
  explicit StudyTrials(const Study& study) : study_(study), moved_(study.space) {
    const auto asked = tests_asked_for(study);
    for (const StudyTest& test : study.tests) {
      if (std::find(asked.begin(), asked.end(), test.name) == asked.end()) continue;
      tests_.push_back({test, moved_.asked_of(study, test)});
    }
  }

  Result<Channels> run(const DesignPoint& point) {
    std::unique_ptr<experiment::Specimen> specimen;
    try {  // the reader of the study checked each bound separately, not every combination of values
      specimen = study_.specimens->at(study_, point, reuse_.take());
    } catch (const InputError& error) {
      return Failure{std::string("the model does not accept this point: ") + error.what()};
    }
    Channels trial;
    for (const auto& [test, slopes] : tests_) {
      auto recording = recorded(test, slopes, *specimen);
      if (!recording) {
        reuse_.give_back(std::move(specimen));
        return recording;
      }
      for (Channel channel : recording->all()) {
        if (!channel.slopes.empty()) channel.slopes = moved_.in_variables(channel.slopes);
        if (!test.name.empty()) channel.name = test.name + "/" + channel.name;
        trial.add(std::move(channel));
      }
    }
    reuse_.give_back(std::move(specimen));
    // The objective decides later whether the trial can be compared, because a study may be
    // corrected after the trial.
    return trial;
  }

 private:
  struct AskedTest {
    StudyTest test;
    experiment::Asked slopes;
  };

  Result<Channels> recorded(const StudyTest& test,
                            const experiment::Asked& slopes,
                            experiment::Specimen& specimen) const {
    auto recording = [&]() -> Result<Channels> {
      try {
        if (!study_.asks_slopes) return test.test->run(specimen);
        return test.test->run_with_slopes(specimen, slopes);
      } catch (const InputError& error) {
        return Failure{std::string("the model does not accept this point: ") + error.what()};
      }
    }();
    if (recording || test.name.empty()) return recording;
    return Failure{test.in_words() + ": " + recording.failure().reason, recording.failure().cause};
  }

  Study study_;
  MovedNumbers moved_;
  std::vector<AskedTest> tests_;
  Reuse reuse_;
};

}  // namespace

Evaluator evaluator(const Study& study) {
  return [trials = std::make_shared<StudyTrials>(study)](const DesignPoint& point) {
    return trials->run(point);
  };
}

Result<Channels> simulate_all(const Study& study, const DesignPoint& point) {
  return evaluate(evaluator(with_predictions(study)), point).result;
}

namespace {

/// Adds the priors of nuisance numbers, each as one more value.
void add_nuisance_priors(const std::vector<StudyExperiment>& experiments,
                         const std::vector<Comparison>& comparisons,
                         double common,
                         const std::vector<double>& weights,
                         double exponent,
                         Score& score) {
  const double total = std::accumulate(weights.begin(), weights.end(), 0.0);
  for (std::size_t e = 0; e < comparisons.size(); ++e) {
    if (!(weights[e] > 0.0)) continue;
    for (const NuisancePrior& prior : nuisance_priors(experiments, e, comparisons[e])) {
      const double d = common * prior.residual;
      score.value += std::pow(std::abs(d), exponent) / total;
      score.residuals.push_back(d / std::sqrt(total));
      if (score.jacobian.empty()) continue;
      for (const double slope : prior.slopes)
        score.jacobian.push_back(common * slope / std::sqrt(total));
    }
  }
}

/// Adds each prior of a variable as one more value.
void add_priors(const DesignSpace& space,
                const DesignPoint& point,
                double common,
                const std::vector<double>& weights,
                double exponent,
                Score& score) {
  const double total = std::accumulate(weights.begin(), weights.end(), 0.0);
  for (const PriorResidual& prior : prior_residuals(space, point)) {
    const double d = common * prior.residual;
    score.value += std::pow(std::abs(d), exponent) / total;
    score.residuals.push_back(d / std::sqrt(total));
    if (score.jacobian.empty()) continue;
    std::vector<double> row(static_cast<size_t>(space.size()), 0.0);
    row[static_cast<size_t>(prior.variable)] = common * prior.slope / std::sqrt(total);
    score.jacobian.insert(score.jacobian.end(), row.begin(), row.end());
  }
}

}  // namespace

double noise_alone(const Study& study) {
  const std::vector<StudyExperiment> fitted = fitted_experiments(study);
  const auto common = common_deviation(fitted);
  if (!common) return 0.0;
  double mean = 0.0, variance = 0.0;
  for (const StudyExperiment& experiment : fitted) {
    const double w = experiment.objective.weight, N = static_cast<double>(experiment.values());
    if (w > 0.0 && experiment.loss.loss != Loss::squares) return 0.0;
    if (experiment.estimates_noise)
      // With estimated noise there is no lower limit of the target: all remaining error counts as
      // noise.
      return 0.0;
    mean += w * N;
    variance += 2.0 * w * w * N;
  }
  return mean > 0.0 ? *common * *common * (1.0 + 2.0 * std::sqrt(variance) / mean) : 0.0;
}

Objective objective(const Study& study) {
  const std::vector<StudyExperiment> fitted = fitted_experiments(study);
  const auto common = common_deviation(fitted);
  std::vector<double> weights;  // with stated noise the number of values also matters
  for (const StudyExperiment& experiment : fitted) {
    const double values = common ? static_cast<double>(experiment.values()) : 1.0;
    weights.push_back(experiment.objective.weight * values);
  }
  return Objective(
      [fitted, weights, common, space = study.space, constraints = study.constraints](
          const DesignPoint& point, const Channels& channels) -> Result<Score> {
        auto comparisons = compare_all(fitted, channels);
        if (!comparisons) return comparisons.failure();
        for (std::size_t e = 0; e < fitted.size(); ++e) weigh(fitted[e], common, (*comparisons)[e]);
        Score score;
        score.value = target(*comparisons, weights);
        score.residuals = weighted_residuals(*comparisons, weights);
        score.jacobian = weighted_slopes(*comparisons, weights);
        if (common) {
          const double exponent = fitted.front().objective.exponent;
          add_nuisance_priors(fitted, *comparisons, *common, weights, exponent, score);
          add_priors(space, point, *common, weights, exponent, score);
        }
        for (const Comparison& comparison : *comparisons) {
          score.stand_ins += static_cast<int>(comparison.pairing.missing.size());
        }
        for (const ChannelConstraint& constraint : constraints) {
          if (const Status done = apply(constraint, channels, score); !done) return done.failure();
        }
        return score;
      },
      study.asks_slopes);
}

}  // namespace latsch::correlation
