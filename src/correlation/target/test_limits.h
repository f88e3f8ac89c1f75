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
/// the list is empty; the trials then report the reason. Limits that depend on the model's file
/// alone, as the ranges of a .tir which the states of a table leave, hold in every trial. If the
/// study varies such a limit itself, the model is examined at both bounds of the variable, too.
std::vector<std::string> limits_of_tests(const Study& study);

/// Runs the fitted and predicted tests once more at a point whose trial succeeded. Returns a
/// sentence for each limit of limits_of_tests() and for each limit that the model reached in one of
/// these tests: a validity range of its file that was left, a tire that left the road, a pressure
/// without effect. Tests of a model that knows no limits are not run. The sentences of the most
/// recent points are kept, so that terminal, page and report run the tests only once.
std::vector<std::string> limits_met_at(const Study& study, const DesignPoint& point);

}  // namespace latsch::correlation
