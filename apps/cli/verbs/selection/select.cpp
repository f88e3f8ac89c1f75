// SPDX-License-Identifier: Apache-2.0
#include "cli/verbs/selection/select.h"

#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <limits>
#include <nlohmann/json.hpp>
#include <utility>

#include "base/file.h"
#include "cli/console/console.h"
#include "cli/run/interrupt.h"
#include "cli/run/trials.h"
#include "cli/run/workers.h"
#include "cli/verbs/selection/selection_text.h"
#include "correlation/search/stage_runs.h"
#include "correlation/selection/selected_study.h"
#include "correlation/selection/study_selection.h"
#include "correlation/target/best_trial.h"
#include "correlation/target/compared_trial.h"
#include "correlation/target/predictions.h"

namespace latsch::cli {
namespace {

using correlation::Study;
using correlation::StudySelection;

/// The study as its last stage leaves it, and the point where the selection begins.
struct SelectionBegin {
  Study study;
  DesignPoint start;
  bool is_fitted = false;  // true: the best trial of a finished or running search
};

/// Begins at the best trial of the study's journal, or at the initial values without one.
SelectionBegin begin_of(const Study& study) {
  SelectionBegin begin{study, study.space.initial()};
  if (!std::filesystem::exists(study.run.journal)) return begin;
  const Journal journal = Journal::read(study.run.journal, correlation::identity(study));
  begin.study = correlation::recorded_stages(study, journal).study;
  if (const auto best = correlation::best_trial(begin.study, journal)) {
    begin.start = best->point;
    begin.is_fitted = true;
  }
  return begin;
}

/// Returns the error of each predicted experiment for each of these points, NaN if it is not known.
/// Returns nullopt if a signal interrupted the trials.
std::optional<std::vector<std::vector<double>>> predicted_errors(
    const Study& study, const std::vector<DesignPoint>& points) {
  ProcessOptions options = worker_processes(study);
  options.arguments.emplace_back("--predictions");
  ProcessExecutor executor(options);
  RunOptions run = counting_options(study, "trials with the predictions");
  run.on_failure.then = FailurePolicy::Then::proceed;
  if (!correlation::predict(study, points, executor, run)) return std::nullopt;
  std::vector<std::vector<double>> errors;
  for (const DesignPoint& point : points) {
    errors.emplace_back();
    const auto channels = correlation::predicted_channels(study, {point});
    for (const correlation::StudyExperiment& experiment : study.experiments) {
      if (experiment.fitted) continue;
      errors.back().push_back(std::numeric_limits<double>::quiet_NaN());
      if (!channels) continue;
      if (const auto comparison =
              correlation::comparison_of(experiment, study.experiments, channels->front()))
        errors.back().back() = correlation::own_measure(experiment, *comparison);
    }
  }
  return errors;
}

std::vector<std::string> predicted_names(const Study& study) {
  std::vector<std::string> names;
  for (const correlation::StudyExperiment& experiment : study.experiments)
    if (!experiment.fitted) names.push_back(experiment.name);
  return names;
}

/// Writes the study with the kept variables, and reads it once to be sure that it can be read.
void write_selected_study(const Study& study,
                          const StudySelection& selected,
                          const experiment::Language& language,
                          const std::filesystem::path& to) {
  const auto text = correlation::selected_study_text(study, selected);
  if (!text) {
    warn("no study of the kept variables is written: " + text.failure().reason);
    return;
  }
  write_file(to, [&](std::ostream& out) { out << *text; });
  (void)correlation::read_study(to, language);
  say_written(to.string());
}

std::filesystem::path output_of(const Study& study, const std::string& output) {
  if (output.empty()) return correlation::selected_study_file(study);
  const std::filesystem::path to(output);
  const auto folder = [](const std::filesystem::path& file) {
    return std::filesystem::weakly_canonical(std::filesystem::absolute(file)).parent_path();
  };
  if (folder(to) != folder(study.file))
    throw InputError(output + " is not in the folder of " + study.file.string() +
                     ", to whose files the study of the kept variables refers; name a file there");
  if (std::filesystem::exists(to) && std::filesystem::equivalent(to, study.file))
    throw InputError(output + " is the study itself, which would be lost; name another file");
  return to;
}

int select(const std::string& file,
           const experiment::Language& language,
           int workers,
           const std::string& output) {
  const Study as_written = correlation::read_study(file, language);
  const std::filesystem::path to = output_of(as_written, output);
  SelectionBegin begin = begin_of(as_written);
  if (workers > 0) begin.study.run.workers = workers;
  if (const std::string reason = correlation::why_no_selection(begin.study); !reason.empty())
    throw InputError({as_written.file.string(), 0}, reason);
  const Study study = correlation::with_selection_journal(begin.study);
  Workers workers_of_study(study);
  if (workers_of_study.served(study)) return kDone;
  Journal journal = Journal::open(study.run.journal, correlation::identity(study));
  catch_interrupts();
  const TrialsRun trials(workers_of_study, study);
  Executor& executor = workers_of_study.start(study);
  say("The selection begins at {}.\n",
      begin.is_fitted ? "the best trial of " + as_written.run.journal.string()
                      : std::string("the initial values, because the study has not been run"));
  const auto found = correlation::select_coefficients(
      study, begin.start, executor, journal, counting_options(study, "trials of the selection"));
  if (!found) {
    say("Interrupted; {} trials are safe. The same command continues.\n", journal.size());
    return kStopped;
  }
  if (!*found) {
    complain(found->failure().reason);
    return kFailed;
  }
  workers_of_study.end();
  const StudySelection& selected = **found;
  std::vector<std::vector<double>> errors;
  if (correlation::has_predictions(study)) {
    std::vector<DesignPoint> points;
    for (const std::size_t k : selected.selection.rivals())
      points.push_back(selected.point(study.space, selected.selection.path()[k]));
    auto predicted = predicted_errors(begin.study, points);
    if (!predicted) {
      say("Interrupted before the predictions; the same command continues.\n");
      return kStopped;
    }
    errors = std::move(*predicted);
  }
  print_path(selected);
  print_candidates(study, selected);
  print_ground(study, selected);
  print_rivals(study, selected, predicted_names(study), errors);
  say("\n{} refit{}, {} trials\n",
      selected.selection.refits(),
      selected.selection.refits() == 1 ? "" : "s",
      selected.trials);
  answer_selection(study, selected, predicted_names(study), errors);
  const auto table = correlation::selection_table_file(as_written);
  correlation::write_selection_table(study, selected, table);
  say_written(table.string());
  write_selected_study(as_written, selected, language, to);
  return kDone;
}

}  // namespace

void add_select(CommandLine& app, Program& program) {
  Verb verb = app.add_subcommand("select", "Chooses the variables that the measurements carry");
  verb.footer(
      "Example:\n  latsch select studies/race_tire_selection/study.toml --workers 2\n\n"
      "Fits all candidates of [selection], drops those that the fit can do without, refits, and "
      "keeps the model\n"
      "with the least criterion. Begins at the best trial of latsch run or, without one, at the "
      "initial values.\n"
      "Writes STUDY.selected.toml, which moves the kept variables alone, and a table of the "
      "candidates. The\n"
      "trials stay in STUDY.selection.latsch; interrupted, even killed, the same command goes on.");
  auto file = std::make_shared<std::string>();
  auto workers = std::make_shared<int>(0);
  auto output = std::make_shared<std::string>();
  verb.add_option("study", *file, "Study file (TOML)").required();
  verb.add_option("--workers", *workers, "Worker processes, instead of the study's")
      .between(1, 1024);
  verb.add_option("-o,--output",
                  *output,
                  "File of the study of the kept variables, in the folder of the study")
      .written_as("TOML", {".toml"});
  verb.callback(
      [=, &program] { program.exit_code = select(*file, program.language, *workers, *output); });
}

}  // namespace latsch::cli
