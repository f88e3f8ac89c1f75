// SPDX-License-Identifier: Apache-2.0
// Implements `latsch run` and `latsch resume`: both run the optimizer of a study on worker
// processes. Resuming runs the same optimizer again, which finds its earlier trials in the journal.
#include <fmt/format.h>

#include <chrono>
#include <cstdio>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <thread>
#include <utility>

#include "base/file.h"
#include "cli/console/answers.h"
#include "cli/console/certainty_answers.h"
#include "cli/console/console.h"
#include "cli/console/identifiability_text.h"
#include "cli/console/implausible.h"
#include "cli/console/ledgers.h"
#include "cli/console/tables.h"
#include "cli/console/tire_faults.h"
#include "cli/run/interrupt.h"
#include "cli/run/served_studies.h"
#include "cli/run/trials.h"
#include "cli/run/virtual_recordings.h"
#include "cli/run/workers.h"
#include "cli/verbs/comparison/run_comparison.h"
#include "cli/verbs/posterior/sample.h"
#include "cli/verbs/verbs.h"
#include "correlation/analysis/prediction_bands.h"
#include "correlation/analysis/refit_trials.h"
#include "correlation/comparison/model_comparison_file.h"
#include "correlation/posterior/posterior.h"
#include "correlation/search/finished_run.h"
#include "correlation/search/stage_runs.h"
#include "correlation/search/study_change.h"
#include "correlation/search/study_method.h"
#include "correlation/study/study_stages.h"
#include "correlation/study/study_start.h"
#include "correlation/target/best_trial.h"
#include "correlation/target/estimated_noise.h"
#include "correlation/target/residuals.h"
#include "correlation/target/study_trials.h"
#include "correlation/target/test_limits.h"
#include "evaluation/executors/launch.h"
#include "evaluation/journal/journal_lock.h"
#include "optimization/problem/infinity.h"

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
  say("\n{} in {}\n\nBest of {}: target {:.4f} %\n",
      counted(journal.size(), "trial"),
      study.run.journal.string(),
      counted(run.steps.size(), "step"),
      best.outcome->value * 100.0);
  answer()["ending"] = run.ending;
  answer()["claims"] = answer_of(run.claims);
  if (!run.basins.empty()) answer()["minima"] = answer_of(study.space, run.basins);
  say("The search ended {}\n", run.ending);
  const double off = violation(*best.outcome);
  if (off > kFulfilled) {
    say("No step fulfills all constraints; the best one is off by {:.2g} of a scale\n", off);
  }
}

/// Prints how measured modes were paired with those of the best trial, if the pairing is not
/// obvious.
void print_remarks(const Study& study, const DesignPoint& best, const Journal& journal) {
  const Channels recording = correlation::recording_at(best, journal);
  for (const correlation::StudyExperiment& experiment : study.experiments) {
    if (!experiment.fitted) continue;
    const auto comparison = correlation::comparison_of(experiment, study.experiments, recording);
    if (!comparison) continue;
    for (const std::string& remark : experiment.observable->remarks(*comparison))
      say("{}: {}\n", experiment.name, remark);
  }
}

/// Returns the sum of squared residuals at a point of the journal.
double sum_of_squares(const Study& study, const DesignPoint& point, const Journal& journal) {
  const auto score =
      correlation::residual_objective(study)(point, correlation::recording_at(point, journal));
  return score ? score->value : kInfinity;
}

/// Says that a trial beside the end of the search has a smaller target, and why the search did not
/// end there.
void print_better_neighbor(const Study& study,
                           const DesignPoint& end,
                           const DesignPoint& better,
                           double target,
                           const Journal& journal) {
  const bool has_less =
      sum_of_squares(study, better, journal) < sum_of_squares(study, end, journal);
  say("A neighboring trial {}: target {:.4f} %; the values below are its values{}\n",
      has_less ? "is better" : "has a smaller target",
      target * 100.0,
      has_less ? ", because the search ended before it reached the least target"
               : ". Its sum of squared errors, which intervals and most searches refer to, is "
                 "larger: the target counts errors with another exponent");
}

