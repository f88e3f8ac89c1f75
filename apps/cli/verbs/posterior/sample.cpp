// SPDX-License-Identifier: Apache-2.0
#include "cli/verbs/posterior/sample.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <utility>

#include "base/units.h"
#include "cli/console/answers.h"
#include "cli/console/console.h"
#include "cli/console/tables.h"
#include "cli/run/interrupt.h"
#include "cli/run/trials.h"
#include "cli/run/workers.h"
#include "correlation/posterior/posterior.h"
#include "correlation/posterior/posterior_file.h"
#include "correlation/search/search_standing.h"
#include "correlation/search/stage_runs.h"
#include "correlation/target/best_trial.h"
#include "correlation/target/trial_ownership.h"

namespace latsch::cli {
namespace {

using correlation::Posterior;
using correlation::Study;

void print_samples(const Study& study, const Posterior& posterior) {
  const std::vector<std::string> names = correlation::axis_names(study, posterior);
  const int width = name_width(study.space.variables());
  say("\n{} samples of the variables, with 95 % intervals\n  {:<{}} {:<16} {:<28} {:<28} {:>6} "
      "{:>6}  {}\n",
      posterior.samples.size(),
      "",
      width,
      "median",
      "samples",
      "linear",
      "R-hat",
      "draws",
      "shape");
  for (std::size_t a = 0; a < names.size(); ++a) {
    const PosteriorShape& shape = posterior.shapes[a];
    const ChainDiagnostics& d = posterior.samples.diagnostics[a];
    const Interval own{shape.lower, shape.upper};
    say("  {:<{}} {:<16} {:<28} {:<28} {:>6.3f} {:>6.0f}  {}\n",
        names[a],
        width,
        correlation::value_text(
            study.space, posterior.axes[a], posterior.value_at(study.space, a, shape.median), own),
        correlation::interval_text(study.space, posterior.axes[a], own),
        correlation::interval_text(study.space, posterior.axes[a], posterior.linear[a]),
        d.rhat,
        std::min(d.bulk, d.tail),
        posterior.is_mixed() ? in_words(shape, names) : "not mixed");
  }
}

/// Warns of variables whose fitted value lies outside of the interval of the samples.
void warn_of_fits_outside(const Study& study, const Posterior& posterior) {
  const std::vector<std::string> names = correlation::axis_names(study, posterior);
  const std::vector<double> fit = study.space.to_unit(posterior.center);
  std::vector<std::string> outside;
  for (std::size_t a = 0; a < names.size(); ++a) {
    const double u = fit[static_cast<std::size_t>(posterior.axes[a])];
    const PosteriorShape& shape = posterior.shapes[a];
    if (u < shape.lower || u > shape.upper) outside.push_back(names[a]);
  }
  answer()["fit_outside"] = outside;
  if (outside.empty()) return;
  warn(
      fmt::format("the fitted value of {} of {} variables lies outside of the interval of the "
                  "samples: {}. Fit and samples weigh the values differently, for example because "
                  "neighbors share noise or weights are stated, or the fit is no minimum; do not "
                  "report the fit with the intervals of the samples",
                  outside.size(),
                  names.size(),
                  fmt::join(outside, ", ")));
}

void print_standing(const Study& study, const Posterior& posterior) {
  say("\n{} trial{} beyond the fit{}; the surrogate learned from {}{}.\n",
      posterior.trials,
      posterior.trials == 1 ? "" : "s",
      posterior.failed > 0 ? fmt::format(", of which {} failed", posterior.failed) : "",
      posterior.learned_from,
      posterior.trials > 0 && !posterior.settled
          ? "; the limit of runs ended the learning, not two good batches in a row"
          : "");
  const std::string verdict = correlation::verdict_text(posterior);
  const std::string without_period = verdict.substr(0, verdict.size() - 1);
  if (!posterior.is_mixed())
    complain(without_period);
  else if (posterior.check.verdict == SurrogateVerdict::stands)
    say("{}\n", verdict);
  else
    warn(without_period);
  for (const std::string& remark : posterior.remarks) say("{}\n", remark);
  for (const int axis : posterior.samples.unmixed) {
    const ChainDiagnostics& d = posterior.samples.diagnostics[static_cast<std::size_t>(axis)];
    warn(
        fmt::format("the chains do not mix in {} after {} steps: R-hat {:.3f}, {:.0f} effective "
                    "draws of the bulk and {:.0f} of the tails, expected at most 1.01 and at least "
                    "400",
                    study.space[posterior.axes[static_cast<std::size_t>(axis)]].name,
                    posterior.samples.steps,
                    d.rhat,
                    d.bulk,
                    d.tail));
  }
}

void answer_samples(const Study& study, const Posterior& posterior) {
  const std::vector<std::string> names = correlation::axis_names(study, posterior);
  for (std::size_t a = 0; a < names.size(); ++a) {
    const PosteriorShape& shape = posterior.shapes[a];
    const DesignVariable& variable = study.space[posterior.axes[a]];
    const Unit unit = Unit::of(variable.unit);
    const auto shown_at = [&](double u) -> Json {
      if (!std::isfinite(u) || u < 0.0 || u > 1.0) return nullptr;
      return unit.from_si(posterior.value_at(study.space, a, u));
    };
    const ChainDiagnostics& d = posterior.samples.diagnostics[a];
    answer()["variables"].push_back(
        {{"name", names[a]},
         {"unit", variable.unit},
         {"median", shown_at(shape.median)},
         {"interval", {shown_at(shape.lower), shown_at(shape.upper)}},
         {"linear", {shown_at(posterior.linear[a].lower), shown_at(posterior.linear[a].upper)}},
         {"shape", posterior.is_mixed() ? Json(in_words(shape, names)) : Json()},
         {"rhat", d.rhat},
         {"bulk", d.bulk},
         {"tail", d.tail}});
  }
  answer()["mixed"] = posterior.is_mixed();
  answer()["samples"] = posterior.samples.size();
  answer()["trials"] = posterior.trials;
  answer()["failed"] = posterior.failed;
  answer()["check"] = {{"verdict", name(posterior.check.verdict)},
                       {"draws", posterior.check.draws},
                       {"failed", posterior.check.failed},
                       {"deviation", posterior.check.deviation},
                       {"largest", posterior.check.largest}};
}

int sample(const std::string& file,
           const experiment::Language& language,
           int workers,
           const std::string& output) {
  Study study = correlation::read_study(file, language);
  if (workers > 0) study.run.workers = workers;
  if (!std::filesystem::exists(study.run.journal))
    throw InputError(study.run.journal.string() +
                     " does not exist: there is no fit whose posterior could be sampled; start "
                     "with latsch run");
  if (const std::string reason = correlation::why_no_posterior(study); !reason.empty())
    throw InputError({study.file.string(), 0}, reason);
  Workers workers_of_study(study);
  if (workers_of_study.served(study)) return kDone;
  Journal journal = Journal::open(study.run.journal, correlation::identity(study));
  const correlation::StagesRun searched = correlation::recorded_stages(study, journal);
  study = searched.study;
  if (workers > 0) study.run.workers = workers;
  correlation::require_best(study, journal);
  correlation::mark_target(study, journal);
  if (!searched.has_ended)
    warn(
        "no search of this study has ended, so the samples are drawn around the best trial so far, "
        "which need not be at a minimum; run latsch run " +
        study.file.string() + " first");
  const auto best = correlation::best_trial(study, journal);
  if (!best) {
    complain("no trial in " + study.run.journal.string() + " succeeded");
    return kFailed;
  }
  catch_interrupts();
  const TrialsRun trials(workers_of_study, study);
  Executor& executor = workers_of_study.start(study);
  const auto found = correlation::sample_posterior(
      study, best->point, executor, journal, counting_options(study, "trials of the posterior"));
  if (!found) {
    say("Interrupted; {} trials are safe. The same command continues.\n", journal.size());
    return kStopped;
  }
  if (!*found) {
    complain(found->failure().reason);
    return kFailed;
  }
  const Posterior& posterior = **found;
  print_samples(study, posterior);
  print_standing(study, posterior);
  warn_of_fits_outside(study, posterior);
  answer_samples(study, posterior);
  const std::filesystem::path to =
      output.empty() ? correlation::samples_file(study) : std::filesystem::path(output);
  correlation::write_samples(study, posterior, to);
  say_written(to.string());
  say("latsch report {} draws the samples beside the linear intervals.\n", study.file.string());
  return posterior.is_mixed() ? kDone : kFailed;
}

}  // namespace

void add_sample(CommandLine& app, Program& program) {
  Verb verb = app.add_subcommand(
      "sample", "Draws samples of the variables' posterior density around the fit");
  verb.footer(
      "Example:\n  latsch sample studies/race_tire_mf/study.toml --workers 2\n\n"
      "Needs a finished latsch run. A surrogate of all residuals learns from the journal and from "
      "up to 50\n"
      "further trials, and ten of them check it. The samples are written beside the study. "
      "[posterior] in the\n"
      "study sets their number. The trials stay in the journal; interrupted, even killed, the same "
      "command\n"
      "goes on.");
  auto file = std::make_shared<std::string>();
  auto workers = std::make_shared<int>(0);
  auto output = std::make_shared<std::string>();
  verb.add_option("study", *file, "Study file (TOML)").required();
  verb.add_option("--workers", *workers, "Worker processes, instead of the study's")
      .between(1, 1024);
  verb.add_option("-o,--output", *output, "CSV file of the samples; beside the study unless given");
  verb.callback(
      [=, &program] { program.exit_code = sample(*file, program.language, *workers, *output); });
}

}  // namespace latsch::cli
