// SPDX-License-Identifier: Apache-2.0
// A limit of a rig on the settings of a test, as a person writes it:
//
//   load * abs(alpha) <= 40 kN deg
//
// Both sides are expressions of numbers of the test by their names, of quantities with units, of
// + - * / ^ and parentheses, and of abs, sqrt, sin, cos, tan, min and max. Both sides must have the
// same dimension; a plain 0 has every dimension. All is computed in SI, angles in rad.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/result.h"
#include "base/units.h"

namespace latsch::correlation {

/// A number of a test that a limit names.
struct LimitedNumber {
  int setting = -1;                // index of the setting; -1: a number that stays
  double value = 0.0;              // SI, if it stays
  Unit::Dimension dimension = {};  // dimension of its unit
};

/// Returns the number of this name; nullopt if the test has none.
using LimitedNumbers = std::function<std::optional<LimitedNumber>(const std::string& name)>;

class RigLimit {
 public:
  /// Returns the limit, or a Failure that says what is wrong with the text. `names` are those of
  /// all numbers of the test.
  static Result<RigLimit> read(const std::string& text,
                               const LimitedNumbers& numbers,
                               const std::vector<std::string>& names);

  /// True if the settings, SI, fulfill it. Settings at which it is not defined do not.
  bool holds(const std::vector<double>& settings) const;
  /// The limit as written.
  const std::string& text() const { return text_; }

  struct Term;  // an expression, defined in rig_limit.cpp

 private:
  std::string text_;
  std::shared_ptr<const Term> lower_, upper_;  // lower <= upper
  bool is_strict_ = false;                     // true: lower < upper
};

}  // namespace latsch::correlation
