// SPDX-License-Identifier: Apache-2.0
// Tables that several verbs print: values of variables with their units, and measured values beside
// simulated ones.
#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "correlation/observable/objective.h"
#include "correlation/study/study_experiment.h"
#include "optimization/problem/design_space.h"

namespace latsch::cli {

/// Returns a value (SI) as text in the unit of its variable, such as "22.3 N/mm^2".
std::string shown(const DesignVariable& variable, double value);

/// Returns the width of the first column: the length of the longest name, at least 16 letters.
template <class Named>
int name_width(const std::vector<Named>& all) {
  std::size_t width = 16;
  for (const Named& one : all) width = std::max(width, one.name.size());
  return static_cast<int>(width);
}

/// Prints name, range, initial value, scale and paths.
void print_variables(const DesignSpace& space);

/// Prints every linear constraint: its name, its sum, its bounds, and the value of the sum at the
/// initial point.
void print_constraints(const DesignSpace& space);

/// Prints name and value of every variable; the values are texts such as "73 N/mm^2".
void print_values(const DesignSpace& space, const std::vector<std::string>& values);

/// Prints a design point whose uncertainty is not known.
void print_point(const DesignSpace& space, const DesignPoint& point);

/// Prints the measured and the simulated value and the error of every force or mode of the
/// experiment, then the mean and the largest error.
void print_comparison(const correlation::Study& study,
                      const correlation::StudyExperiment& experiment,
                      const Channels& channels);

}  // namespace latsch::cli