/// Prints the identified values, with their intervals if these are requested and available. Returns
/// false if a signal interrupted the computation of the intervals.
bool print_values(const Study& study,
                  const DesignPoint& point,
                  correlation::Depth depth,
                  Workers& workers,
                  Executor& executor,
                  Journal& journal) {
  if (!study.run.intervals) {
    print_point(study.space, point);
    return true;
  }
  auto result = correlation::identify(study,
                                      point,
                                      depth,
                                      executor,
                                      journal,
                                      counting_options(study, "trials around the best one"));
  if (!result) {
    print_point(study.space, point);
    say("Interrupted before the intervals; the same command continues.\n");
    return false;
  }
  workers.end();
  if (*result && !take_refined(study, **result)) {
    say("Interrupted before the refined model; the same command continues.\n");
    return false;
  }
  if (*result) {
    if ((*result)->best != point) {
      const auto better = correlation::best_trial(study, journal);
      answer()["target"] = better->target;
      print_better_neighbor(study, point, (*result)->best, better->target, journal);
    }
    answer()["variables"] = answer_of(study, **result);
    print_intervals(study, **result);
    const auto bands = correlation::prediction_bands(study, **result, journal);
    print_delays(study, bands);
    answer()["delays"] = delays_of(study, bands);
    print_nuisance(study, bands);
    answer_certainty(study, **result);
    answer_nuisance(study, bands);
  } else {
    print_point(study.space, point);
    say("  No confidence intervals: {}\n", result->failure().reason);
  }
  return true;
}

/// Returns the best point of the journal, which all commands use, and says so if another command
/// than this run has found it.
DesignPoint best_of_journal(const Study& study, const DesignPoint& of_run, const Journal& journal) {
  const auto best = correlation::best_trial(study, journal);
  if (!best || best->point == of_run) return of_run;
  answer()["target"] = best->target;
  answer()["variables"] = answer_of(study.space, best->point);
  say("The journal knows a better trial, of another command: target {:.4f} %. Values, report and "
      "latsch export refer to it.\n",
      best->target * 100.0);
  return best->point;
}

/// Options of run and resume on the command line.
struct Asked {
  std::string file;
  int workers = 0;  // 0: the number that the study states
  bool resuming = false;
  bool retries_failed = false;
  bool adopts = false;
  bool anew = false;
  bool watch = false;
  bool records_only = false;
  bool samples = false;
};

/// Renames the journal, for example from "study.latsch" to "study.1.latsch"; the number is the
/// first that is free.
void set_aside(const std::filesystem::path& journal) {
  if (!std::filesystem::exists(journal)) return;
  for (int number = 1;; ++number) {
    auto aside = journal;
    aside.replace_extension(fmt::format(".{}{}", number, journal.extension().string()));
    if (std::filesystem::exists(aside)) continue;
    const JournalLock nobody_writes(journal);
    // The files that SQLite may leave beside a journal after a kill.
    for (const char* part : {"", "-wal", "-shm", "-journal"}) {
      if (!std::filesystem::exists(journal.string() + part)) continue;
      move_file(journal.string() + part, aside.string() + part);
    }
    const auto refits = correlation::RefitTrials::file(journal);
    if (std::filesystem::exists(refits)) move_file(refits, correlation::RefitTrials::file(aside));
    say("The old journal is kept as {}\n", aside.string());
    return;
  }
}

Journal open_journal(const Study& stage, const Asked& asked) {
  if (asked.anew) set_aside(stage.run.journal);
  const StudyIdentity identity = correlation::identity(stage);
  if (asked.adopts && std::filesystem::exists(stage.run.journal) &&
      Journal::adopt(stage.run.journal, identity)) {
    say("The trials in {0} are taken over; the original stays as {0}.before_adoption\n",
        stage.run.journal.string());
  }
  Journal journal = open_for_trials(stage, asked.retries_failed);
  say_kind_of_journal(stage);
  if (journal.size() > 0) say("{} finished trials are reused\n", journal.size());
  return journal;
}

void print_beginning(const Study& study, int k, const Study& stage) {
  if (!study.stages.empty()) {
    const auto& settings = study.stages[static_cast<std::size_t>(k)];
    say("\nStage {} of {}, {}: {}\n",
        k + 1,
        study.stages.size(),
        settings.name,
        correlation::in_words(settings));
  }
  const MethodChoice choice = correlation::method_of(stage);
  say("Optimizer {}: {}\n", in_words(choice.method), choice.reason);
  const std::string noise = correlation::noise_in_words(stage);
  if (!noise.empty())
    say("Noise, as {}: {}\n",
        correlation::has_noise_of_own_stages(stage) ? "the experiments' own stages left it"
                                                    : "the stage before leaves it",
        noise);
  const std::string start = correlation::in_words(stage.start);
  if (!start.empty()) say("It starts at {}\n", start);
}

