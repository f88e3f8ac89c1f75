// SPDX-License-Identifier: Apache-2.0
// Settings for running the trials of a study. None of them changes the result, except through the
// choice of trials that fail and the consequences of a failure.
//
// The journal and the report show the trial as failed in any case. A design of experiments has no
// optimizer, so "recover" and "continuation" act there as "proceed". A trial whose worker was
// killed from outside is repeated in any case; no point is started more than retries + 2 times.
//
// The keys are in correlation/study/keys/run_keys.cpp.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "base/document.h"
#include "evaluation/schedule/run_options.h"

namespace latsch::correlation {

struct RunSettings {
  int workers = 1;
  double timeout = 600.0;  // s
  double memory = 0.0;     // bytes; 0: unlimited
  FailurePolicy on_failure;
  bool intervals = true;  // computed after a fit
  std::filesystem::path journal;
  /// ratio to the median time above which a trial counts as a straggler; 0: none does
  double straggler_factor = RunOptions{}.straggler_factor;
  int look_ahead = RunOptions{}.look_ahead;
};

/// Reads [run]. `table` is nullptr if the study has none; `study` is its file.
RunSettings read_run_settings(const Node* table, const std::filesystem::path& study);

/// Returns the consequence of a failed trial in words, as the end of a sentence that begins with
/// the failure.
std::string in_words(const FailurePolicy& policy);

/// Returns the number of bytes for "4 GB", "500 MB", "64 kB" in powers of 1000; nullopt if the text
/// is no such amount.
std::optional<double> parse_memory(std::string_view text);

}  // namespace latsch::correlation
