// SPDX-License-Identifier: Apache-2.0
// Settings for running the trials of a study. None of them changes the result, except through the
// choice of trials that fail and the consequences of a failure.
//
//   [run]
//   workers = 2                        # processes
//   timeout = "10 min"                 # a trial; then its whole process group is killed
//   memory = "4 GB"                    # a worker and each program it starts; else unlimited
//   on_failure = "proceed"             # a failed point is worse than any other
//   intervals = true                   # after a fit: confidence intervals, two to six trials a
//                                      # variable
//   journal = "study.latsch"           # beside the study
//   stragglers = true                  # a trial that runs long is started twice, or stopped, if a
//                                      # worker is idle or a requested point waits; docs/trials.md
//   straggler_factor = 3               # so many times longer than the median
//   look_ahead = 4                     # points proposed ahead for each of several workers, if
//                                      # proposing them is not slower than the trials
//
// Other values of on_failure are:
//   on_failure = "abort"               # the run ends
//   on_failure = "retry"               # once more, `retries` times, then as "proceed"
//   retries = 1
//   on_failure = "recover"             # the optimizer observes a target of `penalty` instead,
//   penalty = "100 %"                  # with residuals that have this as their sum of squares
//   on_failure = "continuation"        # approached from the nearest point that succeeded, halving
//   halvings = 4                       # the step so often (evaluation/schedule/failure_answer.h)
//
// The journal and the report show the trial as failed in any case. A design of experiments has no
// optimizer, so "recover" and "continuation" act there as "proceed". A trial whose worker was
// killed from outside is repeated in any case; no point is started more than retries + 2 times.
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
  double straggler_factor = RunOptions{}.straggler_factor;  // multiple of the median time; 0: no
                                                            // trial counts as a straggler
  int look_ahead = RunOptions{}.look_ahead;
};

/// Reads [run]. `table` is nullptr if the study has none; `study` is its file.
RunSettings read_run_settings(const Node* table, const std::filesystem::path& study);

/// Returns the consequence of a failed trial, as the end of a sentence that begins with the
/// failure.
std::string in_words(const FailurePolicy& policy);

/// Returns the bytes of "4 GB", "500 MB", "64 kB" in powers of 1000; nullopt if the text is no such
/// amount.
std::optional<double> parse_memory(std::string_view text);

}  // namespace latsch::correlation
