// SPDX-License-Identifier: Apache-2.0
// The report's numbers as HTML: a strip of the main results, and the tables.
#pragma once

#include <string>

#include "report/report.h"

namespace latsch::report {

std::string check_table(const StudyReport& report);
std::string key_numbers(const StudyReport& report);
std::string variable_table(const StudyReport& report);
std::string experiment_table(const StudyReport& report);
std::string run_facts(const StudyReport& report);
std::string discretization_table(const StudyReport& report);

/// States whether the fitted value lies on a bound, beyond which the true optimum may lie.
enum class AtBound { no, lower, upper };
AtBound at_bound(const Variable& variable);

}  // namespace latsch::report
