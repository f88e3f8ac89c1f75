// SPDX-License-Identifier: Apache-2.0
// latsch worker: evaluates the trials of a study for the process that started it.
#include "evaluation/worker.h"

#include "cli/verbs.h"
#include "correlation/tire_trials.h"

namespace latsch::cli {

void add_worker(CLI::App& app, int& exit_code) {
  auto* verb = app.add_subcommand("worker", "Evaluates trials for `latsch run` and `latsch doe`");
  verb->group("");  // hidden
  auto file = std::make_shared<std::string>();
  verb->add_option("study", *file)->required();
  verb->callback([file, &exit_code] {
    exit_code = serve(correlation::evaluator(correlation::read_study(*file)));
  });
}

}  // namespace latsch::cli
