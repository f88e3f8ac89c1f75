// SPDX-License-Identifier: Apache-2.0
// A model through the checks of a suite.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "correlation/validation/suite.h"
#include "report/report.h"

namespace latsch::correlation {

/// One limit of a check.
struct CheckResult {
  std::string check, what;             // "stiffness", "largest error of force"
  std::optional<double> value;         // SI; nullopt: `reason` says why there is none
  std::optional<double> lower, upper;  // SI, inclusive
  std::string unit;                    // in which people read it
  std::string source, reason;
  bool accepted = false;
};

struct Validation {
  std::vector<CheckResult> results;
  report::StudyReport page;

  bool accepted() const;
};

/// Runs the tests that checks ask for; `tell` hears each before it runs. A test that fails leaves
/// its checks without a value, others are not touched. Throws InputError where the numbers make no
/// specimen.
Validation validate(const Suite& suite,
                    const experiment::SpecimenKind& kind,
                    const Document& numbers,
                    const std::function<void(const std::string& test)>& tell);

/// "3.99 %"; "–" where there is none.
std::string value_text(const CheckResult& result);
/// "at most 5 %", "200 N/mm .. 240 N/mm"
std::string limit_text(const CheckResult& result);

}  // namespace latsch::correlation
