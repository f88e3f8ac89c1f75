// SPDX-License-Identifier: Apache-2.0
// The stages in which a Magic Formula study fits its coefficients: which coefficients a tire test
// determines, and in which order they are fitted.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "cli/templates/tire_test_record.h"

namespace latsch::cli {

/// A stage of the fit, and the coefficients that become variables in it if the test determines
/// them.
struct Stage {
  const char* name;
  std::vector<std::string> experiments, coefficients;
};

/// The coefficients that become variables, and the others with the reason why not: "of order 2 in
/// the pressure, of which there are 2 levels: 69, 83 kPa".
struct Freed {
  std::vector<Stage> stages;
  std::vector<std::pair<std::string, std::vector<std::string>>> left_out;

  std::vector<std::string> in_words() const;
};

/// Returns the stages for a test. A coefficient of a polynomial in a condition (load, camber,
/// pressure, speed) becomes a variable if the recordings contain more distinct levels of the
/// condition than the order of the polynomial.
Freed stages_of(const TireTest& t);

/// True if the study bounds a coefficient more narrowly than its usual range.
bool is_bounded(std::string_view coefficient);

/// Returns the sections [variable.NAME] of those coefficients that the study bounds, one line each,
/// with a comment.
std::string bounded_variables(const std::vector<std::string>& coefficients);

}  // namespace latsch::cli
