// SPDX-License-Identifier: Apache-2.0
// How the trials of a study are run. None of it changes the result, except which trials fail and
// what follows from that.
//
//   [run]
//   workers = 2                        # processes
//   timeout = "10 min"                 # a trial; then its whole process group is killed
//   memory = "4 GB"                    # a worker and each program it starts; else unlimited
//   on_failure = "proceed"             # a failed point is worse than any other
//   intervals = true                   # after a fit: confidence intervals, two to six trials a
//                                      # variable
//   journal = "study.latsch"           # beside the study
//   stragglers = true                  # what runs long is started twice or stopped, where a worker
//                                      # is idle or a point that is wanted waits; docs/trials.md
//   straggler_factor = 3               # so many times longer than the median
//   look_ahead = 4                     # points proposed ahead for every worker of several, where
//                                      # that is not slower than the trials themselves
//
// What else on_failure may be:
//   on_failure = "abort"               # the run ends
//   on_failure = "retry"               # once more, `retries` times, then as "proceed"
//   retries = 1
//   on_failure = "recover"             # the optimizer is told a target of `penalty` in its place,
//   penalty = "100 %"                  # with residuals that have this as their sum of squares
//   on_failure = "continuation"        # approached from the nearest point that succeeded, halving
//   halvings = 4                       # the way so often; see evaluation/schedule/failure_answer.h
//
// The journal and the report show the trial as failed in any case. A design of experiments has no
// optimizer to be answered: to it "recover" and "continuation" are "proceed". A trial whose worker
// was killed from outside is repeated in any case; no point is started more than retries + 2 times.
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
  bool intervals = true;  // after a fit
  std::filesystem::path journal;
  double straggler_factor = RunOptions{}.straggler_factor;  // 0: nothing is one
  int look_ahead = RunOptions{}.look_ahead;
};

/// `table`: [run], nullptr where the study has none; `study`: its file.
RunSettings read_run_settings(const Node* table, const std::filesystem::path& study);

/// What follows from a failed trial, as the end of a sentence that begins with one.
std::string in_words(const FailurePolicy& policy);

/// Bytes of "4 GB", "500 MB", "64 kB", powers of 1000; nothing where the text is no such amount.
std::optional<double> parse_memory(std::string_view text);

}  // namespace latsch::correlation
