// SPDX-License-Identifier: Apache-2.0
// Implements `latsch check`: reads a study, its model and its measurements, and reports how it
// interprets them.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>

#include "base/file.h"
#include "base/text.h"
#include "cli/console/answers.h"
#include "cli/console/console.h"
#include "cli/console/implausible.h"
#include "cli/console/ledgers.h"
#include "cli/console/tables.h"
#include "cli/console/tire_faults.h"
#include "cli/run/model_source.h"
#include "cli/verbs/comparison/checked_comparison.h"
#include "cli/verbs/verbs.h"
#include "correlation/analysis/beyond_data.h"
#include "correlation/comparison/model_comparison_file.h"
#include "correlation/search/search_standing.h"
#include "correlation/search/stage_runs.h"
#include "correlation/search/study_method.h"
#include "correlation/study/ledgers/file_ledgers.h"
#include "correlation/study/refinement.h"
#include "correlation/study/study.h"
#include "correlation/study/study_stages.h"
#include "correlation/study/study_start.h"
#include "correlation/study/variables.h"
#include "correlation/target/best_trial.h"
#include "correlation/target/derivative_check.h"
#include "correlation/target/estimated_noise.h"
#include "correlation/target/failed_trials.h"
#include "correlation/target/test_limits.h"
#include "evaluation/journal/journal.h"
#include "evaluation/journal/local_file_system.h"
#include "experiment/language/model_file.h"

