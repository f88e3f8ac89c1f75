// SPDX-License-Identifier: Apache-2.0
// Table of single measured values and their simulated counterparts: weight, measured value, initial
// value, fitted value and its interval.
#pragma once

#include <string>

#include "report/report.h"

namespace latsch::report {

std::string value_table(const StudyReport& report);

}  // namespace latsch::report
