// SPDX-License-Identifier: Apache-2.0
// Implements `latsch pareto`: computes the trade-off between two experiments from the trials in the
// journal.

#include <filesystem>
#include <nlohmann/json.hpp>

#include "base/file.h"
#include "cli/console/answers.h"
#include "cli/console/console.h"
#include "cli/console/tables.h"
#include "cli/verbs/verbs.h"
#include "correlation/analysis/pareto_front.h"
#include "correlation/search/search_standing.h"
#include "correlation/search/stage_runs.h"

namespace latsch::cli {
namespace {

int pareto(const std::string& file,
           const experiment::Language& language,
           const std::string& a,
           const std::string& b) {
  if (a == b)
    throw InputError("pareto: an experiment has no front against itself; expected two of them");
  auto study = correlation::read_study(file, language);
  const auto journal = Journal::read(study.run.journal, correlation::identity(study));
  study = correlation::with_estimated_noise(study, journal);
  auto found = correlation::pareto_front(study, journal, a, b);
  found.no_best = correlation::why_no_best(study, journal);
  if (found.no_best.empty() && !correlation::recorded_stages(study, journal).has_ended)
    found.no_best = "no search of this study has ended: the least target need not be at a minimum";
  if (!found.no_best.empty()) warn(found.no_best, {study.file.string(), 0});
  const std::string least = found.no_best.empty() ? "best" : "nearest";
  say("{} trials in {}, none was run for this\n\n{} by the weights of the study: target {:.4f} %\n",
      found.front.size() + found.others.size(),
      study.run.journal.string(),
      found.no_best.empty() ? "Best" : "Nearest, though no search has looked for it,",
      100.0 * found.best.target);
  print_values(study.space, found.best_values);
  say("\nPareto front: no trial is better in both\n  {:>14} {:>14} {:>14}\n",
      a + " %",
      b + " %",
      "target %");
  for (const auto& trial : found.front) {
    say("  {:>14.4f} {:>14.4f} {:>14.4f}{}\n",
        100.0 * trial.a,
        100.0 * trial.b,
        100.0 * trial.target,
        trial.point == found.best.point ? "  " + least : "");
  }
  Json& of_least = found.no_best.empty() ? answer() : answer()["nearest"];
  of_least["target"] = found.best.target;
  of_least["variables"] = answer_of(study.space, found.best.point);
  for (const auto& trial : found.front) {
    answer()["front"].push_back({{a, trial.a},
                                 {b, trial.b},
                                 {"target", trial.target},
                                 {"variables", answer_of(study.space, trial.point)}});
  }
  const auto page = std::filesystem::path(study.run.journal).replace_extension(".pareto.html");
  write_text_file(page, correlation::pareto_page(study, found));
  say("\nPicture, and the variables along it: {}\n", page.string());
  return kDone;
}

}  // namespace

void add_pareto(CommandLine& app, Program& program) {
  Verb verb = app.add_subcommand("pareto",
                                 "Compares two experiments by their errors in the trials of "
                                 "the journal");
  verb.footer(
      "Example:\n  latsch pareto studies/tire_b_twin/study.toml stiffness modes\n\n"
      "Also the trial of the least target by the weights the study has now: nothing is simulated. "
      "It is\n"
      "called the best if a search has run with these weights.");
  auto file = std::make_shared<std::string>();
  auto a = std::make_shared<std::string>(), b = std::make_shared<std::string>();
  verb.add_option("study", *file, "Study file (TOML)").required();
  verb.add_option("a", *a, "Name of a fitted experiment").required();
  verb.add_option("b", *b, "Name of another one").required();
  verb.callback([=, &program] { program.exit_code = pareto(*file, program.language, *a, *b); });
}

}  // namespace latsch::cli
