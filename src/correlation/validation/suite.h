// SPDX-License-Identifier: Apache-2.0
// Acceptance tests of a model: a suite of checks, each with a comparison, its limit, and the source
// of the limit. `latsch validate MODEL SUITE.toml` runs the checks.
//
// A value equal to a limit fulfills it. A measured mode without a partner has the error
// missing_mode. Keys that weight a fit (weight, use, exponent, noise, loss) are not allowed,
// because nothing is fitted. The keys are in correlation/validation/suite_keys.cpp.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "base/document_record.h"
#include "correlation/study/channel_constraint.h"
#include "correlation/study/study_experiment.h"
#include "experiment/language.h"

namespace latsch::correlation {

struct Check {
  std::string name, source;
  /// The experiment whose errors have limits; nullopt: the check has limits for a number.
  std::optional<StudyExperiment> experiment;
  std::optional<double> mean_error, largest_error;  // shares of 1
  ChannelConstraint number = {};
};

struct Suite {
  std::filesystem::path file;
  std::string title;
  std::vector<StudyTest> tests;
  std::vector<Check> checks;
};

/// Reads a suite for models of a kind. Throws InputError naming the place, also if the kind cannot
/// run a test.
Suite read_suite(const std::filesystem::path& file,
                 const experiment::SpecimenKind& kind,
                 const experiment::Language& language);
/// Reads a suite and returns every key that its readers request, by its path.
std::map<std::string, DeclaredKey> keys_of_suite(const std::filesystem::path& file,
                                                 const experiment::SpecimenKind& kind,
                                                 const experiment::Language& language);

}  // namespace latsch::correlation