void print_hopeless(const Study& study, const Journal& journal, const std::string& reason) {
  const std::string how = study.specimens->how_to_see_more();
  complain(fmt::format(
      "no trial succeeded, of {} in {}, even far from the start: every one failed for one "
      "reason, which has nothing to do with the point: {}\n"
      "See how one fails: latsch simulate {}{}. Once that is fixed, continue with: latsch "
      "resume {} --retry-failed",
      journal.size(),
      study.run.journal.string(),
      reason,
      study.file.string(),
      how.empty() ? "" : "; " + how,
      study.file.string()));
}

/// Returns true if the fit of a stage ended with a best point; otherwise reports the reason.
bool has_found(const Study& stage, const correlation::Fit& fit, const Journal& journal) {
  const Run& run = fit.run;
  if (run.end == RunEnd::stopped) {
    say("Interrupted; {} trials are safe. Go on with: latsch resume {}\n",
        journal.size(),
        stage.file.string());
    return false;
  }
  if (run.end == RunEnd::aborted) {
    print_aborted(stage, run.steps.back().point, run.steps.back().outcome.failure());
    return false;
  }
  if (run.best()) return true;
  if (fit.hopeless) {
    print_hopeless(stage, journal, *fit.hopeless);
  } else {
    print_no_success(stage, journal, run.steps.front().outcome.failure().reason);
  }
  return false;
}

/// Runs the stages of a study one after the other on the workers. Journal and executor of the last
/// stage stay open for further trials around its best point.
class StagesOnWorkers {
 public:
  StagesOnWorkers(const Study& study, const Asked& asked, Workers& workers)
      : study_(study), asked_(asked), once_(asked), workers_(workers) {}

  correlation::StagesRun run() {
    return correlation::run_stages(
        study_, [this](const correlation::StageRun& part) { return run_stage(part); });
  }

  Executor& executor() { return *executor_; }
  Journal& journal() { return *journal_; }

 private:
  std::optional<correlation::StageResult> run_stage(const correlation::StageRun& part) {
    trials_.reset();
    journal_.reset();
    const Study& stage = stage_.emplace(part.study);
    journal_.emplace(open_journal(stage, once_));
    print_beginning(study_, part.number, stage);
    trials_.emplace(workers_, stage);
    executor_ = &workers_.start(stage);
    correlation::Fit fit =
        correlation::fit(stage, *executor_, *journal_, run_options(stage, /*length_known=*/false));
    if (has_found(stage, fit, *journal_) && !part.is_last) print_end(fit.run);
    // If stages share a journal, only the first of them sets the old journal aside or runs failed
    // trials again.
    once_.anew = asked_.anew && !part.next_shares_journal;
    once_.retries_failed = asked_.retries_failed && !part.next_shares_journal;
    return correlation::StageResult{std::move(fit), &*journal_};
  }

  void print_end(const Run& run) const {
    say("Best of {}: target {:.4f} %\nThe search ended {}\n",
        counted(run.steps.size(), "step"),
        100.0 * run.best()->outcome->value,
        run.ending);
    print_point(study_.space, run.best()->point);
  }

  const Study& study_;
  const Asked& asked_;
  Asked once_;  // options of the next stage
  Workers& workers_;
  std::optional<Study> stage_;
  std::optional<Journal> journal_;
  std::optional<TrialsRun> trials_;
  Executor* executor_ = nullptr;
};

void say_finished(const Study& study) {
  say("\nThis study is finished: nothing has changed since its last run, whose result follows from "
      "the journal without a new trial.\nAnother search: latsch run {} --anew begins from the "
      "start; start = \"journal\" in [optimizer] begins at the best trial; more max_steps "
      "continue a search that did not end\n",
      study.file.string());
}

