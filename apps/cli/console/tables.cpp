// SPDX-License-Identifier: Apache-2.0
#include "cli/console/tables.h"

#include <fmt/format.h>

#include "base/units.h"
#include "cli/console/console.h"
#include "correlation/study/linear_constraints.h"
#include "correlation/target/compared_trial.h"
#include "experiment/rigs/mode_record.h"

namespace latsch::cli {

using correlation::Comparison;
using correlation::Study;
using correlation::StudyExperiment;

std::string shown(const DesignVariable& variable, double value) {
  return format_quantity(value, variable.unit, 5);
}

namespace {

/// Returns "; prior 30 N/mm, standard deviation 5 N/mm", or a factor in place of the deviation on a
/// logarithmic scale; empty if there is no prior.
std::string prior_text(const DesignVariable& variable) {
  if (!variable.prior) return "";
  const Prior& prior = *variable.prior;
  return fmt::format(
      "; prior {}, {}",
      shown(variable, prior.value),
      prior.of_logarithm
          ? fmt::format("times or over {:.4g} for one standard deviation", 1.0 + prior.sigma)
          : "standard deviation " + shown(variable, prior.sigma));
}

}  // namespace

void print_variables(const DesignSpace& space) {
  for (const DesignVariable& variable : space.variables()) {
    say("  {:<{}} {} from {} to {}, {}, at {}{}\n",
        variable.name,
        name_width(space.variables()),
        shown(variable, variable.initial),
        shown(variable, variable.lower),
        shown(variable, variable.upper),
        variable.scale == Scale::linear ? "linear" : "logarithmic",
        variable.paths.empty() ? "a hole in an input file"
                               : fmt::format("{}", fmt::join(variable.paths, ", ")),
        prior_text(variable));
  }
}

void print_constraints(const DesignSpace& space) {
  for (const LinearConstraint& constraint : space.constraints()) {
    say("  {:<16} {}; {} at the initial point\n",
        constraint.name,
        correlation::in_words(constraint, space),
        format_quantity(constraint.sum(space.initial().values), constraint.unit));
  }
}

void print_values(const DesignSpace& space, const std::vector<std::string>& values) {
  for (int i = 0; i < space.size(); ++i) {
    say("  {:<{}} {}\n", space[i].name, name_width(space.variables()), values[i]);
  }
}

void print_point(const DesignSpace& space, const DesignPoint& point) {
  std::vector<std::string> values;
  for (int i = 0; i < space.size(); ++i) values.push_back(shown(space[i], point.values[i]));
  print_values(space, values);
}

void print_comparison(const Study& study,
                      const StudyExperiment& experiment,
                      const Channels& trial) {
  const correlation::Observable& observable = *experiment.observable;
  const Comparison comparison = compare(experiment, study.experiments, trial);
  const std::string whole = observable.whole();
  say("\n{}{}\n{}  {} |{}| {:.3f} %, largest {:.3f} %{}\n",
      experiment.name,
      experiment.fitted ? "" : " (predicted)",
      observable.table(trial, comparison),
      measure_in_words(experiment),
      observable.error_name(),
      own_measure(experiment, comparison) * 100.0,
      comparison.largest_error * 100.0,
      whole.empty() ? "" : " of " + whole);
}

}  // namespace latsch::cli
