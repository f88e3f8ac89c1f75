// SPDX-License-Identifier: Apache-2.0
// The stages of a Magic Formula study: the coefficients that a tire test determines, and their
// order.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "cli/templates/tire_test_record.h"

namespace latsch::cli {

/// Coefficients that a stage frees if the test determines them.
struct Stage {
  const char* name;
  std::vector<std::string> experiments, coefficients;
};

/// The freed coefficients, and the others by the reason: "of order 2 in the pressure, of which
/// there are 2 levels: 69, 83 kPa".
struct Freed {
  std::vector<Stage> stages;
  std::vector<std::pair<std::string, std::vector<std::string>>> left_out;

  std::vector<std::string> in_words() const;
};

/// A coefficient of a condition is freed if the recordings contain more distinct levels of the
/// condition than the order of its polynomial.
Freed stages_of(const TireTest& t);

/// True if the study bounds a coefficient more narrowly than its usual range.
bool is_bounded(std::string_view coefficient);

/// Returns [variable.NAME] of the bounded ones among the coefficients, one line each, with a
/// comment.
std::string bounded_variables(const std::vector<std::string>& coefficients);

}  // namespace latsch::cli
