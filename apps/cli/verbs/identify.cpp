// SPDX-License-Identifier: Apache-2.0
// Implements `latsch identify`: reports how well the measurements determine the variables around
// the best trial of a journal.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <utility>

#include "cli/console/answers.h"
#include "cli/console/certainty_answers.h"
#include "cli/console/console.h"
#include "cli/console/identifiability_text.h"
#include "cli/run/interrupt.h"
#include "cli/run/trials.h"
#include "cli/run/workers.h"
#include "cli/verbs/verbs.h"
#include "correlation/analysis/identification_start.h"
#include "correlation/analysis/refit_trials.h"
#include "correlation/search/search_standing.h"
#include "correlation/search/stage_runs.h"
#include "correlation/target/best_trial.h"
#include "correlation/target/predictions.h"
#include "correlation/target/residuals.h"
#include "correlation/target/trial_ownership.h"
#include "evaluation/journal/readable_journal.h"

namespace latsch::cli {
namespace {

using correlation::Study;

/// Returns the best point, or a point close to it at which an earlier analysis began: the trials of
/// that analysis may include a slightly better one, and starting there would repeat the analysis.
DesignPoint start(const Study& study, const Journal& journal, const DesignPoint& best) {
  constexpr double kClose = 0.02;  // share of the range of every variable
  const auto recorded = correlation::recorded_identifiability(study, journal);
  if (!recorded) return best;
  const auto u = study.space.to_unit(best), v = study.space.to_unit(recorded->point);
  const auto close = [](double a, double b) { return std::abs(a - b) <= kClose; };
  return std::equal(u.begin(), u.end(), v.begin(), close) ? recorded->point : best;
}

void say_interrupted(const Journal& journal) {
  const long refits = correlation::refit_trial_count(journal);
  say("Interrupted; {} trials are safe{}. The same command continues.\n",
      journal.size() + refits,
      refits == 0 ? ""
                  : fmt::format(", {} of them, of refits, in {}",
                                refits,
                                correlation::RefitTrials::file(journal.file()).string()));
}

/// Ranks experiments that have no measurement yet by the information that measuring them would
/// give. Takes one trial for each variable, on workers of this machine, also under mpirun. Returns
/// false if a signal interrupted it.
bool rank_predictions(const Study& study, const correlation::Identifiability& what) {
  if (!correlation::has_predictions(study)) return true;
  const auto points = correlation::prediction_points(study, what);
  ProcessOptions options = worker_processes(study);
  options.arguments.emplace_back("--predictions");
  ProcessExecutor executor(options);
  if (!correlation::predict(
          study, points, executor, counting_options(study, "trials with the predictions"))) {
    return false;
  }
  const auto channels = correlation::predicted_channels(study, points);
  if (!channels) {
    say("\nThe predicted experiments fail beside the best point; their gain is not known\n");
    return true;
  }
  const auto gains = correlation::prediction_gains(study, what, *channels);
  answer()["predictions"] = gains_of(study, gains);
  print_gains(
      study, "What would add information: experiments that are only predicted so far", gains);
  return true;
}

/// Reports from the trials in a journal without write permission, to which no further trial can be
/// added.
int identify_as_recorded(const Study& as_written,
                         const experiment::Language& language,
                         const std::string& output) {
  const Journal journal = Journal::read(as_written.run.journal, correlation::identity(as_written));
  const Study study = correlation::with_estimated_noise(as_written, journal);
  correlation::require_best(study, journal);
  const auto found = correlation::recorded_identifiability(study, journal);
  if (!found) {
    complain("the trials around the best point are missing, and " + study.run.journal.string() +
             " may not be written: copy the study to a folder of your own and run latsch identify "
             "there");
    return kFailed;
  }
  answer()["variables"] = answer_of(study, *found);
  say("\nValues and their confidence intervals, as far as the trials in {} show\n",
      study.run.journal.string());
  print_intervals(study, *found);
  print_identifiability(study, *found);
  const auto bands = correlation::prediction_bands(study, *found, journal);
  print_bands(study, bands);
  print_nuisance(study, bands);
  answer()["bands"] = answer_of(study, bands);
  answer_nuisance(study, bands);
  if (!output.empty())
    return write_report(study, journal, language, experiment::Thoroughness::seconds, output);
  say("\nNo report is written: its folder may not be written; -o FILE writes it elsewhere\n");
  return kDone;
}

/// Prints the result of the identification and adds it to the JSON answer. Returns false if the
/// user interrupted the ranking of experiments.
bool print_found(const Study& study,
                 const Journal& journal,
                 const correlation::Identifiability& found,
                 const correlation::RatedTrial& before,
                 bool profiles) {
  answer()["variables"] = answer_of(study, found);
  for (const TargetProfile& profile : found.identification.profiles())
    answer()["variables"][profile.variable]["verdict"] = in_words(profile);
  if (const auto now = correlation::best_trial(study, journal); now->point != before.point) {
    answer()["target"] = now->target;
    say("\nA better point was found: target {:.4f} % instead of {:.4f} %. Values, report and "
        "latsch export refer to it from now on.\n",
        100.0 * now->target,
        100.0 * before.target);
  }
  const auto priors = correlation::prior_count(study);
  say("\nValues and their confidence intervals, from {} measured values{}\n",
      found.identification.residuals_used().size() - priors,
      priors == 0 ? "" : fmt::format(" and {} prior{}", priors, priors == 1 ? "" : "s"));
  print_intervals(study, found);
  print_identifiability(study, found);
  if (profiles && !rank_predictions(study, found)) return false;
  const auto bands = correlation::prediction_bands(study, found, journal);
  print_bands(study, bands);
  print_nuisance(study, bands);
  answer()["bands"] = answer_of(study, bands);
  answer_nuisance(study, bands);
  const auto missed = correlation::missed_values(study, found);
  answer()["missed"] = answer_of(study, missed);
  print_missed(study, missed);
  return true;
}

int identify(const std::string& file,
             const experiment::Language& language,
             int workers,
             bool profiles,
             const std::string& output) {
  Study study = correlation::read_study(file, language);
  if (workers > 0) study.run.workers = workers;
  if (!std::filesystem::exists(study.run.journal)) {
    throw InputError(study.run.journal.string() +
                     " does not exist: there is nothing to analyze; start with latsch run");
  }
  if (!may_be_written(study.run.journal)) return identify_as_recorded(study, language, output);
  Workers workers_of_study(study);
  if (workers_of_study.served(study)) return kDone;
  Journal journal = Journal::open(study.run.journal, correlation::identity(study));
  const correlation::StagesRun searched = correlation::recorded_stages(study, journal);
  const Study as_read = std::exchange(study, searched.study);
  correlation::require_best(study, journal);
  correlation::mark_target(study, journal);
  say_kind_of_journal(study);
  if (!searched.has_ended)
    warn(
        "no search of this study has ended, so intervals and verdicts belong to the best trial so "
        "far, which need not be at a minimum; run latsch run " +
        study.file.string() + " first");
  const auto best = correlation::best_trial(study, journal);
  if (!best) {
    complain("no trial in " + study.run.journal.string() + " succeeded");
    return kFailed;
  }
  const bool has_begun = correlation::has_begun(journal, correlation::Depth::profiles);
  const DesignPoint point = has_begun ? best->point : start(study, journal, best->point);
  catch_interrupts();
  const TrialsRun trials(workers_of_study, study);
  Executor& executor = workers_of_study.start(study);
  auto result =
      correlation::identify(study,
                            point,
                            profiles ? correlation::Depth::profiles : correlation::Depth::intervals,
                            executor,
                            journal,
                            counting_options(study, "trials around the best one"));
  if (!result) {
    say_interrupted(journal);
    return kStopped;
  }
  if (!*result) {
    complain(result->failure().reason);
    return kFailed;
  }
  workers_of_study.end();
  if (!take_refined(study, **result)) {
    say("Interrupted before the refined model; the same command continues.\n");
    return kStopped;
  }
  if (!print_found(study, journal, **result, *best, profiles)) {
    say_interrupted(journal);
    return kStopped;
  }
  return write_report_of_run(study, as_read, journal, language, output);
}

}  // namespace

void add_identify(CommandLine& app, Program& program) {
  Verb verb = app.add_subcommand("identify",
                                 "Says which variables the measurements determine, and how well");
  verb.footer(
      "Example:\n  latsch identify studies/tire_b_twin/study.toml --workers 2\n\n"
      "Starts at the best trial of the journal, holds each variable at other values and fits the "
      "others\nanew. That takes some dozens of trials a variable. They stay in the journal or, "
      "where the model\n"
      "brings its slopes, in reduced form in STUDY.latsch.refits beside it; interrupted, even "
      "killed, the "
      "same\n"
      "command goes on.");
  auto file = std::make_shared<std::string>();
  auto workers = std::make_shared<int>(0);
  auto short_form = std::make_shared<bool>(false);
  verb.add_option("study", *file, "Study file (TOML)").required();
  verb.add_option("--workers", *workers, "Worker processes, instead of the study's")
      .between(1, 1024);
  auto output = std::make_shared<std::string>();
  verb.add_option("-o,--output", *output, "HTML file of the report; beside the study unless given")
      .written_as("HTML", {".html", ".htm"});
  verb.add_flag("--short", *short_form, "Intervals only, one more trial a variable");
  verb.callback([=, &program] {
    program.exit_code = identify(*file, program.language, *workers, !*short_form, *output);
  });
}

}  // namespace latsch::cli