/// Says what `batch` would gain if several workers evaluated what a search may do with one point at
/// a time. The figures are those of ./bench.sh workers_search.
void offer_batch(const Study& study, int workers) {
  constexpr int kWorthIt = 4;
  const bool takes_one = study.optimizer.residual_trust_region.outstanding == 1;
  const Method method = correlation::method_of(study).method;
  if (!takes_one && method != Method::residual_trust_region && method != Method::ensemble)
    warn(
        fmt::format("[optimizer] batch had no effect, because the method is {}, which chooses one "
                    "point at a time",
                    in_words(method)));
  if (workers < kWorthIt || !takes_one || method != Method::residual_trust_region) return;
  say("The search knew every outcome before it chose the next point, so most of the {0} workers "
      "evaluated points that it might have needed. With [optimizer] batch = {0} they work for the "
      "search: on test problems 4 places were 1.5 to 2.1 times as fast for twice the trials, and "
      "16 places 1.6 to 3.1 times for 4 to 8 times the trials. It then takes other steps\n",
      workers);
}

/// Ends a run after its last stage: prints the result, runs the trials that the intervals need, and
/// writes the report. Returns the exit code.
int finish(const Study& study,
           const Study& as_read,
           const Run& run,
           StagesOnWorkers& stages,
           Workers& workers,
           const experiment::Language& language) {
  Journal& journal = stages.journal();
  const DesignPoint best = run.best()->point;
  const auto finished = correlation::finished_run(as_read, journal);
  if (finished) say_finished(as_read);
  answer()["repeated"] = finished.has_value();
  print_result(study, run, journal);
  if (!finished) offer_batch(study, stages.executor().workers());
  print_remarks(study, best, journal);
  const DesignPoint shown = finished ? *finished : best_of_journal(study, best, journal);
  const bool is_early = run.end != RunEnd::converged;
  if (is_early && study.run.intervals)
    say("The search stopped early, so values and intervals are those of its best trial as it "
        "stands; they say nothing of a minimum\n");
  const auto depth = is_early ? correlation::Depth::at_the_point : correlation::Depth::intervals;
  if (!print_values(study, shown, depth, workers, stages.executor(), journal)) return kStopped;
  workers.end();
  if (const auto found = correlation::best_trial(study, journal)) {
    warn_beyond_data(study, found->point);
    const auto limits = correlation::limits_met_at(study, found->point);
    warn_of_limits_met(study, limits);
    answer()["limits"] = limits;
  }
  const int exit_code = write_report_of_run(study, as_read, journal, language);
  if (exit_code == kDone) correlation::mark_finished(as_read, shown, journal);
  return exit_code;
}

int fit_on_workers(const Study& study,
                   const Asked& asked,
                   Workers& workers,
                   const experiment::Language& language) {
  StagesOnWorkers stages(study, asked, workers);
  const correlation::StagesRun found = stages.run();
  if (found.end == RunEnd::stopped) return kStopped;
  const Run& last = found.fits.back().run;
  if (!found.has_ended || found.end == RunEnd::aborted || !last.best()) return kFailed;
  return finish(found.study, study, last, stages, workers, language);
}

int fit(const Asked& asked, const experiment::Language& language) {
  make_recordings(asked.file, language);
  if (asked.records_only) return kDone;
  Study study = correlation::read_study(asked.file, language);
  if (asked.workers > 0) study.run.workers = asked.workers;
  const auto first_journal = correlation::stage(study, 0).run.journal;
  if (asked.resuming && !std::filesystem::exists(first_journal)) {
    throw InputError(first_journal.string() +
                     " does not exist: there is nothing to resume; start with latsch run");
  }
  if (asked.samples) {
    if (const std::string reason = correlation::why_no_posterior(study); !reason.empty())
      throw InputError({study.file.string(), 0}, "--sample: " + reason);
  }
  Workers workers(study);
  if (workers.served(study, /*in_stages=*/true)) return kDone;
  reject_implausible(study);
  say_ledgers(study, true, "Files");
  for (const std::string& limit : correlation::limits_of_tests(study)) warn(limit);
  catch_interrupts();
  try {
    return fit_on_workers(study, asked, workers, language);
  } catch (const InputError& error) {
    const auto change = correlation::change_since_read(study, language);
    if (!change) throw;
    throw InputError({study.file.string(), 0},
                     fmt::format("the files of the study have changed since the run began: {}. "
                                 "Trials of them would not belong to its journal, so the run ends "
                                 "({}). Restore the files and continue with latsch resume, or "
                                 "begin anew with latsch run --anew",
                                 *change,
                                 error.what()));
  }
}

