// SPDX-License-Identifier: Apache-2.0
#include "correlation/analysis/missed_values.h"

#include <fmt/format.h>

#include <cmath>

#include "correlation/analysis/measurement_gains.h"
#include "correlation/target/predictions.h"
#include "correlation/target/residuals.h"
#include "optimization/problem/point_vector.h"

namespace latsch::correlation {
namespace {

constexpr std::size_t kMostValues = 20;
constexpr double kUsualNoise = 0.01;  // relative noise assumed for a value that states none
constexpr double kMissed = 3.0;       // multiple of the noise above which a value is missed
// share of the noise; a variable whose effect over its whole range is smaller counts as having no
// effect
constexpr double kNothing = 0.1;

/// A compared value with its difference d from the measurement and the derivatives dd/du.
struct Row {
  std::string name;
  bool fitted;
  double d, noise;
  Eigen::RowVectorXd slopes;
};

bool is_told(const StudyExperiment& experiment) {
  return experiment.values() <= kMostValues && experiment.loss.loss == Loss::squares;
}

std::string name_of(const StudyExperiment& experiment, const std::string& value) {
  return experiment.values() == 1 ? experiment.name : experiment.name + ", " + value;
}

double noise_of(const StudyExperiment& experiment, std::size_t value) {
  const auto stated = stated_deviations(experiment);
  return stated.empty() ? kUsualNoise : stated[value];
}

std::vector<Row> fitted_rows(const Study& study, const Identification& identification) {
  const Linearization& at = identification.linearization();
  const auto known = residual_rows(study);
  std::vector<std::size_t> first(study.experiments.size() + 1, known.size());
  for (std::size_t k = known.size(); k-- > 0;) first[known[k].experiment + 1] = k;
  std::vector<Row> rows;
  for (Eigen::Index k = 0; k < at.r.size(); ++k) {
    const auto place = static_cast<std::size_t>(identification.residuals_used()[k]);
    const ResidualRow& row = known[place];
    if (row.experiment < 0) continue;  // this residual is a prior, not a measured value
    const StudyExperiment& experiment = study.experiments[row.experiment];
    if (!is_told(experiment)) continue;
    rows.push_back({name_of(experiment, row.name),
                    true,
                    row.unit * at.r[k],
                    noise_of(experiment, place - first[row.experiment + 1]),
                    row.unit * at.J.row(k)});
  }
  return rows;
}

void add_predicted_rows(const Study& study, const Identifiability& what, std::vector<Row>& rows) {
  if (!has_predictions(study)) return;
  const auto points = prediction_points(study, what);
  const auto channels = predicted_channels(study, points);
  if (!channels) return;
  for (const StudyExperiment& experiment : study.experiments) {
    if (experiment.fitted || !is_told(experiment)) continue;
    std::vector<Eigen::VectorXd> d;
    for (const Channels& one : *channels) {
      const Comparison comparison = compare(experiment, study.experiments, one);
      d.push_back(to_vector(comparison.differences));
      for (const int missing : comparison.pairing.missing) d.back()[missing] = NAN;
    }
    const Linearization at = differences(study.space, points, d);
    const auto names = experiment.observable->rows();
    for (const Eigen::Index k : known_residuals(d))
      rows.push_back({name_of(experiment, names[k]),
                      false,
                      at.r[k],
                      noise_of(experiment, static_cast<std::size_t>(k)),
                      at.J.row(k)});
  }
}

/// Returns the other fitted value whose error grows most when the variable changes by `change`, a
/// share of its range.
std::optional<MissedValue::Error> payer_of(const std::vector<Row>& rows,
                                           const Row& mended,
                                           int variable,
                                           double change) {
  std::optional<MissedValue::Error> payer;
  double most = 1.0;  // only an error of more than one standard deviation of the noise counts
  for (const Row& row : rows) {
    if (&row == &mended || !row.fitted) continue;
    const double d = row.d + change * row.slopes[variable];
    const double loss = (std::abs(d) - std::abs(row.d)) / row.noise;
    if (loss <= most) continue;
    most = loss;
    payer = {row.name, -d};
  }
  return payer;
}

}  // namespace

std::string MissedValue::Error::in_words() const {
  return fmt::format("{:.1f} % too {}", 100.0 * std::abs(error), error > 0.0 ? "high" : "low");
}

std::string MissedValue::in_words(const DesignSpace& space) const {
  std::string text = missed.name + " is " + missed.in_words();
  if (!variable) {
    text += ": no variable moves it";
  } else {
    text += fmt::format(": {} moves it most, by {:.0f} % for a tenth of its range",
                        space[*variable].name,
                        10.0 * std::abs(effect));
    text += !within_bounds ? ", and cannot correct it within its bounds"
            : payer ? "; corrected by it alone, " + payer->name + " would be " + payer->in_words()
                    : "; correcting it would harm no other value";
  }
  return text + (fitted ? "" : " (it is not fitted)");
}

std::vector<MissedValue> missed_values(const Study& study, const Identifiability& what) {
  const Eigen::VectorXd u = to_vector(study.space.to_unit(what.identification.center()));
  std::vector<Row> rows = fitted_rows(study, what.identification);
  add_predicted_rows(study, what, rows);
  std::vector<MissedValue> all;
  for (const Row& row : rows) {
    if (std::abs(row.d) <= kMissed * row.noise) continue;
    MissedValue one{{row.name, -row.d}, row.fitted};
    int variable = 0;
    if (row.slopes.cwiseAbs().maxCoeff(&variable) >= kNothing * row.noise) {
      const double change = -row.d / row.slopes[variable];
      one.variable = variable;
      one.effect = -row.slopes[variable];
      one.within_bounds = u[variable] + change >= 0.0 && u[variable] + change <= 1.0;
      if (one.within_bounds) one.payer = payer_of(rows, row, variable, change);
    }
    all.push_back(std::move(one));
  }
  return all;
}

}  // namespace latsch::correlation
