// SPDX-License-Identifier: Apache-2.0
// Runs the checks of a suite on a model.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "correlation/validation/suite.h"
#include "report/report.h"

namespace latsch::correlation {

/// Result of the comparison of one value with its limit.
struct CheckResult {
  std::string check, what;             // for example "stiffness", "largest error of force"
  std::optional<double> value;         // SI; nullopt: `reason` says why
  std::optional<double> lower, upper;  // SI, inclusive
  std::string unit;                    // unit in which the value is shown
  std::string source, reason;
  bool accepted = false;
};

struct Validation {
  std::vector<CheckResult> results;
  report::StudyReport page;
  std::vector<std::string> notes;  // limits of the model that the tests have met

  bool accepted() const;
};

/// Runs the tests that the checks need; `tell` is called with the name of each test before it runs.
/// Checks of a failed test have no value; other checks are not affected. Throws InputError if the
/// numbers make no specimen.
Validation validate(const Suite& suite,
                    const experiment::SpecimenKind& kind,
                    const Document& numbers,
                    const std::function<void(const std::string& test)>& tell);

/// Returns the value as text, such as "3.99 %"; "–" if there is no value.
std::string value_text(const CheckResult& result);
/// Returns the limit as text, such as "at most 5 %" or "200 N/mm .. 240 N/mm".
std::string limit_text(const CheckResult& result);

}  // namespace latsch::correlation
