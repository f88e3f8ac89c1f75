// SPDX-License-Identifier: Apache-2.0
#include "experiment/language/key_section.h"

namespace latsch::correlation {

const experiment::KeySection& run_keys() {
  static const experiment::KeySection section = {
      .heading = "[run]",
      .below = "run",
      .about = R"md(
Settings for running the trials of a study. None of them changes the result, except through the
choice of trials that fail and the consequences of a failure.

The journal and the report show the trial as failed in any case. A design of experiments has no
optimizer, so "recover" and "continuation" act there as "proceed". A trial whose worker was
killed from outside is repeated in any case; no point is started more than retries + 2 times.
)md",
      .sentences =
          {
              {"workers", "Number of processes."},
              {"timeout",
               "Time limit of a trial; then its whole process group is killed.",
               "10 min"},
              {"memory", "Memory of a worker and of each program it starts.", "unlimited"},
              {"on_failure",
               "What a failed trial does. \"proceed\": a failed point is worse than any other. "
               "\"abort\": the run ends. \"retry\": once more, `retries` times, then as "
               "\"proceed\". \"recover\": the optimizer observes a target of `penalty` instead, "
               "with residuals that have this as their sum of squares. \"continuation\": the point "
               "is approached from the nearest point that succeeded, halving the step up to "
               "`halvings` times."},
              {"retries", "Number of repetitions, with \"retry\"."},
              {"penalty", "Target of a failed trial, with \"recover\"."},
              {"halvings", "Number of halvings, with \"continuation\"."},
              {"intervals", "After a fit: confidence intervals, two to six trials a variable."},
              {"journal", "File of the trials beside the study.", "the study's name with .latsch"},
              {"stragglers",
               "`true`: a trial that runs long is started twice, or stopped, if a worker is idle "
               "or a requested point waits; docs/trials.md."},
              {"straggler_factor", "So many times longer than the median runs a straggler."},
              {"look_ahead",
               "Points proposed ahead for each of several workers, if proposing them is not slower "
               "than the trials."},
          },
      .samples =
          {
              R"toml([run]
workers = 2
timeout = "10 min"
memory = "4 GB"
on_failure = "proceed"
intervals = true
journal = "study.latsch"
stragglers = true
straggler_factor = 3
look_ahead = 4
)toml",
              R"toml([run]
on_failure = "retry"
retries = 1
)toml",
              R"toml([run]
on_failure = "recover"
penalty = "100 %"
)toml",
              R"toml([run]
on_failure = "continuation"
halvings = 4
)toml",
          },
      .refused = {"method", "max_steps", "seed"},
  };
  return section;
}

}  // namespace latsch::correlation
