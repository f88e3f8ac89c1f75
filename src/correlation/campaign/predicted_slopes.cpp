// SPDX-License-Identifier: Apache-2.0
#include "correlation/campaign/predicted_slopes.h"

#include <algorithm>

#include "correlation/study/study_slopes.h"
#include "correlation/target/residuals.h"
#include "correlation/target/study_trials.h"
#include "evaluation/trial/trial.h"
#include "optimization/problem/point_vector.h"

namespace latsch::correlation {

Result<Eigen::MatrixXd> predicted_slopes(const Study& study,
                                         const CampaignStart& start,
                                         const std::string& experiment) {
  Study alone = study;
  const auto found = std::find_if(study.experiments.begin(),
                                  study.experiments.end(),
                                  [&](const auto& one) { return one.name == experiment; });
  alone.experiments = {*found};
  StudyExperiment& own = alone.experiments.front();
  own.fitted = true;
  own.objective.weight = 1.0;
  own.loss = {};
  own.noise.reset();  // residuals are then plain differences
  own.estimates_noise = false;
  alone.constraints.clear();
  std::vector<DesignVariable> variables = study.space.variables();
  for (DesignVariable& variable : variables) variable.prior.reset();
  alone.space = DesignSpace(std::move(variables), study.space.constraints());
  alone.asks_slopes = !reason_without_slopes(alone).has_value();
  const Evaluator model = evaluator(alone);
  const Objective residuals = residual_objective(alone);
  const std::vector<DesignPoint> points =
      alone.asks_slopes ? std::vector<DesignPoint>{start.point}
                        : difference_points(study.space, start.point, start.lengths);
  std::vector<Eigen::VectorXd> r;
  Eigen::MatrixXd J;
  for (const DesignPoint& point : points) {
    const Outcome outcome = evaluate(model, point);
    if (!outcome.result) return outcome.result.failure();
    const auto score = residuals(point, *outcome.result);
    if (!score) return score.failure();
    r.push_back(to_vector(score->residuals));
    if (alone.asks_slopes) J = study.space.unit_jacobian(point, *score);
  }
  if (J.size() == 0) {
    const auto known = known_residuals(r);
    if (known.empty() || points.size() == 1)
      return Failure{"no value of " + experiment + " has a slope"};
    for (Eigen::VectorXd& one : r) one = Eigen::VectorXd(one(known));
    J = differences(study.space, points, r).J;
  }
  return Eigen::MatrixXd(J(Eigen::all, start.free));
}

}  // namespace latsch::correlation
