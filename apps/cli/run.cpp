// SPDX-License-Identifier: Apache-2.0
// latsch run, latsch resume: the optimizer over the worker processes. To resume is to run the same
// optimizer again on the journal it left.
#include <fmt/format.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "cli/answers.h"
#include "cli/console.h"
#include "cli/identifiability_text.h"
#include "cli/interrupt.h"
#include "cli/tables.h"
#include "cli/trials.h"
#include "cli/verbs.h"
#include "cli/workers.h"
#include "correlation/tire_trials.h"

namespace latsch::cli {
namespace {

using correlation::Study;

void print_result(const Study& study, const Run& run, const Journal& journal) {
  const Step& best = *run.best();
  answer()["target"] = best.outcome->value;
  answer()["steps"] = run.steps.size();
  answer()["trials"] = journal.size();
  answer()["journal"] = study.run.journal.string();
  answer()["variables"] = answer_of(study.space, best.point);
  say("\n{} trials in {}\n\nBest of {} steps: target {:.4f} %\n",
      journal.size(),
      study.run.journal.string(),
      run.steps.size(),
      best.outcome->value * 100.0);
  const double off = violation(*best.outcome);
  if (off > kFulfilled) {
    say("No step fulfills all constraints; the best one is off by {:.2g} of a scale\n", off);
  }
}

/// The values found, with their intervals where these are wanted and can be had; false where that
/// was interrupted.
bool print_values(const Study& study,
                  const DesignPoint& point,
                  Executor& executor,
                  Journal& journal) {
  if (!study.run.intervals) {
    print_point(study.space, point);
    return true;
  }
  const auto result = correlation::identify(study,
                                            point,
                                            correlation::Depth::intervals,
                                            executor,
                                            journal,
                                            counting_options(study, "trials around the best one"));
  if (!result) {
    print_point(study.space, point);
    say("Interrupted before the intervals; the same command goes on.\n");
    return false;
  }
  if (*result) {
    answer()["variables"] = answer_of(study, **result);
    print_intervals(study, **result);
  } else {
    print_point(study.space, point);
    say("  No confidence intervals: {}\n", result->failure().reason);
  }
  return true;
}

int fit(const std::string& file, int workers, bool resuming) {
  Study study = correlation::read_study(file);
  if (workers > 0) study.run.workers = workers;
  if (resuming && !std::filesystem::exists(study.run.journal)) {
    throw InputError(study.run.journal.string() +
                     " does not exist: there is nothing to resume; start with latsch run");
  }
  Workers workers_of_study(study);
  if (workers_of_study.served(study)) return kDone;
  Journal journal = Journal::open(study.run.journal, correlation::identity(study));
  say_kind_of_journal(study);
  if (journal.size() > 0) say("{} finished trials are reused\n", journal.size());

  const MethodChoice choice = correlation::method_of(study);
  say("Optimizer {}: {}\n", in_words(choice.method), choice.reason);

  catch_interrupts();
  const TrialsRun trials(workers_of_study, study);
  Executor& executor = workers_of_study.start(study);
  const auto optimizer = correlation::make_optimizer(study);
  const Run run = run_optimizer(*optimizer,
                                correlation::objective(study),
                                executor,
                                &journal,
                                run_options(study, /*length_known=*/false));
  if (run.end == RunEnd::stopped) {
    say("Interrupted; {} trials are safe. Go on with: latsch resume {}\n", journal.size(), file);
    return kFailed;
  }
  if (run.end == RunEnd::aborted) {
    print_aborted(study, run.steps.back().point, run.steps.back().outcome.failure());
    return kFailed;
  }
  if (!run.best()) {
    print_no_success(study, journal, run.steps.front().outcome.failure().reason);
    return kFailed;
  }
  print_result(study, run, journal);
  if (!print_values(study, run.best()->point, executor, journal)) return kFailed;
  workers_of_study.end();
  return write_report(study, journal);
}

}  // namespace

void add_run(CommandLine& app, int& exit_code) {
  for (const bool resuming : {false, true}) {
    Verb verb = app.add_subcommand(
        resuming ? "resume" : "run",
        resuming ? "Goes on with an interrupted run; the result is the same to the last bit"
                 : "Fits the variables to the measurements");
    verb.footer(fmt::format(
        "[run] in the study says how trials are run: workers, timeout, memory, on_failure, "
        "retries,\n"
        "stragglers = false (what runs long is left alone), straggler_factor = 3 (times the "
        "median),\n"
        "look_ahead = 4 (points ahead for every worker); none of it changes what is found.\n\n"
        "Examples:\n  latsch {0} studies/tire_b_twin/study.toml --workers 2\n"
        "  mpirun -n 8 latsch {0} study.toml           on a cluster: one searches, seven evaluate\n"
        "  srun -n 8 --mpi=pmix latsch {0} study.toml  the same below Slurm",
        resuming ? "resume" : "run"));
    auto file = std::make_shared<std::string>();
    auto workers = std::make_shared<int>(0);
    verb.add_option("study", *file, "Study file (TOML)").required();
    verb.add_option("--workers", *workers, "Worker processes, instead of the study's")
        .between(1, 1024);
    verb.callback([=, &exit_code] { exit_code = fit(*file, *workers, resuming); });
  }
}

}  // namespace latsch::cli
