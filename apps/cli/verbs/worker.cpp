// SPDX-License-Identifier: Apache-2.0
// Implements `latsch worker`: evaluates the trials of a study for the process that started it.
#include "evaluation/executors/worker.h"

#include "base/error.h"
#include "cli/run/trials.h"
#include "cli/verbs/verbs.h"
#include "correlation/study/refinement.h"
#include "correlation/study/study_stages.h"
#include "correlation/target/predictions.h"
#include "correlation/target/study_trials.h"

namespace latsch::cli {

void add_worker(CommandLine& app, Program& program) {
  Verb verb = app.add_subcommand("worker", "Evaluates trials for `latsch run` and `latsch doe`");
  verb.hide();
  auto file = std::make_shared<std::string>();
  verb.add_option("study", *file, "Study file (TOML)").required();
  auto all = std::make_shared<bool>(false);
  auto stage = std::make_shared<std::string>();
  verb.add_option("--stage", *stage, "The model as that [stage.NAME] has it");
  verb.add_flag("--predictions", *all, "The experiments with use = \"predict\" too");
  auto finer = std::make_shared<bool>(false);
  verb.add_flag("--refined", *finer, "The model as [refined] has it");
  auto slopes = std::make_shared<bool>(false);
  verb.add_flag("--slopes", *slopes, "With the slopes that the search needs");
  auto identity = std::make_shared<std::string>();
  verb.add_option("--identity", *identity, "Refuses a study that is another one by now");
  verb.footer(
      "Started by the program itself, one process a worker: it reads points from its standard "
      "input\nand writes their outcomes to its standard output. To try it by hand there is latsch "
      "simulate.");
  verb.callback([=, &program] {
    correlation::Study study = correlation::read_study(*file, program.language);
    if (!stage->empty()) study = correlation::stage_called(study, *stage);
    study.asks_slopes = *slopes;
    if (!identity->empty() && identity_key(study) != *identity)
      throw InputError(  // the text is short because the starting process quotes only its beginning
          "the files of the study have changed since the run began; latsch resume once they are "
          "restored");
    if (*finer) study = correlation::refined(study);
    program.exit_code =
        serve(correlation::evaluator(*all ? correlation::with_predictions(study) : study));
  });
}

}  // namespace latsch::cli
