// SPDX-License-Identifier: Apache-2.0
// The verb `latsch sample`: draws samples of the posterior density of the variables around the best
// trial of a journal.
#pragma once

#include <string>

#include "cli/verbs/verbs.h"

namespace latsch::cli {

/// Options of a sampling.
struct Sampling {
  int workers = 0;             // 0: the number that the study states
  std::string output = {};     // file of the samples; empty: beside the study
  bool writes_report = false;  // true: writes the report anew, with the samples
};

/// Samples the posterior density of a study that was run, and returns the exit code.
int sample(const std::string& file, const experiment::Language& language, const Sampling& asked);

void add_sample(CommandLine& app, Program& program);

}  // namespace latsch::cli
