// SPDX-License-Identifier: Apache-2.0
// Finds the limits that a study's model meets in its tests (experiment/language/known_limits.h), to
// be reported before the study runs.
#pragma once

#include <string>
#include <vector>

#include "correlation/study/study.h"

namespace latsch::correlation {

/// Returns a sentence for each limit, with the tests in which it matters: "test oblique: the
/// sections ...". Examines the model with the initial values. If the model does not accept these,
/// the list is empty; the trials then report the reason.
std::vector<std::string> limits_of_tests(const Study& study);

/// Runs the fitted and predicted tests once more at a point whose trial succeeded. Returns a
/// sentence for each limit of limits_of_tests() and for each limit that the model met in one of
/// these tests: ranges of its file that it left, a tire off the road, a pressure without effect. A
/// test of a model that knows no limits is not run. The sentences of the last points are kept:
/// terminal, page and report run the tests once.
std::vector<std::string> limits_met_at(const Study& study, const DesignPoint& point);

}  // namespace latsch::correlation
