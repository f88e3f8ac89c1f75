// SPDX-License-Identifier: Apache-2.0
#include "correlation/analysis/measurement_gains.h"

#include <algorithm>
#include <cassert>
#include <optional>

#include "correlation/target/residuals.h"
#include "correlation/target/study_trials.h"
#include "optimization/identifiability/d_optimality.h"
#include "optimization/problem/point_vector.h"

namespace latsch::correlation {
namespace {

std::vector<MeasurementGain> gains(const Eigen::MatrixXd& J,
                                   const std::vector<Candidate>& candidates) {
  const Eigen::VectorXd before = deviations_with_bounds(J);
  std::vector<MeasurementGain> rows;
  for (const DOptimality& gain : d_optimality(J, candidates)) {
    Eigen::Index helps = 0;
    (gain.deviations.array() / before.array()).minCoeff(&helps);
    rows.push_back({candidates[gain.candidate].name,
                    gain.shrinkage,
                    static_cast<int>(helps),
                    before[helps],
                    gain.deviations[helps]});
  }
  return rows;
}

/// Returns the derivatives in units of the noise that affects the variables; nullopt if that noise
/// is not known or zero.
std::optional<Eigen::MatrixXd> in_units_of_noise(const Identifiability& what) {
  const Confidence& c = what.identification.confidence();
  if (!(c.sigma > 0.0)) return std::nullopt;
  return Eigen::MatrixXd(c.noise.cwiseInverse().asDiagonal() *
                         what.identification.linearization().J);
}

DesignSpace without_priors(const DesignSpace& space) {
  std::vector<DesignVariable> variables = space.variables();
  for (DesignVariable& variable : variables) variable.prior.reset();
  return DesignSpace(std::move(variables), space.constraints());
}

}  // namespace

std::optional<MeasurementNoise> typical_noise(const Study& study) {
  double sum = 0.0, count = 0.0;
  for (const StudyExperiment& experiment : study.experiments) {
    if (!experiment.fitted) continue;
    for (const double sigma : stated_deviations(experiment)) {
      sum += sigma;
      count += 1.0;
    }
  }
  return count > 0.0 ? std::optional(MeasurementNoise{.relative = sum / count}) : std::nullopt;
}

std::vector<MeasurementGain> repetition_gains(const Study& study, const Identifiability& what) {
  const auto J = in_units_of_noise(what);
  if (!J) return {};
  const auto rows = residual_rows(study);
  const auto& used = what.identification.residuals_used();
  std::vector<Candidate> candidates;
  for (size_t e = 0; e < study.experiments.size(); ++e) {
    std::vector<Eigen::Index> own;
    for (size_t k = 0; k < used.size(); ++k) {
      if (rows[used[k]].experiment == static_cast<int>(e)) own.push_back(k);
    }
    if (own.empty()) continue;
    const StudyExperiment& experiment = study.experiments[e];
    candidates.push_back({experiment.name + ", all of it once more", (*J)(own, Eigen::all)});
    if (own.size() == 1) continue;
    for (Eigen::Index k : own) {
      candidates.push_back({experiment.name + ", " + rows[used[k]].name + " once more", J->row(k)});
    }
  }
  return gains(*J, candidates);
}

std::vector<DesignPoint> prediction_points(const Study& study, const Identifiability& what) {
  return difference_points(study.space, what.point, what.identification.lengths());
}

namespace {

/// Returns the derivatives of a predicted experiment in units of its noise, if they are known.
std::optional<Eigen::MatrixXd> rows_of(const Study& study,
                                       const Identifiability& what,
                                       const StudyExperiment& experiment,
                                       const std::vector<Channels>& at_points) {
  Study alone = study;
  alone.experiments = {experiment};
  alone.experiments[0].fitted = true;
  alone.experiments[0].objective.weight = 1.0;
  alone.experiments[0].loss = {};  // a single value has no robust loss before it is measured
  if (!experiment.noise) alone.experiments[0].noise = typical_noise(study);
  alone.space = without_priors(study.space);
  const Objective residuals = residual_objective(alone);
  std::vector<Eigen::VectorXd> r;
  for (const Channels& channels : at_points) {
    const auto score = residuals(channels);
    r.push_back(to_vector(score->residuals));
  }
  const auto known = known_residuals(r);
  if (known.empty()) return std::nullopt;
  for (Eigen::VectorXd& v : r) v = Eigen::VectorXd(v(known));
  const double spread = alone.experiments[0].noise ? 1.0 : what.identification.confidence().sigma;
  Eigen::MatrixXd J = differences(study.space, prediction_points(study, what), r).J / spread;
  for (int i = 0; !study.free.empty() && i < study.space.size(); ++i)
    if (!std::binary_search(study.free.begin(), study.free.end(), i)) J.col(i).setZero();
  return J;
}

/// Adds candidates for whole tests: all experiments of one test are measured together, such as all
/// channels of a load case.
void add_whole_tests(const Study& study, std::vector<Candidate>& candidates) {
  const std::vector<Candidate> single = candidates;
  for (const StudyTest& test : study.tests) {
    Eigen::MatrixXd all(0, study.space.size());
    int count = 0;
    for (const StudyExperiment& experiment : study.experiments) {
      const std::string& channel = experiment.observable->asks().front();
      if (test.name.empty() || !channel.starts_with(test.name + "/")) continue;
      for (const Candidate& one : single) {
        if (one.name != experiment.name) continue;
        all.conservativeResize(all.rows() + one.J.rows(), Eigen::NoChange);
        all.bottomRows(one.J.rows()) = one.J;
        ++count;
      }
    }
    if (count > 1) candidates.push_back({"test " + test.name + ", all of it", all});
  }
}

}  // namespace

std::vector<MeasurementGain> prediction_gains(const Study& study,
                                              const Identifiability& what,
                                              const std::vector<Channels>& at_points) {
  const auto J = in_units_of_noise(what);
  if (!J) return {};
  assert(at_points.size() == prediction_points(study, what).size());
  std::vector<Candidate> candidates;
  for (const StudyExperiment& experiment : study.experiments) {
    if (experiment.fitted) continue;
    if (auto rows = rows_of(study, what, experiment, at_points))
      candidates.push_back({experiment.name, *std::move(rows)});
  }
  add_whole_tests(study, candidates);
  return gains(*J, candidates);
}

}  // namespace latsch::correlation