/// Runs the fit and, if asked, samples the posterior density around its end; the answer of the
/// sampling is "posterior" of the whole answer.
int fit_and_sample(const Asked& asked, const experiment::Language& language) {
  const int exit_code = fit(asked, language);
  if (exit_code != kDone || !asked.samples) return exit_code;
  Json of_fit = std::exchange(answer(), Json::object());
  const int code = sample(asked.file, language, {.workers = asked.workers, .writes_report = true});
  Json of_samples = std::exchange(answer(), std::move(of_fit));
  answer()["posterior"] = std::move(of_samples);
  return code;
}

/// Runs the fit while the studio serves its page. The page stays until the user ends the program.
int fit_watched(const Asked& asked, const experiment::Language& language) {
  if (correlation::is_model_comparison(asked.file)) {
    if (asked.watch || asked.resuming)
      throw InputError({asked.file, 0},
                       "is a comparison of models, expected latsch run without --watch; it goes on "
                       "where it was interrupted");
    return run_comparison(asked.file, language, asked.records_only, [&](const std::string& study) {
      Asked one = asked;
      one.file = study;
      return fit(one, language);
    });
  }
  if (!asked.watch || launch().task > 0) return fit_and_sample(asked, language);
  catch_interrupts();
  const ServedStudies page({asked.file}, language);
  say("{}\n", page.address());
  std::fflush(stdout);
  page.open_browser();
  const int exit_code = fit_and_sample(asked, language);
  if (!interrupted()) say("\nThe page stays open until Ctrl-C\n");
  std::fflush(stdout);
  while (!interrupted()) std::this_thread::sleep_for(std::chrono::milliseconds(50));
  return exit_code;
}

}  // namespace

void add_run(CommandLine& app, Program& program) {
  for (const bool resuming : {false, true}) {
    Verb verb = app.add_subcommand(
        resuming ? "resume" : "run",
        resuming
            ? "Goes on with an interrupted run; the result is the same to the last bit"
            : "Fits the variables to the measurements; of a comparison all its fits, and compares");
    verb.footer(fmt::format(
        "[run] in the study says how trials are run: workers, timeout, memory, on_failure, "
        "retries,\n"
        "stragglers = false (what runs long is left alone), straggler_factor = 3 (times the "
        "median),\n"
        "look_ahead = 4 (points ahead for every worker); none of it changes what is found.\n\n"
        "A study that has finished and has not changed is not searched again: run and resume "
        "repeat "
        "its result.\n--anew begins from the start, start = \"journal\" in [optimizer] at the best "
        "trial; more max_steps continue.\n\n"
        "A measurement with the key virtual is recorded first, by a test of another model, if it "
        "is "
        "missing or out of date.\nrun of a comparison of models does everything that it needs: "
        "recordings, fits, reference, comparison.\n\n"
        "Examples:\n  latsch {0} studies/tire_b_twin/study.toml --workers 2\n"
        "  latsch run studies/fe_kerb/comparison.toml         # from a tire to a car on a kerb\n"
        "  mpirun -n 8 latsch {0} my_tire/study.toml           # on a cluster: one searches, seven "
        "evaluate\n"
        "  srun -n 8 --mpi=pmix latsch {0} my_tire/study.toml  # the same below Slurm",
        resuming ? "resume" : "run"));
    auto asked = std::make_shared<Asked>();
    asked->resuming = resuming;
    verb.add_option("study", asked->file, "Study file (TOML)").required();
    verb.add_option("--workers", asked->workers, "Worker processes, instead of the study's")
        .between(1, 1024);
    verb.add_flag("--watch",
                  asked->watch,
                  "Opens a page that shows the run, and keeps it open "
                  "after the end");
    verb.add_flag("--sample",
                  asked->samples,
                  "Draws samples of the posterior density after the fit, as latsch sample does");
    if (resuming) {
      verb.add_flag("--retry-failed",
                    asked->retries_failed,
                    "Tries the points that failed so far again, once the cause is fixed");
      verb.add_flag("--adopt",
                    asked->adopts,
                    "Keeps the trials of another version of the model or the outside program");
    } else {
      verb.add_flag("--record",
                    asked->records_only,
                    "Records what the study measures on a model (key virtual) and is missing or "
                    "out of date, and ends");
      verb.add_flag("--anew",
                    asked->anew,
                    "Begins with an empty journal, also if the study has finished; the old one is "
                    "kept beside");
    }
    verb.callback([=, &program] { program.exit_code = fit_watched(*asked, program.language); });
  }
}

}  // namespace latsch::cli
