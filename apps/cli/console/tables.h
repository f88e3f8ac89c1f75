// SPDX-License-Identifier: Apache-2.0
// What several verbs print: values of variables with their units, measured beside simulated.
#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "correlation/observable/objective.h"
#include "correlation/study/study_experiment.h"
#include "optimization/problem/design_space.h"

namespace latsch::cli {

/// A value (SI) in the unit of its variable: "22.3 N/mm^2".
std::string shown(const DesignVariable& variable, double value);

/// Of the column of names in front: the longest of them, 16 letters at least.
template <class Named>
int name_width(const std::vector<Named>& all) {
  std::size_t width = 16;
  for (const Named& one : all) width = std::max(width, one.name.size());
  return static_cast<int>(width);
}

/// Name, bounds, initial value, scale, paths.
void print_variables(const DesignSpace& space);

/// Name, sum, bounds, value at the initial point of every linear constraint.
void print_constraints(const DesignSpace& space);

/// Name and value of every variable, the latter as text: "73 N/mm^2".
void print_values(const DesignSpace& space, const std::vector<std::string>& values);

/// Of a point of which no uncertainty is known.
void print_point(const DesignSpace& space, const DesignPoint& point);

/// Measured, simulated, error of every force or mode, then mean and largest error.
void print_comparison(const correlation::StudyExperiment& experiment, const Channels& channels);

}  // namespace latsch::cli
