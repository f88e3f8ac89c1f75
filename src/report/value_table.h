// SPDX-License-Identifier: Apache-2.0
// Single measured values beside what the model makes of them: what each weighs, its target, at the
// initial values, optimized, and between which values that lies.
#pragma once

#include <string>

#include "report/report.h"

namespace latsch::report {

std::string value_table(const StudyReport& report);

}  // namespace latsch::report
