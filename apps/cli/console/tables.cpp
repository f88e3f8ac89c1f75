// SPDX-License-Identifier: Apache-2.0
#include "cli/console/tables.h"

#include <fmt/format.h>

#include "base/units.h"
#include "cli/console/console.h"
#include "correlation/study/linear_constraints.h"
#include "experiment/rigs/mode_record.h"

namespace latsch::cli {
namespace {

using correlation::Comparison;
using correlation::StudyExperiment;

void print_forces(const StudyExperiment& experiment,
                  const Channels& channels,
                  const Comparison& comparison) {
  say("  {:>13} {:>16} {:>13} {:>13} {:>9} {:>10} {:>9} {:>10}\n",
      "deflection mm",
      "loaded radius mm",
      "measured N",
      "simulated N",
      "error %",
      "length mm",
      "width mm",
      "area cm^2");
  for (size_t j = 0; j < experiment.forces.size(); ++j) {
    say("  {:13.3f} {:16.3f} {:13.1f} {:13.1f} {:9.2f} {:10.1f} {:9.1f} {:10.1f}\n",
        channels["deflection"][j] * 1e3,
        channels["loaded_radius"][j] * 1e3,
        experiment.forces[j],
        channels["force"][j],
        comparison.errors[j] * 100.0,
        channels["patch_length"][j] * 1e3,
        channels["patch_width"][j] * 1e3,
        channels["patch_area"][j] * 1e4);
  }
}

void print_curve(const StudyExperiment& experiment, const Channels& channels) {
  const correlation::CurveExperiment& curve = *experiment.curve;
  const Comparison comparison = compare(experiment, channels);
  const auto simulated = simulated_curve(curve, channels);
  say("\n{}{}\n", experiment.name, experiment.fitted ? "" : " (predicted)");
  say("  {:>16} {:>18} {:>18} {:>9}\n",
      curve.x_compared.empty() ? "sample" : "at " + curve.x_compared_unit,
      "measured " + curve.y_compared_unit,
      "simulated " + curve.y_compared_unit,
      "error %");
  for (size_t i = 0; i < simulated->size(); ++i) {
    say("  {:16.6g} {:18.6g} {:18.6g} {:9.2f}\n",
        curve.x_compared.empty() ? static_cast<double>(i + 1) : curve.x_compared[i],
        curve.y_compared[i],
        (*simulated)[i],
        comparison.errors[i] * 100.0);
  }
  say("  mean |d| {:.3f} %, largest {:.3f} % of {:g} {}\n",
      comparison.mean_error * 100.0,
      comparison.largest_error * 100.0,
      curve.scale,
      curve.y_compared_unit);
}

void print_modes(const StudyExperiment& experiment,
                 const Channels& channels,
                 const Comparison& comparison) {
  const auto simulated = experiment::mode_records(channels);
  say("  {:>12} {:>13} {:>9} {:>6}  {:<22} {}\n",
      "measured Hz",
      "simulated Hz",
      "error %",
      "MAC",
      "measured as",
      "simulated as");
  for (const auto& pair : comparison.pairing.pairs) {
    say("  {:12.2f} {:13.2f} {:9.2f} {:6.2f}  {:<22} {}\n",
        experiment.modes[pair.measured].frequency,
        simulated[pair.simulated].frequency,
        comparison.errors[pair.measured] * 100.0,
        pair.likeness,
        experiment.modes[pair.measured].label(),
        simulated[pair.simulated].label());
  }
  for (int i : comparison.pairing.missing) {
    say("  {:12.2f} {:>13} {:9.2f} {:>6}  {:<22} no simulated mode is like it\n",
        experiment.modes[i].frequency,
        "-",
        comparison.errors[i] * 100.0,
        "-",
        experiment.modes[i].label());
  }
  for (int j : comparison.pairing.extra) {
    say("  {:>12} {:13.2f} {:>9} {:>6}  {:<22} {}\n",
        "-",
        simulated[j].frequency,
        "-",
        "-",
        "not measured",
        simulated[j].label());
  }
}

}  // namespace

std::string shown(const DesignVariable& variable, double value) {
  return format_quantity(value, variable.unit, 5);
}

void print_variables(const DesignSpace& space) {
  for (const DesignVariable& variable : space.variables()) {
    say("  {:<{}} {} from {} to {}, {}, at {}\n",
        variable.name,
        name_width(space.variables()),
        shown(variable, variable.initial),
        shown(variable, variable.lower),
        shown(variable, variable.upper),
        variable.scale == Scale::linear ? "linear" : "logarithmic",
        variable.paths.empty() ? "a hole in an input file"
                               : fmt::format("{}", fmt::join(variable.paths, ", ")));
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

void print_comparison(const StudyExperiment& experiment, const Channels& channels) {
  if (experiment.curve) return print_curve(experiment, channels);
  const Comparison comparison = compare(experiment, channels);
  say("\n{}{}\n", experiment.name, experiment.fitted ? "" : " (predicted)");
  if (experiment.modal()) {
    print_modes(experiment, channels, comparison);
  } else {
    print_forces(experiment, channels, comparison);
  }
  say("  mean |{}| {:.3f} %, largest {:.3f} %\n",
      experiment.modal() ? "df" : "dF",
      comparison.mean_error * 100.0,
      comparison.largest_error * 100.0);
}

}  // namespace latsch::cli