namespace latsch::cli {
namespace {

using correlation::Study;
using correlation::StudyExperiment;

std::string values_in_words(std::size_t count) {
  return fmt::format("{} value{}", count, count == 1 ? "" : "s");
}

void print_tests(const Study& study) {
  bool is_first = true;
  for (const correlation::StudyTest& test : study.tests) {
    if (test.is_own || test.name.empty()) continue;
    say("{}  {:<{}} {}\n",
        is_first ? "\nTests\n" : "",
        test.name,
        name_width(study.tests),
        test.test->in_words());
    is_first = false;
  }
}

/// Returns in words what an experiment compares: channels of its own test, or of another
/// experiment's test.
std::string what(const Study& study, const StudyExperiment& experiment) {
  for (const correlation::StudyTest& test : study.tests)
    if (test.name == experiment.name) return test.test->in_words();
  const correlation::Observable& observable = *experiment.observable;
  return observable.compared(experiment.objective) +
         (observable.over().empty() ? "" : " " + observable.over());
}

/// Returns the noise and the loss of a fitted experiment, each after a comma; without a stated
/// noise its spread is estimated.
std::string noise_and_loss_in_words(const StudyExperiment& experiment) {
  std::string text;
  if (!experiment.fitted) return text;
  if (experiment.noise) {
    const std::string& unit = experiment.observable->shown_unit();
    const auto& [relative, absolute] = *experiment.noise;
    text = ", noise ";
    if (absolute > 0.0) text += format_quantity(absolute, unit, 4);
    if (absolute > 0.0 && relative > 0.0) text += " + ";
    if (relative > 0.0) text += format_quantity(relative, "%", 4);
  } else if (experiment.estimates_noise) {
    text = experiment.noise_of_own_stage ? ", noise that of its own stage" : ", noise estimated";
  } else {
    text = ", noise not stated";
  }
  if (experiment.loss.loss != Loss::squares)
    text += fmt::format(", loss {}, scale {:g}{}",
                        experiment.loss.loss == Loss::huber ? "huber" : "cauchy",
                        experiment.loss.scale,
                        experiment.noise ? " deviations" : "");
  return text;
}

void print_experiments(const Study& study) {
  for (const StudyExperiment& experiment : study.experiments) {
    const std::string exponent =
        experiment.objective.exponent == 1.0
            ? ""
            : fmt::format(", exponent {:g}", experiment.objective.exponent);
    const std::string nuisance = experiment.nuisance.in_words();
    say("  {:<{}} {}; {} from {}; {}, weight {:g}{}{}{}\n",
        experiment.name,
        name_width(study.experiments),
        what(study, experiment),
        values_in_words(experiment.values()),
        experiment.measured_in(),
        experiment.fitted ? "fitted" : "predicted",
        experiment.objective.weight,
        exponent,
        noise_and_loss_in_words(experiment),
        nuisance.empty() ? "" : "; solved at every trial: " + nuisance);
  }
}

std::string journal_in_words(const Study& study) {
  const std::string file = study.run.journal.string();
  const auto shared = shared_file_system(study.run.journal);
  return shared ? fmt::format("{} ({}: a rollback log, slower than on a local disk)", file, *shared)
                : file;
}

void answer_check(const Study& study) {
  answer() = {{"title", study.title},
              {"model", study.model_file.string()},
              {"variables", answer_of(study.space)},
              {"method", in_words(method_of(study).method)},
              {"max_steps", study.max_steps},
              {"workers", study.run.workers},
              {"timeout_s", study.run.timeout},
              {"journal", study.run.journal.string()}};
  for (const StudyExperiment& experiment : study.experiments) {
    answer()["experiments"].push_back({{"name", experiment.name},
                                       {"kind", experiment.observable->kind()},
                                       {"values", experiment.values()},
                                       {"measurement", experiment.measurement_file.string()},
                                       {"fitted", experiment.fitted},
                                       {"weight", experiment.objective.weight}});
  }
}

/// Reports on earlier trials: how many failed, why most of them did, for which study they were run,
/// and whether the measurements can be compared with the successful ones.
void print_trials_so_far(const Study& study) {
  if (!std::filesystem::exists(study.run.journal)) return;
  const Journal journal = Journal::read(study.run.journal);
  if (const auto what = difference(journal.identity(), correlation::identity(study))) {
    answer_counts({.trials = journal.size(), .foreign = journal.size()}, /*targets_known=*/false);
    warn(
        fmt::format("its journal {} was made otherwise: {}. None of its {} trials {} of the study "
                    "as it stands. Next: latsch run {} --anew, which keeps it beside",
                    study.run.journal.string(),
                    *what,
                    journal.size(),
                    journal.size() == 1 ? "is" : "are",
                    study.file.string()));
    return;
  }
  const Study weighted = correlation::with_estimated_noise(study, journal);
  const correlation::FailedTrials failures = correlation::failed_trials(weighted, journal);
  const correlation::TrialCounts counts = correlation::count_trials(weighted, journal);
  answer_counts(counts);
  say("{} trials so far, {} of them without a target{}\n",
      counts.trials,
      counts.failed,
      failures.reasons.empty() ? "" : ", most often because: " + failures.reasons.front().first);
  if (failures.timed_out > 0) warn(correlation::in_words(failures), {study.file.string(), 0});
  if (counts.foreign > 0) say("{}\n", correlation::in_words(counts));
  const std::string why = correlation::why_no_best(weighted, journal);
  if (!why.empty()) warn(why, {study.file.string(), 0});
}

void print_stages(const Study& study) {
  if (!study.stages.empty()) say("\nStages\n");
  for (int k = 0; k < std::ssize(study.stages); ++k) {
    const Study stage = correlation::stage(study, k);
    say("  {:<16} {}; {}, at most {} steps; {}\n",
        stage.stage,
        in_words(study.stages[static_cast<std::size_t>(k)]),
        in_words(method_of(stage).method),
        stage.max_steps,
        stage.run.journal.filename().string());
  }
  const std::string start = in_words(study.start);
  if (!start.empty()) say("\nThe search starts at {}\n", start);
}

/// Checks for each variable whether the derivatives that the model computes agree with finite
/// differences of its values.
int check_derivatives(const std::string& file, const experiment::Language& language) {
  const Study study = correlation::read_study(file, language);
  const auto slopes = correlation::check_slopes(study, study.space.initial());
  if (!slopes) {
    complain("a trial fails beside the initial values: " + slopes.failure().reason);
    return kFailed;
  }
  say("Slopes of the residuals in the variables, beside differences of the residuals\n"
      "  {:<16} {:>10}  {:<44} {:>12} {:>12}\n",
      "variable",
      "off by",
      "most in",
      "slope",
      "difference");
  bool all_agree = true;
  for (const auto& one : *slopes) {
    all_agree = all_agree && one.agrees;
    say("  {:<16} {:>10.1e}  {:<44} {:>12.5g} {:>12.5g}{}\n",
        one.variable,
        one.off,
        one.row,
        one.slope,
        one.difference,
        one.agrees ? "" : "  wrong");
    answer()["slopes"].push_back({{"variable", one.variable},
                                  {"most_in", one.row},
                                  {"off", one.off},
                                  {"slope", one.slope},
                                  {"difference", one.difference},
                                  {"agrees", one.agrees}});
  }
  if (all_agree) say("\nAll of them agree\n");
  if (!all_agree) complain("slopes disagree with differences: a fault of the model's derivatives");
  return all_agree ? kDone : kFailed;
}

/// Returns one line on the parameters of a table, such as material.RUBBER: for each unit, first and
/// last name, their count, smallest and largest value.
std::string many_in_words(const std::vector<std::string>& paths, const Document& numbers) {
  std::vector<std::pair<std::string, std::vector<std::string>>> by_unit;
  for (const std::string& path : paths) {
    const std::string unit = numbers.unit(path);
    auto known = std::find_if(
        by_unit.begin(), by_unit.end(), [&](const auto& one) { return one.first == unit; });
    if (known == by_unit.end()) known = by_unit.insert(known, {unit, {}});
    known->second.push_back(path);
  }
  std::string text;
  for (const auto& [unit, same] : by_unit) {
    const auto name = [](const std::string& path) { return path.substr(path.rfind('.') + 1); };
    double low = numbers.get(same.front()), high = low;
    for (const std::string& path : same) {
      low = std::min(low, numbers.get(path));
      high = std::max(high, numbers.get(path));
    }
    if (!text.empty()) text += "; ";
    text += name(same.front());
    if (same.size() > 1) text += fmt::format(" ... {} ({})", name(same.back()), same.size());
    text += " " + format_number(low, 6);
    if (same.size() > 1) text += " to " + format_number(high, 6);
    if (unit != "1") text += " " + unit;
  }
  return text;
}

/// Prints each parameter in a line of its own. A table with many parameters has one line.
void print_numbers(const Document& numbers, const std::string& file) {
  constexpr std::size_t kFew = 6;
  std::vector<std::pair<std::string, std::vector<std::string>>> things;
  for (const std::string& path : numbers.paths()) {
    const std::size_t dot = path.rfind('.');
    const std::string thing = dot == path.npos ? "" : path.substr(0, dot);
    if (things.empty() || things.back().first != thing) things.push_back({thing, {}});
    things.back().second.push_back(path);
  }
  bool shortened = false;
  for (const auto& [thing, paths] : things) {
    if (!thing.empty() && paths.size() > kFew) {
      say("  {:<40} {}\n", thing + ".*", many_in_words(paths, numbers));
      shortened = true;
      continue;
    }
    for (const std::string& path : paths) {
      const std::string unit = numbers.unit(path);
      say("  {:<40} {}{}\n",
          path,
          format_number(numbers.get(path), 6),
          unit == "1" ? "" : " " + unit);
    }
  }
  if (shortened) say("  {:<40} each by itself: latsch show {}\n", "", file);
}

/// Returns the final sentence of a check. A file with warnings is accepted but not called correct.
std::string verdict() {
  const int count = warnings();
  if (count == 0) return "Everything is in order.";
  return fmt::format("Nothing is refused, but there {} {} {}: read {} first.",
                     count == 1 ? "is" : "are",
                     count,
                     count == 1 ? "warning" : "warnings",
                     count == 1 ? "it" : "them");
}

/// Reports on a model file of another program: its kind, the assumptions made for it, and the
/// parameters that a study may vary.
void check_model(const std::string& file, const experiment::Language& language) {
  const experiment::SpecimenKind& kind = language.kind_of_file(file);
  const Document numbers = kind.read(file);
  kind.check(numbers);
  answer() = {{"model", file}, {"kind", kind.name()}};
  say("{}, {}: {}\n\nNumbers a study may vary, by their path\n",
      file,
      kind.in_words(),
      kind.describe(numbers));
  for (const std::string& path : numbers.paths()) {
    const double value = numbers.get(path);
    const std::string unit = numbers.unit(path);
    answer()["numbers"].push_back({{"path", path}, {"value", value}, {"unit", unit}});
  }
  print_numbers(numbers, file);
  say_ledgers(correlation::ledgers_of_file(file, "the model"), LinesTo::output, "Files");
  examine_model(kind, numbers, file);
  say("\n{} Next: a test of it, latsch test {} TEST, or a study with model = \"{}\"\n",
      verdict(),
      file,
      std::filesystem::path(file).filename().string());
}

/// True if the file is a model of some kind: a car, a suspension, a tire. Any other file is read as
/// a study, with the error messages of a study.
bool is_model(const std::string& file, const experiment::Language& language) {
  expect_no_pipe(file);
  if (!experiment::is_document(file)) return true;
  if (is_study(file)) return false;
  const Node root = Document::read(file).root();
  if (root.has("kind")) return language.find_kind(root.text("kind")) != nullptr;
  return std::any_of(language.kinds.begin(), language.kinds.end(), [&](const auto* kind) {
    return kind->recognizes(file);
  });
}

/// Warns if the tire behaves implausibly beyond the data, and of coefficients that the data do not
/// determine. The tire is that of the best trial, or of the initial values if there is none.
void warn_tire(const Study& study) {
  std::optional<DesignPoint> best;
  if (std::filesystem::exists(study.run.journal)) {
    const Journal journal = Journal::read(study.run.journal);
    if (!difference(journal.identity(), correlation::identity(study)))
      if (const auto found =
              correlation::best_trial(correlation::with_estimated_noise(study, journal), journal))
        best = found->point;
  }
  if (best)
    warn_beyond_data(study, *best, "the best trial so far, ");
  else
    warn_beyond_data(study, study.space.initial(), "the initial values, from which a run starts, ");
  for (const std::string& words : correlation::untold_in_words(study))
    warn(words, {study.file.string(), 0});
}

void check(const std::string& file, const experiment::Language& language) {
  if (is_model(file, language)) return check_model(file, language);
  if (const Node root = Document::read(file).root(); root.has("tire") && !root.has("experiment"))
    throw InputError({file, 0},
                     "is a comparison of tires, expected latsch compare " + file +
                         ", which reads it; latsch check reads studies, models and comparisons of "
                         "models");
  if (correlation::is_model_comparison(file)) {
    check_comparison(file, language);
    say("\n{} Next: latsch run {}, which runs its fits and compares\n", verdict(), file);
    return;
  }
  const Study study = correlation::read_study(file, language);
  reject_implausible(study);
  study.specimens->check(study);
  say("{}\n\n{}\n", study.title, study.specimens->describe(study));
  print_tests(study);
  answer_check(study);
  say("\nVariables\n");
  print_variables(study.space);
  if (!study.space.constraints().empty()) say("\nLinear constraints\n");
  print_constraints(study.space);
  say("\nExperiments\n");
  print_experiments(study);
  say_ledgers(study, true, "Files");
  if (!study.constraints.empty()) say("\nConstraints on channels\n");
  for (const auto& constraint : study.constraints) {
    say("  {:<16} {}\n", constraint.name, in_words(constraint));
  }
  print_stages(study);
  if (study.refinement)
    say("\nRefined model, for the effect of mesh and step on the numbers: {}\n",
        in_words(*study.refinement));
  warn_tire(study);
  for (const std::string& limit : correlation::limits_of_tests(study)) warn(limit);
  const MethodChoice choice = method_of(study);
  say("\nOptimizer {}, at most {} steps: {}\n"
      "Workers {}, {:g} s a trial at most, journal {}\n"
      "If a trial fails, {}\n",
      in_words(choice.method),
      study.max_steps,
      choice.reason,
      study.run.workers,
      study.run.timeout,
      journal_in_words(study),
      correlation::in_words(study.run.on_failure));
  print_trials_so_far(study);
  say("\n{} Next: latsch run {}\n", verdict(), file);
}

}  // namespace

void add_check(CommandLine& app, Program& program) {
  Verb verb = app.add_subcommand("check",
                                 "Reads a study, its model and its measurements, a model alone, or "
                                 "a comparison of models, and says what it understood");
  verb.footer(
      "Examples:\n  latsch check studies/tire_b_twin/study.toml\n"
      "  latsch check studies/race_tire_mf/study.toml --derivatives");
  auto file = std::make_shared<std::string>();
  verb.add_option("study",
                  *file,
                  "Study file (TOML); a model alone: a car, a suspension, a tire, .inp, .tir; a "
                  "comparison of models")
      .required();
  auto derivatives = std::make_shared<bool>(false);
  verb.add_flag(
      "--derivatives",
      *derivatives,
      "Compares the slopes that the model reports with differences, four trials for each variable");
  verb.callback([=, &program] {
    if (*derivatives) {
      if (experiment::is_document(*file) && correlation::is_model_comparison(*file))
        throw InputError({*file, 0},
                         "is a comparison of models, expected a study for --derivatives");
      program.exit_code = check_derivatives(*file, program.language);
    } else {
      check(*file, program.language);
    }
  });
}

}  // namespace latsch::cli
